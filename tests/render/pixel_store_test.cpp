#include "core/render/pixel_store.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <memory>
#include <span>

using namespace crt::core;

TEST_CASE("each pixel has memory of its own, be it of small pages or large ones") {
  for (const std::size_t count : {std::size_t{1}, std::size_t{1000}, std::size_t{30000}}) {
    PixelStore store(count);
    const std::span<PixelSamples> all = store.part(0, count);
    REQUIRE(all.size() == count);
    CHECK(reinterpret_cast<std::uintptr_t>(all.data()) % alignof(PixelSamples) == 0);
    std::uninitialized_value_construct(all.begin(), all.end());
    const auto value = [](std::size_t i) { return static_cast<double>(i % 4096); };
    for (std::size_t i = 0; i < count; ++i) all[i].add_step({}, lanes_of(value(i)));
    for (std::size_t i = 0; i < count; ++i) {
      const std::span<PixelSamples> one = store.part(i, 1);
      CHECK(one[0].mean(1)[0] == value(i));
    }
  }
}
