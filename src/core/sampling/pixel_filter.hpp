// A pixel filter says where around a pixel's middle its samples lie. Places are drawn with the
// filter's weight as their density, so that a pixel is the plain mean of its samples, whatever the
// filter.
#pragma once

#include <array>
#include <cstddef>

#include "core/math/lanes.hpp"
#include "crt/settings.hpp"

namespace crt::core {

class FilterPlaces {
 public:
  /// Takes the settings' filter and its width, which must be valid.
  explicit FilterPlaces(const Settings& settings);

  /// Returns the distance from the pixel's left (or upper) side, in pixels, for a number in [0, 1).
  /// It is in [0, 1) for the box, and may be beside the pixel for wider filters. It increases with
  /// the number.
  double operator()(double u) const {
    if (is_box_) return u;
    const double place = u * double{intervals};
    const auto index = static_cast<std::size_t>(place);
    return places_[index] +
           (place - static_cast<double>(index)) * (places_[index + 1] - places_[index]);
  }
  Lanes operator()(const Lanes& u) const {
    if (is_box_) return u;
    return Lanes([&](auto lane) { return (*this)(double{u[lane]}); });
  }

 private:
  static constexpr std::size_t intervals = 1024;

  bool is_box_ = true;
  /// These are the filter's quantiles.
  std::array<double, intervals + 1> places_{};
};

}  // namespace crt::core
