#include "core/geometry/mesh/passing_line.hpp"

#include <algorithm>
#include <cmath>

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
int PassingLine::crosses(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 to_a = a - near_.origin;
  const Vec3 to_b = b - near_.origin;
  const Vec3 to_c = c - near_.origin;
  const Vec3 across_a = glm::cross(direction_, to_a);
  const Vec3 across_b = glm::cross(direction_, to_b);
  const std::array<double, 3> volumes = {glm::dot(across_a, to_b), glm::dot(across_b, to_c),
                                         -glm::dot(across_a, to_c)};
  const double size =
      std::max({largest_component(to_a), largest_component(to_b), largest_component(to_c)});
  constexpr double roundings = 6 * 2 * 8 + 1;
  const double open =
      size * (size * (roundings * unit_roundoff + 6 * direction_error_) + 24 * origin_error_);
  constexpr double least_size = 0x1p-450;  // so that nothing underflows
  const bool is_safe = size > least_size;
  bool left = false;
  bool right = false;
  std::array<bool, 3> undecided{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (is_safe && std::abs(volumes[i]) > open) {
      left = left || volumes[i] > 0;
      right = right || volumes[i] < 0;
    } else {
      undecided[i] = true;
    }
  }
  const std::array<const Vec3*, 3> corners = {&a, &b, &c};
  for (std::size_t i = 0; i < 3 && !(left && right); ++i) {
    if (!undecided[i]) continue;
    const bool is_left = exact_side(*corners[i], *corners[(i + 1) % 3]) > 0;
    left = left || is_left;
    right = right || !is_left;
  }
  if (left && right) return 0;
  return left ? 1 : -1;
}

const ExactLine& PassingLine::exact() {
  if (!exact_) {
    exact_ = ray_ != nullptr
                 ? ray_->exact()
                 : ExactLine{.origin = exactly(near_.origin) + exactly(near_.origin_low),
                             .direction = exactly(near_.direction) + exactly(near_.direction_low)};
  }
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
