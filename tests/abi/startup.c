// A program pays little for libcrt before it renders: no thread starts, and no library for image
// files is loaded.
#include <crt/crt.h>
#include <dirent.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

// Returns 1 if a file of this name is mapped into the program.
static int is_mapped(const char* name) {
  char line[4096];
  int found = 0;
  FILE* const maps = fopen("/proc/self/maps", "r");
  if (maps == NULL) return -1;
  while (fgets(line, sizeof line, maps) != NULL) found |= strstr(line, name) != NULL;
  fclose(maps);
  return found;
}

static int thread_count(void) {
  int count = 0;
  DIR* const threads = opendir("/proc/self/task");
  if (threads == NULL) return -1;
  for (const struct dirent* entry = readdir(threads); entry != NULL; entry = readdir(threads)) {
    count += entry->d_name[0] != '.';
  }
  closedir(threads);
  return count;
}

static void look(const char* when, int threads_before) {
  static const char* const unwanted[] = {"libOpenImageIO", "libOpenEXR",      "libtiff",
                                         "libpng",         "crt_image_files", "libfreetype"};
  for (size_t i = 0; i < sizeof unwanted / sizeof *unwanted; ++i) {
    if (is_mapped(unwanted[i]) == 0) continue;
    printf("%s: %s is mapped\n", when, unwanted[i]);
    ++failures;
  }
  if (thread_count() == threads_before) return;
  printf("%s: %d threads, not %d\n", when, thread_count(), threads_before);
  ++failures;
}

int main(void) {
  static const double center[3] = {0, 0, 2};
  static const char script[] = "Scene { Sphere { center -> vec3(0, 0, 2) radius -> 1 } }";
  crt_entity* sphere = NULL;
  crt_scene* scene = NULL;
#ifdef STARTS_THREADS_BY_ITSELF
  const int threads = thread_count();
#else
  const int threads = 1;
#endif
  if (is_mapped("libcrt.so") != 1) {
    puts("libcrt.so is not mapped: the test sees nothing");
    return 1;
  }
  look("at the start", threads);
  if (crt_sphere_create(center, 1, &sphere) != CRT_OK) return 1;
  if (crt_scene_from_script(script, sizeof script - 1, "sphere.crt", NULL, NULL, &scene) != CRT_OK)
    return 1;
  if (crt_scene_add_entity(scene, sphere) != CRT_OK) return 1;
  look("with a scene", threads);
  crt_entity_release(sphere);
  crt_scene_release(scene);
  return failures != 0;
}
