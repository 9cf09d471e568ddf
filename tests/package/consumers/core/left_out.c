/* This program calls functions of the C interface whose libraries CRT was built without. */
#include <crt/crt.h>
#include <stdio.h>
#include <string.h>

static int fails_for(const char* option, crt_status status) {
  if (status == CRT_ERROR_UNSUPPORTED && strstr(crt_error_message(), option) != NULL) return 1;
  fprintf(stderr, "%s: %s: %s\n", option, crt_status_string(status), crt_error_message());
  return 0;
}

int main(void) {
  const double center[3] = {0, 0, 0};
  const char* script = "Scene {}";
  crt_scene* scene = NULL;
  crt_scene* other = NULL;
  crt_entity* sphere = NULL;
  crt_entity* mesh = NULL;
  crt_profile* profile = NULL;
  crt_farm_job job = {sizeof job};
  size_t length = 0;
  int all;
  if (crt_scene_create(&scene) != CRT_OK) return 1;
  if (crt_sphere_create(center, 1, &sphere) != CRT_OK) return 1;
  if (crt_profile_create(&profile) != CRT_OK) return 1;
  all = fails_for("CRT_WITH_LANG",
                  crt_scene_from_script(script, strlen(script), "a", NULL, NULL, &other)) &&
        fails_for("CRT_WITH_MESH_FILES", crt_mesh_load("a.obj", NULL, &mesh)) &&
        fails_for("CRT_WITH_FONTS", crt_profile_text(profile, "a", 1, NULL, 1, 0, 1, 0, NULL)) &&
        fails_for("CRT_WITH_SOURCE", crt_scene_save_script(scene, "a.crt")) &&
        fails_for("CRT_WITH_SOURCE", crt_entity_describe(sphere, NULL, 0, &length)) &&
        fails_for("CRT_WITH_FARM", crt_farm_plan("a.crt", "job", NULL, &job));
  crt_profile_release(profile);
  crt_entity_release(sphere);
  crt_scene_release(scene);
  return all ? 0 : 1;
}
