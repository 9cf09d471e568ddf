#include "core/simd/lanes.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/simd/bits.hpp"
#include "doctest/doctest.h"

using namespace crt::core;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

/// Numbers of which operations may make something else.
constexpr std::array<double, 15> odd_numbers = {0.0,
                                                -0.0,
                                                1.0,
                                                -1.0,
                                                0.1,
                                                -2.5,
                                                3.0,
                                                0x1p-1022,
                                                smallest,
                                                -smallest,
                                                0x1.fffffffffffffp+1023,
                                                infinity,
                                                -infinity,
                                                nan,
                                                1e-30};

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

/// Calls use(a, b, c) with triples of such numbers side by side, all of them in the end.
template <class Use>
void for_triples(const Use& use) {
  std::array<std::array<double, lane_count>, 3> columns;
  std::size_t count = 0;
  for (const double a : odd_numbers) {
    for (const double b : odd_numbers) {
      for (const double c : odd_numbers) {
        columns[0][count] = a;
        columns[1][count] = b;
        columns[2][count] = c;
        if (++count < lane_count) continue;
        use(columns[0], columns[1], columns[2]);
        count = 0;
      }
    }
  }
}

}  // namespace

TEST_CASE("lanes have the bits that numbers have alone") {
  for_triples([](const auto& a, const auto& b, const auto& c) {
    const auto x = lanes_at<Lanes>(a.data());
    const auto y = lanes_at<Lanes>(b.data());
    const auto z = lanes_at<Lanes>(c.data());
    const Lanes least_of_two = min(x, y);
    const Lanes greatest = max(x, y);
    const Lanes fused = fma(x, y, z);
    const Lanes root = sqrt(x);
    const Lanes size = abs(x);
    const Lanes whole = floor(x);
    const Lanes chosen = select(x < y && !(z > 0.0), x, z);
    const Lanes within = clamp(x, lanes_of(-1), lanes_of(1));
    for (std::size_t i = 0; i < lane_count; ++i) {
      CAPTURE(a[i]);
      CAPTURE(b[i]);
      CAPTURE(c[i]);
      REQUIRE(same_bits(least_of_two[i], a[i] < b[i] ? a[i] : b[i]));
      REQUIRE(same_bits(greatest[i], std::max(a[i], b[i])));
      REQUIRE(same_bits(fused[i], std::fma(a[i], b[i], c[i])));
      REQUIRE(same_bits(root[i], std::sqrt(a[i])));
      REQUIRE(same_bits(size[i], std::abs(a[i])));
      REQUIRE(same_bits(whole[i], std::floor(a[i])));
      REQUIRE(same_bits(chosen[i], a[i] < b[i] && !(c[i] > 0) ? a[i] : c[i]));
      if (!std::isnan(a[i])) REQUIRE(within[i] == std::clamp(a[i], -1.0, 1.0));
      REQUIRE(same_bits(to_doubles(to_floats(x))[i], double{static_cast<float>(a[i])}));
    }
  });
}

TEST_CASE("masks and their bits are the same") {
  for (std::uint32_t bits = 0; bits < 16; ++bits) {
    const LaneMask mask = lanes_with(bits);
    CHECK(mask_of(mask) == bits);
    CHECK(mask_of(!mask) == (bits ^ 15u));
    CHECK(mask_of(lanes_of_mask<Lanes>(bits)) == bits);
    CHECK(all(mask) == (bits == 15));
    CHECK(any(mask) == (bits != 0));
    CHECK(mask_of(lanes_with(0xfffffff0u | bits)) == bits);
    const IntLanes numbers = int_lanes_with(bits);
    for (std::size_t i = 0; i < lane_count; ++i) {
      CHECK(mask[i] == ((bits >> i & 1u) != 0));
      CHECK(numbers[i] == ((bits >> i & 1u) != 0 ? -1 : 0));
    }
    for (std::uint32_t other = 0; other < 16; ++other) {
      CHECK(mask_of(mask && lanes_with(other)) == (bits & other));
      CHECK(mask_of(mask || lanes_with(other)) == (bits | other));
      CHECK(mask_of(select(mask, lanes_with(other), lanes_with(5))) ==
            ((bits & other) | (~bits & 5u)));
    }
  }
  CHECK(lanes_of_mask<double>(1));
  CHECK_FALSE(lanes_of_mask<double>(2));
}

TEST_CASE("rows become columns, and columns are written where they belong") {
  const std::array<Lanes, lane_count> rows = {lanes_of(0, 1, 2, 3), lanes_of(4, 5, 6, 7),
                                              lanes_of(8, 9, 10, 11), lanes_of(12, 13, 14, 15)};
  const auto columns = transposed(rows);
  std::array<double, 16> written;
  for (std::size_t i = 0; i < lane_count; ++i) put_lanes(rows[i], written, lane_count * i);
  for (std::size_t i = 0; i < lane_count; ++i) {
    for (std::size_t k = 0; k < lane_count; ++k) {
      CHECK(columns[i][k] == rows[k][i]);
      CHECK(written[lane_count * i + k] == rows[i][k]);
    }
    CHECK(least(lanes_of(3, 1, 2, 4)) == 1);
  }
  const std::array<std::uint32_t, 8> numbers = {7, 3, 0xffffffffu, 7, 0, 7, 1, 2};
  CHECK(which_of_eight(numbers.data(), 7) == 0b101001);
  CHECK(which_of_eight(numbers.data(), 0xffffffffu) == 0b100);
  CHECK(which_of_eight(numbers.data(), 5) == 0);
}

TEST_CASE("whole numbers side by side have the same bits as one by one") {
  std::uint64_t state = 0x9e3779b97f4a7c15u;
  const auto next = [&] { return state = state * 0x5851f42d4c957f2du + 0x14057b7ef767814fu; };
  for (int round = 0; round < 1000; ++round) {
    const WordLanes words([&](auto) { return next(); });
    const auto factor = static_cast<std::uint32_t>(next() >> 32);
    const WordLanes products = low_product(words, factor);
    for (std::size_t i = 0; i < lane_count; ++i) {
      REQUIRE(products[i] == std::uint64_t{static_cast<std::uint32_t>(words[i])} * factor);
    }
    const BitOctet bits([&](auto) { return static_cast<std::uint32_t>(next() >> 32); });
    const BitOctet backwards = reversed(bits);
    for (std::size_t i = 0; i < octet_size; ++i) {
      for (int bit = 0; bit < 32; ++bit) {
        REQUIRE((backwards[i] >> bit & 1u) == (bits[i] >> (31 - bit) & 1u));
      }
      REQUIRE(reversed(std::uint32_t{bits[i]}) == backwards[i]);
    }
    const auto bytes = std::bit_cast<std::array<std::uint8_t, 8>>(next());
    const Lanes numbers = lanes_of_bytes(&bytes[2]);
    for (std::size_t i = 0; i < lane_count; ++i) REQUIRE(numbers[i] == bytes[i + 2]);
  }
}
