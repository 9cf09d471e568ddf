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

/// By degrees of freedom, from 1 on: what a mean must be divided by to lie within the quotient in 95 of 100
/// cases (Student, The probable error of a mean, Biometrika 6(1), 1908).
constexpr std::array<double, 7> student_95 = {12.7062, 4.30265, 3.18245, 2.77645, 2.57058, 2.44691, 2.36462};

/// Of what is seen in and around a pixel, N samples may overlook this divided by N: see docs/trade.md.
constexpr double overlooked_samples = 2;
/// The same where the pixel itself shows one thing: of what its neighbours alone have seen.
constexpr double overlooked_samples_of_neighbours = 1;
/// What is taken for the contrast, on a display, of things that look alike where they were seen.
constexpr double least_contrast_of_edges = 1.0 / 8;

constexpr int alpha_channel = pixel_channels - 1;

}  // namespace

Lanes DisplayScale::shown(const Lanes& values) const {
  const Lanes clamped = clamp(values, Lanes{}, lanes_of(1));
  if (exponent_ == 1) return clamped;
  Lanes shown = rough_power(clamped, lanes_of(exponent_));
  shown[alpha_channel] = clamped[alpha_channel];
  return shown;
}

Lanes DisplayScale::half_widths(const Lanes& values, const Lanes& half_widths) const {
  const Lanes middle = shown(values);
  const Lanes least = values - half_widths;
  const Lanes below = middle - shown(least);
  // A scale that rises ever less: with as much room below nothing above is farther away.
  if (exponent_ <= 1 && all(least >= 0.0)) return below;
  return max(shown(values + half_widths) - middle, below);
}

Lanes PixelSamples::mean(std::int64_t count) const {
  Lanes sum{};
  for (const Channels& block : blocks_) sum += to_doubles(block);
  return sum / static_cast<double>(count);
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

double PixelSamples::half_width(std::int64_t count, const DisplayScale& scale) const {
  const int exponent = block_exponent(count);
  const auto blocks = static_cast<std::size_t>(count >> exponent);
  if (blocks < 2) return 1;
  const Channels low = has_notes_ ? min(low_, low_around_) : low_;
  const Channels high = has_notes_ ? max(high_, high_around_) : high_;
  Lanes sum{};
  for (std::size_t b = 0; b < blocks; ++b) sum += to_doubles(blocks_[b]);
  const Lanes middle = sum / static_cast<double>(blocks);
  for (std::size_t b = blocks; b < block_count; ++b) sum += to_doubles(blocks_[b]);
  const Lanes means = sum / static_cast<double>(count);
  // A sample that is no number is neither low nor high, but leaves the largest mean there is.
  const bool sees_one_colour = all_equal(low, high) && all(means <= 2 * to_doubles(high));
  if (!edge_ && !mixed_ && sees_one_colour) return 0;

  Lanes squares{};
  for (std::size_t b = 0; b < blocks; ++b) {
    const Lanes distance = to_doubles(blocks_[b]) - middle;
    squares += distance * distance;
  }
  const double samples = static_cast<double>(count);
  // The variance of a block's sum to that of the mean of as many blocks as there are.
  const Lanes variance = squares / (static_cast<double>(blocks - 1) *
                                    static_cast<double>(std::int64_t{1} << exponent) * samples);
  const double overlooked_here = overlooked_samples / samples;
  const double overlooked_around = mixed_ ? overlooked_here : overlooked_samples_of_neighbours / samples;
  const Lanes overlooked = max(overlooked_here * (to_doubles(high_) - to_doubles(low_)),
                               overlooked_around * (to_doubles(high) - to_doubles(low)));
  const Lanes half_widths = max(student_95[blocks - 2] * sqrt(variance), overlooked);

  double widest = edge_ || mixed_ ? overlooked_around * least_contrast_of_edges : 0;
  const Lanes shown = scale.half_widths(means, half_widths);
  for (int i = 0; i < pixel_channels; ++i) widest = std::max(widest, shown[i]);
  return widest;
}

}  // namespace crt::core
