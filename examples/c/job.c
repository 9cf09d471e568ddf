// Renders in the background: it starts a job, looks at its progress from time to time, saves what
// is there half-way to half.png, and waits for the rest, job.png. `job cancel` stops half-way
// instead.
#define _POSIX_C_SOURCE 199309L  // nanosleep
#include <crt/crt.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static const char marbles[] =
    "Settings {\n"
    "  width -> 480 height -> 320 supersampling -> 2 recursiondepth -> 8\n"
    "  camera -> Camera { position -> vec3(0, 3.2, -6) pointing -> vec3(0, 0.3, 0) fov -> 36 }\n"
    "  lights -> [\n"
    "    ParallelLight { from -> vec3(-3, 5, 2) pointing -> vec3(0, 0, 0) color -> rgb(0.9, 0.9, "
    "0.9) },\n"
    "    PointLight { origin -> vec3(2, 4, -6) color -> rgb(0.25, 0.25, 0.25) }\n"
    "  ]\n"
    "  background -> Background { horizon -> rgb(0.9, 0.9, 0.9) sky -> rgb(0.2, 0.4, 0.8) }\n"
    "}\n"
    "marble = Macro (tint) {\n"
    "  glass = Material {\n"
    "    color -> tint transparency -> 0.92 refractiveindex -> 1.5 specular -> 1 shininess -> 200\n"
    "  }\n"
    "  Sphere { center -> vec3(0, 0.48, 0) radius -> 0.48 material -> glass }\n"
    "}\n"
    "tiles = Material { color -> Checker { colorA -> rgb(0.8, 0.8, 0.78) colorB -> rgb(0.3, 0.3, "
    "0.35) } }\n"
    "Scene {\n"
    "  Plane { normal -> vec3(0, 1, 0) position -> vec3(0, 0, 0) material -> tiles }\n"
    "  for (z in range(3)) {\n"
    "    for (x in range(5)) {\n"
    "      marble(rgb(1 - 0.2 * x, 0.4 + 0.25 * z, 0.2 + 0.2 * x)) <translate vec3(x - 2, 0, z - "
    "1)>\n"
    "    }\n"
    "  }\n"
    "}\n";

static int prepare(crt_prepared** out) {
  crt_scene* scene = NULL;
  const int failed =
      crt_scene_from_script(marbles, strlen(marbles), "marbles", NULL, NULL, &scene) ||
      crt_scene_prepare(scene, out);
  crt_scene_release(scene);
  return failed;
}

// Returns when at least so much is done, or the job has ended otherwise. `done` gets how much.
static int wait_until(crt_job* job, double fraction, double* done) {
  const struct timespec a_moment = {0, 20 * 1000 * 1000};
  for (;;) {
    if (crt_job_progress(job, done)) return 1;
    if (*done >= fraction || crt_job_is_finished(job)) return 0;
    nanosleep(&a_moment, NULL);
  }
}

static int save_snapshot(crt_job* job, const char* path) {
  crt_image* image = NULL;
  const int failed = crt_job_snapshot(job, &image) || crt_image_write(image, path);
  crt_image_release(image);
  return failed;
}

static int save_result(crt_job* job, const char* path) {
  crt_image* image = NULL;
  const int failed = crt_job_wait(job, &image) || crt_image_write(image, path);
  crt_image_release(image);
  return failed;
}

// Cancels the job, which may have come to its end by itself before.
static int cancel(crt_job* job) {
  if (crt_job_cancel(job)) return 1;
  const crt_status status = crt_job_wait(job, NULL);
  printf("the job ended: %s\n", crt_status_string(status));
  return status != CRT_ERROR_CANCELLED && status != CRT_OK;
}

int main(int argc, char** argv) {
  const int is_to_be_cancelled = argc > 1 && strcmp(argv[1], "cancel") == 0;
  crt_prepared* prepared = NULL;
  crt_job* job = NULL;
  double done = 0;
  int failed = prepare(&prepared) || crt_render_start(prepared, NULL, &job) ||
               wait_until(job, 0.5, &done) || save_snapshot(job, "half.png");
  if (!failed) {
    printf("half.png shows what was there at %.0f %%\n", 100 * done);
    failed = is_to_be_cancelled ? cancel(job) : save_result(job, "job.png");
  }
  if (failed) fprintf(stderr, "job: %s\n", crt_error_message());
  crt_job_release(job);
  crt_prepared_release(prepared);
  return failed;
}
