/* A program of somebody else's that links libcrt: it asks a ray, renders a small picture and writes
 * it. usage: program picture.png */
#include <crt/crt.h>
#include <math.h>
#include <stdio.h>

#define STEP(call)                                                                            \
  do {                                                                                        \
    const crt_status status = (call);                                                         \
    if (status != CRT_OK) {                                                                   \
      fprintf(stderr, "%s: %s: %s\n", #call, crt_status_string(status), crt_error_message()); \
      return 1;                                                                               \
    }                                                                                         \
  } while (0)

int main(int argc, char** argv) {
  static const char script[] = "Scene { Sphere { center -> vec3(0, 0, 2) radius -> 1 } }";
  const crt_ray ray = {{0, 0, -5}, {0, 0, 1}, 0, INFINITY};
  crt_settings settings;
  crt_light light;
  crt_scene* scene = NULL;
  crt_prepared* prepared = NULL;
  crt_image* image = NULL;
  crt_hit hit;

  if (argc != 2) return 2;
  STEP(crt_scene_from_script(script, sizeof script - 1, "sphere.crt", NULL, NULL, &scene));
  STEP(crt_light_init(&light, sizeof light));
  light.origin[1] = 3;
  STEP(crt_scene_add_light(scene, &light));
  STEP(crt_settings_init(&settings, sizeof settings));
  settings.width = 64;
  settings.height = 48;
  STEP(crt_scene_set_settings(scene, &settings));
  STEP(crt_scene_prepare(scene, &prepared));

  STEP(crt_intersect(prepared, &ray, 0, 1, &hit, 0));
  if (hit.t != 6 || hit.normal[2] != -1) {
    fprintf(stderr, "the sphere was hit at t = %g, not 6\n", hit.t);
    return 1;
  }

  STEP(crt_render(prepared, NULL, &image));
  STEP(crt_image_write(image, argv[1]));
  printf("libcrt %u.%u.%u: %s has %u x %u pixels\n", crt_version() >> 16, crt_version() >> 8 & 255,
         crt_version() & 255, argv[1], crt_image_width(image), crt_image_height(image));

  crt_image_release(image);
  crt_prepared_release(prepared);
  crt_scene_release(scene);
  return 0;
}
