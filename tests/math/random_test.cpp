#include "core/math/random.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

using namespace crt::core;

TEST_CASE("Philox4x32-10 gives the known answers that Random123 publishes") {
  CHECK(philox4x32_10({0, 0, 0, 0}, {0, 0}) ==
        PhiloxCounter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  CHECK(philox4x32_10({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}) ==
        PhiloxCounter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  // These are the digits of pi.
  CHECK(philox4x32_10({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        PhiloxCounter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("seed and use become key and counter in the order that is documented") {
  const std::uint64_t seed = 0x299f31d0'a4093822u;
  const auto pair = random_pair(
      seed, {.x = 0x243f6a88, .y = 0x85a308d3, .sample = 0x13198a2e, .dimension = 0x03707344});
  CHECK(pair[0] == to_unit_interval(0x94fdcceb'd16cfe09u));
  CHECK(pair[1] == to_unit_interval(0x24126ea1'5001e420u));
}

TEST_CASE("the unit interval is closed at 0, open at 1, and has 53 bits") {
  CHECK(to_unit_interval(0) == 0.0);
  CHECK(to_unit_interval(~std::uint64_t{0}) == 1.0 - 0x1p-53);
  CHECK(to_unit_interval(std::uint64_t{1} << 11) == 0x1p-53);
  CHECK(to_unit_interval(std::uint64_t{1} << 63) == 0.5);
}

namespace {

/// Returns the pairs of a small picture with several samples and dimensions, all from neighbouring
/// counters.
std::vector<std::array<double, 2>> many_pairs(std::uint64_t seed) {
  std::vector<std::array<double, 2>> pairs;
  for (std::uint32_t y = 0; y < 32; ++y)
    for (std::uint32_t x = 0; x < 32; ++x)
      for (std::uint32_t sample = 0; sample < 32; ++sample)
        for (std::uint32_t dimension = 0; dimension < 4; ++dimension)
          pairs.push_back(random_pair(seed, {x, y, sample, dimension}));
  return pairs;
}

}  // namespace

TEST_CASE("numbers for neighbouring uses fill the unit square evenly") {
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32}) {
    const auto pairs = many_pairs(seed);
    constexpr std::size_t side = 16;
    std::vector<double> counts(side * side, 0.0);
    for (const auto& [u, v] : pairs) {
      REQUIRE(u >= 0.0);
      REQUIRE(u < 1.0);
      REQUIRE(v >= 0.0);
      REQUIRE(v < 1.0);
      counts[static_cast<std::size_t>(u * side) * side + static_cast<std::size_t>(v * side)] += 1;
    }
    const double expected = static_cast<double>(pairs.size()) / (side * side);
    double chi_square = 0;
    for (const double count : counts)
      chi_square += (count - expected) * (count - expected) / expected;
    // With 255 degrees of freedom the mean is 255, and the standard deviation is sqrt(510) = 22.6.
    // Five of them are allowed on either side.
    CHECK(chi_square > 255 - 5 * 22.6);
    CHECK(chi_square < 255 + 5 * 22.6);
  }
}

TEST_CASE("every part of the use and of the seed changes the number") {
  std::set<double> numbers;
  for (std::uint32_t i = 0; i < 64; ++i) {
    for (const std::uint64_t high : {std::uint64_t{0}, std::uint64_t{1} << 32}) {
      numbers.insert(random_number(i + high, {0, 0, 0, 0}));
      numbers.insert(random_number(high, {i, 0, 0, 0}));
      numbers.insert(random_number(high, {0, i, 0, 0}));
      numbers.insert(random_number(high, {0, 0, i, 0}));
      numbers.insert(random_number(high, {0, 0, 0, i}));
    }
  }
  // All zero is in each of the five series once for each `high`.
  CHECK(numbers.size() == 2 * (5 * 64 - 4));
}

TEST_CASE("the numbers of one pixel do not correlate with those of the next") {
  constexpr int count = 100000;
  double sum_of_products = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    sum_of_products +=
        (random_number(0, {7, 3, i, 0}) - 0.5) * (random_number(0, {8, 3, i, 0}) - 0.5);
  }
  // The product of two independent uniform numbers about 0 has standard deviation 1/12.
  CHECK(std::abs(sum_of_products / count) < 5 / (12 * std::sqrt(double{count})));
}

TEST_CASE("pairs of four samples are those of each") {
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{0x299f31d0a4093822}}) {
    for (std::uint32_t sample = 0; sample < 4000; sample += 4) {
      const RandomUse use = {
          .x = 0x243f6a88, .y = 0x85a308d3, .sample = sample - 2000, .dimension = 3};
      const auto [first, second] = random_pairs(seed, use);
      for (std::uint32_t i = 0; i < 4; ++i) {
        RandomUse one = use;
        one.sample += i;
        const std::size_t lane = i;
        CHECK(std::array{first[lane], second[lane]} == random_pair(seed, one));
      }
    }
  }
}

TEST_CASE("bits at the ends of their range are the same numbers four at a time") {
  constexpr std::uint64_t all = 0xffffffffffffffffu;
  for (const std::uint64_t bits :
       {std::uint64_t{0}, all, all - 2047, std::uint64_t{2048}, all >> 21, all << 43}) {
    const Lanes numbers = to_unit_interval(lanes_of<WordLanes>(bits, 0, bits, all));
    CHECK(double{numbers[2]} == to_unit_interval(bits));
  }
  CHECK(to_unit_interval(all) < 1);
}
