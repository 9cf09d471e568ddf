// Times crt_intersect for ray_queries.py:  ray_queries SCENE.crt RAYS_PER_SIDE REPETITIONS
//
// Prints the seconds of each repetition. The rays are a grid along z, over x and y from -4 to 4,
// from z = -20.
#define _POSIX_C_SOURCE 199309L  // clock_gettime
#include <crt/crt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
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

int main(int argc, char** argv) {
  if (argc != 4) return 2;
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
    failed = crt_intersect(prepared, rays, 0, count, hits, 0);
    printf("%.9f\n", now() - start);
  }
  if (failed) fprintf(stderr, "ray_queries: %s\n", crt_error_message());
  crt_prepared_release(prepared);
  crt_scene_release(scene);
  free(hits);
  free(rays);
  return failed;
}
