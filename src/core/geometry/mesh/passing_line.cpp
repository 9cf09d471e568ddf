#include "core/geometry/mesh/passing_line.hpp"

#include <bit>

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

void PassingLine::decide(const TriangleLanes& triangles, std::uint32_t some, Sides& sides) {
  auto& [left, right, decided] = sides;
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
