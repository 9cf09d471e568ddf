// crt.h as an older version might have had it: each struct that may grow ends earlier, where its
// comment says. Compiled into programs for good, and so never brought up to date.
#pragma once

#include <stddef.h>
#include <stdint.h>

typedef struct crt_entity crt_entity;
typedef struct crt_scene crt_scene;
typedef struct crt_prepared crt_prepared;
typedef struct crt_image crt_image;
typedef struct crt_diagnostics crt_diagnostics;

typedef struct crt_pattern {  // before `direction`
  uint32_t struct_size;
  int32_t type;
  double color_a[3];
  double alpha_a;
  double color_b[3];
  double alpha_b;
} crt_pattern;

typedef struct crt_material {  // before `reflectivity`
  uint32_t struct_size;
  int32_t reserved;
  double color[3];
  double alpha;
  const crt_pattern* pattern;
} crt_material;

typedef struct crt_light {  // before `pointing`
  uint32_t struct_size;
  int32_t type;
  double origin[3];
} crt_light;

typedef struct crt_camera {  // before `fov`
  uint32_t struct_size;
  int32_t projection;
  double position[3];
  double pointing[3];
} crt_camera;

typedef struct crt_background {  // before `alpha`
  uint32_t struct_size;
  int32_t type;
  double color[3];
} crt_background;

typedef struct crt_settings {  // before `supersampling`
  uint32_t struct_size;
  int32_t width;
  int32_t height;
} crt_settings;

typedef struct crt_script_options {  // before `resource_directories`
  uint32_t struct_size;
  int32_t allow_outside_files;
} crt_script_options;

typedef struct crt_diagnostic {  // before `column`
  uint32_t struct_size;
  int32_t severity;
  int32_t status;
  int32_t line;
} crt_diagnostic;

typedef struct crt_render_options {  // before `region_x`
  uint32_t struct_size;
  int32_t threads;
} crt_render_options;

typedef struct crt_render_stats {  // before `camera_rays`
  uint32_t struct_size;
  int32_t threads;
  uint64_t pixels;
} crt_render_stats;

typedef struct crt_write_options {  // before `reproducible`
  uint32_t struct_size;
} crt_write_options;

const char* crt_error_message(void);
void crt_entity_release(crt_entity* entity);
void crt_scene_release(crt_scene* scene);
void crt_prepared_release(crt_prepared* prepared);
void crt_image_release(crt_image* image);
void crt_diagnostics_release(crt_diagnostics* diagnostics);

int crt_pattern_init(crt_pattern* pattern, size_t struct_size);
int crt_material_init(crt_material* material, size_t struct_size);
int crt_light_init(crt_light* light, size_t struct_size);
int crt_camera_init(crt_camera* camera, size_t struct_size);
int crt_background_init(crt_background* background, size_t struct_size);
int crt_settings_init(crt_settings* settings, size_t struct_size);
int crt_script_options_init(crt_script_options* options, size_t struct_size);
int crt_render_options_init(crt_render_options* options, size_t struct_size);
int crt_write_options_init(crt_write_options* options, size_t struct_size);

int crt_sphere_create(const double center[3], double radius, crt_entity** out);
int crt_entity_with_material(crt_entity* entity, const crt_material* material, crt_entity** out);
int crt_scene_create(crt_scene** out);
int crt_scene_from_script(const char* text, size_t length, const char* name,
                          const crt_script_options* options, crt_diagnostics** diagnostics,
                          crt_scene** out);
int crt_diagnostics_get(const crt_diagnostics* diagnostics, size_t index,
                        crt_diagnostic* diagnostic);
int crt_scene_add_entity(crt_scene* scene, crt_entity* entity);
int crt_scene_add_light(crt_scene* scene, const crt_light* light);
int crt_scene_set_camera(crt_scene* scene, const crt_camera* camera);
int crt_scene_set_background(crt_scene* scene, const crt_background* background);
int crt_scene_set_settings(crt_scene* scene, const crt_settings* settings);
int crt_scene_get_camera(const crt_scene* scene, crt_camera* camera);
int crt_scene_prepare(crt_scene* scene, crt_prepared** out);
int crt_render(crt_prepared* prepared, const crt_render_options* options, crt_image** out);
int crt_image_to_rgba8(const crt_image* image, uint8_t* pixels, size_t row_stride);
int crt_image_stats(const crt_image* image, crt_render_stats* stats);
int crt_image_write_with(const crt_image* image, const char* path,
                         const crt_write_options* options);
