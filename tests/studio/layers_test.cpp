// What the page shows is kept as it lies over one another, and shown in another exposure.
#include "studio/layers.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

using namespace crt;
using namespace crt::studio;

namespace {

Layer layer_of(PictureKind kind, std::optional<Region> region = {}, double light = 0.25) {
  auto image = std::make_shared<Image>(2, 1);
  for (const int x : {0, 1}) image->set(x, 0, grey(light));
  return {.kind = kind, .image = image, .width = 2, .height = 1, .region = region};
}

std::vector<PictureKind> kinds_of(const Layers& layers) {
  std::vector<PictureKind> kinds;
  for (const Layer& layer : layers.all()) kinds.push_back(layer.kind);
  return kinds;
}

}  // namespace

TEST_CASE("a draft and a whole picture hide all below, and progress only what it was before") {
  using enum PictureKind;
  const Region left{0, 0, 1, 1};
  Layers layers;
  layers.add(layer_of(draft));
  layers.add(layer_of(progress));
  layers.add(layer_of(progress));
  CHECK(kinds_of(layers) == std::vector{draft, progress});
  layers.add(layer_of(progress, left));
  CHECK(kinds_of(layers) == std::vector{draft, progress, progress});
  layers.add(layer_of(final));
  CHECK(kinds_of(layers) == std::vector{final});
  layers.add(layer_of(progress, left));
  CHECK(kinds_of(layers) == std::vector{final, progress});
  layers.add(layer_of(draft));
  CHECK(kinds_of(layers) == std::vector{draft});
}

TEST_CASE("of many regions the last ones are kept, above the whole picture") {
  Layers layers;
  layers.add(layer_of(PictureKind::final));
  for (int i = 0; i < 20; ++i) layers.add(layer_of(PictureKind::progress, Region{i, 0, 1, 1}));
  CHECK(layers.all().size() == 8);
  CHECK(layers.all().front().kind == PictureKind::final);
  CHECK(layers.all().back().region->x == 19);
}

TEST_CASE("a display shows a layer without noise if it knows that, and says so") {
  Layer layer = layer_of(PictureKind::final, {}, 1);
  auto filtered = std::make_shared<Image>(*layer_of(PictureKind::final, {}, 0).image);
  Settings settings;
  settings.denoise = true;
  filtered->set_settings(settings);
  const auto shown = [&](const Display& display) { return encoded(layer, display, 1); };
  CHECK(shown({.denoise = true}).rgba[0] == 255);
  CHECK_FALSE(shown({.denoise = true}).is_denoised);
  layer.denoised = filtered;
  CHECK(shown({.denoise = true}).rgba[0] == 0);
  CHECK(shown({.denoise = true}).is_denoised);
  CHECK(shown({}).rgba[0] == 255);
  CHECK_FALSE(shown({}).is_denoised);
  // A scene may say so itself. What is measured of a picture is never filtered.
  layer.image = filtered;
  CHECK(shown({}).is_denoised);
  auto measured = std::make_shared<Image>(*filtered);
  measured->set_channels({{.name = "error", .values = std::vector<float>(2)}});
  layer.image = measured;
  layer.channel = Channel::error;
  CHECK_FALSE(shown({}).is_denoised);
}

TEST_CASE("a display shows the light of a layer brighter, by the curve that it has") {
  const auto shown = [](double light, const Display& display) {
    return int{encoded(layer_of(PictureKind::final, {}, light), display, 1).rgba[0]};
  };
  CHECK(shown(0.25, {}) == shown(0.125, {.exposure = 1}));
  CHECK(shown(0.25, {}) == shown(1, {.exposure = -2}));
  CHECK(shown(1, {}) == 255);
  Settings filmic;
  filmic.tone_map = ToneMap::filmic;
  CHECK(shown(1, {.tone_map = ToneMap::filmic}) == std::lround(255 * displayed(1, filmic)));
  // It does not go beyond what settings take.
  CHECK(shown(0.25, {.exposure = 1e9}) == 255);
  CHECK(shown(0.25, {.exposure = -1e9}) == 0);
}
