#include "core/geometry/grid_boxes.hpp"

#include <algorithm>

#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// These factors cover the roundings of a difference and a quotient.
constexpr double less = 1 - 0x1p-50;
constexpr double more = 1 + 0x1p-50;

constexpr double most_steps = 255;

/// Returns a power of two of which 255 reach over an extent.
double step_over(double extent) {
  constexpr double smallest = 0x1p-1000;
  double step = smallest;
  if (extent > smallest) step = power_of_two_below(extent) / 128;
  while (extent * more > most_steps * step) step *= 2;
  return step;
}

}  // namespace

GridBoxes::GridBoxes(std::span<const Bounds> boxes) {
  Bounds whole;
  for (const Bounds& box : boxes) whole.include(box);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double origin = whole.lower[axis];
    const double step = step_over(whole.upper[axis] - origin);
    origin_[i] = origin;
    step_[i] = step;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const double low = (boxes[k].lower[axis] - origin) * less;
      const double high = (boxes[k].upper[axis] - origin) * more;
      corners_[lower][i][k] = static_cast<std::uint8_t>(low / step);
      corners_[upper][i][k] =
          static_cast<std::uint8_t>(std::min(std::ceil(high / step), most_steps));
    }
  }
}

Bounds GridBoxes::box(std::size_t index) const {
  Bounds box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double low = origin_[i] + step_[i] * corners_[lower][i][index];
    const double high = origin_[i] + step_[i] * corners_[upper][i][index];
    constexpr double rounding = 0x1p-52;
    box.lower[axis] = low - rounding * std::abs(low);
    box.upper[axis] = high + rounding * std::abs(high);
  }
  return box;
}

std::uint32_t GridBoxes::touching(const Bounds& other) const {
  std::uint32_t result = 0;
  for (std::size_t half = 0; half < most; half += lane_count) {
    LaneMask touch = lanes_with(~0u);
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      // Steps are counted from the origin, with roundings of what they are counted of.
      const double low = other.lower[axis] - origin_[i];
      const double high = other.upper[axis] - origin_[i];
      const double from = (low - std::abs(low) * (more - 1)) / step_[i];
      const double to = (high + std::abs(high) * (more - 1)) / step_[i];
      touch = touch & (lanes_of_bytes(&corners_[lower][i][half]) <= to) &
              (lanes_of_bytes(&corners_[upper][i][half]) >= from);
    }
    result |= mask_of(touch) << half;
  }
  return result;
}

GridSlabs::GridSlabs(const Vec3& origin, const Vec3& direction, double origin_error)
    : origin_(lanes_of(origin.x, origin.y, origin.z, 1)),
      inverse_scale_(power_of_two_below(largest_component(direction))) {
  constexpr double least_share = 0x1p-1000;
  constexpr double least_distance = 0x1p-400;
  const double distance =
      origin_error + 16 * RaySlabs::slack * largest_component(origin) + least_distance;
  const double scale = inverse_of_power(inverse_scale_);
  std::array<double, lane_count> inverses{};
  std::array<double, lane_count> errors{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double share = direction[axis] * scale;
    const bool is_parallel = std::abs(share) < least_share;
    inverses[i] = is_parallel ? 1 / least_share : 1 / share;
    errors[i] = std::abs(inverses[i]) * (is_parallel ? distance : origin_error);
    near_[i] = inverses[i] < 0 ? GridBoxes::upper : GridBoxes::lower;
  }
  inverse_ = lanes_at<Lanes>(inverses.data());
  error_ = lanes_at<Lanes>(errors.data());
}

}  // namespace crt::core
