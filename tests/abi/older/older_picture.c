// This program is compiled against an older crt.h. Guards behind each struct show that the library
// leaves alone what this version of the structs does not have.
#include <stdio.h>
#include <string.h>

#include "older_crt.h"
#include "picture.h"

enum { guard_bytes = 200, guard_value = 0x5a };

// Declares a struct with a guard behind it.
#define GUARDED(type, name)           \
  struct {                            \
    type value;                       \
    unsigned char guard[guard_bytes]; \
  } name;                             \
  memset(&(name), guard_value, sizeof(name))

static int failed = 0;

static void expect(int condition, const char* what) {
  if (condition) return;
  printf("older program: not so: %s (%s)\n", what, crt_error_message());
  failed = 1;
}
#define EXPECT(condition) expect((condition), #condition)

static int untouched(const unsigned char* guard) {
  for (int i = 0; i < guard_bytes; ++i) {
    if (guard[i] != guard_value) return 0;
  }
  return 1;
}

// Adds a checkered ball. Pattern and material have only fields of the older version.
static void add_ball(crt_scene* scene) {
  static const double center[3] = {0, 0, 2};
  crt_entity* bare = NULL;
  crt_entity* ball = NULL;
  GUARDED(crt_pattern, pattern);
  GUARDED(crt_material, material);
  EXPECT(crt_pattern_init(&pattern.value, sizeof pattern.value) == 0);
  pattern.value.color_a[0] = 0.25;
  EXPECT(crt_material_init(&material.value, sizeof material.value) == 0);
  material.value.pattern = &pattern.value;
  EXPECT(crt_sphere_create(center, 1, &bare) == 0);
  EXPECT(crt_entity_with_material(bare, &material.value, &ball) == 0);
  EXPECT(crt_scene_add_entity(scene, ball) == 0);
  EXPECT(untouched(pattern.guard) && untouched(material.guard));
  crt_entity_release(bare);
  crt_entity_release(ball);
}

static void set_scene(crt_scene* scene) {
  GUARDED(crt_light, light);
  GUARDED(crt_camera, camera);
  GUARDED(crt_background, background);
  GUARDED(crt_settings, settings);
  EXPECT(crt_light_init(&light.value, sizeof light.value) == 0);
  light.value.origin[1] = 3;
  EXPECT(crt_scene_add_light(scene, &light.value) == 0);
  EXPECT(crt_camera_init(&camera.value, sizeof camera.value) == 0);
  camera.value.position[2] = -2;
  EXPECT(crt_scene_set_camera(scene, &camera.value) == 0);
  EXPECT(crt_background_init(&background.value, sizeof background.value) == 0);
  background.value.color[2] = 0.5;
  EXPECT(crt_scene_set_background(scene, &background.value) == 0);
  EXPECT(crt_settings_init(&settings.value, sizeof settings.value) == 0);
  settings.value.width = picture_width;
  settings.value.height = picture_height;
  EXPECT(crt_scene_set_settings(scene, &settings.value) == 0);

  camera.value.position[2] = 0;
  EXPECT(crt_scene_get_camera(scene, &camera.value) == 0);
  EXPECT(camera.value.position[2] == -2);
  EXPECT(untouched(light.guard) && untouched(camera.guard));
  EXPECT(untouched(background.guard) && untouched(settings.guard));
}

static void render(crt_scene* scene, uint8_t* pixels) {
  crt_prepared* prepared = NULL;
  crt_image* image = NULL;
  GUARDED(crt_render_options, options);
  GUARDED(crt_render_stats, stats);
  GUARDED(crt_write_options, write_options);
  EXPECT(crt_scene_prepare(scene, &prepared) == 0);
  EXPECT(crt_render_options_init(&options.value, sizeof options.value) == 0);
  options.value.threads = 1;
  EXPECT(crt_render(prepared, &options.value, &image) == 0);
  EXPECT(crt_image_to_rgba8(image, pixels, 0) == 0);

  stats.value.struct_size = sizeof stats.value;
  EXPECT(crt_image_stats(image, &stats.value) == 0);
  EXPECT(stats.value.threads == 1 && stats.value.pixels == picture_width * picture_height);
  EXPECT(crt_write_options_init(&write_options.value, sizeof write_options.value) == 0);
  EXPECT(crt_image_write_with(image, "older.png", &write_options.value) == 0);
  EXPECT(untouched(options.guard) && untouched(stats.guard) && untouched(write_options.guard));
  crt_image_release(image);
  crt_prepared_release(prepared);
}

static void run_wrong_script(void) {
  static const char script[] = "Scene {\n  Spher {}\n}\n";
  crt_diagnostics* diagnostics = NULL;
  crt_scene* scene = NULL;
  GUARDED(crt_script_options, options);
  GUARDED(crt_diagnostic, diagnostic);
  EXPECT(crt_script_options_init(&options.value, sizeof options.value) == 0);
  EXPECT(crt_scene_from_script(script, sizeof script - 1, "wrong.crt", &options.value, &diagnostics,
                               &scene) != 0);
  diagnostic.value.struct_size = sizeof diagnostic.value;
  EXPECT(crt_diagnostics_get(diagnostics, 0, &diagnostic.value) == 0);
  EXPECT(diagnostic.value.line == 2);
  EXPECT(untouched(options.guard) && untouched(diagnostic.guard));
  crt_diagnostics_release(diagnostics);
}

int older_picture(uint8_t* pixels) {
  crt_scene* scene = NULL;
  EXPECT(crt_scene_create(&scene) == 0);
  add_ball(scene);
  set_scene(scene);
  render(scene, pixels);
  run_wrong_script();
  crt_scene_release(scene);
  return failed;
}
