// Pictures are freed of noise as they are rendered, and say so.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/error.hpp>
#include <crt/job.hpp>
#include <string>
#include <vector>

#include "core/image/file_texts.hpp"
#include "pictures.hpp"
#include "support/temporary_directory.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr int width = 64;
constexpr int height = 48;

Scene small_scene() {
  Scene scene;
  scene.settings.width = width;
  scene.settings.height = height;
  return scene;
}

/// Makes a room with a light in its ceiling, whose light bounces.
Scene room() {
  Scene scene = small_scene();
  scene.background = SolidBackground{{0, 0, 0}};
  scene.camera = {.position = {0, 1, -3.2}, .pointing = {0, 1, 0}, .fov = 0.8};
  scene.settings.indirect = 3;
  scene.lights = {RectangleLight{.corner = {-0.4, 1.9, -0.4},
                                 .edge_a = {0.8, 0, 0},
                                 .edge_b = {0, 0, 0.8},
                                 .color = {7, 7, 6}}};
  const auto paint = [](double r, double g, double b) { return Material{.color = Color{r, g, b}}; };
  const Material tiles{.color = Pattern(Checker{.scale = 0.5})};
  const Box block{
      .corner_a = {0.1, 0, 0}, .corner_b = {0.6, 0.7, 0.5}, .material = paint(.7, .7, .7)};
  scene.entities = {
      Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = tiles},
      Plane{.normal = {0, -1, 0}, .position = {0, 2, 0}, .material = paint(.8, .8, .8)},
      Plane{.normal = {0, 0, -1}, .position = {0, 0, 1}, .material = paint(.8, .8, .8)},
      Plane{.normal = {1, 0, 0}, .position = {-1, 0, 0}, .material = paint(.6, .1, .1)},
      Plane{.normal = {-1, 0, 0}, .position = {1, 0, 0}, .material = paint(.1, .4, .1)},
      Sphere{.center = {-0.4, 0.4, 0.2}, .radius = 0.4},
      Entity(block)};
  return scene;
}

/// Makes things that throw soft shadows on a floor with a texture.
Scene soft_shadows() {
  Scene scene = small_scene();
  scene.background = GradientBackground{};
  scene.camera = {.position = {0, 2, -5}, .pointing = {0, 0.6, 0}, .fov = 0.7};
  scene.lights = {SphereLight{.center = {2, 4, -1}, .radius = 1.2, .color = {4, 4, 4}},
                  EnvironmentLight{.scale = 0.3}};
  const Material floor{.color = Pattern(Noise{.scale = 0.3})};
  scene.entities = {Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = floor},
                    Sphere{.center = {-0.9, 0.7, 0.2}, .radius = 0.7},
                    Box{.corner_a = {0.3, 0, -0.2}, .corner_b = {1, 1.2, 0.5}},
                    Cylinder{.from = {0, 0, -1.2}, .to = {0, 0.9, -1.2}, .radius = 0.05}};
  return scene;
}

Scene with_samples(Scene scene, int samples) {
  scene.settings.target_error = 1;
  scene.settings.min_samples = scene.settings.max_samples = samples;
  return scene;
}

Scene denoised(Scene scene) {
  scene.settings.denoise = true;
  return scene;
}

/// Returns the root of the mean square of what two pictures differ by on a display.
double shown_error(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const double difference = displayed(double{a.pixels()[i]}, a.settings()) -
                              displayed(double{b.pixels()[i]}, b.settings());
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(a.pixels().size()));
}

Image picture_of(const Scene& scene, const RenderOptions& options = {}) {
  return render(prepare(scene), options);
}

}  // namespace

TEST_CASE("16 samples that are denoised are far nearer to what they are the mean of") {
  struct Case {
    std::string name;
    Scene scene;
    double factor;  ///< of the error, a bit less than was measured
  };
  for (const auto& [name, scene, factor] :
       {Case{"room", room(), 1.6}, Case{"soft shadows", soft_shadows(), 1.3}}) {
    Scene few = scene;
    few.settings.supersampling = 4;
    // The grid's places are the same for all seeds. What is left is the noise of light.
    Image mean = picture_of(few);
    constexpr int seeds = 32;
    for (float& value : mean.pixels()) value = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const Image one = picture_of(few, {.seed = seed});
      for (std::size_t i = 0; i < mean.pixels().size(); ++i)
        mean.pixels()[i] += one.pixels()[i] / seeds;
    }
    const double noisy = shown_error(picture_of(few), mean);
    const double smooth = shown_error(picture_of(denoised(few)), mean);
    CAPTURE(name);
    CAPTURE(noisy);
    CAPTURE(smooth);
    CHECK(smooth < noisy / factor);
  }
}

TEST_CASE("a picture without noise gets no worse by the filter") {
  // What differs within pixels at edges looks like noise, and is as uncertain.
  Scene scene = soft_shadows();
  scene.lights = {PointLight{.origin = {2, 4, -1}}};
  Scene exact = scene;
  exact.settings.supersampling = 24;
  const Image truth = picture_of(exact);
  for (const int side : {1, 2, 4}) {
    scene.settings.supersampling = side;
    const double plain = shown_error(picture_of(scene), truth);
    const double smooth = shown_error(picture_of(denoised(scene)), truth);
    CHECK(smooth < 1.05 * plain);
  }
}

TEST_CASE("a denoised picture has the same bytes for any number of threads, and after a break") {
  for (const Scene& scene : {room(), with_samples(soft_shadows(), 16)}) {
    const PreparedScene prepared = prepare(denoised(scene));
    const Image one = render(prepared, {.threads = 1});
    CHECK(same_pixels(one, render(prepared, {.threads = 4})));
    if (scene.settings.target_error == 0) continue;
    const TemporaryDirectory directory;
    const auto checkpoint = directory / "picture.state";
    render(prepared, {.passes = 40, .checkpoint = checkpoint});
    CHECK(same_pixels(one, render(prepared, {.checkpoint = checkpoint})));
  }
}

TEST_CASE("a part of a picture is filtered as in the whole, with what is beyond its borders") {
  Scene grid = room();
  grid.settings.supersampling = 2;
  for (const Scene& scene : {grid, with_samples(room(), 4)}) {
    const PreparedScene prepared = prepare(denoised(scene));
    const RenderOptions whole_options{.aovs = {.normal = true, .id = true}};
    const Image whole = render(prepared, whole_options);
    for (const Region& region :
         {Region{10, 5, 13, 20}, Region{0, 40, 64, 8}, Region{63, 0, 1, 1}}) {
      RenderOptions options = whole_options;
      options.region = region;
      const Image part = render(prepared, options);
      REQUIRE(part.width() == region.width);
      REQUIRE(part.height() == region.height);
      for (int y = 0; y < region.height; ++y) {
        for (int x = 0; x < region.width; ++x) {
          REQUIRE(part.at(x, y) == whole.at(region.x + x, region.y + y));
          const auto here = static_cast<std::size_t>(y * region.width + x);
          const auto there = static_cast<std::size_t>((region.y + y) * width + region.x + x);
          REQUIRE(part.channel("N.Z")[here] == whole.channel("N.Z")[there]);
          REQUIRE(part.integer_channel("id")[here] == whole.integer_channel("id")[there]);
        }
      }
    }
  }
}

TEST_CASE("of a denoised picture no accuracy is claimed, and its file says so") {
  const Scene scene = with_samples(soft_shadows(), 16);
  const auto texts_of = [](const Image& image) {
    std::string all;
    for (const auto& [name, value] : core::file_texts(image, true))
      all += name + "=" + value + "\n";
    return all;
  };
  const Image plain = picture_of(scene, {.aovs = {.albedo = true, .error = true}});
  const Image smooth = picture_of(denoised(scene), {.aovs = {.albedo = true, .error = true}});
  CHECK(plain.stats().half_width_rms > 0);
  CHECK(texts_of(plain).find("crt:halfwidth") != std::string::npos);
  CHECK(texts_of(plain).find("crt:denoised") == std::string::npos);
  CHECK(smooth.stats().half_width_rms == 0);
  CHECK(smooth.stats().half_width_max == 0);
  CHECK(smooth.stats().pixels_unresolved == 0);
  CHECK(smooth.stats().samples_mean == plain.stats().samples_mean);
  CHECK(texts_of(smooth).find("crt:denoised=true") != std::string::npos);
  CHECK(texts_of(smooth).find("crt:halfwidth") == std::string::npos);
  CHECK(texts_of(smooth).find("crt:unresolvedpixels") == std::string::npos);
  const auto error = smooth.channel("error");
  CHECK(std::all_of(error.begin(), error.end(), [](float value) { return value == 1; }));
  const auto albedo = smooth.channel("albedo.G");
  CHECK(std::equal(albedo.begin(), albedo.end(), plain.channel("albedo.G").begin()));
}

TEST_CASE("a job that may be denoised has the picture, and the one that the setting makes of it") {
  Scene grid = room();
  grid.settings.supersampling = 2;
  for (const Scene& scene : {grid, with_samples(soft_shadows(), 16)}) {
    const RenderOptions options{.threads = 2, .aovs = {.error = true}};
    RenderOptions denoisable = options;
    denoisable.denoisable = true;
    const Image plain = picture_of(scene, options);
    const Image smooth = picture_of(denoised(scene), options);
    const PreparedScene prepared = prepare(scene);
    const RenderJob job(prepared, denoisable);
    const Image begun = job.denoised();
    for (const float value : begun.pixels()) REQUIRE(std::isfinite(value));
    const Image done = job.wait();
    CHECK(same_pixels(done, plain));
    CHECK(same_pixels(job.snapshot(), plain));
    CHECK(done.stats().half_width_rms == plain.stats().half_width_rms);
    CHECK_FALSE(done.settings().denoise);
    for (int count = 0; count < 2; ++count) {
      const Image filtered = job.denoised();
      CHECK(same_pixels(filtered, smooth));
      CHECK_FALSE(same_pixels(filtered, plain));
      CHECK(filtered.settings().denoise);
      CHECK(filtered.stats().half_width_rms == 0);
      CHECK(std::ranges::equal(filtered.channel("error"), smooth.channel("error")));
    }
    CHECK_THROWS_WITH_AS(job.denoised([] { return false; }), doctest::Contains("cancelled"), Error);
    const RenderJob without(prepared, options);
    CHECK_THROWS_WITH_AS(without.denoised(), doctest::Contains("denoisable"), Error);
    CHECK(same_pixels(RenderJob(prepare(denoised(scene)), options).wait(), smooth));
  }
}

TEST_CASE("what is kept for a filter continues from a checkpoint that has it, and from no other") {
  const PreparedScene prepared = prepare(with_samples(soft_shadows(), 16));
  const TemporaryDirectory directory;
  const auto checkpoint = directory / "picture.state";
  const RenderOptions options{.checkpoint = checkpoint, .aovs = {.normal = true}};
  RenderOptions begun = options;
  begun.passes = 4;
  begun.denoisable = true;
  render(prepared, begun);
  CHECK_THROWS_AS(render(prepared, options), Error);
  RenderOptions continued = options;
  continued.denoisable = true;
  const RenderJob job(prepared, continued);
  CHECK(same_pixels(job.wait(), render(prepared)));
  CHECK(same_pixels(job.denoised(), render(prepare(denoised(with_samples(soft_shadows(), 16))))));
}

TEST_CASE("snapshots are denoised, and the last one is the picture") {
  const PreparedScene scene = prepare(denoised(with_samples(room(), 16)));
  const RenderJob job(scene, {.threads = 1});
  for (int count = 0; count < 3; ++count) {
    const Image snapshot = job.snapshot();
    for (const float value : snapshot.pixels()) REQUIRE(std::isfinite(value));
  }
  const Image done = job.wait();
  CHECK(same_pixels(job.snapshot(), done));
  CHECK(same_pixels(done, render(scene)));
}
