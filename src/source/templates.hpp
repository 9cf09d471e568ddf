// Every program that is written has this around what makes the scene.
#pragma once

namespace crt::source {

inline constexpr const char* cpp_begin = R"(#include <array>
#include <crt/crt.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

using namespace crt;

)";

inline constexpr const char* cpp_main = R"(
int main(int argc, char** argv) try {
  render(prepare(make_scene())).write(argc > 1 ? argv[1] : "picture.png", {.reproducible = true});
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
)";

inline constexpr const char* python_begin = R"(import sys

import crt


)";

inline constexpr const char* python_main = R"(

if __name__ == "__main__":
    path = sys.argv[1] if len(sys.argv) > 1 else "picture.png"
    make_scene().render().save(path, reproducible=True)
)";

inline constexpr const char* c_begin = R"(#include <crt/crt.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program if something has failed. */
static void check(crt_status status) {
  if (status == CRT_OK) return;
  fprintf(stderr, "%s\n", crt_error_message());
  exit(1);
}

)";

inline constexpr const char* c_set =
    R"(static void set(double* vector, double x, double y, double z) {
  vector[0] = x;
  vector[1] = y;
  vector[2] = z;
}

)";

inline constexpr const char* c_main = R"(
int main(int argc, char** argv) {
  crt_scene* scene = make_scene();
  crt_prepared* prepared = NULL;
  check(crt_scene_prepare(scene, &prepared));
  crt_image* image = NULL;
  check(crt_render(prepared, NULL, &image));
  crt_write_options options;
  check(crt_write_options_init(&options, sizeof options));
  options.reproducible = 1;
  check(crt_image_write_with(image, argc > 1 ? argv[1] : "picture.png", &options));
  crt_image_release(image);
  crt_prepared_release(prepared);
  crt_scene_release(scene);
  return 0;
}
)";

}  // namespace crt::source
