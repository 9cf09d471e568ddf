// The quadric of the exact tier takes from the line in twice the precision what is certain, and t
// where its last bit is. The rest comes from the quadratic without rounding.
#include "core/geometry/exact_quadratic.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/quadric/line.hpp"
#include "core/geometry/quadric/quadric.hpp"

namespace crt::core {
namespace {

/// Gives a crossing its t, if it is certain to the last bit. Returns whether it is.
bool settle(const ExactRay& ray, const Bounded& t, Crossing& crossing) {
  return std::isfinite(t.error) && core::settle(ray, t.value, t.error, crossing);
}

class ExactQuadricShape final : public ExactShape {
 public:
  explicit ExactQuadricShape(const Quadric& quadric) : form_(quadric) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    if (ray.near.start.face == 0) return crossings_from_surface(ray, out);
    const QuadricLine line = QuadricLine::at_closest(form_, ray);
    const Bounded discriminant = line.discriminant();
    if (!line.a.is_certain() || !discriminant.is_certain()) return exact_crossings(ray, out);
    const bool opens_up = line.a.sign() > 0;
    if (discriminant.sign() < 0) return !opens_up;
    const auto [low, high] = line.roots(discriminant);
    std::array<Crossing, 2> roots;
    if (!settle(ray, low, roots[0]) || !settle(ray, high, roots[1]))
      return exact_crossings(ray, out);
    return emit_roots(opens_up, roots, out);
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    if (is_start(ray, crossing)) return RealRoot::at(0);
    const ExactQuadratic equation = quadratic(ray.exact());
    const DyadicPolynomial polynomial =
        ray.near.start.face == 0 ? equation.beside_zero() : equation.polynomial();
    if (polynomial.degree() < 1) return std::nullopt;
    return root_at(ray, crossing, polynomial);
  }

  ExactSurface surface(std::uint32_t /*face*/) const override {
    const Surface surface = QuadricShape::quadric_surface(form_);
    const auto& [x, y, z] = exactly(surface.direction);
    ExactSurface result{.points = {exactly(surface.position)}, .numbers = {x, y, z}};
    result.numbers.insert(result.numbers.end(), surface.sizes.begin(), surface.sizes.end());
    return result;
  }

  std::size_t bytes() const override { return sizeof *this; }

 private:
  /// Returns 2 f along the line, times the square of the line's weight.
  ExactQuadratic quadratic(const ExactLine& line) const {
    const Dyadic inverse_unit = inverse_of_power(form_.unit);
    const DyadicVector p = inverse_unit * line.origin;
    const DyadicVector d = inverse_unit * line.direction;
    const DyadicVector linear = line.weight * exactly(form_.linear);
    const auto curved = [&](const DyadicVector& v) {
      const auto& [x, y, z] = form_.rows;
      return DyadicVector{dot(exactly(x), v), dot(exactly(y), v), dot(exactly(z), v)};
    };
    const DyadicVector slope = curved(p) + linear;
    return {dot(d, curved(d)), dot(d, slope),
            dot(p, slope + linear) + Dyadic(2 * form_.constant) * square(line.weight)};
  }

  bool exact_crossings(const ExactRay& ray, CrossingList& out) const {
    const ExactQuadratic equation = quadratic(ray.exact());
    if (equation.a.sign() == 0) {
      // A line within the surface is nowhere inside.
      if (equation.b.sign() == 0) return equation.c.sign() < 0;
      const ScaledNumber t = -equation.c.rounded() / (equation.b + equation.b).rounded();
      return emit_only_root(equation.b.sign() > 0, exact_crossing(t.unscaled(), {}), out);
    }
    const bool opens_up = equation.a.sign() > 0;
    if (equation.discriminant().sign() <= 0) return !opens_up;
    const auto [low, high] = equation.roots();
    return emit_roots(opens_up, {exact_crossing(low, {}), exact_crossing(high, {})}, out);
  }

  /// Finds the crossings of a ray that starts on the surface. As in the standard tier, c is 0 by
  /// identity, and the other root is -2 b / a.
  bool crossings_from_surface(const ExactRay& ray, CrossingList& out) const {
    const Side side = ray.near.start.side;
    const double shortest = shortest_length(ray.near);
    const QuadricLine line = QuadricLine::at_origin(form_, ray);
    Crossing other;
    if (line.a.is_certain() && settle(ray, line.root_beside_zero(), other))
      return emit_from_surface(side, line.a.sign() > 0, other, shortest, out);
    const ExactQuadratic equation = quadratic(ray.exact());
    if (equation.a.sign() != 0) {
      other = exact_crossing(equation.root_beside_zero(), {});
      return emit_from_surface(side, equation.a.sign() > 0, other, shortest, out);
    }
    if (equation.b.sign() != 0) return emit_start(side, out);
    return side == Side::inside;
  }

  QuadricForm form_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Quadric& quadric) {
  return std::make_unique<ExactQuadricShape>(quadric);
}

}  // namespace crt::core
