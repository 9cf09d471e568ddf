#include "core/geometry/exact_plane.hpp"

#include <algorithm>
#include <optional>

#include "core/math/vector.hpp"

namespace crt::core {
namespace {

/// This is at least the sum of a plane's normal's components, as none is larger than 1.
constexpr double normal_size = 3;

}  // namespace

DyadicVector exact_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const DyadicVector corner = exactly(a);
  return cross(exactly(b) - corner, exactly(c) - corner);
}

PreciseVec3 rounded_direction(const DyadicVector& direction) {
  std::array<ScaledNumber, 3> rounded;
  std::optional<int> largest;
  for (std::size_t i = 0; i < 3; ++i) {
    rounded[i] = direction[i].rounded();
    if (direction[i].sign() == 0) continue;
    largest = std::max(largest.value_or(rounded[i].exponent), rounded[i].exponent);
  }
  PreciseVec3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    rounded[i].exponent -= largest.value_or(0);
    result[i] = rounded[i].unscaled();
  }
  return result;
}

ExactPlane::ExactPlane(const Vec3& normal, const Vec3& position) : position_(position) {
  take_normal(exactly(normal));
}

ExactPlane ExactPlane::across_axis(const Vec3& from, const Vec3& to, const Vec3& position) {
  ExactPlane plane;
  plane.position_ = position;
  plane.take_normal(exactly(to) - exactly(from));
  return plane;
}

ExactPlane ExactPlane::through(const Vec3& a, const Vec3& b, const Vec3& c) {
  ExactPlane plane;
  plane.position_ = a;
  plane.take_normal(exact_normal(a, b, c));
  return plane;
}

void ExactPlane::take_normal(const DyadicVector& normal) {
  exact_normal_ = normal;
  normal_ = rounded_direction(normal);
  int components = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (normal[i].sign() == 0) continue;
    ++components;
    axis_ = components == 1 ? static_cast<int>(i) : -1;
  }
}

ExactPlane::Meeting ExactPlane::meet(const ExactRay& ray) const {
  return settled(ray, axis_ >= 0 ? estimate_across_axis(ray) : estimate(ray));
}

/// Estimates t by one quotient, and corrects it by the remainder.
ExactPlane::Meeting ExactPlane::estimate_across_axis(const ExactRay& ray) const {
  const ObjectRay& near = ray.near;
  const double speed = near.direction[axis_];
  Meeting result;
  if (!(std::abs(speed) > ray.direction_error)) return result;
  result.side = (speed > 0) == (normal_[static_cast<std::size_t>(axis_)].hi > 0) ? 1 : -1;
  const DoubleDouble offset = two_sum(position_[axis_], -near.origin[axis_]);
  const double quotient = offset.hi / speed;
  const double low = offset.lo - near.origin_low[axis_];
  const double drift = quotient * near.direction_low[axis_];
  const double remainder = std::fma(-quotient, speed, offset.hi) + (low - drift);
  result.t = two_sum(quotient, remainder / speed);
  // Besides the ray's own errors there are the roundings of these summands, each far below that of
  // the quotient.
  constexpr double roundings = 4;
  const double rounding = roundings * unit_roundoff *
                          (std::abs(offset.lo) + std::abs(near.origin_low[axis_]) +
                           std::abs(drift) + std::abs(remainder));
  result.error =
      (rounding + ray.origin_error + std::abs(quotient) * ray.direction_error) / std::abs(speed) +
      precise_roundoff * std::abs(quotient);
  return result;
}

ExactPlane::Rate ExactPlane::rate(const ExactRay& ray) const {
  const PreciseVec3 direction = precise_direction(ray.near);
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) size += std::abs(normal_[i].hi * direction[i].hi);
  return {precise_dot(normal_, direction),
          precise_roundoff * size + normal_size * ray.direction_error};
}

int ExactPlane::side(const ExactRay& ray) const {
  const Rate estimate = rate(ray);
  if (estimate.error == 0 && estimate.value.hi == 0)
    return 0;  // every product is 0, so nothing was rounded
  return estimate.certain() ? estimate.sign() : meet_exactly(ray.exact()).side;
}

ExactPlane::Meeting ExactPlane::estimate(const ExactRay& ray) const {
  const ObjectRay& near = ray.near;
  const Rate rate = this->rate(ray);
  Meeting result;
  if (!rate.certain()) return result;
  PreciseVec3 offset;
  double size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const DoubleDouble high = two_sum(near.origin[axis], -position_[axis]);
    offset[i] = two_sum(high.hi, high.lo + near.origin_low[axis]);
    size += std::abs(normal_[i].hi) * (std::abs(near.origin[axis]) + std::abs(position_[axis]));
  }
  const DoubleDouble height = precise_dot(normal_, offset);
  result.side = rate.sign();
  result.t = -height / rate.value;
  const double height_error = precise_roundoff * size + normal_size * ray.origin_error;
  result.error =
      (height_error + std::abs(result.t.hi) * rate.error) / (std::abs(rate.value.hi) - rate.error) +
      precise_roundoff * std::abs(result.t.hi);
  return result;
}

/// Returns the estimate if it decides everything, and the exact meeting otherwise.
ExactPlane::Meeting ExactPlane::settled(const ExactRay& ray, const Meeting& estimate) const {
  const double t = estimate.t.hi;
  if (estimate.side != 0 && ray.is_settled(t, estimate.error) && std::isfinite(t)) return estimate;
  Meeting result;
  if (axis_ >= 0 && ray.near.direction[axis_] == 0 && ray.origin_error == 0 &&
      ray.direction_error == 0) {
    // The sum of these three doubles has the right sign.
    const DoubleDouble height = two_sum(ray.near.origin[axis_], -position_[axis_]) +
                                DoubleDouble(ray.near.origin_low[axis_]);
    const bool upwards = normal_[static_cast<std::size_t>(axis_)].hi > 0;
    result.behind = upwards ? height.hi < 0 : height.hi > 0;
    return result;
  }
  const Fraction exact = meet_exactly(ray.exact());
  result.behind = exact.side < 0 ? exact.numerator.sign() < 0 : exact.numerator.sign() > 0;
  if (exact.side == 0) return result;
  result.t = (exact.numerator.rounded() / exact.denominator.rounded()).unscaled();
  result.error = precise_roundoff * std::abs(result.t.hi);
  if (std::isfinite(result.t.hi)) result.side = exact.side;
  return result;
}

ExactPlane::Meeting ExactPlane::meet_surface(const ExactRay& ray) const {
  if (ray.near.start.face != 0) return meet(ray);
  Meeting meeting;
  if (side(ray) != 0) meeting.side = ray.near.start.side == Side::inside ? -1 : 1;
  return meeting;
}

ExactPlane::Fraction ExactPlane::meet_exactly(const ExactLine& line) const {
  Fraction t;
  t.numerator = dot(exact_normal_, line.weight * exactly(position_) - line.origin);
  t.denominator = dot(exact_normal_, line.direction);
  t.side = t.denominator.sign();
  if (t.side >= 0) return t;
  return {-t.numerator, -t.denominator, t.side};
}

int order(const ExactRay& ray, const ExactPlane& first_plane, const ExactPlane::Meeting& first,
          const ExactPlane& second_plane, const ExactPlane::Meeting& second) {
  const double difference = (first.t.hi - second.t.hi) + (first.t.lo - second.t.lo);
  const double rounding = precise_roundoff * (std::abs(first.t.hi) + std::abs(second.t.hi));
  if (std::abs(difference) > first.error + second.error + rounding) return difference > 0 ? 1 : -1;
  const ExactLine line = ray.exact();
  const ExactPlane::Fraction a = first_plane.meet_exactly(line);
  const ExactPlane::Fraction b = second_plane.meet_exactly(line);
  return (a.numerator * b.denominator - b.numerator * a.denominator).sign();
}

ExactPoint exact_point(const ExactLine& line, const ExactPlane::Fraction& t, const Vec3& center) {
  ExactPoint point;
  point.weight = line.weight * t.denominator;
  point.offset =
      t.denominator * line.origin + t.numerator * line.direction - point.weight * exactly(center);
  return point;
}

}  // namespace crt::core
