// Each pixel has a sequence of sample points in four dimensions. Every beginning of it is
// distributed evenly, and every point is a function of the seed, the pixel and its index alone.
//
// Sources: Sobol, On the distribution of points in a cube and the approximate evaluation of
// integrals, 1967; Joe and Kuo, Constructing Sobol sequences with better two-dimensional
// projections, 2008 (the direction numbers); Owen, Randomly permuted (t,m,s)-nets and
// (t,s)-sequences, 1995 (the scrambling); Laine and Karras, Stratified sampling for stochastic
// transparency, 2011, and Burley, Practical hash-based Owen scrambling, 2020 (scrambling by a hash
// whose bits depend on the bits before them alone).
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "core/math/random.hpp"
#include "core/simd/bits.hpp"

namespace crt::core {

/// A sample's dimensions are a place on the pixel's plane, then a point of the lens.
inline constexpr int sequence_dimensions = 4;

/// A SequencePoint has what a sample is made of, each number in [0, 1).
struct SequencePoint {
  double pixel_u = 0;
  double pixel_v = 0;
  double lens_u = 0;
  double lens_v = 0;
};

namespace sequence_detail {

/// A Column has the bits of the coordinates that one bit of the index flips. They are written from
/// the lowest bit up, as scrambling goes through them in that order.
using Column = std::array<std::uint32_t, sequence_dimensions>;
inline constexpr int index_bits = 32;

/// A Recurrence is the start of a recurrence for direction numbers. It has a primitive polynomial
/// over two elements, by its degree and inner coefficients, and the first odd numbers.
struct Recurrence {
  int degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 3> first;
};

/// This many points are found at once, side by side.
inline constexpr std::uint32_t points_at_once = octet_size;

constexpr std::array<Column, index_bits> columns() {
  // The first dimension's numbers are all 1: its coordinates are the index read backwards.
  constexpr std::array<Recurrence, sequence_dimensions - 1> recurrences = {
      {{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}}};
  std::array<Column, index_bits> result{};
  for (int bit = 0; bit < index_bits; ++bit) result[static_cast<std::size_t>(bit)][0] = 1u << bit;
  for (std::size_t dimension = 1; dimension < sequence_dimensions; ++dimension) {
    const auto& [degree, coefficients, first] = recurrences[dimension - 1];
    std::array<std::uint32_t, index_bits> numbers{};  // as fractions, whose highest bit is a half
    for (int i = 0; i < index_bits; ++i) {
      auto& number = numbers[static_cast<std::size_t>(i)];
      if (i < degree) {
        number = first[static_cast<std::size_t>(i)] << (index_bits - 1 - i);
        continue;
      }
      const std::uint32_t back = numbers[static_cast<std::size_t>(i - degree)];
      number = back ^ back >> degree;
      for (int k = 1; k < degree; ++k) {
        if ((coefficients >> (degree - 1 - k) & 1u) != 0)
          number ^= numbers[static_cast<std::size_t>(i - k)];
      }
    }
    for (std::size_t i = 0; i < index_bits; ++i) result[i][dimension] = reversed(numbers[i]);
  }
  return result;
}

/// A Digit has the bits that each value of four bits of the index flips.
inline constexpr int digit_bits = 4;
using Digit = std::array<Column, std::size_t{1} << digit_bits>;
constexpr std::array<Digit, index_bits / digit_bits> digits() {
  const std::array<Column, index_bits> table = columns();
  std::array<Digit, index_bits / digit_bits> result{};
  for (std::size_t place = 0; place < result.size(); ++place) {
    for (std::size_t digit = 0; digit < result[place].size(); ++digit) {
      for (std::size_t bit = 0; bit < digit_bits; ++bit) {
        if ((digit >> bit & 1u) == 0) continue;
        for (std::size_t d = 0; d < sequence_dimensions; ++d)
          result[place][digit][d] ^= table[place * digit_bits + bit][d];
      }
    }
  }
  return result;
}

inline constexpr std::array<Digit, index_bits / digit_bits> digit_table = digits();

/// This many points are kept side by side.
inline constexpr std::uint32_t points_of_window = 64;

/// Returns the bits that the lowest bits of the indices of these points flip, by dimension.
constexpr std::array<std::array<std::uint32_t, points_of_window>, sequence_dimensions> low_bits() {
  constexpr std::uint32_t of_digit = (1u << digit_bits) - 1;
  std::array<std::array<std::uint32_t, points_of_window>, sequence_dimensions> result{};
  for (std::size_t i = 0; i < points_of_window; ++i) {
    const Column& low = digit_table[0][i & of_digit];
    const Column& high = digit_table[1][i >> digit_bits];
    for (std::size_t d = 0; d < sequence_dimensions; ++d) result[d][i] = low[d] ^ high[d];
  }
  return result;
}
inline constexpr auto low_bit_table = low_bits();

/// Flips each bit or not by a hash of the seed and the bits below it. Both steps keep to bits
/// below: adding and multiplying carry upwards, and an even factor leaves a bit itself out of what
/// it is mixed with. It takes one number, or lanes with one seed or a seed each.
template <class Bits, class Seed>
constexpr Bits scrambled_upwards(Bits bits, Seed seed) {
  constexpr std::array<std::uint32_t, 3> even_factors = {0x9e3779baU, 0xbf58476cU, 0x94d049baU};
  bits += seed;
  bits ^= bits * even_factors[0];
  // The bits times an odd factor are mixed with themselves times an even one. Both are products of
  // the earlier bits, so the second multiplication need not wait for the first.
  for (std::size_t i = 1; i < even_factors.size(); ++i) {
    const Seed odd_factor = seed << 1 | 1u;
    bits = bits * odd_factor ^ bits * (odd_factor * even_factors[i]);
    seed = seed >> 7 | seed << 25;
  }
  return bits * (seed << 1 | 1u);
}

}  // namespace sequence_detail

/// A PixelSequence is the sequence of one pixel.
class PixelSequence {
 public:
  /// Makes the sequence of no pixel.
  PixelSequence() = default;
  PixelSequence(std::uint64_t seed, int x, int y)
      : seeds_(philox4x32_10({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, use},
                             key_of(seed))) {}

  /// A Decision is one that a sample of a pixel takes after its place and lens.
  struct Decision {
    int x = 0;
    int y = 0;
    std::uint32_t index = 0;     ///< of the sample
    std::uint32_t decision = 0;  ///< its number
  };
  /// This is the number of the decision on place and lens, which has the pixel's own sequence.
  static constexpr std::uint32_t place_and_lens = 0;
  /// Returns the numbers, each in [0, 1), by which as many samples decide as there are lanes. Each
  /// other decision of a pixel has a sequence of its own, and these are independent: the points of
  /// each have an order of their own.
  ///
  /// Source: Burley, Practical hash-based Owen scrambling, 2020, section 4 (padding).
  static std::array<Lanes, sequence_dimensions> numbers_of_each(
      std::uint64_t seed, const std::array<Decision, lane_count>& decisions);
  /// Returns the first two of these numbers in a third of the time.
  static std::array<Lanes, 2> first_numbers_of_each(
      std::uint64_t seed, const std::array<Decision, lane_count>& decisions);

  /// Pixel is a pixel's position. of_each() makes the sequences of four pixels at once.
  struct Pixel {
    int x = 0;
    int y = 0;
  };
  static std::array<PixelSequence, lane_count> of_each(
      std::uint64_t seed, const std::array<Pixel, lane_count>& pixels) {
    WordLanes x;
    WordLanes y;
    for (std::size_t i = 0; i < lane_count; ++i) {
      x[i] = static_cast<std::uint32_t>(pixels[i].x);
      y[i] = static_cast<std::uint32_t>(pixels[i].y);
    }
    const auto words = philox_rounds<WordLanes>({x, y, WordLanes{}, use}, key_of(seed));
    std::array<PixelSequence, lane_count> sequences;
    for (std::size_t i = 0; i < lane_count; ++i) {
      for (std::size_t d = 0; d < sequence_dimensions; ++d) {
        sequences[i].seeds_[d] = static_cast<std::uint32_t>(words[d][i]);
      }
    }
    return sequences;
  }

  /// Returns a point. Any 2^k consecutive points from a multiple of 2^k on are distributed evenly.
  /// On the pixel every rectangle of area 2^-k that comes of halving its sides holds one of them.
  /// In every dimension by itself, so does each of 2^k equal parts.
  SequencePoint point(std::uint32_t index) const {
    const auto [pixel_u, pixel_v, lens_u, lens_v] = coordinates<sequence_dimensions>(index);
    return {pixel_u, pixel_v, lens_u, lens_v};
  }

  /// Returns a point without its part on the lens.
  SequencePoint pixel_point(std::uint32_t index) const {
    const auto [pixel_u, pixel_v] = coordinates<2>(index);
    return {.pixel_u = pixel_u, .pixel_v = pixel_v};
  }

  /// A Window has the points from a multiple of their number on, side by side, by dimension. A
  /// group of them is as many as there are lanes.
  struct Window {
    static constexpr std::uint32_t size = sequence_detail::points_of_window;
    std::array<std::array<Lanes, size / lane_count>, sequence_dimensions> coordinates;
  };
  /// Puts the points from `first` to before `end` to their places in their window, with some before
  /// and after them. All must be of one window. Without the lens only their places on the pixel are
  /// computed.
  void points(std::uint32_t first, std::uint32_t end, bool with_lens, Window& window) const {
    with_lens ? fill<sequence_dimensions>(first, end, window) : fill<2>(first, end, window);
  }

 private:
  /// Returns the bits that an index flips, not scrambled.
  template <std::size_t dimensions>
  static std::array<std::uint32_t, dimensions> bits_of(std::uint32_t index) {
    using namespace sequence_detail;
    std::array<std::uint32_t, dimensions> bits{};
    for (std::size_t place = 0; index != 0; ++place, index >>= digit_bits) {
      const Column& turned = digit_table[place][index & ((1u << digit_bits) - 1)];
      for (std::size_t d = 0; d < dimensions; ++d) bits[d] ^= turned[d];
    }
    return bits;
  }

  /// Returns the fractions that reversed bits are.
  static std::array<Lanes, 2> fractions(const BitOctet& bits) {
    // Processors convert only signed numbers to doubles side by side, from -1/2 to 1/2, exactly.
    constexpr std::uint32_t middle = 0x80000000u;
    const auto groups = stdx::split<IntLanes>(bits_as<IntOctet>(BitOctet(bits ^ middle)));
    std::array<Lanes, 2> result;
    for (std::size_t k = 0; k < groups.size(); ++k) {
      const auto from_middle = stdx::static_simd_cast<Lanes>(groups[k]);
      result[k] = fma(from_middle, lanes_of(0x1p-32), lanes_of(0.5));
    }
    return result;
  }
  static double fraction(std::uint32_t reversed_bits) { return 0x1p-32 * reversed_bits; }

  template <std::size_t dimensions>
  std::array<double, dimensions> coordinates(std::uint32_t index) const {
    using namespace sequence_detail;
    const auto bits = bits_of<dimensions>(index);
    std::array<double, dimensions> result;
    for (std::size_t d = 0; d < dimensions; ++d)
      result[d] = fraction(reversed(scrambled_upwards(bits[d], seeds_[d])));
    return result;
  }

  template <std::size_t dimensions>
  void fill(std::uint32_t first, std::uint32_t end, Window& window) const {
    const std::uint32_t begin = first / Window::size * Window::size;
    const auto high_bits = bits_of<dimensions>(begin);
    for (std::size_t d = 0; d < dimensions; ++d) {
      fill(window.coordinates[d], d, high_bits[d], first - begin, end - begin);
    }
  }
  void fill(std::array<Lanes, Window::size / lane_count>& coordinates, std::size_t dimension,
            std::uint32_t high_bits, std::uint32_t first, std::uint32_t end) const {
    using namespace sequence_detail;
    const std::uint32_t seed = seeds_[dimension];
    for (std::uint32_t i = first / points_at_once * points_at_once; i < end; i += points_at_once) {
      const auto low_bits = lanes_at<BitOctet>(&low_bit_table[dimension][i]);
      const BitOctet bits = reversed(scrambled_upwards(BitOctet(low_bits ^ high_bits), seed));
      const auto groups = fractions(bits);
      for (std::size_t k = 0; k < groups.size(); ++k) coordinates[i / lane_count + k] = groups[k];
    }
  }

  /// DecisionLanes have what the numbers of decisions follow from.
  struct DecisionLanes {
    std::array<WordLanes, sequence_dimensions> seeds;  ///< their lower halves, by dimension
    BitOctet indices;  ///< of the points, each twice: an octet has the lanes of two dimensions
  };
  static DecisionLanes lanes_of_decisions(std::uint64_t seed,
                                          const std::array<Decision, lane_count>& decisions);
  /// Returns the numbers of two dimensions, from the first one on, of which these are the bits.
  static std::array<Lanes, 2> numbers_in(const DecisionLanes& lanes, std::size_t dimension,
                                         const BitOctet& bits) {
    const BitOctet seeds([&](auto i) {
      return static_cast<std::uint32_t>(lanes.seeds[dimension + i / lane_count][i % lane_count]);
    });
    return fractions(reversed(sequence_detail::scrambled_upwards(bits, seeds)));
  }

  /// This key separates the sequence from other random numbers of a pixel.
  static constexpr std::uint32_t use = 0x5e9ce001;

  PhiloxCounter seeds_{};
};

inline PixelSequence::DecisionLanes PixelSequence::lanes_of_decisions(
    std::uint64_t seed, const std::array<Decision, lane_count>& decisions) {
  using namespace sequence_detail;
  static_assert(octet_size == 2 * lane_count && sequence_dimensions == 4);
  WordLanes x;
  WordLanes y;
  WordLanes numbers;
  for (std::size_t i = 0; i < lane_count; ++i) {
    x[i] = static_cast<std::uint32_t>(decisions[i].x);
    y[i] = static_cast<std::uint32_t>(decisions[i].y);
    numbers[i] = decisions[i].decision;
  }
  DecisionLanes lanes{.seeds = philox_rounds<WordLanes>({x, y, numbers, use}, key_of(seed)),
                      .indices = {}};
  BitOctet orders;
  for (std::size_t i = 0; i < octet_size; ++i) {
    const std::size_t lane = i % lane_count;
    const auto last = static_cast<std::uint32_t>(lanes.seeds[3][lane]);
    orders[i] = static_cast<std::uint32_t>(lanes.seeds[0][lane]) ^ (last << 16 | last >> 16);
    lanes.indices[i] = decisions[lane].index;
  }
  const BitOctet in_order = reversed(scrambled_upwards(reversed(lanes.indices), orders));
  for (std::size_t i = 0; i < octet_size; ++i) {
    if (decisions[i % lane_count].decision != place_and_lens) lanes.indices[i] = in_order[i];
  }
  return lanes;
}

inline std::array<Lanes, 2> PixelSequence::first_numbers_of_each(
    std::uint64_t seed, const std::array<Decision, lane_count>& decisions) {
  const DecisionLanes lanes = lanes_of_decisions(seed, decisions);
  // The first dimension has the bits of the index. In the second, a bit is flipped by those of the
  // index whose places have all ones of its own place: this sums them up, a bit of places at a
  // time.
  const BitOctet of_second([](auto i) { return i < lane_count ? 0 : ~std::uint32_t{0}; });
  BitOctet bits = lanes.indices;
  bits ^= bits >> 16 & of_second & 0x0000ffffu;
  bits ^= bits >> 8 & of_second & 0x00ff00ffu;
  bits ^= bits >> 4 & of_second & 0x0f0f0f0fu;
  bits ^= bits >> 2 & of_second & 0x33333333u;
  bits ^= bits >> 1 & of_second & 0x55555555u;
  return numbers_in(lanes, 0, bits);
}

inline std::array<Lanes, sequence_dimensions> PixelSequence::numbers_of_each(
    std::uint64_t seed, const std::array<Decision, lane_count>& decisions) {
  const DecisionLanes lanes = lanes_of_decisions(seed, decisions);
  std::array<BitOctet, 2> bits;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const auto of_index = bits_of<sequence_dimensions>(lanes.indices[lane]);
    for (std::size_t d = 0; d < sequence_dimensions; ++d)
      bits[d / 2][d % 2 * lane_count + lane] = of_index[d];
  }
  const auto first = numbers_in(lanes, 0, bits[0]);
  const auto second = numbers_in(lanes, 2, bits[1]);
  return {first[0], first[1], second[0], second[1]};
}

}  // namespace crt::core
