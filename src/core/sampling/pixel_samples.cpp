#include "core/sampling/pixel_samples.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace crt::core {

namespace {

/// By degrees of freedom, from 1 on: what a mean must be divided by to lie within the quotient in 95 of 100
/// cases (Student, The probable error of a mean, Biometrika 6(1), 1908).
constexpr std::array<double, 7> student_95 = {12.7062, 4.30265, 3.18245, 2.77645, 2.57058, 2.44691, 2.36462};

/// Of what is seen in and around a pixel, N samples may overlook this divided by N: see docs/trade.md.
constexpr double overlooked_samples = 2;
/// What is taken for the contrast, on a display, of things that look alike where they were seen.
constexpr double least_contrast_of_edges = 1.0 / 8;

float channel(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -largest, largest));
}

void widen(Channels& low, Channels& high, const Channels& other_low, const Channels& other_high) {
  for (std::size_t i = 0; i < pixel_channels; ++i) {
    low[i] = std::min(low[i], other_low[i]);
    high[i] = std::max(high[i], other_high[i]);
  }
}

}  // namespace

void SampleSum::add(const std::array<double, pixel_channels>& values, std::uint64_t sample_identity,
                    double lost) {
  Channels rounded;
  for (std::size_t i = 0; i < pixel_channels; ++i) {
    sum[i] += values[i];
    rounded[i] = channel(values[i]);
  }
  if (count++ == 0) {
    low = high = rounded;
    identity = sample_identity;
  }
  widen(low, high, rounded, rounded);
  mixed = mixed || sample_identity != identity;
  dropped += lost;
}

double DisplayScale::shown(double value) const {
  const double clamped = std::clamp(value, 0.0, 1.0);
  return exponent_ == 1 ? clamped : std::pow(clamped, exponent_);
}

double DisplayScale::half_width(double value, double half_width, bool is_alpha) const {
  const double low = std::clamp(value - half_width, 0.0, 1.0);
  const double high = std::clamp(value + half_width, 0.0, 1.0);
  const double middle = std::clamp(value, 0.0, 1.0);
  if (is_alpha || exponent_ == 1) return std::max(high - middle, middle - low);
  return std::max(shown(high) - shown(middle), shown(middle) - shown(low));
}

std::int64_t PixelSamples::block_size(std::int64_t count) {
  if (count <= std::int64_t{block_count}) return 1;
  return static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(count))) /
         std::int64_t{block_count};
}

void PixelSamples::merge_blocks() {
  for (std::size_t i = 0; i < block_count / 2; ++i) {
    for (std::size_t c = 0; c < pixel_channels; ++c) {
      blocks_[i][c] = blocks_[2 * i][c] + blocks_[2 * i + 1][c];
    }
  }
  std::fill(blocks_.begin() + block_count / 2, blocks_.end(), Channels{});
}

void PixelSamples::add_pass(std::int64_t count, const SampleSum& pass) {
  const std::int64_t size = block_size(count + pass.count);
  if (count > 0 && size != block_size(count)) merge_blocks();
  Channels& block = blocks_[static_cast<std::size_t>(count / size)];
  for (std::size_t i = 0; i < pixel_channels; ++i) block[i] = channel(double{block[i]} + pass.sum[i]);
  const auto pass_identity = static_cast<std::uint32_t>(pass.identity ^ pass.identity >> 32);
  if (count == 0) {
    low_ = pass.low;
    high_ = pass.high;
    identity_ = pass_identity;
  }
  widen(low_, high_, pass.low, pass.high);
  mixed_ = mixed_ || pass.mixed || pass_identity != identity_;
  dropped_ = static_cast<float>(double{dropped_} + pass.dropped);
}

std::array<double, pixel_channels> PixelSamples::mean(std::int64_t count) const {
  std::array<double, pixel_channels> mean{};
  for (std::size_t i = 0; i < pixel_channels; ++i) {
    for (const Channels& block : blocks_) mean[i] += double{block[i]};
    mean[i] /= static_cast<double>(count);
  }
  return mean;
}

void PixelSamples::take_note(const PixelSamples& neighbour) {
  if (!has_notes_) {
    low_around_ = neighbour.low_;
    high_around_ = neighbour.high_;
    has_notes_ = true;
  }
  widen(low_around_, high_around_, neighbour.low_, neighbour.high_);
  edge_ = edge_ || neighbour.mixed_ || neighbour.identity_ != identity_;
}

double PixelSamples::half_width(std::int64_t count, const DisplayScale& scale) const {
  const std::int64_t size = block_size(count);
  const auto blocks = static_cast<std::size_t>(count / size);
  if (blocks < 2) return 1;
  const std::array<double, pixel_channels> means = mean(count);
  Channels low = low_;
  Channels high = high_;
  if (has_notes_) widen(low, high, low_around_, high_around_);
  const double overlooked_share = overlooked_samples / static_cast<double>(count);
  double widest = edge_ || mixed_ ? overlooked_share * least_contrast_of_edges : 0;
  for (std::size_t i = 0; i < pixel_channels; ++i) {
    double middle = 0;
    for (std::size_t b = 0; b < blocks; ++b) middle += double{blocks_[b][i]};
    middle /= static_cast<double>(blocks);
    double squares = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      const double distance = double{blocks_[b][i]} - middle;
      squares += distance * distance;
    }
    const double variance = squares / static_cast<double>(blocks - 1) / static_cast<double>(size * size);
    const double of_blocks =
        student_95[blocks - 2] * std::sqrt(variance * static_cast<double>(size) / static_cast<double>(count));
    const double overlooked = overlooked_share * (double{high[i]} - double{low[i]});
    const bool is_alpha = i == pixel_channels - 1;
    const double shown = scale.half_width(means[i], std::max(of_blocks, overlooked), is_alpha);
    if (!(shown <= widest)) widest = shown;
  }
  return widest <= 1 ? widest : 1;
}

}  // namespace crt::core
