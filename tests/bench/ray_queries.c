// Times queries for ray_queries.py, and asks them for figures.py:
//
//   ray_queries SCENE.crt RAYS_PER_SIDE REPETITIONS [single|crossings]
//
// Prints the seconds of each repetition: of one batch, of one ray after the other, or of all
// crossings of one ray after the other. The rays are a grid along z, over x and y from -4 to 4,
// from z = -20.
#define _POSIX_C_SOURCE 199309L  // clock_gettime
#include <crt/crt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void aim(crt_ray* rays, size_t side) {
  for (size_t i = 0; i < side * side; ++i) {
    const double x = 8 * ((double)(i % side) + 0.5) / (double)side - 4;
    const double y = 8 * ((double)(i / side) + 0.5) / (double)side - 4;
    const crt_ray ray = {{x, y, -20}, {0, 0, 1}, 0, INFINITY};
    rays[i] = ray;
  }
}

static int ask(const char* kind, crt_prepared* prepared, const crt_ray* rays, size_t count,
               crt_hit* hits) {
  size_t crossings = 0;
  int failed = 0;
  if (strcmp(kind, "batch") == 0) return crt_intersect(prepared, rays, 0, count, hits, 0);
  for (size_t i = 0; i < count && !failed; ++i) {
    if (strcmp(kind, "single") == 0) {
      failed = crt_intersect(prepared, &rays[i], 0, 1, &hits[i], 0);
    } else {
      failed = crt_crossings(prepared, &rays[i], hits, count, &crossings);
    }
  }
  return failed;
}

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) return 2;
  const char* const kind = argc == 5 ? argv[4] : "batch";
  const size_t side = strtoul(argv[2], NULL, 10), count = side * side;
  const int repetitions = atoi(argv[3]);
  crt_ray* rays = malloc(count * sizeof *rays);
  crt_hit* hits = malloc(count * sizeof *hits);
  crt_scene* scene = NULL;
  crt_prepared* prepared = NULL;
  int failed = rays == NULL || hits == NULL ||
               crt_scene_from_script_file(argv[1], NULL, NULL, &scene) ||
               crt_scene_prepare(scene, &prepared);
  if (!failed) aim(rays, side);
  for (int i = 0; i < repetitions && !failed; ++i) {
    const double start = now();
    failed = ask(kind, prepared, rays, count, hits);
    printf("%.9f\n", now() - start);
  }
  if (failed) fprintf(stderr, "ray_queries: %s\n", crt_error_message());
  crt_prepared_release(prepared);
  crt_scene_release(scene);
  free(hits);
  free(rays);
  return failed;
}
