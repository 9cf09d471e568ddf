// What is kept of a pixel's samples while more are to come: their sum, by blocks, and what tells
// how far the mean may be from the truth.
//
// How: the samples are one sequence cut into 4 to 8 blocks of equal length, each of which is
// broadcast over the pixel as evenly as its length allows. Means of such blocks differ more than
// independent estimates of the same quality as the whole would (together the blocks are broadcast
// better than any one of them), so that the interval from their variance and Student's t covers the
// truth more often than it says. Where the blocks agree by chance, or as the sampling is regular,
// the floor below holds. See docs/design/sampling.md for what was measured.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/math/lanes.hpp"

namespace crt::core {

/// Red, green, blue, alpha.
inline constexpr int pixel_channels = lane_count;
using Channels = FloatLanes;

/// As floats, of which none is infinite.
inline Channels rounded_channels(const Lanes& values) {
  const Lanes largest = lanes_of(std::numeric_limits<float>::max());
  return to_floats(min(max(values, -largest), largest));
}

class PixelSamples;

/// What some samples of a pixel show that follow each other, be they of several steps.
class SeenSamples {
 public:
  SeenSamples() = default;
  /// Of those that come after what the pixel has; the first has that identity.
  SeenSamples(const PixelSamples& pixel, std::uint64_t first_identity);

  void add(const Lanes& values, double dropped, std::uint64_t identity) {
    low_ = min(values, low_);  // what is no number is left out
    high_ = max(high_, values);
    dropped_ += dropped;
    differing_ |= identity ^ identity_;
  }

 private:
  friend class PixelSamples;

  /// Of each channel the least and the greatest.
  Lanes low_ = lanes_of(std::numeric_limits<double>::infinity());
  Lanes high_ = lanes_of(-std::numeric_limits<double>::infinity());
  double dropped_ = 0;           ///< of all of the pixel, those before them too
  std::uint64_t identity_ = 0;   ///< of the first
  std::uint64_t differing_ = 0;  ///< bits in which others differ from it
};

/// What is claimed to hold the true mean of a pixel: each channel is within its half-width of the
/// mean.
struct MeanInterval {
  Lanes mean{};
  Lanes half_width{};
  /// Half of the interval's width on a display, whatever the other numbers say: at least that.
  double least_shown = 0;
};

/// What a viewer sees of red, green, blue and alpha.
class DisplayScale {
 public:
  explicit DisplayScale(double gamma) : exponent_(1 / gamma) {}

  /// Half of the widths of intervals on a display: the farthest that anything in them is from the
  /// mean, in the worst channel. (Four at once take little longer than one.)
  [[gnu::flatten]] Lanes half_widths(const std::array<MeanInterval, lane_count>& intervals) const;

 private:
  /// Of a channel, from 0 to 1, within 10^-9.
  Lanes shown(const Lanes& values, int channel) const;

  double exponent_;
};

/// What follows from how many samples a pixel has, at least one: found once for many pixels.
class SampleCount {
 public:
  /// Out of focus things fade over many pixels, each of which has few samples that hit them: what
  /// the neighbours alone have seen counts as much there as what the pixel has.
  explicit SampleCount(std::int64_t count, bool with_lens = false);

 private:
  friend class PixelSamples;

  /// Division by a whole number. By a power of two that is multiplication, with the same bits and
  /// sooner.
  class Divisor {
   public:
    explicit Divisor(std::int64_t number)
        : number_(static_cast<double>(number)),
          reciprocal_(std::has_single_bit(static_cast<std::uint64_t>(number)) ? 1 / number_ : 0) {}

    Lanes divide(const Lanes& values) const {
      return reciprocal_ != 0 ? values * reciprocal_ : values / number_;
    }

   private:
    double number_;
    double reciprocal_;  ///< 0 if it is not exact
  };

  std::size_t blocks_;  ///< that are full
  Divisor samples_;
  Divisor full_blocks_;
  double variance_divisor_ = 1;  ///< of the squares of blocks' distances from their mean
  double student_ = 0;
  double overlooked_share_;
  double overlooked_share_of_neighbours_;
};

class PixelSamples {
 public:
  /// Where the samples of a step belong.
  struct StepPlace {
    std::uint8_t block = 0;
    bool merges = false;  ///< before that there are blocks to be merged
  };
  /// Of so many samples that come after `count`.
  static StepPlace place_of_step(std::int64_t count, std::int64_t size);
  /// Adds the sum of a step's samples (see schedule.hpp); all steps must come, in their order.
  void add_step(const StepPlace& place, const Lanes& sum);
  /// Adds what the samples of some steps show, the very first ones or further ones.
  void add_seen(const SeenSamples& seen, bool are_first);

  Lanes mean(const SampleCount& count) const;
  /// The mean share of light that was cut off.
  double dropped(std::int64_t count) const { return dropped_ / static_cast<double>(count); }

  /// What is seen in one or several pixels.
  struct Statistics {
    Channels low;
    Channels high;
    std::uint32_t least_identity;
    std::uint32_t greatest_identity;
    bool mixed;  ///< some of them are

    void take(const Statistics& others) {
      low = min(low, others.low);
      high = max(high, others.high);
      least_identity = std::min(least_identity, others.least_identity);
      greatest_identity = std::max(greatest_identity, others.greatest_identity);
      mixed |= others.mixed;
    }
  };
  Statistics statistics() const { return {low_, high_, identity_, identity_, mixed_}; }
  /// Those of neighbours, in one or several portions: what is seen there may reach in here.
  void keep(const Statistics& statistics) {
    low_around_ = has_statistics_ ? min(low_around_, statistics.low) : statistics.low;
    high_around_ = has_statistics_ ? max(high_around_, statistics.high) : statistics.high;
    edge_ = edge_ || statistics.mixed || statistics.least_identity != identity_ ||
            statistics.greatest_identity != identity_;
    has_statistics_ = true;
  }

  /// Says that there may be something here that the first samples can miss.
  void expect_subpixel_objects() { expects_subpixel_objects_ = true; }
  /// Whether there are enough samples to see what there is.
  bool has_seen_enough(std::int64_t count) const {
    return !expects_subpixel_objects_ ||
           count >= (mixed_ ? enough_samples : enough_samples_of_one_thing);
  }

  /// All that is kept here, as bytes.
  static constexpr std::size_t stored_size =
      12 * sizeof(Channels) + sizeof(double) + sizeof(std::uint32_t) + 1;
  using Stored = std::array<std::byte, stored_size>;
  Stored stored() const;
  static PixelSamples restored(const Stored& bytes);

  /// Of one sample nothing is known.
  MeanInterval interval(const SampleCount& count) const {
    return count.blocks_ == block_count ? interval<block_count>(count) : interval<0>(count);
  }

 private:
  friend class SeenSamples;
  friend class SampleCount;
  static constexpr std::size_t block_count = 8;
  /// Of 64 samples none hits a disc of a 20th of the pixel's area in 2 of 10000 cases, of 16 in 33
  /// of 100.
  static constexpr std::int64_t enough_samples = 64;
  /// Wires that cover a 20th to a 14th of a pixel are missed by 64 samples in 3 of 1000 cases.
  static constexpr std::int64_t enough_samples_of_one_thing = 256;
  /// With `count` samples, at least 1, a block has two to the power of this.
  static int block_exponent(std::int64_t count);
  void merge_blocks();
  /// The same with so many full blocks; 0 for any number.
  template <std::size_t full_blocks>
  MeanInterval interval(const SampleCount& count) const;
  /// Calls use(member) for all that are numbers, in one order.
  template <class Self, class Use>
  static void for_each_number(Self& self, const Use& use);
  using Flag = bool PixelSamples::*;
  static constexpr std::array<Flag, 4> flags() {
    return {&PixelSamples::mixed_, &PixelSamples::edge_, &PixelSamples::has_statistics_,
            &PixelSamples::expects_subpixel_objects_};
  }

  std::array<Channels, block_count> blocks_{};  ///< sums
  Channels low_{};
  Channels high_{};
  Channels low_around_{};  ///< here and in the neighbours, after the first samples
  Channels high_around_{};
  double dropped_ = 0;
  std::uint32_t identity_ = 0;
  bool mixed_ = false;
  bool edge_ = false;  ///< things of several identities are here or in the neighbours
  bool has_statistics_ = false;
  bool expects_subpixel_objects_ = false;
};

inline int PixelSamples::block_exponent(std::int64_t count) {
  constexpr int most_of_single_samples = std::countr_zero(block_count);
  const auto exponent = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(count - 1)));
  return std::max(exponent - most_of_single_samples, 0);
}

inline void PixelSamples::merge_blocks() {
  for (std::size_t i = 0; i < block_count / 2; ++i)
    blocks_[i] = blocks_[2 * i] + blocks_[2 * i + 1];
  std::fill(blocks_.begin() + block_count / 2, blocks_.end(), Channels{});
}

inline PixelSamples::StepPlace PixelSamples::place_of_step(std::int64_t count, std::int64_t size) {
  // No step reaches beyond a power of two.
  const auto before = static_cast<std::uint64_t>(count);
  return {.block = static_cast<std::uint8_t>(count >> block_exponent(count + size)),
          .merges = before >= block_count && std::has_single_bit(before)};
}

inline void PixelSamples::add_step(const StepPlace& place, const Lanes& sum) {
  if (place.merges) merge_blocks();
  Channels& block = blocks_[place.block];
  block = rounded_channels(to_doubles(block) + sum);
}

inline void PixelSamples::add_seen(const SeenSamples& seen, bool are_first) {
  const Channels low = rounded_channels(seen.low_);
  const Channels high = rounded_channels(seen.high_);
  low_ = are_first ? low : min(low_, low);
  high_ = are_first ? high : max(high_, high);
  dropped_ = seen.dropped_;
  const auto identity = static_cast<std::uint32_t>(seen.identity_ ^ seen.identity_ >> 32);
  if (are_first) identity_ = identity;
  mixed_ = mixed_ || seen.differing_ != 0 || identity != identity_;
}

inline SeenSamples::SeenSamples(const PixelSamples& pixel, std::uint64_t first_identity)
    : dropped_(pixel.dropped_), identity_(first_identity) {}

}  // namespace crt::core
