// Exact cylinders and cones first try rounded arithmetic. Lengths are in `unit`, a power of two
// near the wider radius, and W is in one near its own size.
#include <limits>

#include "core/geometry/exact_shape.hpp"
#include "core/geometry/frustum/exact.hpp"
#include "core/geometry/frustum/frustum.hpp"
#include "core/math/vector.hpp"

namespace crt::core {
namespace {

/// These are far more roundings than any of the filters in doubles has.
constexpr double filter_rounding = 0x1p8 * unit_roundoff;
/// These bound each component of W in its unit, and the sum of them.
constexpr double largest_of_axis = 2;
constexpr double sum_of_axis = 6;

}  // namespace

ExactFrustum::ExactFrustum(const Vec3& from, const Vec3& to, double from_radius, double to_radius)
    : narrow(to_radius > from_radius ? from : to),
      wide(to_radius > from_radius ? to : from),
      radius(std::min(from_radius, to_radius)),
      wide_radius(std::max(from_radius, to_radius)),
      unit(power_of_two_below(wide_radius)) {
  const double axis_unit = power_of_two_below(largest_component(wide - narrow));
  for (int i = 0; i < 3; ++i) {
    const DoubleDouble component = two_sum(wide[i], -narrow[i]);
    axis[static_cast<std::size_t>(i)] = {component.hi / axis_unit, component.lo / axis_unit};
  }
  squared_length = precise_dot(axis, axis);
  narrow_part = squared_length * DoubleDouble(radius / unit);
  const DoubleDouble difference = two_sum(wide_radius, -radius);
  growth = {difference.hi / axis_unit, difference.lo / axis_unit};
}

std::optional<int> FilteredSide::sign_at(const CapMeeting& end) const {
  if (!end.found()) return 1;
  if (end.within_rim) return -1;
  const double off = end.meeting.error * largest_component(ray_.near.direction);
  const std::optional<int> rough = rough_sign_at(end.meeting.t, off);
  return rough ? rough : precise_at(end.meeting.t, off).sign();
}

std::optional<bool> FilteredSide::is_inside_between(const CapMeeting& enter,
                                                    const CapMeeting& leave) {
  find_middle(enter, leave);
  const Local& g = middle_;
  const double error = filter_rounding * (g.inner * g.inner + g.outer * g.outer) +
                       2 * (g.inner + g.outer) * g.rate_of_points * point_error(middle_t_);
  if (lowest_between(enter, leave) > error) return false;
  const bool surely_between =
      distance_to(enter) < -enter.meeting.error && distance_to(leave) > leave.meeting.error;
  if (!surely_between) return std::nullopt;
  if (g.value < -error) return true;
  const Precise precise = precise_at(middle_t_, 0);
  if (precise.value.hi < -precise.error) return true;
  return std::nullopt;
}

std::optional<Crossing> FilteredSide::root(bool entering, const CapMeeting& enter,
                                           const CapMeeting& leave) {
  if (!line_) find_middle(enter, leave);
  const Local& g = middle_;
  if (!(std::abs(g.curvature) > g.curvature_error)) return std::nullopt;
  const double half = std::sqrt(std::max(g.slope * g.slope - g.curvature * g.value, 0.0));
  // This is the root with the wanted slope, by the formula that adds what has one sign.
  const double side = entering ? -1 : 1;
  const double x = side * g.slope < 0 ? (side * half - g.slope) / g.curvature
                                      : -g.value / (g.slope + side * half);
  Crossing crossing{.face = FrustumShape::side_face, .entering = entering};
  crossing.root = (g.curvature > 0) == entering ? 0 : 1;
  if (!polish(line_->to_precise_t(x), crossing)) return std::nullopt;
  return crossing;
}

std::optional<SideStart> FilteredSide::start() const {
  const PointAt at = point_at(0.0, 0);
  PreciseVec3 d = precise_direction(ray_.near);
  for (DoubleDouble& component : d)
    component = {component.hi / frustum_.unit, component.lo / frustum_.unit};
  const double d_error = ray_.direction_error / frustum_.unit;
  const PointAt way = part_of(d, d_error + precise_roundoff * sum_of_sizes(d), 0.0);
  const DoubleDouble& ll = frustum_.squared_length;
  const DoubleDouble a = ll * precise_dot(way.across, way.across) - way.radius * way.radius;
  const DoubleDouble b = ll * precise_dot(at.across, way.across) - at.radius * way.radius;
  const double a_error = difference_error(way, way);
  const double b_error = difference_error(at, way);
  const bool cylinder = frustum_.growth.hi == 0;
  const auto certain = [](const DoubleDouble& value, double error) {
    return std::abs(value.hi) > error;
  };
  if (!certain(a, a_error) || !certain(b, b_error)) return std::nullopt;
  if (!cylinder &&
      (!certain(at.radius, at.radius_error) || !certain(way.radius, way.radius_error))) {
    return std::nullopt;
  }
  SideStart result{.a = sign_of(a.hi),
                   .b = sign_of(b.hi),
                   .radius = sign_of(at.radius.hi),
                   .radius_rate = cylinder ? 0 : sign_of(way.radius.hi),
                   .other = {.face = FrustumShape::side_face}};
  const DoubleDouble half = -b / a;
  result.other.t = 2 * half.hi;
  result.other.t_low = 2 * half.lo;
  result.other.error = 2 * (b_error + std::abs(half.hi) * a_error) / (std::abs(a.hi) - a_error) +
                       precise_roundoff * std::abs(result.other.t);
  if (!ray_.is_settled(result.other.t, result.other.error)) return std::nullopt;
  return result;
}

std::optional<int> FilteredSide::rough_sign_at(DoubleDouble t, double off) const {
  const Vec3 p = ray_.near.from_center(frustum_.narrow, t.hi, t.lo) * (1 / frustum_.unit);
  const double length = std::sqrt(frustum_.squared_length.hi);
  const double growth = frustum_.growth.hi;
  const double distance = length * glm::length(accurate_cross(p, axis_));
  const double radius = frustum_.narrow_part.hi + growth * glm::dot(p, axis_);
  const double size = largest_component(p);
  const double rate = sum_of_axis * (2 * length + growth);
  const double error = filter_rounding * (rate * size + frustum_.narrow_part.hi) +
                       rate * (point_error(t) + off / frustum_.unit);
  if (!(std::abs(distance - radius) > error)) return std::nullopt;
  return distance > radius ? 1 : -1;
}

FilteredSide::PointAt FilteredSide::part_of(const PreciseVec3& p, double error,
                                            DoubleDouble offset) const {
  const PreciseVec3& w = frustum_.axis;
  const double size = sum_of_sizes(p);
  const double growth = frustum_.growth.hi;
  PointAt result;
  result.across = precise_cross(p, w);
  result.across_size = sum_of_sizes(result.across);
  result.across_error = 2 * largest_of_axis * (error + precise_roundoff * size);
  result.radius = offset + frustum_.growth * precise_dot(p, w);
  result.radius_error =
      sum_of_axis * growth * (error + precise_roundoff * size) + precise_roundoff * offset.hi;
  return result;
}

FilteredSide::PointAt FilteredSide::point_at(DoubleDouble t, double off) const {
  PreciseVec3 p = precise_from_center(ray_.near, frustum_.narrow, t);
  const double scale = 1 / frustum_.unit;
  for (DoubleDouble& component : p) component = {component.hi * scale, component.lo * scale};
  return part_of(p, point_error(t) + off * scale, frustum_.narrow_part);
}

double FilteredSide::difference_error(const PointAt& a, const PointAt& b) const {
  const double ll = frustum_.squared_length.hi;
  return ll * (a.across_size * b.across_error + b.across_size * a.across_error +
               3 * a.across_error * b.across_error) +
         std::abs(a.radius.hi) * b.radius_error + std::abs(b.radius.hi) * a.radius_error +
         a.radius_error * b.radius_error +
         precise_roundoff *
             (ll * a.across_size * b.across_size + std::abs(a.radius.hi * b.radius.hi));
}

FilteredSide::Precise FilteredSide::precise_at(DoubleDouble t, double off) const {
  const PointAt at = point_at(t, off);
  const DoubleDouble& ll = frustum_.squared_length;
  Precise result;
  result.value = ll * precise_dot(at.across, at.across) - at.radius * at.radius;
  result.error = difference_error(at, at);

  const Vec3 d = ray_.near.direction * (1 / frustum_.unit);
  const Vec3 turning = accurate_cross(d, axis_);
  const Vec3 across{at.across[0].hi, at.across[1].hi, at.across[2].hi};
  const double growth = frustum_.growth.hi;
  const double widening = growth * glm::dot(d, axis_);
  result.rate = 2 * (ll.hi * glm::dot(across, turning) - at.radius.hi * widening);
  const double axis_size = sum_of_axis * largest_component(d);
  const double rate_rounding =
      0x1p-46 + 2 * ray_.direction_error / largest_component(ray_.near.direction);
  result.rate_error = rate_rounding * (ll.hi * at.across_size * axis_size +
                                       std::abs(at.radius.hi) * growth * axis_size);
  result.half_curvature = ll.hi * glm::dot(turning, turning) + widening * widening;
  return result;
}

void FilteredSide::find_middle(const CapMeeting& enter, const CapMeeting& leave) {
  line_ = NearLine::at_closest(ray_.near, frustum_.narrow, frustum_.unit);
  middle_ = local();
  middle_t_ = line_->to_precise_t(middle_.curvature > 0 ? -middle_.slope / middle_.curvature : 0);
  if (enter.found() && !(distance_to(enter) < 0)) middle_t_ = enter.meeting.t;
  if (leave.found() && !(distance_to(leave) > 0)) middle_t_ = leave.meeting.t;
  if (!std::isfinite(middle_t_.hi)) middle_t_ = line_->to_precise_t(0);
  line_->move_to(ray_.near, frustum_.narrow, middle_t_);
  middle_ = local();
}

double FilteredSide::distance_to(const CapMeeting& end) const {
  if (!end.found()) return end.meeting.side * std::numeric_limits<double>::infinity();
  return (end.meeting.t.hi - middle_t_.hi) + (end.meeting.t.lo - middle_t_.lo);
}

FilteredSide::Local FilteredSide::local() const {
  const Vec3& p = line_->point;
  const Vec3& d = line_->direction;
  const double length = std::sqrt(frustum_.squared_length.hi);
  const double growth = frustum_.growth.hi;
  const Vec3 turning = length * accurate_cross(d, axis_);
  const Vec3 across = length * accurate_cross(p, axis_);
  const double widening = growth * glm::dot(d, axis_);
  const double radius = frustum_.narrow_part.hi + growth * glm::dot(p, axis_);
  const double turn = glm::length(turning);
  const double distance = glm::length(across);
  const double size = largest_component(p);
  Local g{};
  g.curvature = (turn - std::abs(widening)) * (turn + std::abs(widening));
  g.slope = glm::dot(across, turning) - radius * widening;
  g.value = (distance - std::abs(radius)) * (distance + std::abs(radius));
  g.rate_of_points = sum_of_axis * (2 * length + growth);
  g.inner = std::max(distance, g.rate_of_points * size);
  g.outer = std::max(std::abs(radius), frustum_.narrow_part.hi + g.rate_of_points * size);
  constexpr double largest_direction = 2;
  const double off =
      g.rate_of_points * largest_direction *
      (4 * unit_roundoff + ray_.direction_error / largest_component(ray_.near.direction));
  const double rates = turn + std::abs(widening);
  g.slope_error = (filter_rounding * rates + off) * (g.inner + g.outer);
  g.curvature_error = filter_rounding * rates * rates + 2 * rates * off + off * off;
  return g;
}

double FilteredSide::lowest_between(const CapMeeting& enter, const CapMeeting& leave) const {
  const Local& g = middle_;
  const double steepest = std::abs(g.slope) + g.slope_error;
  const double opening = g.curvature - g.curvature_error;
  const double by_vertex = opening > 0 ? g.value - steepest / opening * steepest
                                       : -std::numeric_limits<double>::infinity();
  // A parabola that opens upwards is nowhere below a tangent. Otherwise it is lowest at an end.
  const auto tangent_at = [&](const CapMeeting& end) {
    const double way = distance_to(end) / line_->to_t_length(1);
    return 2 * (g.slope * way - g.slope_error * std::abs(way));
  };
  const double by_tangent = g.value + std::min(tangent_at(enter), tangent_at(leave));
  return std::isnan(by_tangent) ? by_vertex : std::max(by_vertex, by_tangent);
}

bool FilteredSide::polish(DoubleDouble t, Crossing& crossing) const {
  constexpr int most_steps = 4;
  for (int step = 0; step < most_steps; ++step) {
    const Precise g = precise_at(t, 0);
    if ((g.rate < 0) != crossing.entering) return false;
    const NewtonStep newton{.change = g.value.value() / g.rate,
                            .value_error = g.error,
                            .rate = g.rate,
                            .rate_error = g.rate_error,
                            .half_curvature = g.half_curvature};
    t = t + DoubleDouble(-newton.change);
    const double error = newton.error() + precise_roundoff * std::abs(t.hi);
    if (settle(ray_, t, error, crossing)) return true;
  }
  return false;
}

}  // namespace crt::core
