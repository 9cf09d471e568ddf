// The sphere of the exact tier finds in doubles the lines that clearly miss or hit. Those that hit
// get their t by Newton's iteration on |p(t)|^2 - r^2 in double-double. The few that all but touch
// get both from the quadratic without rounding.
#include "core/geometry/clipped_span.hpp"
#include "core/geometry/exact_quadratic.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/near_line.hpp"
#include "core/geometry/sphere/sphere.hpp"
#include "core/math/precise_transform.hpp"

namespace crt::core {
namespace {

class ExactSphereShape final : public ExactShape {
 public:
  explicit ExactSphereShape(const Sphere& sphere)
      : center_(sphere.center), radius_(sphere.radius), unit_(power_of_two_below(sphere.radius)) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    if (ray.near.start.face == 0) return crossings_from_surface(ray, out);
    const NearLine line = NearLine::at_closest(ray.near, center_, unit_);
    const double r = radius_ / unit_;
    const double closest = line.closest();
    const double distance = glm::length(line.at(closest));
    // This is some tens of roundings of numbers of the line's size near the sphere, and the error
    // of the ray itself.
    constexpr double filter_rounding = 0x1p9 * unit_roundoff;
    constexpr double largest_rest = 4;  // that NearLine::at_closest leaves
    const double open = filter_rounding * (distance + r + largest_rest) +
                        2 * ray.point_error(center_, line.to_t(closest)) / unit_;
    if (distance - r > open) return false;
    if (!(r - distance > open)) return exact_crossings(ray, out);

    const double a = line.squared_length;
    const double half_chord = std::sqrt(a * (r + distance) * (r - distance)) / a;
    Crossing enter{.t = line.to_t(closest - half_chord), .root = 0, .entering = true};
    Crossing leave{.t = line.to_t(closest + half_chord), .root = 1, .entering = false};
    if (!polish(ray, enter)) return exact_crossings(ray, out);
    const bool is_enough = ray.near.is_first_wanted(enter);
    if (!is_enough && !polish(ray, leave)) return exact_crossings(ray, out);
    out.push_back(enter);
    if (!is_enough) out.push_back(leave);
    return false;
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    if (is_start(ray, crossing)) return RealRoot::at(0);
    const ExactQuadratic equation = quadratic(ray.exact());
    return root_at(ray, crossing,
                   ray.near.start.face == 0 ? equation.beside_zero() : equation.polynomial());
  }

  ExactSurface surface(std::uint32_t /*face*/) const override {
    return {.points = {exactly(center_)}, .numbers = {radius_}};
  }

  std::size_t bytes() const override { return sizeof *this; }

 private:
  /// Takes steps of Newton's iteration until t is certain to the last bit. Returns false if that
  /// fails.
  bool polish(const ExactRay& ray, Crossing& crossing) const {
    const Vec3& d = ray.near.direction;
    DoubleDouble t = crossing.t;
    constexpr int most_steps = 3;
    for (int step = 0; step < most_steps; ++step) {
      const PreciseVec3 p = precise_from_center(ray.near, center_, t);
      const DoubleDouble height = precise_dot(p, p) - two_product(radius_, radius_);
      const double slope = p[0].hi * d.x + p[1].hi * d.y + p[2].hi * d.z;
      if ((slope < 0) != crossing.entering || slope == 0) return false;
      const double change = height.value() / (2 * slope);
      t = t + DoubleDouble(-change);

      const double size = sum_of_sizes(p);
      const double height_error = 2 * size * ray.point_error(center_, t.hi) +
                                  precise_roundoff * (size * size + radius_ * radius_);
      // The slope and the change are rounded, too.
      constexpr double change_rounding = 0x1p-48;
      const NewtonStep newton{.change = change,
                              .value_error = height_error,
                              .rate = 2 * slope,
                              .rate_error = 2 * change_rounding * size * largest_component(d),
                              .half_curvature = glm::dot(d, d)};
      const double error = newton.error() + precise_roundoff * std::abs(t.hi);
      if (settle(ray, t, error, crossing)) return true;
    }
    return false;
  }

  ExactQuadratic quadratic(const ExactLine& line) const {
    const DyadicVector offset = line.origin - line.weight * exactly(center_);
    return {dot(line.direction, line.direction), dot(line.direction, offset),
            dot(offset, offset) - square(line.weight * Dyadic(radius_))};
  }

  bool exact_crossings(const ExactRay& ray, CrossingList& out) const {
    const ExactQuadratic equation = quadratic(ray.exact());
    if (equation.discriminant().sign() <= 0) return false;
    const auto [enter, leave] = equation.roots();
    if (!std::isfinite(enter.hi) || !std::isfinite(leave.hi)) return false;
    out.push_back(exact_crossing(enter, {.root = 0, .entering = true}));
    out.push_back(exact_crossing(leave, {.root = 1, .entering = false}));
    return false;
  }

  /// Finds the crossings of a ray that starts on the surface. As in the standard tier, c is 0 by
  /// identity, and the other root is -2 b / a.
  bool crossings_from_surface(const ExactRay& ray, CrossingList& out) const {
    const ObjectRay& near = ray.near;
    const PreciseVec3 d = precise_direction(near);
    const PreciseVec3 p = precise_from_center(near, center_, 0.0);
    const DoubleDouble a = precise_dot(d, d);
    const DoubleDouble half = -precise_dot(p, d) / a;
    const DoubleDouble t{2 * half.hi, 2 * half.lo};
    const double size = sum_of_sizes(p);
    const double error =
        2 *
            (sum_of_sizes(d) * ray.point_error(center_, 0) + size * ray.direction_error +
             precise_roundoff * size * largest_component(near.direction)) /
            a.hi +
        (precise_roundoff + 4 * ray.direction_error / largest_component(near.direction)) *
            std::abs(t.hi);
    const bool outside = near.start.side == Side::outside;
    Crossing other{.root = static_cast<std::uint8_t>(!outside)};
    if (!settle(ray, t, error, other)) {
      other = exact_crossing(quadratic(ray.exact()).root_beside_zero(), other);
    }
    ClippedSpan span(near.start, unit_roundoff * (radius_ / largest_component(near.direction)));
    const Crossing start{.root = static_cast<std::uint8_t>(outside)};
    span.enter(outside ? other : start);
    span.leave(outside ? start : other);
    return span.finish(out);
  }

  Vec3 center_;
  double radius_;
  double unit_;  ///< a power of two near the radius
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Sphere& sphere) {
  return std::make_unique<ExactSphereShape>(sphere);
}

}  // namespace crt::core
