#include "core/sampling/pixel_samples.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "core/math/power.hpp"

namespace crt::core {

namespace {

bool all_equal(const Channels& a, const Channels& b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2] && a[3] == b[3];
}

/// These are the 97.5 % quantiles of Student's t, by degrees of freedom, from 1 on. A mean is
/// within so many standard errors in 95 of 100 cases (Student, The probable error of a mean,
/// Biometrika 6(1), 1908).
constexpr std::array<double, 7> student_95 = {12.7062, 4.30265, 3.18245, 2.77645,
                                              2.57058, 2.44691, 2.36462};

/// N samples may overlook this divided by N of what is seen in and around a pixel. See
/// docs/trade.md.
constexpr double overlooked_samples = 2;
/// Where the pixel itself shows one thing, in focus, N samples may overlook this divided by N of
/// what only its neighbours have seen.
constexpr double overlooked_samples_of_neighbours = 1;
/// This is taken for the contrast on a display of things that look alike where they were seen.
constexpr double least_contrast_of_edges = 1.0 / 8;

constexpr int alpha_channel = pixel_channels - 1;

}  // namespace

Lanes DisplayScale::shown(const Lanes& values, int channel) const {
  const bool is_alpha = channel == alpha_channel;
  const Lanes toned = is_alpha || tone_.is_identity() ? values : tone_(values);
  const Lanes clamped = clamp(toned, Lanes{}, lanes_of(1));
  const bool is_linear = exponent_ == 1 || is_alpha;
  return is_linear ? clamped : rough_power(clamped, lanes_of(exponent_));
}

Lanes DisplayScale::half_widths(const std::array<MeanInterval, lane_count>& intervals) const {
  const auto& [a, b, c, d] = intervals;
  Lanes widest = lanes_of(a.least_shown, b.least_shown, c.least_shown, d.least_shown);
  const auto has_width = [](const MeanInterval& interval) {
    return any(interval.half_width != 0.0);
  };
  if (std::none_of(intervals.begin(), intervals.end(), has_width)) return widest;

  const std::array<Lanes, pixel_channels> means = transposed({a.mean, b.mean, c.mean, d.mean});
  const std::array<Lanes, pixel_channels> half_widths =
      transposed({a.half_width, b.half_width, c.half_width, d.half_width});
  // A concave scale has nothing above that is farther from the mean, with as much margin below.
  const bool is_concave = exponent_ <= 1 && tone_.is_linear();
  LaneMask is_below = lanes_with(is_concave ? (1u << lane_count) - 1 : 0);
  for (std::size_t i = 0; i < means.size(); ++i) is_below &= means[i] - half_widths[i] >= 0.0;
  for (int channel = 0; channel < pixel_channels; ++channel) {
    const Lanes& mean = means[static_cast<std::size_t>(channel)];
    const Lanes& half_width = half_widths[static_cast<std::size_t>(channel)];
    const Lanes middle = shown(mean, channel);
    Lanes farthest = middle - shown(mean - half_width, channel);
    if (!all(is_below)) {
      const Lanes above = shown(mean + half_width, channel) - middle;
      farthest = select(is_below, farthest, max(above, farthest));
    }
    widest = max(widest, farthest);
  }
  return widest;
}

SampleCount::SampleCount(std::int64_t count, bool with_lens)
    : blocks_(static_cast<std::size_t>(count >> PixelSamples::block_exponent(count))),
      samples_(count),
      full_blocks_(static_cast<std::int64_t>(blocks_)),
      overlooked_share_(overlooked_samples / static_cast<double>(count)),
      overlooked_share_of_neighbours_(with_lens ? overlooked_share_
                                                : overlooked_samples_of_neighbours /
                                                      static_cast<double>(count)) {
  if (blocks_ < 2) return;
  // This brings the variance of a block's sum to that of the mean of as many blocks as there are.
  const auto block_size =
      static_cast<double>(std::int64_t{1} << PixelSamples::block_exponent(count));
  variance_divisor_ = static_cast<double>(blocks_ - 1) * block_size * static_cast<double>(count);
  student_ = student_95[blocks_ - 2];
}

Lanes PixelSamples::mean(const SampleCount& count) const {
  Lanes sum{};
  for (const Channels& block : blocks_) sum += to_doubles(block);
  return count.samples_.divide(sum);
}

inline Lanes PixelSamples::sum_of(std::size_t blocks) const {
  Lanes sum{};
  for (std::size_t b = 0; b < blocks; ++b) sum += to_doubles(blocks_[b]);
  return sum;
}

inline Lanes PixelSamples::variance_of(std::size_t blocks, const Lanes& sum,
                                       const SampleCount& count) const {
  const Lanes middle = count.full_blocks_.divide(sum);
  Lanes squares{};
  for (std::size_t b = 0; b < blocks; ++b) {
    const Lanes distance = to_doubles(blocks_[b]) - middle;
    squares += distance * distance;
  }
  return squares / count.variance_divisor_;
}

Lanes PixelSamples::variance(const SampleCount& count) const {
  return variance_of(count.blocks_, sum_of(count.blocks_), count);
}

template <class Self, class Use>
void PixelSamples::for_each_number(Self& self, const Use& use) {
  for (auto& block : self.blocks_) use(block);
  use(self.low_);
  use(self.high_);
  use(self.low_around_);
  use(self.high_around_);
  use(self.dropped_);
  use(self.identity_);
}

PixelSamples::Stored PixelSamples::stored() const {
  Stored bytes{};
  std::byte* next = bytes.data();
  for_each_number(*this, [&](const auto& number) {
    std::memcpy(next, &number, sizeof number);
    next += sizeof number;
  });
  for (std::size_t i = 0; i < flags().size(); ++i) {
    if (this->*flags()[i]) *next |= std::byte{1} << i;
  }
  return bytes;
}

PixelSamples PixelSamples::restored(const Stored& bytes) {
  PixelSamples result;
  const std::byte* next = bytes.data();
  for_each_number(result, [&](auto& number) {
    std::memcpy(&number, next, sizeof number);
    next += sizeof number;
  });
  for (std::size_t i = 0; i < flags().size(); ++i) {
    result.*flags()[i] = (*next >> i & std::byte{1}) != std::byte{0};
  }
  return result;
}

template <std::size_t full_blocks>
MeanInterval PixelSamples::interval(const SampleCount& count) const {
  const std::size_t blocks = full_blocks > 0 ? full_blocks : count.blocks_;
  if (blocks < 2) return {.least_shown = 1};
  const Channels low = has_statistics_ ? min(low_, low_around_) : low_;
  const Channels high = has_statistics_ ? max(high_, high_around_) : high_;
  const Lanes sum = sum_of(blocks);
  Lanes whole = sum;
  for (std::size_t b = blocks; b < block_count; ++b) whole += to_doubles(blocks_[b]);
  const Lanes means = count.samples_.divide(whole);
  // A NaN sample is neither the lowest nor the highest, but leaves the largest mean there is.
  const bool sees_one_colour = all_equal(low, high) && all(means <= 2 * to_doubles(high));
  if (!edge_ && !mixed_ && sees_one_colour) return {};

  const Lanes variance = variance_of(blocks, sum, count);
  const double overlooked_around =
      mixed_ ? count.overlooked_share_ : count.overlooked_share_of_neighbours_;
  const Lanes overlooked = max(count.overlooked_share_ * (to_doubles(high_) - to_doubles(low_)),
                               overlooked_around * (to_doubles(high) - to_doubles(low)));
  return {.mean = means,
          .half_width = max(count.student_ * sqrt(variance), overlooked),
          .least_shown = edge_ || mixed_ ? overlooked_around * least_contrast_of_edges : 0};
}

template MeanInterval PixelSamples::interval<0>(const SampleCount& count) const;
template MeanInterval PixelSamples::interval<PixelSamples::block_count>(
    const SampleCount& count) const;

}  // namespace crt::core
