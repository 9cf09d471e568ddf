// Rendering pass by pass gives the same bytes on any number of threads and tiles, and reports what
// is known of the pixels.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <crt/error.hpp>
#include <crt/job.hpp>
#include <numbers>

#include "core/render/rendering.hpp"
#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Makes a white disc before black. Every pixel but those of its edge has one colour.
Scene disc_scene(int size) {
  Scene scene = dark_scene();
  scene.settings.width = scene.settings.height = size;
  scene.settings.target_error = 2.0 / 255;
  scene.camera = {.position = {0, 0, -3}, .pointing = {0, 0, 0}};
  scene.lights = {glow(1)};
  scene.entities = {Sphere{.radius = 1, .material = inert()}};
  return scene;
}

bool same_part(const Image& part, int left, int top, const Image& whole) {
  for (int y = 0; y < part.height(); ++y) {
    for (int x = 0; x < part.width(); ++x) {
      const Color a = part.at(x, y);
      const Color b = whole.at(left + x, top + y);
      if (a.r != b.r || a.g != b.g || a.b != b.b || a.a != b.a) return false;
    }
  }
  return true;
}

/// Says whether what is known of the pixels in a part of a picture with this width is the same.
bool same_part(const core::PixelMeasures& part, const Region& region,
               const core::PixelMeasures& whole, int width) {
  for (int y = 0; y < region.height; ++y) {
    for (int x = 0; x < region.width; ++x) {
      const auto here = static_cast<std::size_t>(y * region.width + x);
      const auto there = static_cast<std::size_t>((region.y + y) * width + region.x + x);
      if (part.samples[here] != whole.samples[there]) return false;
      if (part.half_widths[here] != whole.half_widths[there]) return false;
    }
  }
  return true;
}

/// Returns a clock that is one second further at each reading.
core::PassClock::Seconds ticking_clock() {
  return [now = 0.0]() mutable { return now++; };
}

core::PixelMeasures measures_of(const PreparedScene& scene, const RenderOptions& options = {}) {
  core::Rendering rendering(scene.data(), options);
  rendering.run();
  return rendering.measures();
}

}  // namespace

TEST_CASE("pass by pass, a picture has the same bytes for any number of threads") {
  const PreparedScene scene = prepare(varied_scene());
  const Image reference = render(scene, {.threads = 1});
  CHECK(reference.stats().samples_min < reference.stats().samples_max);
  for (const int threads : {0, 2, 7}) {
    const Image image = render(scene, {.threads = threads});
    CHECK(same_pixels(image, reference));
    CHECK(image.stats().half_width_rms == reference.stats().half_width_rms);
    CHECK(image.stats().cutoff_mean == reference.stats().cutoff_mean);
  }
}

TEST_CASE("pass by pass, every part of a picture is as in the whole, to its samples") {
  const PreparedScene scene = prepare(varied_scene());
  const Image whole = render(scene);
  const core::PixelMeasures all = measures_of(scene);
  for (const Region& region : {Region{0, 0, 37, 1}, Region{5, 3, 1, 1}, Region{11, 7, 20, 9},
                               Region{36, 0, 1, 26}, Region{0, 25, 37, 1}, Region{3, 9, 17, 16}}) {
    CHECK(same_part(render(scene, {.region = region}), region.x, region.y, whole));
    CHECK(same_part(measures_of(scene, {.region = region}), region, all, 37));
  }
}

TEST_CASE("pass by pass, it makes no difference where the tiles meet that threads work on") {
  constexpr int size = 44;
  for (const double target : {2.0 / 255, 1e-6}) {
    Scene description = disc_scene(size);
    description.settings.target_error = target;
    description.settings.max_samples =
        target < 1e-3 ? 16 : 64;  // the first samples may be the last
    const PreparedScene scene = prepare(description);
    const Image whole = render(scene);
    const core::PixelMeasures all = measures_of(scene);
    for (int corner = 0; corner < 18; ++corner) {
      const Region region{corner, corner, 26, 26};
      CHECK(same_part(render(scene, {.region = region}), corner, corner, whole));
      CHECK(same_part(measures_of(scene, {.region = region}), region, all, size));
    }
  }
}

TEST_CASE("a pixel goes on for what is seen beside it in another tile") {
  // The edge of a white wall lies between the pixels 15 and 16, where none of their samples can see
  // it.
  Scene scene = disc_scene(32);
  scene.camera.projection = Projection::orthographic;
  scene.entities = {Box{.corner_a = {0, -9, 0}, .corner_b = {9, 9, 1}, .material = inert()}};
  const core::PixelMeasures measures = measures_of(prepare(scene));
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const auto samples = measures.samples[static_cast<std::size_t>(32 * y + x)];
      CHECK((samples > 16) == (x == 15 || x == 16));
    }
  }
}

TEST_CASE("the pass count that a picture tells gives the same picture, whatever ended it") {
  Scene description = varied_scene();
  const PreparedScene by_error = prepare(description);
  const Image image = render(by_error);
  CHECK(same_pixels(render(by_error, {.passes = image.stats().passes}), image));
  CHECK(!same_pixels(render(by_error, {.passes = 66}), image));

  for (const double budget : {0.4, 2.0, 7.0, 15.7, 23.0, 66.0, 76.0}) {
    description.settings.time_budget = budget;
    const PreparedScene by_clock = prepare(description);
    core::Rendering first(by_clock.data(), {}, ticking_clock());
    first.run();
    const Image timed = first.take();
    const int passes = timed.stats().passes;
    // The first eight passes come in one. As long as all of the others are of one size the end is
    // within half a pass.
    if (budget < 50) CHECK(passes == 7 + std::max(1, static_cast<int>(std::floor(budget + 0.5))));
    if (budget > 50) CHECK(passes > 50);
    CHECK(same_pixels(render(by_clock, {.threads = 1, .passes = passes}), timed));
    CHECK(same_part(render(by_clock, {.region = Region{9, 2, 11, 20}, .passes = passes}), 9, 2,
                    timed));
  }
}

TEST_CASE("more passes than it takes change nothing") {
  const PreparedScene scene = prepare(varied_scene());
  CHECK(same_pixels(render(scene, {.passes = 1000}), render(scene)));
}

TEST_CASE("a target error of 0 without a time budget is the plain grid") {
  Scene scene = varied_scene();
  scene.settings.target_error = 0;
  scene.settings.supersampling = 3;
  const Image grid = render(prepare(scene));
  CHECK(grid.stats().passes == 0);
  CHECK(grid.stats().samples_min == 18);
  CHECK(grid.stats().samples_max == 18);
  CHECK(grid.stats().camera_rays == 37u * 26 * 18);
  CHECK(grid.stats().half_width_max == 0);
  scene.settings.min_samples = 64;
  CHECK(same_pixels(render(prepare(scene)), grid));
}

TEST_CASE("the plain grid puts its places where a filter has its weight") {
  Scene scene = disc_scene(16);
  scene.settings.target_error = 0;
  const Image middle = render(prepare(scene));
  scene.settings.filter = PixelFilter::blackman_harris;
  CHECK(same_pixels(render(prepare(scene)), middle));
  scene.settings.supersampling = 8;
  const Image wide = render(prepare(scene));
  scene.settings.filter = PixelFilter::box;
  const Image box = render(prepare(scene));
  const auto grey_pixels = [](const Image& image) {
    int count = 0;
    for (int i = 0; i < 256; ++i) {
      const double value = image.at(i % 16, i / 16).r;
      if (value > 0.02 && value < 0.98) ++count;
    }
    return count;
  };
  CHECK(grey_pixels(wide) > 1.3 * grey_pixels(box));
}

TEST_CASE("samples go where they are needed") {
  const PreparedScene scene = prepare(disc_scene(48));
  const Image image = render(scene);
  const RenderStats& stats = image.stats();
  const core::PixelMeasures measures = measures_of(scene);
  CHECK(measures.samples[0] == 16);
  CHECK(measures.samples[24 * 48 + 24] == 16);
  CHECK(stats.samples_min == 16);
  CHECK(stats.samples_max > 64);
  CHECK(stats.unseen_share == doctest::Approx(3.0 / 16));
  CHECK(stats.camera_rays == doctest::Approx(stats.samples_mean * 48 * 48));
  std::uint64_t unresolved = 0;
  for (std::size_t i = 0; i < measures.samples.size(); ++i) {
    const double half_width = double{measures.half_widths[i]};
    CHECK(half_width <= stats.half_width_max);
    if (half_width > 2.0 / 255) {
      ++unresolved;
      CHECK(measures.samples[i] == 1024);
    }
  }
  CHECK(stats.pixels_unresolved == unresolved);
  CHECK(stats.half_width_rms < stats.half_width_max);
}

TEST_CASE("what is smaller than a pixel is found beside what has been seen of it") {
  // A wire is a 12th of a pixel wide, nearly level, and every pixel along it must have its share.
  Scene scene = dark_scene();
  scene.settings.width = 40;
  scene.settings.height = 9;
  scene.settings.target_error = 4.0 / 255;
  scene.camera = {.position = {0, 0, -3},
                  .fov = 2 * std::atan(4.5),
                  .projection = Projection::orthographic,
                  .focal_distance = 1};
  scene.lights = {glow(1)};
  scene.entities = {
      Box{.corner_a = {-30, -1.0 / 24, -1}, .corner_b = {30, 1.0 / 24, 1}, .material = inert()}};
  scene.entities[0] = scene.entities[0].transformed(rotate_degrees({0, 0, 0.5}));
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Image image = render(prepare(scene), {.seed = seed});
    for (int x = 0; x < 40; ++x) {
      double column = 0;
      for (int y = 0; y < 9; ++y) column += image.at(x, y).r;
      CHECK(std::abs(column - 1.0 / 12) < 0.5 / 12);
    }
  }
}

TEST_CASE("no wire that covers more than a 20th of a pixel vanishes, however it lies") {
  constexpr int size = 48;
  Scene scene = dark_scene();
  scene.settings.width = scene.settings.height = size;
  scene.settings.max_samples = 256;
  scene.camera = {.position = {0, 0, -3},
                  .fov = 2 * std::atan(size / 2.0),
                  .projection = Projection::orthographic,
                  .focal_distance = 1};
  scene.lights = {glow(1)};
  // These cylinders, cones and boxes go through corners of pixels, where all pixels around see
  // little of them.
  const double width = 0.07;
  for (int i = 0; i < 3; ++i) {
    const double rise = 0.5 + 0.2 * i;
    const Vec3 from(-24, -20 + 10 * i, 0);
    const Vec3 to(24, from.y + 48 * rise / 2, 0);
    if (i == 0) scene.entities.push_back(Cylinder{from, to, width / 2, inert()});
    if (i == 1) scene.entities.push_back(Cone{from, to, width / 2, 0.9 * width / 2, inert()});
    if (i == 2) {
      const Entity bar = Box{.corner_a = {-24, -width / 2, -0.02},
                             .corner_b = {24, width / 2, 0.02},
                             .material = inert()};
      scene.entities.push_back(bar.transformed(rotate_degrees({0, 0, 41})));
    }
  }
  // A needle is wider than a pixel where it begins.
  scene.entities.push_back(Cone{{-24, 22, 0}, {24, 11.3, 0}, 0.6, 0.01, inert()});
  scene.settings.supersampling = 32;
  const Image truth = render(prepare(scene));
  scene.settings.target_error = 8.0 / 255;
  const PreparedScene prepared = prepare(scene);
  int covered = 0;
  int vanished = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const Image image = render(prepared, {.seed = seed});
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        if (truth.at(x, y).r <= 0.05) continue;
        ++covered;
        if (image.at(x, y).r == 0) ++vanished;
      }
    }
    CHECK(image.at(1, 46).r == 0);
    CHECK(image.stats().samples_min == 16);
  }
  CHECK(covered > 2000);
  CHECK(vanished == 0);
}

TEST_CASE("no sphere that covers more than a 20th of a pixel vanishes") {
  Scene scene = dark_scene();
  scene.settings.width = scene.settings.height = 25;
  scene.settings.target_error = 8.0 / 255;
  scene.camera = {.position = {0, 0, -3},
                  .fov = 2 * std::atan(12.5),
                  .projection = Projection::orthographic,
                  .focal_distance = 1};
  scene.lights = {glow(1)};
  // These are in the middle of every fifth pixel, where no neighbour sees any of them.
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      const double radius = std::sqrt(0.055 / std::numbers::pi);
      scene.entities.push_back(Sphere{.center = {5.0 * x + 0.1 * y, 5.0 * y - 0.1 * x, 0},
                                      .radius = radius,
                                      .material = inert()});
    }
  }
  const PreparedScene prepared = prepare(scene);
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Image image = render(prepared, {.seed = seed});
    for (int y = 2; y < 25; y += 5) {
      for (int x = 2; x < 25; x += 5) CHECK(std::abs(image.at(x, y).r - 0.055) < 8.0 / 255);
    }
    const Region region{6, 7, 10, 11};
    CHECK(same_part(render(prepared, {.region = region, .seed = seed}), 6, 7, image));
  }
}

TEST_CASE("a job's picture is whole after the first passes, long before the end") {
  Scene description = varied_scene();
  description.settings.target_error = 0.5 / 255;
  const PreparedScene scene = prepare(description);
  core::Rendering* rendering = nullptr;
  bool seen = false;
  core::Rendering watched(scene.data(), {.threads = 2, .progress = [&](double share) {
                                           if (share < 0.5 || share > 0.7 || seen) return true;
                                           seen = true;
                                           const Image image = rendering->picture();
                                           for (int i = 0; i < 37 * 26; ++i)
                                             CHECK(image.at(i % 37, i / 37).a == 1);
                                           return true;
                                         }});
  rendering = &watched;
  watched.run();
  CHECK(seen);
}

TEST_CASE(
    "a picture that is shown evenly is as noisy everywhere at any time, and the same picture") {
  Scene description = dark_scene();
  description.settings.width = 32;
  description.settings.height = 96;
  description.settings.target_error = 1e-6;
  description.settings.min_samples = description.settings.max_samples = 64;
  // The floor is far from the edges of what lights it: all of its pixels are about as noisy.
  description.camera = {.position = {0, 0, -3}, .pointing = {0, 0, 0}};
  description.entities = {Plane{.normal = {0, 0, -1}, .position = {0, 0, 0}}};
  description.lights = {
      RectangleLight{.corner = {-20, -20, -5}, .edge_a = {40, 0, 0}, .edge_b = {0, 40, 0}}};
  const PreparedScene scene = prepare(description);
  description.settings.min_samples = description.settings.max_samples = 4096;
  const Image truth = render(prepare(description), {.seed = 1});

  const auto noise_of_rows = [&](const Image& image, int first, int last) {
    double sum = 0;
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < 32; ++x) sum += std::pow(image.at(x, y).r - truth.at(x, y).r, 2);
    }
    return std::sqrt(sum / (32 * (last - first)));
  };
  core::Rendering* rendering = nullptr;
  int looks = 0;
  RenderOptions options{.threads = 1, .evenly = true};
  options.progress = [&](double share) {
    const Image image = rendering->picture();
    if (share == 0 || image.at(31, 95).a == 0) return true;  // within the first pass
    ++looks;
    const double top = noise_of_rows(image, 0, 48);
    const double bottom = noise_of_rows(image, 48, 96);
    CHECK(top < 2 * bottom);
    CHECK(bottom < 2 * top);
    return true;
  };
  core::Rendering watched(scene.data(), options);
  rendering = &watched;
  watched.run();
  CHECK(looks > 50);
  CHECK(same_pixels(watched.picture(), render(scene)));
}

TEST_CASE("a transparent background shows as a width where things end, be they black") {
  Scene scene = disc_scene(16);
  scene.background = SolidBackground{{0, 0, 0, 0}};
  scene.lights.clear();
  const Image image = render(prepare(scene));
  CHECK(image.stats().samples_max > 16);
}

TEST_CASE("passes must not be negative, and pictures pass by pass not immense") {
  Scene scene = disc_scene(8);
  CHECK_THROWS_AS(render(prepare(scene), {.passes = -1}), Error);
  scene.settings.width = scene.settings.height = 8192;
  const PreparedScene large = prepare(scene);
  CHECK_THROWS_AS(render(large), Error);
  CHECK_NOTHROW(render(large, {.region = Region{4000, 4000, 2, 2}}));
}
