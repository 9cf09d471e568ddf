// A pipe flange with a quarter cut away: solids, materials, lights, a camera, a line of progress,
// and at last a picture, scene.png.
//
// Functions return 0 if all is well, as those of CRT do. So calls are chained with ||: the first
// that fails ends the chain, and crt_error_message() tells why. Releasing NULL does no harm.
#include <crt/crt.h>
#include <math.h>
#include <stdio.h>

static const double pi = 3.14159265358979323846;
enum { hole_count = 8, cutter_count = hole_count + 3 };

// Gives a material to all of `*entity` that has none, and puts the result in its place.
static int paint(crt_entity** entity, double red, double green, double blue, double reflectivity) {
  crt_material material;
  crt_entity* painted = NULL;
  if (crt_material_init(&material, sizeof material)) return 1;
  material.color[0] = red;
  material.color[1] = green;
  material.color[2] = blue;
  material.reflectivity = reflectivity;
  material.specular = 0.6;
  material.shininess = 50;
  if (crt_entity_with_material(*entity, &material, &painted)) return 1;
  crt_entity_release(*entity);
  *entity = painted;
  return 0;
}

static int upright_cylinder(double x, double z, double radius, double bottom, double top,
                            crt_entity** out) {
  const double from[3] = {x, bottom, z}, to[3] = {x, top, z};
  return crt_cylinder_create(from, to, radius, out);
}

// Makes a plate and a hub, less a bore, a groove, the quarter towards the camera, and holes for
// bolts.
static int make_flange(crt_entity** out) {
  const double foot[3] = {0, 0.45, 0}, neck[3] = {0, 1.8, 0}, up[3] = {0, 1, 0};
  const double below[3] = {0, -1, 0}, beyond[3] = {3, 3, -3};
  crt_entity *solids[2] = {NULL}, *cutters[cutter_count] = {NULL}, *body = NULL;

  int failed =
      upright_cylinder(0, 0, 2, 0, 0.45, &solids[0]) ||
      crt_cone_create(foot, neck, 1.1, 0.8, &solids[1]) || crt_union_create(solids, 2, &body) ||
      upright_cylinder(0, 0, 0.5, -1, 3, &cutters[0]) ||
      crt_torus_create(foot, up, 1.25, 0.06, &cutters[1]) ||
      crt_box_create(below, beyond, &cutters[2]) || paint(&cutters[2], 0.90, 0.28, 0.02, 0);
  for (int i = 0; i < hole_count && !failed; ++i) {
    const double angle = (i + 0.5) * 2 * pi / hole_count;
    failed = upright_cylinder(1.62 * cos(angle), 1.62 * sin(angle), 0.17, -1, 3, &cutters[3 + i]);
  }
  failed = failed || crt_difference_create(body, cutters, cutter_count, out) ||
           paint(out, 0.13, 0.17, 0.24, 0.25);  // steel, but for the cut, which has its own paint

  for (int i = 0; i < cutter_count; ++i) crt_entity_release(cutters[i]);
  for (int i = 0; i < 2; ++i) crt_entity_release(solids[i]);
  crt_entity_release(body);
  return failed;
}

static int add_parts(crt_scene* scene) {
  const double up[3] = {0, 1, 0}, ground[3] = {0, 0, 0};
  crt_entity *flange = NULL, *floor = NULL;
  const int failed = make_flange(&flange) || crt_scene_add_entity(scene, flange) ||
                     crt_plane_create(up, ground, &floor) ||
                     paint(&floor, 0.62, 0.60, 0.57, 0.06) || crt_scene_add_entity(scene, floor);
  crt_entity_release(flange);
  crt_entity_release(floor);
  return failed;
}

static int set_the_stage(crt_scene* scene) {
  crt_light sun, lamp;
  crt_camera camera;
  crt_background background;
  crt_settings settings;
  if (crt_light_init_type(&sun, sizeof sun, CRT_LIGHT_PARALLEL) ||
      crt_light_init(&lamp, sizeof lamp) || crt_camera_init(&camera, sizeof camera) ||
      crt_background_init(&background, sizeof background) ||
      crt_settings_init(&settings, sizeof settings))
    return 1;
  sun.origin[0] = -4, sun.origin[1] = 6,
  sun.origin[2] = -3;  // it shines from there to `pointing`, 0
  lamp.origin[0] = 4, lamp.origin[1] = 5, lamp.origin[2] = -7;
  for (int i = 0; i < 3; ++i) {
    sun.color[i] = 0.8;
    lamp.color[i] = 0.35;
  }
  lamp.ambient = 0.08;
  camera.position[0] = 3.6, camera.position[1] = 4.2, camera.position[2] = -6.4;
  camera.pointing[1] = 0.5;
  camera.fov = 0.62;
  background.type = CRT_BACKGROUND_GRADIENT;
  settings.width = 640;
  settings.height = 480;
  settings.supersampling = 2;
  return crt_scene_add_light(scene, &sun) || crt_scene_add_light(scene, &lamp) ||
         crt_scene_set_camera(scene, &camera) || crt_scene_set_background(scene, &background) ||
         crt_scene_set_settings(scene, &settings);
}

static int show_progress(double fraction, void* user) {
  (void)user;
  fprintf(stderr, "\rrendering: %3.0f %%%s", 100 * fraction, fraction < 1 ? "" : "\n");
  return 0;  // anything else would cancel
}

int main(void) {
  crt_scene* scene = NULL;
  crt_prepared* prepared = NULL;
  crt_render_options options;
  crt_image* image = NULL;
  int failed = crt_render_options_init(&options, sizeof options);
  options.progress = show_progress;
  failed = failed || crt_scene_create(&scene) || add_parts(scene) || set_the_stage(scene) ||
           crt_scene_prepare(scene, &prepared) || crt_render(prepared, &options, &image) ||
           crt_image_write(image, "scene.png");
  if (failed) fprintf(stderr, "scene: %s\n", crt_error_message());
  crt_image_release(image);
  crt_prepared_release(prepared);
  crt_scene_release(scene);
  return failed;
}
