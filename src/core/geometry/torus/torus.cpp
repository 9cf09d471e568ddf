#include "core/geometry/torus/torus.hpp"

#include <numbers>

#include "core/geometry/disc/disc.hpp"
#include "core/geometry/torus/spans.hpp"

#include "core/geometry/torus/functions.hpp"

namespace crt::core {

TorusShape::TorusShape(const Torus& torus)
    : center_(torus.center),
      frame_(frame_about(torus.axis)),
      radius_(torus.radius),
      thickness_(torus.thickness),
      unit_(power_of_two_below(std::abs(torus.radius) + torus.thickness)),
      ring_(torus.radius / unit_),
      tube_(torus.thickness / unit_) {}

std::unique_ptr<const FaceFunctions> TorusShape::face_functions() const {
  return face_functions_of(TorusFunction{.center = center_,
                                         .axis = enclosed_unit(frame_.along),
                                         .inverse_unit = inverse_of_power(unit_),
                                         .ring = Interval::of(ring_),
                                         .tube = Interval::of(tube_)});
}

Bounds TorusShape::bounds() const {
  Bounds result;
  result.include_around(center_, disc_extents(frame_.along, radius_) + Vec3(thickness_));
  return result;
}

template <class Vector>
Vector TorusShape::in_frame(const Vector& v) const {
  using Real = RealOf<Vector>;
  return {dot(v, broadcast<Real>(frame_.zero)), dot(v, broadcast<Real>(frame_.quarter)),
          dot(v, broadcast<Real>(frame_.along))};
}

template <class Real>
TorusLineOf<Real> TorusShape::in_frame(const NearLineOf<Real>& line, bool on_surface) const {
  return {in_frame(line.point), in_frame(line.direction), ring_, tube_, on_surface};
}

template <class Real>
[[gnu::always_inline]] inline TorusShape::Meeting<Real> TorusShape::meeting(
    const NearLineOf<Real>& line, const TorusLineOf<Real>& torus, const Real& x,
    const Real& length) const {
  const double size = std::abs(ring_) + tube_;
  const Vec3Of<Real> place = line.at(x);
  const Real reach = size + sqrt(dot(place, place));
  // |n . d| is |G'| / 2r. No root moves by more than the lengths of the span and of the grazing
  // error.
  return {.reach = reach,
          .approach = abs(torus.half_slope(x)) / tube_,
          .longest = length + grazing_error(line, reach, size)};
}

template <class Real>
TorusEntry<Real> TorusShape::first_entry(const NearLineOf<Real>& line,
                                         const TorusLineOf<Real>& torus,
                                         const typename TorusEntry<Real>::Mask& wanted) const {
  const auto entry = torus.first_entry(wanted);
  TorusEntry<Real> result{.found = entry.found};
  if (!any(entry.found)) return result;
  const Real x = torus.root(entry.bracket, entry.found);
  result.t = line.to_t(x);
  // From x on the line is inside at least up to `inside`. Unless that is next to nothing, it does
  // not matter how much longer.
  const Real inside = entry.bracket.negative;
  const Meeting<Real> at = meeting<Real>(line, torus, x, inside - x);
  const auto is_steep = standard_error_across(at.reach) < at.longest * at.approach;
  result.known = entry.found && is_steep && result.t < line.to_t(inside);
  result.error = standard_error(line, result.t, at.reach, at.approach, at.longest);
  return result;
}

/// Finds where lines first enter the torus. Where they leave it depends on their other crossings.
template <class Real, class Ray>
void TorusShape::write_span(const Ray& ray, const WantedEnds<Real>& wanted,
                            ShapeSpan<Real>& span) const {
  if (!any(wanted.enter)) return;
  const auto line = NearLineOf<Real>::at_closest(ray, center_, unit_);
  const auto entry = first_entry<Real>(line, in_frame<Real>(line, false), wanted.enter);
  span.misses = wanted.enter && !entry.found;
  span.enter = {.known = entry.known, .t = entry.t, .error = entry.error};
}

bool TorusShape::leaves_for_good(const ObjectRay& ray, bool wanted) const {
  const auto line = NearLine::at_origin(ray, center_, unit_);
  return !in_frame<double>(line, true).reenters(wanted);
}
LaneMask TorusShape::leaves_for_good(const ObjectRayLanes& rays, const LaneMask& wanted) const {
  const auto line = NearLineOf<Lanes>::at_origin(rays, center_, unit_);
  return !in_frame<Lanes>(line, true).reenters(wanted);
}

bool TorusShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  const bool on_surface = ray.start.face == 0;
  const NearLine line = on_surface ? NearLine::at_origin(ray, center_, unit_)
                                   : NearLine::at_closest(ray, center_, unit_);
  TorusLine torus(in_frame(line.point), in_frame(line.direction), ring_, tube_, on_surface);
  if (!on_surface && ray.first_wanted_after < std::numeric_limits<double>::infinity()) {
    const auto first = first_entry<double>(line, torus, true);
    if (!first.found) return false;
    const Crossing crossing{.t = first.t, .error = first.error, .entering = true};
    if (first.known && ray.is_first_wanted(crossing)) {
      out.push_back(crossing);
      return false;
    }
  }
  // Makes the crossing at one end of a span, which is at least `length` long.
  const auto crossing = [&](double x, std::size_t span, bool entering, double length) {
    Crossing end{.root = static_cast<std::uint8_t>(2 * span + (entering ? 0 : 1)),
                 .entering = entering};
    if (on_surface && x == 0) return end;
    end.t = line.to_t(x);
    // The direction's length is at least 1, and no span is longer than the torus is wide.
    if (end.t < ray.begin) {
      end.error = line.to_t_length(2 * (std::abs(ring_) + tube_));
      return end;
    }
    const auto& [reach, approach, longest] = meeting<double>(line, torus, x, length);
    // If rounding has moved the start off the surface, the error includes the whole level of G
    // there.
    const double off_surface = on_surface ? std::abs(torus.level_at_start()) / (2 * tube_) : 0;
    const double along = off_surface < longest * approach ? off_surface / approach : longest;
    end.error = standard_error(line, end.t, reach, approach, longest) + line.to_t_length(along);
    return end;
  };
  const auto add = [&](const TorusLine::Span& ends, std::size_t span) {
    const Crossing enter = crossing(ends.enter, span, true, ends.leave - ends.enter);
    const Crossing leave = crossing(ends.leave, span, false, ends.leave - ends.enter);
    if (!(enter.t < leave.t)) return;
    out.push_back(enter);
    out.push_back(leave);
  };

  if (on_surface) {
    TorusLine::Spans spans =
        torus.spans(ray.begin >= 0 ? 0 : -std::numeric_limits<double>::infinity());
    obey_side(ray.start.side, torus.half_curvature(0) > 0, unit_roundoff * tube_, spans);
    for (std::size_t i = 0; i < spans.count; ++i) add(spans.span[i], i);
    return false;
  }
  const TorusLine::Intervals intervals = torus.intervals();
  for (std::size_t i = 0; i < intervals.count; ++i) {
    const auto& [enter, leave] = intervals.interval[i];
    const double first = torus.root(enter, true);
    // The line is inside at least up to `leave.negative`. So the end of the span is computed only
    // if it is needed.
    const Crossing entry = crossing(first, i, true, leave.positive - first);
    if (ray.is_first_wanted(entry) && entry.t < line.to_t(leave.negative)) {
      out.push_back(entry);
      return false;
    }
    add({first, torus.root(leave, true)}, i);
    if (!out.empty() && ray.is_first_wanted(out.back())) return false;
  }
  return false;
}

template <class Real>
TorusShape::TubePlace<Real>::TubePlace(const TorusShape& torus, const Vec3Of<Real>& offset) {
  const Vec3Of<Real> along = broadcast<Real>(torus.frame_.along);
  const Vec3Of<Real> p = broadcast<Real>(1 / torus.unit_) * offset;
  height = dot(p, along);
  // The component along the axis is removed twice. The second time removes what the first one's
  // rounding left.
  Vec3Of<Real> across = p - height * along;
  across = across - dot(across, along) * along;
  radial = select(largest_component(across) > 0.0, unit_vector(across),
                  broadcast<Real>(torus.frame_.zero));
  outward = dot(across, radial) - torus.ring_;
}

template <class Real>
void TorusShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>&, std::uint32_t,
                             bool with_uv, SurfacePointOf<Real>& point) const {
  const TubePlace<Real> place(*this, offset);
  const Vec3Of<Real>& radial = place.radial;
  const Vec3Of<Real> from_ring =
      place.outward * radial + place.height * broadcast<Real>(frame_.along);
  const Vec3Of<Real> normal =
      select(largest_component(from_ring) > 0.0, unit_vector(from_ring), radial);
  const Vec3Of<Real> from_center =
      broadcast<Real>(ring_) * radial + broadcast<Real>(tube_) * normal;
  point.position = broadcast<Real>(center_) + broadcast<Real>(unit_) * from_center;
  point.normal = normal;
  if (!with_uv) return;
  point.u =
      turn(dot(radial, broadcast<Real>(frame_.zero)), dot(radial, broadcast<Real>(frame_.quarter)));
  point.v = turn(place.outward, place.height);
}

Surface TorusShape::surface(std::uint32_t) const {
  // A torus is the same if its axis is turned round.
  return {.kind = SurfaceKind::torus,
          .position = center_,
          .direction = canonical_axis(frame_.along),
          .sizes = {radius_, thickness_}};
}

std::unique_ptr<const Shape> make_shape(const Torus& torus) {
  return std::make_unique<TorusShape>(torus);
}

}  // namespace crt::core
