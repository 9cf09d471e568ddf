#include "core/geometry/quadric/line.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/geometry/near_line.hpp"

namespace crt::core {
namespace {

/// This is the relative error of a few sums of products in twice the precision.
constexpr double rounding = 4 * precise_roundoff;
/// This is more than what underflows.
constexpr double underflow = 0x1p-900;

Vec3 sizes(const Vec3& v) {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

double sum(const Vec3& v) {
  return v.x + v.y + v.z;
}

PreciseVec3 scaled(const PreciseVec3& v, double power) {
  PreciseVec3 result = v;
  for (DoubleDouble& component : result) component = {component.hi * power, component.lo * power};
  return result;
}

Vec3 high_parts(const PreciseVec3& v) {
  return {v[0].hi, v[1].hi, v[2].hi};
}

PreciseVec3 precise(const Vec3& v) {
  return {v.x, v.y, v.z};
}

DoubleDouble half(const DoubleDouble& x) {
  return {x.hi / 2, x.lo / 2};
}

PreciseVec3 curved(const QuadricForm& form, const PreciseVec3& v) {
  const auto& [x, y, z] = form.rows;
  return {precise_dot(precise(x), v), precise_dot(precise(y), v), precise_dot(precise(z), v)};
}

/// Returns the sums of sizes of the terms of H v.
Vec3 curved_sizes(const QuadricForm& form, const Vec3& v) {
  const auto& [x, y, z] = form.rows;
  return {glm::dot(sizes(x), v), glm::dot(sizes(y), v), glm::dot(sizes(z), v)};
}

/// Returns a quotient whose divisor is certain.
Bounded quotient(const Bounded& a, const Bounded& b) {
  Bounded result{a.value / b.value};
  result.error =
      (a.error + result.size() * b.error) / (b.size() - b.error) + precise_roundoff * result.size();
  return result;
}

}  // namespace

QuadricLine QuadricLine::at_closest(const QuadricForm& form, const ExactRay& ray) {
  const double distance = largest_component(ray.near.origin);
  const double unit = form.has_size ? form.unit : power_of_two_below(distance);
  const NearLine line = NearLine::at_closest(ray.near, Vec3(0), unit);
  const DoubleDouble shift = line.to_precise_t(line.closest());
  return {form, ray, std::isfinite(shift.hi) ? shift : DoubleDouble()};
}

QuadricLine::QuadricLine(const QuadricForm& form, const ExactRay& ray, const DoubleDouble& shift)
    : shift_(shift),
      unit_(form.unit),
      inverse_speed_(inverse_of_power(power_of_two_below(largest_component(ray.near.direction)))) {
  const double inverse_unit = inverse_of_power(unit_);
  const PreciseVec3 p = scaled(precise_from_center(ray.near, Vec3(0), shift), inverse_unit);
  const PreciseVec3 d = scaled(precise_direction(ray.near), inverse_speed_);
  const double p_error = inverse_unit * ray.point_error(Vec3(0), shift.hi);
  const double d_error = inverse_speed_ * ray.direction_error;

  const PreciseVec3 turning = curved(form, d);
  const PreciseVec3 curving = curved(form, p);
  PreciseVec3 slope;      // the gradient H p + b
  PreciseVec3 slope_too;  // H p + 2 b
  for (std::size_t i = 0; i < 3; ++i) {
    const DoubleDouble linear = form.linear[static_cast<int>(i)];
    slope[i] = curving[i] + linear;
    slope_too[i] = slope[i] + linear;
  }
  a.value = half(precise_dot(d, turning));
  b.value = half(precise_dot(d, slope));
  c.value = half(precise_dot(p, slope_too)) + DoubleDouble(form.constant);

  // The errors of p and d themselves are among the sizes, so that their squares are, too.
  const Vec3 p_size = sizes(high_parts(p)) + Vec3(p_error);
  const Vec3 d_size = sizes(high_parts(d)) + Vec3(d_error);
  const Vec3 turning_size = curved_sizes(form, d_size);
  const Vec3 slope_size = curved_sizes(form, p_size) + 2.0 * sizes(form.linear);
  const double turning_sum = sum(turning_size);
  const double slope_sum = sum(slope_size);
  a.error = rounding * glm::dot(d_size, turning_size) + 2 * d_error * turning_sum + underflow;
  b.error = rounding * glm::dot(d_size, slope_size) + p_error * turning_sum + d_error * slope_sum +
            underflow;
  c.error = rounding * (glm::dot(p_size, slope_size) + std::abs(form.constant)) +
            2 * p_error * slope_sum + underflow;
}

Bounded QuadricLine::discriminant() const {
  Bounded result{b.value * b.value - a.value * c.value};
  result.error = rounding * (b.size() * b.size() + a.size() * c.size()) +
                 (2 * b.size() + b.error) * b.error + (a.size() + a.error) * c.error +
                 c.size() * a.error;
  return result;
}

std::array<Bounded, 2> QuadricLine::roots(const Bounded& discriminant) const {
  // In q = -(b + sign(b) sqrt(discriminant)) both summands have one sign, so nothing cancels.
  Bounded root{sqrt(discriminant.value)};
  root.error = discriminant.error / root.size() + precise_roundoff * root.size();
  const bool b_is_positive = b.value.hi > 0;
  Bounded q{b_is_positive ? -(b.value + root.value) : root.value - b.value};
  q.error = b.error + root.error + precise_roundoff * q.size();
  std::array<Bounded, 2> result = {t_of(quotient(q, a)), t_of(quotient(c, q))};
  const bool first_is_larger = b_is_positive == (a.value.hi < 0);
  if (first_is_larger) std::swap(result[0], result[1]);
  return result;
}

Bounded QuadricLine::only_root() const {
  const Bounded x = quotient(c, b);
  return t_of({half(-x.value), x.error / 2});
}

Bounded QuadricLine::root_beside_zero() const {
  const Bounded x = quotient(b, a);
  return t_of({{-2 * x.value.hi, -2 * x.value.lo}, 2 * x.error});
}

Bounded QuadricLine::t_of(const Bounded& x) const {
  const DoubleDouble from_shift{to_t_length(x.value.hi), to_t_length(x.value.lo)};
  Bounded t{shift_ + from_shift};
  t.error = to_t_length(x.error) + precise_roundoff * t.size();
  return t;
}

bool emit_roots(bool opens_up, const std::array<Crossing, 2>& roots, CrossingList& out) {
  bool inside_before = !opens_up;
  bool inside = inside_before;
  for (std::size_t i = 0; i < 2; ++i) {
    inside = !inside;
    Crossing crossing = roots[i];
    crossing.root = static_cast<std::uint8_t>(i);
    crossing.entering = inside;
    if (std::isfinite(crossing.t)) {
      out.push_back(crossing);
    } else if (crossing.t < 0) {
      inside_before = inside;
    }
  }
  return inside_before;
}

bool emit_only_root(bool rises, Crossing root, CrossingList& out) {
  root.entering = !rises;
  if (!std::isfinite(root.t)) return rises == (root.t > 0);
  out.push_back(root);
  return rises;
}

bool emit_from_surface(Side side, bool opens_up, Crossing other, double shortest,
                       CrossingList& out) {
  const bool inwards = side == Side::inside;
  const bool is_ahead = opens_up == inwards;
  if (!std::isfinite(other.t)) return emit_start(side, out);
  if (is_ahead ? !(other.t > 0) : !(other.t < 0)) {
    other.t = is_ahead ? shortest : -shortest;
    other.t_low = 0;
  }
  Crossing start{.root = 1, .entering = inwards};
  other.entering = !inwards;
  if (is_ahead) std::swap(start.root, other.root);
  out.push_back(is_ahead ? start : other);
  out.push_back(is_ahead ? other : start);
  return is_ahead != inwards;
}

bool emit_start(Side side, CrossingList& out) {
  const bool inwards = side == Side::inside;
  out.push_back({.entering = inwards});
  return !inwards;
}

double shortest_length(const ObjectRay& ray) {
  const double length =
      unit_roundoff * largest_component(ray.origin) / largest_component(ray.direction);
  return std::max(length, std::numeric_limits<double>::min());
}

}  // namespace crt::core
