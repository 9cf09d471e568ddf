// write_span() finds where rays plainly enter a cylinder or cone through its side. It computes as
// FrustumShape::crossings() does, for as many rays side by side as there are lanes. What is not
// plain is left to that function.
#include "core/geometry/frustum/frustum.hpp"

namespace crt::core {

template <class Real, class Ray>
void FrustumShape::write_span(const Ray& ray, const WantedEnds<Real>& wanted,
                              ShapeSpan<Real>& span) const {
  if (!any(wanted.enter)) return;
  auto line = NearLineOf<Real>::at_closest(ray, narrow_, unit_);
  const Vec3Of<Real> axis = broadcast<Real>(axis_);
  const SideRatesOf<Real> rates = side_rates(line);
  const Real closest = line.to_t(where_least(line, rates));
  const Real sphere = line.to_t_length((height_ + wide_radius_) / sqrt(line.squared_length));
  const Real origin = line.to_t(Real{});
  const auto is_near = closest >= origin - sphere && closest <= origin + sphere;
  if (!any(is_near)) return;
  line.move_to(ray, narrow_, closest);

  // These points are between the caps by more than the errors of the caps. So the caps have no part
  // in where the side is solved.
  const Real margin = 0x1p-20 * height_ +
                      64.0 * unit_roundoff * abs(closest) / line.to_t_length(broadcast<Real>(1));
  const auto is_between = [&](const Real& x) {
    const Real height = dot(line.at(x), axis);
    return height > margin && height < height_ - margin;
  };
  const SideEquationOf<Real> side = side_equation(line, rates);
  const auto plainly = is_near && is_between(Real{}) && side.a > 0.0 && passes_plainly(line, side);
  span.misses = plainly && side.discriminant < 0.0;
  const Real x = SideRoots<Real>(side).low;
  const Real root = sqrt(max(side.discriminant, Real{}));
  const auto meets = plainly && is_between(x) && !(span.misses || side.is_on_other_nappe());
  if (!any(meets)) return;

  const Real at_root = abs(side.radius + side.radius_rate * x);
  const Real rate = root / at_root;
  const Real ray_speed = sqrt(line.squared_length);
  const Vec3Of<Real> p = line.at(x);
  const Real largest = largest_component(p);
  const Real reach = wide_radius_ + min(sqrt(dot(p, p)), 2.0 * largest);
  const Real graze = ray_speed / sqrt(abs(side.a)) * grazing_error(line, reach, wide_radius_);
  const Real longest = min(graze, reach / ray_speed);
  const Real t = line.to_t(x);
  SpanEnd<Real>& entry = span.enter;
  entry.error = standard_error(line, t, reach, rate, longest);

  // This is one step of Newton's iteration from the root itself.
  auto there = line;
  const auto precise = line.to_precise_t(x);
  there.move_to(ray, narrow_, precise.hi, precise.lo);
  const Real step = distance_from_side(there.point) / rate;
  entry.t = there.to_t(step);
  // The ray meets the side so squarely that no rounding takes one root near the other.
  constexpr double squarely = 0x1p-10;
  const Real max_reach = wide_radius_ + 2.0 * largest;
  const Real half_chord = root / side.a;
  const auto is_square =
      rate > squarely * ray_speed && half_chord * ray_speed > squarely * max_reach;
  // The chord is so long that t separates where the ray enters from where it leaves.
  const auto is_long = line.to_t_length(half_chord) > 4.0 * rounding_of(t);
  entry.known = meets && is_long && is_square && side.is_straight(step, at_root, max_reach);
}

template class ShapeOfSpans<FrustumShape>;

}  // namespace crt::core
