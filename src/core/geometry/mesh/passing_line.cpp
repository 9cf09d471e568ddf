#include "core/geometry/mesh/passing_line.hpp"

#include <bit>
#include <limits>

#include "core/math/dyadic_vector.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

PassingLine::PassingLine(const ObjectRay& near, const ExactRay* ray, double origin_error,
                         double direction_error)
    : near_(near), ray_(ray) {
  const double scale = inverse_of_power(power_of_two_below(largest_component(near.direction)));
  constexpr double least = 0x1p-1070;  // what scaling may lose of a component
  direction_ = scale * near.direction;
  origin_error_ = origin_error + largest_component(near.origin_low);
  direction_error_ = scale * (direction_error + largest_component(near.direction_low)) + least;
}

// Errors. Six products of components make up S, each below 2 m^2 for the largest component m of
// the offsets. Each is off by 8 roundings at most, those of the offsets and sums among them. An
// error of the origin changes two factors, one of the direction a third.
PassingLine::Crossed PassingLine::crosses(const TriangleLanes& triangles, std::uint32_t some) {
  const VectorLanes origin = lanes_of(near_.origin);
  const VectorLanes direction = lanes_of(direction_);
  const VectorLanes to_a = triangles[0] - origin;
  const VectorLanes to_b = triangles[1] - origin;
  const VectorLanes to_c = triangles[2] - origin;
  const VectorLanes across_a = cross(direction, to_a);
  const VectorLanes across_b = cross(direction, to_b);
  const std::array<Lanes, 3> volumes = {dot(across_a, to_b), dot(across_b, to_c),
                                        -dot(across_a, to_c)};
  const Lanes size =
      max(max(largest_component(to_a), largest_component(to_b)), largest_component(to_c));
  constexpr double roundings = 6 * 2 * 8 + 1;
  const double by_direction = roundings * unit_roundoff + 6 * direction_error_;
  constexpr double least_size = 0x1p-450;  // so that nothing underflows
  const Lanes open = select(size > least_size, size * (size * by_direction + 24 * origin_error_),
                            lanes_of(std::numeric_limits<double>::infinity()));
  std::uint32_t left = 0;
  std::uint32_t right = 0;
  std::array<std::uint32_t, 3> decided{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t to_left = mask_of(volumes[i] > open);
    const std::uint32_t to_right = mask_of(volumes[i] < -open);
    decided[i] = to_left | to_right;
    left |= to_left;
    right |= to_right;
  }
  for (std::uint32_t near = some & ~(left & right); near != 0; near &= near - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(near));
    const std::uint32_t bit = near & (0u - near);
    for (std::size_t i = 0; i < 3 && (left & right & bit) == 0; ++i) {
      if ((decided[i] & bit) != 0) continue;
      const bool is_left =
          exact_side(triangles[i].lane(lane), triangles[(i + 1) % 3].lane(lane)) > 0;
      (is_left ? left : right) |= bit;
    }
  }
  return {.along = some & left & ~right, .against = some & right & ~left};
}

const ExactLine& PassingLine::exact() {
  if (!exact_) exact_ = ray_ != nullptr ? ray_->exact() : exact_line(near_);
  return *exact_;
}

int PassingLine::exact_side(const Vec3& from, const Vec3& to) {
  const ExactLine& line = exact();
  const DyadicVector a = line.weight * exactly(from) - line.origin;
  const DyadicVector b = line.weight * exactly(to) - line.origin;
  const DyadicVector moment = cross(a, b);
  if (const int sign = dot(line.direction, moment).sign()) return sign;
  const DyadicVector edge = exactly(to) - exactly(from);
  for (const Dyadic& component : cross(line.direction, edge)) {
    if (const int sign = component.sign()) return sign;
  }
  for (const Dyadic& component : moment) {
    if (const int sign = component.sign()) return sign;
  }
  if (const int sign = edge[2].sign()) return sign;
  if (const int sign = edge[1].sign()) return -sign;
  return edge[0].sign();
}

}  // namespace crt::core
