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

/// As floats, of which none is infinite.
Channels rounded(const Lanes& values) {
  const Lanes largest = lanes_of(std::numeric_limits<float>::max());
  const Lanes clamped = min(max(values, -largest), largest);
  Channels result;
  for (int i = 0; i < pixel_channels; ++i)
    result[static_cast<std::size_t>(i)] = static_cast<float>(clamped[i]);
  return result;
}

Lanes exactly(const Channels& channels) {
  return Lanes{double{channels[0]}, double{channels[1]}, double{channels[2]}, double{channels[3]}};
}

void widen(Channels& low, Channels& high, const Channels& other_low, const Channels& other_high) {
  for (std::size_t i = 0; i < pixel_channels; ++i) {
    low[i] = std::min(low[i], other_low[i]);
    high[i] = std::max(high[i], other_high[i]);
  }
}

}  // namespace

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

void PixelSamples::add_step(std::int64_t count, const SampleSum& step) {
  const std::int64_t size = block_size(count + step.count);
  if (count > 0 && size != block_size(count)) merge_blocks();
  Channels& block = blocks_[static_cast<std::size_t>(count / size)];
  block = rounded(exactly(block) + step.sum);
  const Channels low = rounded(step.low);
  const Channels high = rounded(step.high);
  const auto identity = static_cast<std::uint32_t>(step.identity ^ step.identity >> 32);
  if (count == 0) {
    low_ = low;
    high_ = high;
    identity_ = identity;
  }
  widen(low_, high_, low, high);
  mixed_ = mixed_ || step.mixed || identity != identity_;
  dropped_ = static_cast<float>(double{dropped_} + step.dropped);
}

Lanes PixelSamples::mean(std::int64_t count) const {
  Lanes sum{};
  for (const Channels& block : blocks_) sum += exactly(block);
  return sum / static_cast<double>(count);
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
  Channels low = low_;
  Channels high = high_;
  if (has_notes_) widen(low, high, low_around_, high_around_);

  Lanes middle{};
  for (std::size_t b = 0; b < blocks; ++b) middle += exactly(blocks_[b]);
  middle /= static_cast<double>(blocks);
  Lanes squares{};
  for (std::size_t b = 0; b < blocks; ++b) {
    const Lanes distance = exactly(blocks_[b]) - middle;
    squares += distance * distance;
  }
  const double samples = static_cast<double>(count);
  // The variance of a block's sum to that of the mean of as many blocks as there are.
  const Lanes variance = squares / (static_cast<double>(blocks - 1) * static_cast<double>(size) * samples);
  const double overlooked_share = overlooked_samples / samples;
  const Lanes half_widths =
      max(student_95[blocks - 2] * sqrt(variance), overlooked_share * (exactly(high) - exactly(low)));

  const Lanes means = mean(count);
  double widest = edge_ || mixed_ ? overlooked_share * least_contrast_of_edges : 0;
  for (int i = 0; i < pixel_channels; ++i) {
    const bool is_alpha = i == pixel_channels - 1;
    const double shown = scale.half_width(means[i], half_widths[i], is_alpha);
    if (!(shown <= widest)) widest = shown;
  }
  return widest <= 1 ? widest : 1;
}

}  // namespace crt::core
