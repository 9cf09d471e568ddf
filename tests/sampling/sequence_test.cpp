// These tests check the sequence of a pixel's samples, the schedule of passes, and pixel filters.
#include "core/sampling/sequence.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/sampling/pixel_filter.hpp"
#include "core/sampling/schedule.hpp"

using namespace crt;
using namespace crt::core;

namespace {

/// Says whether `count` points from `begin` on hit each of as many equal rectangles in so many
/// columns once.
bool is_net(const PixelSequence& sequence, std::uint32_t begin, std::uint32_t count,
            std::uint32_t columns) {
  std::vector<int> hits(count, 0);
  const std::uint32_t rows = count / columns;
  for (std::uint32_t i = 0; i < count; ++i) {
    const SequencePoint point = sequence.point(begin + i);
    const auto column = static_cast<std::uint32_t>(point.pixel_u * columns);
    const auto row = static_cast<std::uint32_t>(point.pixel_v * rows);
    ++hits[row * columns + column];
  }
  for (const int hit : hits) {
    if (hit != 1) return false;
  }
  return true;
}

/// Returns the root of the mean square error of the mean over `count` points of something whose
/// mean is 0.
template <class Integrand>
double spread(std::uint32_t count, const Integrand& integrand) {
  constexpr int pixels = 2000;
  double squares = 0;
  for (int pixel = 0; pixel < pixels; ++pixel) {
    const PixelSequence sequence(5, pixel, 3);
    double sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) sum += integrand(sequence.point(i));
    squares += sum / count * (sum / count);
  }
  return std::sqrt(squares / pixels);
}

/// Returns the numbers of one decision. Other lanes have other decisions, which must not matter.
std::array<double, 4> numbers_of(std::uint64_t seed, int x, int y, std::uint32_t decision,
                                 std::uint32_t index) {
  std::array<PixelSequence::Decision, lane_count> each;
  for (std::uint32_t i = 0; i < lane_count; ++i)
    each[i] = {.x = x + 3 * static_cast<int>(i), .y = y, .index = 5 * i, .decision = 7 * i};
  const std::size_t lane = index % lane_count;
  each[lane] = {.x = x, .y = y, .index = index, .decision = 1 + decision};
  const auto numbers = PixelSequence::numbers_of_each(seed, each);
  const auto first = PixelSequence::first_numbers_of_each(seed, each);
  for (std::size_t d = 0; d < first.size(); ++d) CHECK(all(first[d] == numbers[d]));
  return {numbers[0][lane], numbers[1][lane], numbers[2][lane], numbers[3][lane]};
}

}  // namespace

TEST_CASE(
    "points that follow each other from a multiple of their number on fill the pixel evenly") {
  for (int pixel = 0; pixel < 20; ++pixel) {
    const PixelSequence sequence(7, pixel, 100 - pixel);
    for (const std::uint32_t count : {1u, 2u, 4u, 16u, 64u, 512u}) {
      for (std::uint32_t block = 0; block < 3; ++block) {
        for (std::uint32_t columns = 1; columns <= count; columns *= 2)
          CHECK(is_net(sequence, block * count, count, columns));
      }
    }
  }
}

TEST_CASE("each coordinate of the lens is spread evenly as well") {
  const PixelSequence sequence(1, 2, 3);
  constexpr std::uint32_t count = 64;
  std::array<int, count> us{};
  std::array<int, count> vs{};
  for (std::uint32_t i = 0; i < count; ++i) {
    const SequencePoint point = sequence.point(i);
    ++us[static_cast<std::size_t>(point.lens_u * count)];
    ++vs[static_cast<std::size_t>(point.lens_v * count)];
  }
  for (std::size_t i = 0; i < count; ++i) {
    CHECK(us[i] == 1);
    CHECK(vs[i] == 1);
  }
}

TEST_CASE("points lie in the unit cube, and other pixels and seeds have other ones") {
  const SequencePoint one = PixelSequence(1, 2, 3).point(9);
  for (const auto& other : {PixelSequence(2, 2, 3), PixelSequence(1, 3, 3), PixelSequence(1, 2, 4)})
    CHECK(other.point(9).pixel_u != one.pixel_u);
  for (std::uint32_t i = 0; i < 100; ++i) {
    const SequencePoint point = PixelSequence(1, 2, 3).point(i * 1000003u);
    for (const double u : {point.pixel_u, point.pixel_v, point.lens_u, point.lens_v}) {
      CHECK(u >= 0);
      CHECK(u < 1);
    }
  }
}

TEST_CASE("four pixels' sequences are those of each") {
  constexpr std::uint64_t seed = 0x123456789abcdef;
  const std::array<PixelSequence::Pixel, lane_count> pixels = {
      {{0, 0}, {70000, 3}, {-2, 8}, {5, 2147483647}}};
  const auto sequences = PixelSequence::of_each(seed, pixels);
  for (std::size_t i = 0; i < lane_count; ++i) {
    const SequencePoint point = sequences[i].point(77);
    const SequencePoint expected = PixelSequence(seed, pixels[i].x, pixels[i].y).point(77);
    CHECK(point.pixel_u == expected.pixel_u);
    CHECK(point.pixel_v == expected.pixel_v);
    CHECK(point.lens_u == expected.lens_u);
    CHECK(point.lens_v == expected.lens_v);
  }
}

TEST_CASE("points side by side are those that are found one by one") {
  const PixelSequence sequence(1, 2, 3);
  PixelSequence::Window window;
  constexpr std::uint32_t size = PixelSequence::Window::size;
  for (const bool with_lens : {false, true}) {
    for (const std::uint32_t first : {0u, 8u, 16u, 21u, 248u, 0xffffffc0u, 0xfffffff0u}) {
      const std::uint32_t end = first == 8 ? 13 : first == 16 ? 48 : first / size * size + size - 1;
      sequence.points(first, end, with_lens, window);
      const auto number = [&](std::size_t dimension, std::uint32_t i) -> double {
        return window.coordinates[dimension][i % size / lane_count][i % lane_count];
      };
      for (std::uint32_t i = first; i < end; ++i) {
        const SequencePoint expected = with_lens ? sequence.point(i) : sequence.pixel_point(i);
        CHECK(number(0, i) == expected.pixel_u);
        CHECK(number(1, i) == expected.pixel_v);
        CHECK((!with_lens || number(2, i) == expected.lens_u));
        CHECK((!with_lens || number(3, i) == expected.lens_v));
      }
    }
  }
}

TEST_CASE("four times the points halve the error at least, on an edge they do better") {
  const auto edge = [](const SequencePoint& p) {
    return 0.3 * p.pixel_u + 0.7 * p.pixel_v < 0.5 ? 0.5 : -0.5;
  };
  const auto blur = [](const SequencePoint& p) {
    return p.pixel_u + p.lens_u + p.lens_v < 1.5 ? 0.5 : -0.5;
  };
  // Independent points would be at 0.125 with 16 of them.
  CHECK(spread(16, edge) < 0.06);
  CHECK(spread(256, edge) < spread(16, edge) / 6);
  CHECK(spread(16, blur) < 0.1);
  CHECK(spread(256, blur) < spread(16, blur) / 4);
}

TEST_CASE("passes add up: eight to a sample, then eight to a doubling") {
  std::int64_t samples = 1;
  for (int pass = 9; pass <= 64; ++pass) {
    CHECK(samples_after(pass).samples == pass / 8);
    CHECK(samples_after(pass).eighths == pass % 8);
    if (pass % 8 == 0) CHECK(passes_until(pass / 8) == pass);
  }
  while (samples < 8) samples += samples_of_next_step(samples);
  for (int pass = 65; pass <= 150; ++pass) {
    CHECK(samples_of_next_step(samples) * 8 <= samples);
    samples += samples_of_next_step(samples);
    CHECK(samples_after(pass).samples == samples);
    CHECK(samples_after(pass).eighths == 0);
    CHECK(passes_until(samples) == pass);
  }
  CHECK(samples_after(0).samples == 1);
  CHECK(samples_after(72).samples == 16);
  CHECK(samples_after(120).samples == 1024);
}

TEST_CASE("in each line of eight pixels every rank comes once") {
  for (int start = 0; start < 64; ++start) {
    unsigned across = 0;
    unsigned down = 0;
    for (int i = 0; i < 8; ++i) {
      across |= 1u << rank_of_pixel(start + i, 5);
      down |= 1u << rank_of_pixel(5, start + i);
    }
    CHECK(across == 255);
    CHECK(down == 255);
  }
}

TEST_CASE("the box is the pixel itself") {
  const FilterPlaces box{Settings{}};
  for (const double u : {0.0, 0.125, 0.3, 0.9999}) CHECK(box(u) == u);
}

TEST_CASE("a wide filter's places have its weight as their density") {
  const Settings settings{.filter = PixelFilter::blackman_harris, .filter_width = 3};
  const FilterPlaces filter(settings);
  CHECK(filter(0) == -1);
  CHECK(filter(0.5) == 0.5);
  constexpr int count = 1 << 16;
  double last = filter(0);
  double mean = 0;
  double square = 0;
  for (int i = 0; i < count; ++i) {
    const double place = filter((i + 0.5) / count);
    CHECK_MESSAGE(place >= last, i);
    CHECK_MESSAGE(place <= 2, i);
    last = place;
    mean += place / count;
    square += (place - 0.5) * (place - 0.5) / count;
  }
  CHECK(mean == doctest::Approx(0.5));
  // The window's second moment is found so: a cosine of frequency k weighs x^2 by its integral over
  // [-1/2, 1/2], which is (-1)^k / (2 pi^2 k^2).
  const double pi_2 = std::numbers::pi * std::numbers::pi;
  const double moment =
      (0.35875 / 12 - 0.48829 / (2 * pi_2) + 0.14128 / (8 * pi_2) - 0.01168 / (18 * pi_2)) /
      0.35875;
  CHECK(square == doctest::Approx(9 * moment).epsilon(1e-3));
}

TEST_CASE(
    "the numbers of a decision fill the square evenly, and those of another in another order") {
  for (int pixel = 0; pixel < 20; ++pixel) {
    for (const std::uint32_t decision : {0u, 1u, 77u}) {
      for (const std::uint32_t count : {16u, 64u}) {
        std::vector<int> cells(count, 0);
        const std::uint32_t side = count / 4;
        for (std::uint32_t i = 0; i < count; ++i) {
          const auto [u, v, w, x] = numbers_of(7, pixel, 3, decision, count + i);
          REQUIRE((u >= 0 && u < 1 && v >= 0 && v < 1 && w >= 0 && w < 1 && x >= 0 && x < 1));
          ++cells[static_cast<std::uint32_t>(u * 4) * side + static_cast<std::uint32_t>(v * side)];
        }
        for (const int cell : cells) CHECK(cell == 1);
      }
    }
  }
  // Two decisions together are spread not much worse than at random: products of centered numbers
  // have the variance 1/144.
  const auto product_of = [](std::uint32_t first, std::uint32_t second, std::size_t dimension) {
    double squares = 0;
    constexpr int pixels = 2000;
    constexpr std::uint32_t count = 16;
    for (int pixel = 0; pixel < pixels; ++pixel) {
      double sum = 0;
      for (std::uint32_t i = 0; i < count; ++i)
        sum += (numbers_of(5, pixel, 1, first, i)[0] - 0.5) *
               (numbers_of(5, pixel, 1, second, i)[dimension] - 0.5);
      squares += sum / count * (sum / count);
    }
    return std::sqrt(squares / pixels);
  };
  const double at_random = 1.0 / 12 / std::sqrt(16.0);
  CHECK(product_of(0, 1, 0) < 1.4 * at_random);
  CHECK(product_of(0, 1, 0) > 0.8 * at_random);
  CHECK(product_of(3, 1u << 15, 1) < 1.4 * at_random);
}
