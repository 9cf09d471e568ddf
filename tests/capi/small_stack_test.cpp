// A thread that calls the library needs no more stack than crt.h says.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "support.hpp"
#include "support/small_stack.hpp"

using namespace crt::test;

namespace {

/// This is what crt.h promises.
constexpr std::size_t enough_stack = std::size_t{256} << 10;

std::vector<std::filesystem::path> example_scripts() {
  std::vector<std::filesystem::path> scripts;
  for (const auto& entry : std::filesystem::directory_iterator(CRT_SOURCE_DIR "/examples/scenes")) {
    if (entry.path().extension() == ".crt") scripts.push_back(entry.path());
  }
  std::sort(scripts.begin(), scripts.end());
  return scripts;
}

SceneHandle small_scene_of(const std::filesystem::path& script, const char* precision) {
  static constexpr const char* names[] = {"width",      "height",      "supersampling",
                                          "dofsamples", "targeterror", "precision"};
  const char* const values[] = {"12", "8", "1", "1", "0", precision};
  crt_script_options options;
  REQUIRE(crt_script_options_init(&options, sizeof options) == CRT_OK);
  options.setting_names = names;
  options.setting_values = values;
  options.setting_count = 6;
  return made<SceneHandle>([&](crt_scene** out) {
    return crt_scene_from_script_file(script.c_str(), &options, nullptr, out);
  });
}

std::vector<crt_ray> rays_about(std::size_t count) {
  std::vector<crt_ray> rays(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto angle = static_cast<double>(i);
    rays[i] = {.origin = {5 * std::sin(angle), 0.3, 5 * std::cos(angle)},
               .direction = {-std::sin(1.01 * angle), 0.01, -std::cos(1.01 * angle)},
               .t_min = 0,
               .t_max = infinity};
  }
  return rays;
}

void ask_rays(crt_prepared* prepared) {
  const std::vector<crt_ray> rays = rays_about(64);
  std::vector<crt_hit> hits(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  CHECK(crt_intersect(prepared, rays.data(), 0, rays.size(), hits.data(), 0) == CRT_OK);
  CHECK(crt_occluded(prepared, rays.data(), 0, rays.size(), blocked.data()) == CRT_OK);
  for (const crt_ray& ray : rays) {
    std::size_t count = 0;
    std::vector<crt_hit> crossings(64);
    const crt_status status =
        crt_crossings(prepared, &ray, crossings.data(), crossings.size(), &count);
    CHECK((status == CRT_OK || status == CRT_ERROR_LIMIT));
  }
}

}  // namespace

TEST_CASE("threads with 256 kB of stack run scripts, prepare, render and ask rays") {
  for (const std::filesystem::path& script : example_scripts()) {
    CAPTURE(script.string());
    for (const char* precision : {"\"standard\"", "\"exact\""}) {
      on_small_stack(enough_stack, [&] {
        const SceneHandle scene = small_scene_of(script, precision);
        const PreparedHandle prepared = prepare(scene.get());
        crt_render_options options;
        REQUIRE(crt_render_options_init(&options, sizeof options) == CRT_OK);
        options.threads = 1;
        const ImageHandle image = render(prepared.get(), &options);
        CHECK(crt_image_width(image.get()) == 12);
        ask_rays(prepared.get());
      });
    }
  }
}

TEST_CASE("threads with 256 kB of stack write and read pictures of every format") {
  const SceneHandle scene = small_scene(300, 200);
  const PreparedHandle prepared = prepare(scene.get());
  const ImageHandle image = render(prepared.get());
  for (const char* format : {"png", "tif", "jpg", "bmp", "ppm", "exr", "hdr"}) {
    CAPTURE(format);
    on_small_stack(enough_stack, [&] {
      const BufferHandle file = made<BufferHandle>(
          [&](crt_buffer** out) { return crt_image_encode(image.get(), format, nullptr, out); });
      const ImageHandle again = made<ImageHandle>([&](crt_image** out) {
        return crt_image_decode(crt_buffer_data(file.get()), crt_buffer_size(file.get()), nullptr,
                                out);
      });
      CHECK(crt_image_width(again.get()) == 300);
    });
  }
}
