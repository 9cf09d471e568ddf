// Makes the same picture as older_picture.c by a program of today, which has every field at its
// default.
#include <crt/crt.h>

#include "picture.h"

static int add_ball(crt_scene* scene) {
  static const double center[3] = {0, 0, 2};
  crt_entity* bare = NULL;
  crt_entity* ball = NULL;
  crt_pattern pattern;
  crt_material material;
  int failed =
      crt_pattern_init(&pattern, sizeof pattern) || crt_material_init(&material, sizeof material);
  pattern.color_a[0] = 0.25;
  material.pattern = &pattern;
  failed = failed || crt_sphere_create(center, 1, &bare) ||
           crt_entity_with_material(bare, &material, &ball) || crt_scene_add_entity(scene, ball);
  crt_entity_release(bare);
  crt_entity_release(ball);
  return failed;
}

static int set_scene(crt_scene* scene) {
  crt_light light;
  crt_camera camera;
  crt_background background;
  crt_settings settings;
  const int failed = crt_light_init(&light, sizeof light) ||
                     crt_camera_init(&camera, sizeof camera) ||
                     crt_background_init(&background, sizeof background) ||
                     crt_settings_init(&settings, sizeof settings);
  if (failed) return 1;
  light.origin[1] = 3;
  camera.position[2] = -2;
  background.color[2] = 0.5;
  settings.width = picture_width;
  settings.height = picture_height;
  return crt_scene_add_light(scene, &light) || crt_scene_set_camera(scene, &camera) ||
         crt_scene_set_background(scene, &background) || crt_scene_set_settings(scene, &settings);
}

int current_picture(uint8_t* pixels) {
  crt_scene* scene = NULL;
  crt_prepared* prepared = NULL;
  crt_image* image = NULL;
  const int failed = crt_scene_create(&scene) || add_ball(scene) || set_scene(scene) ||
                     crt_scene_prepare(scene, &prepared) || crt_render(prepared, NULL, &image) ||
                     crt_image_to_rgba8(image, pixels, 0);
  crt_image_release(image);
  crt_prepared_release(prepared);
  crt_scene_release(scene);
  return failed;
}
