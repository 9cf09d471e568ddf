// Measures a steel plate, 100 x 60 x 12 mm, with four drilled holes and a hemispherical pocket: its
// volume and mass, its centroid and box, and whether a bolt's axis is in it. It is the part of
// volume.c, where the same comes of rays. Numbers are intervals that surely hold the truth.
#include <crt/crt.h>
#include <stdio.h>

static const double density = 7.85e-3;  // of steel, in grams per cubic millimetre

static int make_part(crt_entity** out) {
  const double corner[3] = {-50, -30, -12}, opposite[3] = {50, 30, 0}, pocket[3] = {18, 0, 0};
  crt_entity *plate = NULL, *cutters[5] = {NULL};
  int failed =
      crt_box_create(corner, opposite, &plate) || crt_sphere_create(pocket, 10, &cutters[4]);
  for (int i = 0; i < 4 && !failed; ++i) {
    const double x = i % 2 ? 40 : -40, y = i / 2 ? 20 : -20;
    const double from[3] = {x, y, -12}, to[3] = {x, y, 0};
    failed = crt_cylinder_create(from, to, 4, &cutters[i]);
  }
  failed = failed || crt_difference_create(plate, cutters, 5, out);
  for (int i = 0; i < 5; ++i) crt_entity_release(cutters[i]);
  crt_entity_release(plate);
  return failed;
}

int main(void) {
  crt_entity* part = NULL;
  crt_mass mass;
  double lower[3], upper[3];
  const double points[2][3] = {{40, 20, -6}, {0, 0, -6}};
  int8_t sides[2];

  int failed = make_part(&part) || crt_mass_init(&mass, sizeof mass) ||
               crt_entity_mass(part, 1e-4, 0, &mass) || crt_entity_bounds(part, lower, upper) ||
               crt_entity_contains(part, points[0], 0, 2, sides);
  if (failed) {
    fprintf(stderr, "measure: %s\n", crt_error_message());
  } else {
    printf("volume between %.1f and %.1f mm3\n", mass.volume.lower, mass.volume.upper);
    printf("mass between %.2f and %.2f g\n", density * mass.volume.lower,
           density * mass.volume.upper);
    printf("centroid at x = %.3f mm\n", 0.5 * (mass.centroid[0].lower + mass.centroid[0].upper));
    printf("size %.1f x %.1f x %.1f mm\n", upper[0] - lower[0], upper[1] - lower[1],
           upper[2] - lower[2]);
    printf("the hole is %s, the middle %s\n", sides[0] > 0 ? "in it" : "empty",
           sides[1] > 0 ? "in it" : "empty");
  }
  crt_entity_release(part);
  return failed;
}
