// A PixelSamples is what is kept of a pixel's samples while more are to come. That is their sums by
// blocks, and what bounds how far the mean may be from the truth.
//
// The samples are one sequence, cut into 4 to 8 blocks of equal length. Each block is distributed
// over the pixel as evenly as its length allows. Together the blocks are distributed better than
// any one of them. So their means differ more than independent estimates of the quality of the
// whole would. The interval from their variance and Student's t therefore covers the truth more
// often than it claims. Where the blocks agree by chance, or as the sampling is regular, the
// overlooked share below is the least half-width. docs/design/sampling.md has what was measured.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/math/lanes.hpp"
#include "core/math/tone_curve.hpp"

namespace crt::core {

/// The channels are red, green, blue and alpha.
inline constexpr int pixel_channels = lane_count;
using Channels = FloatLanes;

/// Rounds to floats, of which none is infinite.
inline Channels rounded_channels(const Lanes& values) {
  const Lanes largest = lanes_of(std::numeric_limits<float>::max());
  return to_floats(min(max(values, -largest), largest));
}

class PixelSamples;

/// A SeenSamples is what consecutive samples of a pixel show, from one step or from several.
class SeenSamples {
 public:
  SeenSamples() = default;
  /// Takes the samples that come after those of the pixel. The first of them has the given
  /// identity.
  SeenSamples(const PixelSamples& pixel, std::uint64_t first_identity);

  void add(const Lanes& values, double dropped, std::uint64_t identity) {
    low_ = min(values, low_);  // NaN is left out
    high_ = max(high_, values);
    dropped_ += dropped;
    differing_ |= identity ^ identity_;
  }

 private:
  friend class PixelSamples;

  /// These are the least and the greatest value of each channel.
  Lanes low_ = lanes_of(std::numeric_limits<double>::infinity());
  Lanes high_ = lanes_of(-std::numeric_limits<double>::infinity());
  double dropped_ = 0;           ///< from all samples of the pixel, those before these too
  std::uint64_t identity_ = 0;   ///< of the first sample
  std::uint64_t differing_ = 0;  ///< bits in which other identities differ from it
};

/// A MeanInterval is claimed to hold the true mean of a pixel: each channel is within its
/// half-width of `mean`.
struct MeanInterval {
  Lanes mean{};
  Lanes half_width{};
  /// Half of the interval's width on a display is at least this, whatever the other numbers say.
  double least_shown = 0;
};

/// A DisplayScale is what a viewer sees of red, green, blue and alpha.
class DisplayScale {
 public:
  explicit DisplayScale(double gamma, const ToneCurve& tone = {})
      : exponent_(1 / gamma), tone_(tone) {}

  /// Returns half of the widths of intervals on a display: the farthest that anything in them is
  /// from the mean, in the worst channel. Four intervals at once take little longer than one.
  [[gnu::flatten]] Lanes half_widths(const std::array<MeanInterval, lane_count>& intervals) const;

 private:
  /// Returns how bright values of a channel look, from 0 to 1, within 10^-9.
  Lanes shown(const Lanes& values, int channel) const;

  double exponent_;
  ToneCurve tone_;
};

/// A SampleCount holds what follows from the number of samples of a pixel, which is at least one.
/// It is found once for many pixels.
class SampleCount {
 public:
  /// With a lens, things out of focus fade over many pixels, each of which has few samples that hit
  /// them. So what only the neighbours have seen counts as much as what the pixel itself has seen.
  explicit SampleCount(std::int64_t count, bool with_lens = false);

  std::int64_t samples() const { return samples_.number(); }

 private:
  friend class PixelSamples;

  /// A Divisor divides by a whole number. For a power of two it multiplies, which gives the same
  /// bits faster.
  class Divisor {
   public:
    explicit Divisor(std::int64_t number)
        : number_(static_cast<double>(number)),
          reciprocal_(std::has_single_bit(static_cast<std::uint64_t>(number)) ? 1 / number_ : 0) {}

    std::int64_t number() const { return static_cast<std::int64_t>(number_); }
    Lanes divide(const Lanes& values) const {
      return reciprocal_ != 0 ? values * reciprocal_ : values / number_;
    }

   private:
    double number_;
    double reciprocal_;  ///< 0 if it is not exact
  };

  std::size_t blocks_;  ///< the number of full blocks
  Divisor samples_;
  Divisor full_blocks_;
  double variance_divisor_ = 1;  ///< for the sum of the squares of the blocks' distances from their
                                 ///< mean
  double student_ = 0;
  double overlooked_share_;
  double overlooked_share_of_neighbours_;
};

class PixelSamples {
 public:
  /// A StepPlace says to which block the samples of a step belong.
  struct StepPlace {
    std::uint8_t block = 0;
    bool merges = false;  ///< there are blocks to be merged before
  };
  /// Returns the place of the `size` samples that come after `count`.
  static StepPlace place_of_step(std::int64_t count, std::int64_t size);
  /// Adds the sum of a step's samples (see schedule.hpp). All steps must come, in their order.
  void add_step(const StepPlace& place, const Lanes& sum);
  /// Adds what the samples of some steps show, the very first ones or further ones.
  void add_seen(const SeenSamples& seen, bool are_first);

  Lanes mean(const SampleCount& count) const;
  /// Returns the mean share of light that was cut off.
  double dropped(std::int64_t count) const { return dropped_ / static_cast<double>(count); }

  /// Statistics are what is seen in one or several pixels.
  struct Statistics {
    Channels low;
    Channels high;
    std::uint32_t least_identity;
    std::uint32_t greatest_identity;
    bool mixed;  ///< some of the pixels are mixed

    void take(const Statistics& others) {
      low = min(low, others.low);
      high = max(high, others.high);
      least_identity = std::min(least_identity, others.least_identity);
      greatest_identity = std::max(greatest_identity, others.greatest_identity);
      mixed |= others.mixed;
    }
  };
  Statistics statistics() const { return {low_, high_, identity_, identity_, mixed_}; }
  /// Takes in the statistics of neighbours, in one or several portions, as what is seen there may
  /// reach into this pixel.
  void keep(const Statistics& statistics) {
    low_around_ = has_statistics_ ? min(low_around_, statistics.low) : statistics.low;
    high_around_ = has_statistics_ ? max(high_around_, statistics.high) : statistics.high;
    edge_ = edge_ || statistics.mixed || statistics.least_identity != identity_ ||
            statistics.greatest_identity != identity_;
    has_statistics_ = true;
  }

  /// Returns the variances of the means, as far as the blocks show them. There are as many
  /// independent estimates as blocks() says, and of one the variance counts as 0.
  Lanes variance(const SampleCount& count) const;
  static std::size_t blocks(const SampleCount& count) { return count.blocks_; }

  /// Says that there may be something in the pixel that the first samples can miss.
  void expect_subpixel_objects() { expects_subpixel_objects_ = true; }
  /// Returns whether there are enough samples to see what there is.
  bool has_seen_enough(std::int64_t count) const {
    return !expects_subpixel_objects_ ||
           count >= (mixed_ ? enough_samples : enough_samples_of_one_thing);
  }

  /// A Stored has all that is kept here, as bytes.
  static constexpr std::size_t stored_size =
      12 * sizeof(Channels) + sizeof(double) + sizeof(std::uint32_t) + 1;
  using Stored = std::array<std::byte, stored_size>;
  Stored stored() const;
  static PixelSamples restored(const Stored& bytes);

  /// Returns the interval of the mean. One sample says nothing of it.
  MeanInterval interval(const SampleCount& count) const {
    return count.blocks_ == block_count ? interval<block_count>(count) : interval<0>(count);
  }

 private:
  friend class SeenSamples;
  friend class SampleCount;
  static constexpr std::size_t block_count = 8;
  /// 64 samples all miss a disc of a 20th of the pixel's area in 2 of 10000 cases, and 16 samples
  /// do in 33 of 100.
  static constexpr std::int64_t enough_samples = 64;
  /// Wires that cover a 20th to a 14th of a pixel are missed by 64 samples in 3 of 1000 cases.
  static constexpr std::int64_t enough_samples_of_one_thing = 256;
  /// Returns the exponent of the power of two of samples that a block has. `count` is at least 1.
  static int block_exponent(std::int64_t count);
  void merge_blocks();
  /// Returns the sum of so many full blocks.
  Lanes sum_of(std::size_t blocks) const;
  /// Returns the variances of the means, from the full blocks and their sum.
  Lanes variance_of(std::size_t blocks, const Lanes& sum, const SampleCount& count) const;
  /// Computes the interval for a fixed number of full blocks, or with 0 for any number.
  template <std::size_t full_blocks>
  MeanInterval interval(const SampleCount& count) const;
  /// Calls use(member) for all members that are numbers, in a fixed order.
  template <class Self, class Use>
  static void for_each_number(Self& self, const Use& use);
  using Flag = bool PixelSamples::*;
  static constexpr std::array<Flag, 4> flags() {
    return {&PixelSamples::mixed_, &PixelSamples::edge_, &PixelSamples::has_statistics_,
            &PixelSamples::expects_subpixel_objects_};
  }

  std::array<Channels, block_count> blocks_{};  ///< sums of samples
  Channels low_{};
  Channels high_{};
  Channels low_around_{};  ///< of this pixel and its neighbours, after the first samples
  Channels high_around_{};
  double dropped_ = 0;
  std::uint32_t identity_ = 0;
  bool mixed_ = false;
  bool edge_ = false;  ///< things of several identities are here or in the neighbours
  bool has_statistics_ = false;
  bool expects_subpixel_objects_ = false;
};

inline int PixelSamples::block_exponent(std::int64_t count) {
  constexpr int max_of_single_samples = std::countr_zero(block_count);
  const auto exponent = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(count - 1)));
  return std::max(exponent - max_of_single_samples, 0);
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
