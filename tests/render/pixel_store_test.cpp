#include "core/render/pixel_store.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

using namespace crt::core;

TEST_CASE("each pixel has memory of its own, be it of small pages or large ones") {
  for (const std::size_t count : {std::size_t{1}, std::size_t{1000}, std::size_t{30000}}) {
    PixelStore store(count);
    std::vector<PixelSamples*> pixels;
    for (std::size_t portion = 1; pixels.size() < count; ++portion) {
      const std::span<PixelSamples> some = store.take(std::min(portion, count - pixels.size()));
      CHECK(reinterpret_cast<std::uintptr_t>(some.data()) % alignof(PixelSamples) == 0);
      std::uninitialized_value_construct(some.begin(), some.end());
      for (PixelSamples& pixel : some) pixels.push_back(&pixel);
    }
    const auto value = [](std::size_t i) { return static_cast<double>(i % 4096); };
    for (std::size_t i = 0; i < count; ++i) pixels[i]->add_step({}, lanes_of(value(i)));
    for (std::size_t i = 0; i < count; ++i) {
      const double mean = pixels[i]->mean(SampleCount(1))[0];
      CHECK(mean == value(i));
    }
  }
}
