#include "core/geometry/frustum/frustum.hpp"

#include <crt/elementary.hpp>

#include "core/geometry/disc/disc.hpp"
#include "core/geometry/frustum/enclose.hpp"
#include "core/geometry/frustum/start.hpp"

#include "core/geometry/frustum/functions.hpp"

namespace crt::core {

FrustumShape::FrustumShape(const Vec3& from, const Vec3& to, double from_radius, double to_radius)
    : from_(from), to_(to), radii_{from_radius, to_radius}, frame_(frame_about(to - from)) {
  caps_[0].emplace(from - to, from);
  if (to_radius > 0) caps_[1].emplace(to - from, to);
  const bool widening = to_radius > from_radius;
  narrow_ = widening ? from : to;
  axis_ = widening ? frame_.along : -frame_.along;
  const double wide = std::max(from_radius, to_radius);
  const double narrow = std::min(from_radius, to_radius);
  unit_ = power_of_two_below(wide);
  const Vec3 axis = to - from;
  const double axis_scale = power_of_two_below(largest_component(axis));
  height_ = glm::length(axis * (1 / axis_scale)) * axis_scale / unit_;
  wide_radius_ = wide / unit_;
  narrow_radius_ = narrow / unit_;
  if (wide > narrow) {
    const double growth = (wide - narrow) / unit_;
    const double slant = elementary::hypot(growth, height_);
    cosine_ = height_ / slant;
    sine_ = growth / slant;
  }
}

std::unique_ptr<const FaceFunctions> FrustumShape::face_functions() const {
  const auto [narrow, wide] = std::minmax(radii_[0], radii_[1]);
  return face_functions_of(FrustumFunctions(from_, to_, narrow_, narrow, wide));
}

SurfacePieces FrustumShape::pieces() const {
  if (radii_[0] != radii_[1]) return {};
  const double radius = radii_[0];
  SurfacePieces pieces = {
      {.kind = SurfacePiece::Kind::tube, .origin = from_, .edge_a = to_ - from_, .radius = radius}};
  for (const std::optional<PlaneFace>& cap : caps_) {
    pieces.push_back({.kind = SurfacePiece::Kind::disc,
                      .origin = cap->position(),
                      .edge_a = radius * frame_.zero,
                      .edge_b = radius * frame_.quarter,
                      .normal = cap->unit_normal()});
  }
  return pieces;
}

Bounds FrustumShape::bounds() const {
  Bounds result;
  result.include_around(from_, disc_extents(to_ - from_, radii_[0]));
  result.include_around(to_, disc_extents(to_ - from_, radii_[1]));
  if (caps_[0]->axis() >= 0) {
    const int axis = caps_[0]->axis();
    result.lower[axis] = std::min(from_[axis], to_[axis]);
    result.upper[axis] = std::max(from_[axis], to_[axis]);
  }
  return result;
}

std::unique_ptr<const PlacedSolid> FrustumShape::placed(const Placement& placement) const {
  const bool widens = narrow_ == from_;
  const EnclosedFrustum solid{.narrow = narrow_,
                              .axis = axis_,
                              .height = height_ * unit_,
                              .narrow_radius = narrow_radius_ * unit_,
                              .wide_radius = wide_radius_ * unit_,
                              .cosine = cosine_,
                              .sine = sine_,
                              .wide_face = widens ? 2U : 1U};
  return place(solid, placement);
}

bool FrustumShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  NearLine line = NearLine::at_closest(ray, narrow_, unit_);
  ClippedSpan span(ray.start, line.to_t_length(unit_roundoff * std::min(height_, wide_radius_)));
  for (std::uint32_t cap = 0; cap < 2; ++cap) {
    if (caps_[cap]) caps_[cap]->clip(ray, cap + 1, span);
  }
  if (ray.start.face == side_face) {
    clip_side_from_surface(side_start(ray, span), ray.start, span);
    return span.finish(out);
  }
  // Squares of what is farther away could overflow. The closest point is known to a few units.
  constexpr double far = 64;
  const bool passes_far = largest_component(line.point) > far * (height_ + wide_radius_);
  if (ray.start.face == invalid_index && (span.empty() || passes_far)) return false;
  const SideRates rates = side_rates(line);
  if (!move_to_least(ray, line, rates, span)) return false;
  clip_side(ray, line, rates, span);
  return span.finish(out);
}

/// Moves the line to where |P|^2 + s0^2 is least between the caps. Returns false if t is not finite
/// there.
bool FrustumShape::move_to_least(const ObjectRay& ray, NearLine& line, const SideRates& rates,
                                 const ClippedSpan& span) const {
  // Along the axis of a cylinder there is no such point, and nearly along it the point is far away.
  // So t is clamped to a sphere that holds the solid, and to between the caps.
  const double least = where_least(line, rates);
  double t = line.to_t(std::isfinite(least) ? least : 0);
  const double sphere = line.to_t_length((height_ + wide_radius_) / std::sqrt(line.squared_length));
  t = std::clamp(t, line.to_t(0) - sphere, line.to_t(0) + sphere);
  if (!span.empty()) t = std::min(std::max(t, span.enter_t()), span.leave_t());
  if (!std::isfinite(t)) return false;
  line.move_to(ray, narrow_, t);
  return true;
}

/// Returns |n . d| at a root: sqrt(discriminant) / (s0 + s1 x).
double FrustumShape::approach(const SideEquation& side, double x) {
  // Through the apex a ray meets the cone as squarely as its angle to the side allows. A cylinder
  // is touched.
  if (!(side.discriminant > 0)) return side.radius_rate == 0 ? 0 : std::sqrt(std::abs(side.a));
  return std::sqrt(side.discriminant) / std::abs(side.radius + side.radius_rate * x);
}

/// Returns the crossing at a root. It shifts the line once more, to the root itself, and takes one
/// step of Newton's iteration on the distance from the side there. That distance does not depend on
/// the rounding of a, b and c. Beyond the caps a root stays where it is: next to a ruling it may be
/// so far away that a distance there says nothing.
Crossing FrustumShape::polished(const ObjectRay& ray, const NearLine& line,
                                const SideEquation& side, const Root& root,
                                const ClippedSpan& span) const {
  const Vec3 p = line.at(root.x);
  const Crossing crossing = side_crossing(line, side, root, reach_of(p));
  if (!(crossing.t > span.enter_t() && crossing.t < span.leave_t())) return crossing;
  const auto unpolished = [&] {
    return side_crossing(line, side, root, std::max(reach_of(p), reach_of(line.point)));
  };
  // Where a ray grazes more closely, the step could take it to the other root.
  constexpr double squarely = 0x1p-20;
  constexpr double longest_step = 64 * unit_roundoff;
  const double rate = approach(side, root.x);
  if (!std::isfinite(rate) || rate == 0) return unpolished();
  const double gap = std::sqrt(std::max(side.discriminant, 0.0)) / std::abs(side.a);
  const double reach = wide_radius_ + 2 * largest_component(p);
  const bool is_isolated = longest_step * reach < squarely * gap * rate;
  if (!is_isolated && !(rate > squarely * std::sqrt(line.squared_length))) return unpolished();
  NearLine at_root = line;
  at_root.move_to(ray, narrow_, line.to_precise_t(root.x));
  const double distance = distance_from_side(at_root.point);
  double step = root.entering ? distance / rate : -distance / rate;
  Crossing result = crossing;
  result.t = at_root.to_t(step);
  // Beside the apex the side bends away within such a step. The next steps take the slope at their
  // own point.
  constexpr int most_steps = 8;
  double radius = std::abs(side.radius + side.radius_rate * root.x);
  for (int i = 0; i < most_steps && !side.is_straight(step, radius, reach); ++i) {
    at_root.move_to(ray, narrow_, at_root.to_precise_t(step));
    const Vec3 along = glm::dot(at_root.point, axis_) * axis_;
    const Vec3 across = at_root.point - along;
    if (largest_component(across) == 0) break;
    const double slope = cosine_ * glm::dot(unit_vector(across), at_root.direction) -
                         sine_ * glm::dot(axis_, at_root.direction);
    if ((slope < 0) != root.entering || !(std::abs(slope) > squarely)) break;
    radius = cosine_ * glm::length(across);
    step = -distance_from_side(at_root.point) / slope;
    result.t = at_root.to_t(step);
  }
  return result;
}

double FrustumShape::reach_of(const Vec3& p) const {
  // Along needles the square of the length may overflow, but the length does not.
  return wide_radius_ + std::min(glm::length(p), 2 * largest_component(p));
}

Crossing FrustumShape::side_crossing(const NearLine& line, const SideEquation& side,
                                     const Root& root, double reach) const {
  const double t = line.to_t(root.x);
  const double speed = std::sqrt(line.squared_length);
  const double graze =
      speed / std::sqrt(std::abs(side.a)) * grazing_error(line, reach, wide_radius_);
  const double longest = std::min(side.a > 0 ? graze : reach / speed, reach / speed);
  return {.t = t,
          .error = standard_error(line, t, reach, approach(side, root.x), longest),
          .face = side_face,
          .root = root.number};
}

/// Moves the line to halfway between the roots if it grazes the side, as the discriminant may then
/// be what is left of large numbers. From there it is a c with b nearly 0, and c is the distance
/// from the side.
void FrustumShape::center_on_grazing(const ObjectRay& ray, NearLine& line, const SideRates& rates,
                                     SideEquation& side) const {
  if (passes_plainly(line, side)) return;
  constexpr double nearly = 0x1p-4;
  const bool cancels = std::abs(side.discriminant) < nearly * (side.b * side.b);
  const double middle = -side.b / side.a;
  const double farthest = (height_ + wide_radius_) * (height_ + wide_radius_);
  if (!(side.a > 0 && cancels && middle * middle * line.squared_length < farthest)) return;
  line.move_to(ray, narrow_, line.to_precise_t(middle));
  side = side_equation(line, rates);
}

void FrustumShape::clip_side(const ObjectRay& ray, NearLine& line, const SideRates& rates,
                             ClippedSpan& span) const {
  SideEquation side = side_equation(line, rates);
  center_on_grazing(ray, line, rates, side);
  const auto enter = [&](double x, std::uint8_t number) {
    span.enter(polished(ray, line, side, {side.on_nappe(x), true, number}, span));
  };
  const auto leave = [&](double x, std::uint8_t number) {
    span.leave(polished(ray, line, side, {side.on_nappe(x), false, number}, span));
  };
  const bool is_within = side.is_within();
  if (side.a >= 0 && !(side.discriminant > 0)) {
    // Within the side, only the axis of a cylinder meets nothing.
    if (!is_within) span.clear();
    return;
  }
  const auto [low, high] = SideRoots<double>(side);
  if (side.a >= 0) {
    // If the line is parallel to a ruling, one of them is infinite.
    if (side.is_on_other_nappe()) return span.clear();
    enter(low, 0);
    leave(high, 1);
  } else if (is_within ? side.b * side.radius < 0 : side.radius_rate > 0) {
    // There is one root on each nappe. From within both are ahead or both behind. From outside the
    // root is on this nappe where the radius grows.
    enter(high, 1);
  } else if (!is_within || side.b * side.radius > 0) {
    leave(low, 0);
  }
}

std::array<Crossing, 2> FrustumShape::side_crossings(const ObjectRay& ray, ClippedSpan span) const {
  NearLine line = NearLine::at_closest(ray, narrow_, unit_);
  const SideRates rates = side_rates(line);
  move_to_least(ray, line, rates, span);
  SideEquation side = side_equation(line, rates);
  center_on_grazing(ray, line, rates, side);
  const auto [low, high] = SideRoots<double>(side);
  const Crossing enter = polished(ray, line, side, {low, true, 0}, span);
  span.enter(enter);
  return {enter, polished(ray, line, side, {high, false, 1}, span)};
}

/// The root at the origin is known, so c is 0 whatever rounding made of the origin. The other root
/// is -2 b / a, and is on this nappe if a > 0.
SideStart FrustumShape::side_start(const ObjectRay& ray, const ClippedSpan& span) const {
  const NearLine line = NearLine::at_origin(ray, narrow_, unit_);
  SideEquation side = side_equation(line, side_rates(line));
  side.discriminant = side.b * side.b;
  Crossing other = side_crossing(line, side, {}, reach_of(line.point));
  if (side.a != 0) {
    const double x = -2 * side.b / side.a;
    // Towards the apex the rounding of the origin grows as the radius shrinks. There it matters
    // which of the roots is the origin: the one at which the line enters, or the one at which it
    // leaves.
    constexpr double much_narrower = 0.5;
    if (side.a > 0 && !(side.radius + side.radius_rate * x >= much_narrower * side.radius)) {
      other = root_next_to_apex(ray, side.b >= 0, span);
    } else {
      other =
          side_crossing(line, side, {.x = x}, std::max(reach_of(line.at(x)), reach_of(line.point)));
      other.error += line.to_t_length(start_error(side.c, side.a, side.b));
    }
  }
  return {.a = sign_of(side.a),
          .b = sign_of(side.b),
          .radius = ray.start.on_face ? 1 : sign_of(side.radius),
          .radius_rate = sign_of(side.radius_rate),
          .other = other};
}

/// Returns the crossing next to the apex of a line that also crosses the side where it is much
/// wider. That other crossing comes after this one if the line enters here, and before it
/// otherwise.
Crossing FrustumShape::root_next_to_apex(const ObjectRay& ray, bool entering,
                                         const ClippedSpan& span) const {
  NearLine line = NearLine::at_closest(ray, narrow_, unit_);
  const SideRates rates = side_rates(line);
  move_to_least(ray, line, rates, span);
  const SideEquation side = side_equation(line, rates);
  const auto [low, high] = SideRoots<double>(side);
  return polished(ray, line, side, {side.on_nappe(entering ? low : high), entering, 0}, span);
}

template <class Real>
FrustumShape::SidePoint<Real>::SidePoint(const FrustumShape& frustum, const Vec3Of<Real>& offset,
                                         SurfacePointOf<Real>& point) {
  using Vector = Vec3Of<Real>;
  const Vector axis = broadcast<Real>(frustum.axis_);
  const Vector p = broadcast<Real>(1 / frustum.unit_) * offset;
  const Real z = dot(p, axis);
  // The component along the axis is removed twice. The second time removes what the first one's
  // rounding left.
  Vector across = p - z * axis;
  across = across - dot(across, axis) * axis;
  const auto at_apex = largest_component(across) == 0.0;
  radial = select(at_apex, broadcast<Real>(frustum.frame_.zero), unit_vector(across));
  // The point is moved straight onto the ruling in this direction.
  const double sine = frustum.sine_;
  const double cosine = frustum.cosine_;
  const Real slant = (dot(across, radial) - frustum.narrow_radius_) * sine + z * cosine;
  share = clamp(slant * cosine / frustum.height_, Real{}, broadcast<Real>(1));
  const Real radius =
      frustum.narrow_radius_ + (frustum.wide_radius_ - frustum.narrow_radius_) * share;
  point.position =
      broadcast<Real>(frustum.narrow_) +
      broadcast<Real>(frustum.unit_) * (share * frustum.height_ * axis + radius * radial);
  point.normal = unit_vector(broadcast<Real>(cosine) * radial - broadcast<Real>(sine) * axis);
  if (sine > 0) point.normal = select(at_apex, -axis, point.normal);
}

template <class Real>
void FrustumShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>&, std::uint32_t face,
                               bool with_uv, SurfacePointOf<Real>& point) const {
  if (face != side_face) return write_cap_point(offset, face - 1, with_uv, point);
  const SidePoint<Real> side(*this, offset, point);
  if (!with_uv) return;
  point.u = turn(dot(side.radial, broadcast<Real>(frame_.zero)),
                 dot(side.radial, broadcast<Real>(frame_.quarter)));
  point.v = narrow_ == from_ ? side.share : 1 - side.share;
}

template <class Real>
void FrustumShape::write_cap_point(const Vec3Of<Real>& offset, std::size_t end, bool with_uv,
                                   SurfacePointOf<Real>& point) const {
  const PlaneFace& cap = *caps_[end];
  const Vec3Of<Real> relative = cap.onto_plane(offset);
  cap.write_point(relative, point);
  if (with_uv) set_polar(relative, frame_, radii_[end], point);
}

template void FrustumShape::write_point<double>(const Vec3&, const Vec3&, std::uint32_t, bool,
                                                SurfacePoint&) const;
template void FrustumShape::write_point<Lanes>(const VectorLanes&, const VectorLanes&,
                                               std::uint32_t, bool, SurfacePointLanes&) const;
template class ShapeOfPoints<FrustumShape>;

Surface FrustumShape::surface(std::uint32_t face) const {
  if (face != side_face) return caps_[face - 1]->surface();
  // Neither sense of the axis is preferred.
  Surface result{.kind = SurfaceKind::cylinder,
                 .position = from_ + Vec3(0.0),
                 .direction = canonical_axis(caps_[0]->normal()),
                 .sizes = {radii_[0], 0}};
  if (sine_ > 0) {
    const double to_apex = narrow_radius_ * cosine_ / sine_;
    result.kind = SurfaceKind::cone;
    result.position = narrow_ - (unit_ * to_apex) * axis_ + Vec3(0.0);
    result.sizes = {sine_ / cosine_, 0};
  } else if (caps_[0]->axis() >= 0) {
    result.position[caps_[0]->axis()] = 0;
  }
  return result;
}

}  // namespace crt::core
