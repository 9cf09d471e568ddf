// A program that uses much of version 1.0's interface and checks what it gets. program.o was made
// of it once, with that version's header, and is linked with every later library: see README.md.
#include <crt/crt.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

static void expect(int condition, const char* what, int line) {
  if (condition) return;
  printf("program.c:%d: not so: %s (%s)\n", line, what, crt_error_message());
  ++failures;
}
// A program keeps the defaults of the version that it was compiled with.
#if CRT_VERSION_MAJOR == 1 && CRT_VERSION_MINOR == 0
static const double usual_gamma = 1;
#else
static const double usual_gamma = 2.2;
#endif

#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == CRT_OK, #call, __LINE__)

// A plate with a hole.
static crt_entity* make_part(void) {
  static const double low[3] = {-1, -1, 0}, high[3] = {1, 1, 1}, from[3] = {0, 0, -1},
                      to[3] = {0, 0, 2};
  static const double moved[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 3};
  crt_entity *plate = NULL, *hole = NULL, *part = NULL, *placed = NULL, *numbered = NULL;
  EXPECT_OK(crt_box_create(low, high, &plate));
  EXPECT_OK(crt_cylinder_create(from, to, 0.5, &hole));
  EXPECT_OK(crt_difference_create(plate, &hole, 1, &part));
  EXPECT_OK(crt_entity_with_transform(part, moved, &placed));
  EXPECT_OK(crt_entity_with_id(placed, 77, &numbered));
  EXPECT(crt_entity_is_solid(numbered) == 1);
  EXPECT(crt_entity_primitive_count(numbered) == 2);
  crt_entity_release(plate);
  crt_entity_release(hole);
  crt_entity_release(part);
  crt_entity_release(placed);
  return numbered;
}

static void add_others(crt_scene* scene) {
  static const double far_away[3] = {20, 0, 0}, farther[3] = {22, 0, 0}, up[3] = {0, 1, 0},
                      along[3] = {1, 0, 0};
  static const double positions[12] = {30, 0, 0, 31, 0, 0, 30, 1, 0, 31, 1, 0};
  static const uint32_t indices[6] = {0, 1, 2, 2, 1, 3};
  crt_entity* made[9] = {NULL};
  EXPECT_OK(crt_sphere_create(far_away, 1, &made[0]));
  EXPECT_OK(crt_cone_create(far_away, farther, 1, 0.5, &made[1]));
  EXPECT_OK(crt_torus_create(far_away, up, 1, 0.25, &made[2]));
  EXPECT_OK(crt_disc_create(far_away, along, 1, &made[3]));
  EXPECT_OK(crt_triangle_create(positions, positions + 3, positions + 6, &made[4]));
  EXPECT_OK(crt_mesh_create(positions, 4, indices, 2, &made[5]));
  EXPECT_OK(crt_half_plane_create(along, farther, up, &made[6]));
  EXPECT_OK(crt_union_create(made, 3, &made[7]));
  EXPECT_OK(crt_intersection_create(made, 2, &made[8]));
  EXPECT(crt_entity_is_solid(made[5]) == 0);
  for (int i = 0; i < 9; ++i) {
    EXPECT_OK(crt_scene_add_entity(scene, made[i]));
    crt_entity_release(made[i]);
  }
}

static crt_image* make_texture(void) {
  static const float pixels[16] = {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 1};
  crt_image *image = NULL, *decoded = NULL;
  crt_buffer* buffer = NULL;
  size_t stride = 0;
  EXPECT_OK(crt_image_create(2, 2, pixels, 0, &image));
  EXPECT(crt_image_width(image) == 2 && crt_image_height(image) == 2);
  EXPECT(memcmp(crt_image_pixels(image, &stride), pixels, sizeof pixels) == 0 && stride == 32);
  EXPECT_OK(crt_image_encode(image, "exr", NULL, &buffer));
  EXPECT_OK(
      crt_image_decode(crt_buffer_data(buffer), crt_buffer_size(buffer), "texture.exr", &decoded));
  EXPECT(crt_image_width(decoded) == 2);
  crt_buffer_release(crt_buffer_retain(buffer));
  crt_buffer_release(buffer);
  crt_image_release(image);
  return decoded;
}

static void add_textured_floor(crt_scene* scene, const crt_image* texture) {
  static const double up[3] = {0, 1, 0}, below[3] = {0, -1, 0};
  crt_entity *bare = NULL, *floor = NULL;
  crt_pattern pattern;
  crt_material material;
  EXPECT_OK(crt_pattern_init(&pattern, sizeof pattern));
  EXPECT(pattern.type == CRT_PATTERN_CHECKER && pattern.repeat_v == 1);
  EXPECT_OK(crt_pattern_init_type(&pattern, sizeof pattern, CRT_PATTERN_IMAGE));
  pattern.image = texture;
  EXPECT_OK(crt_material_init(&material, sizeof material));
  material.pattern = &pattern;
  material.reflectivity = 0.25;
  EXPECT_OK(crt_plane_create(up, below, &bare));
  EXPECT_OK(crt_entity_with_material(bare, &material, &floor));
  EXPECT_OK(crt_scene_add_entity(scene, floor));
  crt_entity_release(bare);
  crt_entity_release(floor);
}

static void set_scene(crt_scene* scene) {
  crt_light light;
  crt_camera camera;
  crt_background background;
  crt_settings settings;
  EXPECT_OK(crt_light_init_type(&light, sizeof light, CRT_LIGHT_SPOT));
  light.origin[1] = 5;
  light.origin[2] = -5;
  light.pointing[2] = 3;
  EXPECT_OK(crt_scene_add_light(scene, &light));
  EXPECT_OK(crt_light_init(&light, sizeof light));
  light.ambient = 0.125;
  EXPECT_OK(crt_scene_add_light(scene, &light));
  EXPECT_OK(crt_camera_init(&camera, sizeof camera));
  camera.position[2] = -2;
  camera.fov = 0.75;
  EXPECT_OK(crt_scene_set_camera(scene, &camera));
  EXPECT_OK(crt_background_init(&background, sizeof background));
  background.type = CRT_BACKGROUND_GRADIENT;
  EXPECT_OK(crt_scene_set_background(scene, &background));
  EXPECT_OK(crt_settings_init(&settings, sizeof settings));
  settings.width = 64;
  settings.height = 48;
  settings.title = "the oldest program";
  EXPECT_OK(crt_scene_set_settings(scene, &settings));

  memset(&camera, 0, sizeof camera);
  camera.struct_size = sizeof camera;
  EXPECT_OK(crt_scene_get_camera(scene, &camera));
  EXPECT(camera.fov == 0.75 && camera.focal_distance == 1);
  EXPECT(crt_scene_light_count(scene) == 2);
  EXPECT_OK(crt_scene_get_light(scene, 1, &light));
  EXPECT(light.type == CRT_LIGHT_POINT && light.ambient == 0.125);
  EXPECT_OK(crt_scene_get_background(scene, &background));
  EXPECT(background.type == CRT_BACKGROUND_GRADIENT && background.image == NULL);
  EXPECT_OK(crt_scene_get_settings(scene, &settings));
  EXPECT(settings.width == 64 && settings.gamma == usual_gamma &&
         (settings.author == NULL || settings.author[0] == 0));
}

// A ray inside a struct of the program's own.
typedef struct probe {
  int32_t number;
  crt_ray ray;
  crt_hit hit;
} probe;

static void ask_rays(crt_prepared* prepared) {
  const crt_ray hits_plate = {{0.75, 0, 0}, {0, 0, 1}, 0, INFINITY};
  const crt_ray through_hole = {{0, 0, 0}, {0, 0, 1}, 0, 10};
  probe probes[2];
  uint8_t occluded[2] = {9, 9};
  crt_hit crossings[4];
  size_t count = 0;
  memset(probes, 0, sizeof probes);
  probes[0].ray = hits_plate;
  probes[1].ray = through_hole;
  EXPECT_OK(
      crt_intersect(prepared, &probes[0].ray, sizeof(probe), 2, &probes[0].hit, sizeof(probe)));
  EXPECT(probes[0].hit.t == 3 && probes[0].hit.entity_id == 77 && probes[0].hit.normal[2] == -1);
  EXPECT((probes[0].hit.flags & CRT_HIT_ENTERING) != 0);
  EXPECT(isinf(probes[1].hit.t));
  EXPECT_OK(crt_occluded(prepared, &probes[0].ray, sizeof(probe), 2, occluded));
  EXPECT(occluded[0] == 1 && occluded[1] == 0);
  EXPECT_OK(crt_crossings(prepared, &hits_plate, crossings, 4, &count));
  EXPECT(count == 2 && crossings[0].t == 3 && crossings[1].t == 4);
}

// Writes the image as it is and darker, and reads it again.
static void use_files(const crt_image* image) {
  static uint8_t written[64 * 48 * 4], found[64 * 48 * 4];
  crt_write_options options;
  crt_settings settings;
  crt_image *read = NULL, *again = NULL, *darker = NULL;
  EXPECT_OK(crt_image_to_rgba8(image, written, 0));
  EXPECT_OK(crt_write_options_init(&options, sizeof options));
  options.reproducible = 1;
  EXPECT_OK(crt_image_write(image, "oldest.png"));
  EXPECT_OK(crt_image_write_with(image, "oldest.png", &options));
  EXPECT_OK(crt_image_read("oldest.png", &read));
  EXPECT_OK(crt_image_to_rgba8(read, found, 64 * 4));
  EXPECT(memcmp(written, found, sizeof written) == 0);
  EXPECT_OK(crt_image_from_rgba8(64, 48, written, 0, &again));
  EXPECT(crt_image_width(again) == 64);
  EXPECT_OK(crt_settings_init(&settings, sizeof settings));
  settings.gamma = 0.5;
  EXPECT_OK(crt_image_with_settings(image, &settings, &darker));
  EXPECT_OK(crt_image_to_rgba8(darker, found, 0));
  EXPECT(memcmp(written, found, sizeof written) != 0);
  crt_image_release(read);
  crt_image_release(again);
  crt_image_release(darker);
}

static int see_progress(double fraction, void* user) {
  double* const last = user;
  EXPECT(fraction >= *last);
  *last = fraction;
  return 0;
}

static int cancel_at_once(double fraction, void* user) {
  (void)fraction;
  (void)user;
  return 42;
}

static void render(crt_prepared* prepared) {
  crt_render_options options;
  crt_render_stats stats;
  crt_settings settings;
  crt_image *image = NULL, *same = NULL, *so_far = NULL, *none = NULL;
  crt_job* job = NULL;
  double last = 0, fraction = 0;
  size_t stride = 0;
  EXPECT_OK(crt_render_options_init(&options, sizeof options));
  options.threads = 2;
  options.progress = see_progress;
  options.progress_user = &last;
  EXPECT_OK(crt_render(prepared, &options, &image));
  EXPECT(last == 1);
  stats.struct_size = sizeof stats;
  EXPECT_OK(crt_image_stats(image, &stats));
  EXPECT(stats.pixels == 64 * 48 && stats.camera_rays == 64 * 48);
  settings.struct_size = sizeof settings;
  EXPECT_OK(crt_image_settings(image, &settings));
  EXPECT(settings.width == 64 && strcmp(settings.title, "the oldest program") == 0);
  use_files(image);

  EXPECT_OK(crt_render_start(prepared, NULL, &job));
  EXPECT_OK(crt_job_wait(job, &same));
  EXPECT(crt_job_is_finished(job) == 1 && crt_job_is_finished(NULL) == 0);
  EXPECT_OK(crt_job_progress(job, &fraction));
  EXPECT(fraction == 1);
  EXPECT_OK(crt_job_snapshot(job, &so_far));
  EXPECT(memcmp(crt_image_pixels(image, NULL), crt_image_pixels(same, &stride), 64 * 48 * 16) == 0);
  EXPECT(stride == 64 * 16);
  EXPECT_OK(crt_job_cancel(job));
  crt_job_release(crt_job_retain(job));
  crt_job_release(job);

  options.progress = cancel_at_once;
  EXPECT(crt_render(prepared, &options, &none) == CRT_ERROR_CANCELLED && none == NULL);
  EXPECT(crt_cancel_value() == 42);
  crt_image_release(crt_image_retain(image));
  crt_image_release(image);
  crt_image_release(same);
  crt_image_release(so_far);
}

static int open_file(const char* path, crt_file_content* content, void* user) {
  static const char text[] = "radius_of_ball = 2";
  (void)user;
  if (strstr(path, "given.crt") == NULL) return CRT_FILE_NOT_GIVEN;
  EXPECT_OK(crt_file_content_append(content, text, sizeof text - 1));
  return CRT_FILE_GIVEN;
}

static int see_line(const char* line, size_t length, void* user) {
  *(int*)user += length == 5 && memcmp(line, "hello", 5) == 0;
  return 0;
}

static void run_scripts(void) {
  static const char wrong[] =
      "ball = Macro (r) { Sphere { center -> vec3(0, 0, 0) radius -> r } }\nScene {\n  "
      "ball(-1)\n}\n";
  static const char right[] =
      "import \"given.crt\"\n"
      "print(\"hello\")\n"
      "Scene { Sphere { center -> vec3(0, 0, 2) radius -> radius_of_ball } }\n";
  crt_script_options options;
  crt_diagnostics* diagnostics = NULL;
  crt_diagnostic diagnostic;
  crt_diagnostic_call call;
  crt_scene* scene = NULL;
  int lines = 0;
  EXPECT_OK(crt_script_options_init(&options, sizeof options));
  options.open_file = open_file;
  options.print = see_line;
  options.print_user = &lines;
  EXPECT(crt_scene_from_script(wrong, sizeof wrong - 1, "wrong.crt", &options, &diagnostics,
                               &scene) == CRT_ERROR_SCRIPT);
  EXPECT(crt_diagnostics_count(diagnostics) == 1 && scene == NULL);
  diagnostic.struct_size = sizeof diagnostic;
  EXPECT_OK(crt_diagnostics_get(diagnostics, 0, &diagnostic));
  EXPECT(diagnostic.severity == CRT_SEVERITY_ERROR && diagnostic.line == 1 &&
         diagnostic.call_count == 1);
  call.struct_size = sizeof call;
  EXPECT_OK(crt_diagnostics_get_call(diagnostics, 0, 0, &call));
  EXPECT(call.line == 3 && strcmp(call.name, "ball") == 0);
  EXPECT(strstr(crt_diagnostics_text(diagnostics), "wrong.crt") != NULL);
  EXPECT(crt_diagnostics_json(diagnostics)[0] == '[');
  crt_diagnostics_release(crt_diagnostics_retain(diagnostics));
  crt_diagnostics_release(diagnostics);

  EXPECT_OK(crt_scene_from_script(right, sizeof right - 1, "right.crt", &options, NULL, &scene));
  EXPECT(lines == 1);
  EXPECT(crt_scene_entity_count(scene) == 1);
  EXPECT(crt_scene_from_script_file("not there.crt", NULL, NULL, &scene) == CRT_ERROR_IO);
  EXPECT_OK(crt_scene_clear_lights(scene));
  crt_scene_release(crt_scene_retain(scene));
  crt_scene_release(scene);
}

static void make_mistakes(void) {
  static const double center[3] = {0, 0, 0};
  crt_entity* entity = NULL;
  EXPECT(crt_sphere_create(center, -1, &entity) == CRT_ERROR_INVALID_ARGUMENT && entity == NULL);
  EXPECT(strstr(crt_error_message(), "radius") != NULL);
  EXPECT(crt_sphere_create(center, 1, NULL) == CRT_ERROR_INVALID_ARGUMENT);
  EXPECT(strcmp(crt_status_string(CRT_OK), "ok") == 0);
  crt_entity_release(NULL);
}

int main(void) {
  crt_scene *scene = NULL, *copy = NULL;
  crt_prepared* prepared = NULL;
  crt_entity *part = NULL, *first = NULL;
  crt_image* texture = NULL;
  EXPECT(crt_version() >> 16 == 1);
  make_mistakes();
  run_scripts();
  EXPECT_OK(crt_scene_create(&scene));
  part = make_part();
  texture = make_texture();
  EXPECT_OK(crt_scene_add_entity(scene, part));
  add_others(scene);
  add_textured_floor(scene, texture);
  set_scene(scene);
  EXPECT(crt_scene_entity_count(scene) == 11);
  EXPECT_OK(crt_scene_get_entity(scene, 0, &first));
  crt_entity_release(crt_entity_retain(first));
  EXPECT_OK(crt_scene_copy(scene, &copy));
  EXPECT_OK(crt_scene_clear_entities(scene));
  EXPECT_OK(crt_scene_prepare(copy, &prepared));
  crt_image_release(texture);
  crt_entity_release(part);
  crt_entity_release(first);
  crt_scene_release(scene);
  crt_scene_release(copy);
  ask_rays(prepared);
  render(prepared);
  crt_prepared_release(crt_prepared_retain(prepared));
  crt_prepared_release(prepared);
  if (failures == 0) puts("all as in 1.0");
  return failures != 0;
}
