// Computes volume, mass and centre of mass of a part, from what a grid of parallel rays passes of
// it. The part is a steel plate, 100 x 60 x 12 mm, with four drilled holes and a hemispherical
// pocket, so that a closed form shows whether the result is within the stated error. Else the
// program fails.
//
// The method is this. The cells of the grid tile the plate. L(x, y), the length of material along
// z, is measured at the middle of each and stands for all of it (the midpoint rule). Crossings are
// exact but for rounding, so errors come from the plane. A cell that a contour crosses has another
// L beyond it. A contour that misses a cell's middle leaves at most half of the cell beyond it, and
// the middle of one of the eight cells around is there too. So the cell errs by at most half its
// area times the spread (greatest less least) of L over these nine. Where no contour crosses, a
// cell errs by its area times a 24th of L's second differences, which is less than that again. The
// stated error is the sum over all cells. It needs contours that are no finer than the grid: three
// cells apart, with radii of four cells or more. So curved, they may leave a little more than half,
// but the cells beside the contour, which count as well, more than make up for it. As errors
// cancel, the stated error is far larger than the true one.
#include <crt/crt.h>
#include <float.h>
#include <math.h>
#include <stdio.h>

static const double pi = 3.14159265358979323846;
static const double width = 100, depth = 60, height = 12;  // along x, y and z, in millimetres
static const double hole_radius = 4, hole_x = 40, hole_y = 20, pocket_radius = 10, pocket_x = 18;
static const double density = 7.85e-3;  // of steel, in grams per cubic millimetre

enum { cells = 1000 };  // along x, and along y
static double lengths[cells][cells];

typedef struct measure {
  double volume, error;
  double moment[3];  // the integrals of x, y and z over the part
} measure;

// Makes the plate, whose upper side is at z = 0, with its middle at x = y = 0.
static int make_part(crt_prepared** out) {
  const double corner[3] = {-width / 2, -depth / 2, -height},
               opposite[3] = {width / 2, depth / 2, 0};
  const double pocket[3] = {pocket_x, 0, 0};
  crt_entity *plate = NULL, *cutters[5] = {NULL}, *part = NULL;
  crt_scene* scene = NULL;
  int failed = crt_box_create(corner, opposite, &plate) ||
               crt_sphere_create(pocket, pocket_radius, &cutters[4]);
  for (int i = 0; i < 4 && !failed; ++i) {
    const double x = i % 2 ? hole_x : -hole_x, y = i / 2 ? hole_y : -hole_y;
    const double from[3] = {x, y, -height},
                 to[3] = {x, y, 0};  // flush with the plate: there is no film left
    failed = crt_cylinder_create(from, to, hole_radius, &cutters[i]);
  }
  failed = failed || crt_difference_create(plate, cutters, 5, &part) || crt_scene_create(&scene) ||
           crt_scene_add_entity(scene, part) || crt_scene_prepare(scene, out);
  crt_scene_release(scene);
  crt_entity_release(part);
  for (int i = 0; i < 5; ++i) crt_entity_release(cutters[i]);
  crt_entity_release(plate);
  return failed;
}

static measure closed_form(void) {
  const double drilled = width * depth * height - 4 * pi * hole_radius * hole_radius * height;
  const double pocket = 2 * pi / 3 * pow(pocket_radius, 3);
  const double pocket_z = -3 * pocket_radius / 8;  // the centre of mass of half a ball
  const measure m = {
      drilled - pocket, 0, {-pocket * pocket_x, 0, -drilled * height / 2 - pocket * pocket_z}};
  return m;
}

// Adds what the line along z through the middle of a cell measures.
static int measure_line(crt_prepared* part, int i, int j, measure* m) {
  enum { most = 32 };
  const double x = ((i + 0.5) / cells - 0.5) * width, y = ((j + 0.5) / cells - 0.5) * depth;
  const double cell_area = width / cells * depth / cells;
  const crt_ray ray = {{x, y, 0}, {0, 0, 1}, -INFINITY, INFINITY};
  crt_hit hits[most];
  size_t count = 0;
  if (crt_crossings(part, &ray, hits, most, &count)) return 1;
  for (size_t k = 0; k < count && k < most; ++k) {
    const double z = hits[k].t, sign = hits[k].flags & CRT_HIT_ENTERING ? -1 : 1;
    lengths[j][i] += sign * z;
    m->moment[2] += cell_area * sign * z * z / 2;
  }
  m->volume += cell_area * lengths[j][i];
  m->moment[0] += cell_area * lengths[j][i] * x;
  m->moment[1] += cell_area * lengths[j][i] * y;
  return 0;
}

// Returns the greatest less the least of the lengths in a cell and the cells around it.
static double spread(int i, int j) {
  double least = INFINITY, greatest = 0;
  for (int b = j > 0 ? j - 1 : 0; b <= j + 1 && b < cells; ++b) {
    for (int a = i > 0 ? i - 1 : 0; a <= i + 1 && a < cells; ++a) {
      least = fmin(least, lengths[b][a]);
      greatest = fmax(greatest, lengths[b][a]);
    }
  }
  return greatest - least;
}

static int integrate(crt_prepared* part, measure* m) {
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      if (measure_line(part, i, j, m)) return 1;
    }
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) m->error += width / cells * depth / cells / 2 * spread(i, j);
  }
  m->error += (double)cells * cells * DBL_EPSILON * m->volume;  // the rounding of so many additions
  return 0;
}

static void print_measure(const char* name, const measure* m) {
  printf("%-13s %9.2f mm3 %9.3f g   (%.3f, %.3f, %.3f) mm\n", name, m->volume, density * m->volume,
         m->moment[0] / m->volume, m->moment[1] / m->volume, m->moment[2] / m->volume);
}

int main(void) {
  const measure exact = closed_form();
  measure m = {0, 0, {0, 0, 0}};
  crt_prepared* part = NULL;
  const int failed = make_part(&part) || integrate(part, &m);
  crt_prepared_release(part);
  if (failed) {
    fprintf(stderr, "volume: %s\n", crt_error_message());
    return 1;
  }
  const double error = fabs(m.volume - exact.volume);
  printf("                 volume           mass      centre of mass\n");
  print_measure("measured", &m);
  print_measure("closed form", &exact);
  printf("stated error  %9.2f mm3 (%.2f %%)\nactual error  %9.2f mm3\n", m.error,
         100 * m.error / m.volume, error);
  return error <= m.error ? 0 : 1;
}
