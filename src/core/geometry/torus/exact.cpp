// The torus of the exact tier finds in doubles how often the line enters and leaves, with a bound
// on what rounding may change of that (TorusLine). Each crossing gets its t by Newton's iteration
// on
//    G = (rho - R)^2 + z^2 - r^2
// in double-double. What that leaves undecided is decided by polynomials in t without rounding.
// With q relative to the centre, A the axis of any length and S = |q|^2 + R^2 - r^2, a point is
// inside if S < 2 R rho, that is, if
//    S < 0  or  Q = |A|^2 S^2 - 4 R^2 (|q|^2 |A|^2 - (q . A)^2) < 0.
// In the inner lemon, where R < 0 (torus.hpp), it is inside if S < 0 and Q > 0.
// All crossings are roots of Q. Its other roots are where a spindle torus has its inner lemon, and
// where the line only touches. There both sides are alike.
#include <optional>

#include "core/geometry/exact_shape.hpp"
#include "core/geometry/near_line.hpp"
#include "core/geometry/torus/spans.hpp"
#include "core/geometry/torus/torus.hpp"
#include "core/math/isolated_roots.hpp"
#include "core/math/precise_transform.hpp"

namespace crt::core {
namespace {

/// An ExactTorusLine is the torus along a line without rounding: S and Q, each times some positive
/// number, as polynomials of x. There t = shift + scale x, where x is about 1 at the torus.
class ExactTorusLine {
 public:
  /// Makes the polynomials of t itself.
  ExactTorusLine(const Torus& torus, const ExactRay& ray) { expand(torus, ray.exact()); }

  ExactTorusLine(const Torus& torus, const ExactRay& ray, const NearLine& near_line, double unit) {
    shift_ = near_line.to_precise_t(near_line.closest());
    scale_ = unit / power_of_two_below(largest_component(ray.near.direction));
    constexpr double smallest_scale = 0x1p-1000;
    if (!std::isfinite(shift_.hi) || !std::isfinite(scale_) || scale_ < smallest_scale) {
      shift_ = 0.0;
      scale_ = 1;
    }
    expand(torus, ray.exact());
  }

  /// Appends all crossings.
  void append(CrossingList& out) const {
    std::uint8_t root = 0;
    each_crossing([&](const DyadicPolynomial& polynomial, const Dyadic& low, const Dyadic& high,
                      bool entering) {
      Crossing crossing{.root = root++, .entering = entering};
      refine(polynomial, low, high, crossing);
      if (std::isfinite(crossing.t)) out.push_back(crossing);
    });
  }

  /// Returns the place of one of the crossings.
  std::optional<RealRoot> place(const Crossing& crossing) const {
    std::optional<RealRoot> place =
        RealRoot::near(quartic_, DoubleDouble(crossing.t, crossing.t_low), crossing.error);
    std::uint8_t root = 0;
    if (place) return place;
    each_crossing([&](const DyadicPolynomial& polynomial, const Dyadic& low, const Dyadic& high,
                      bool /*entering*/) {
      if (root++ == crossing.root) place = RealRoot(polynomial, low, high);
    });
    return place;
  }

  /// Finds the crossing at about t, if that is the only one within `margin` of it. Returns false if
  /// it cannot decide.
  bool find(const DoubleDouble& t, double margin, Crossing& crossing) const {
    const Dyadic x = ((t.hi - shift_.hi) + (t.lo - shift_.lo)) / scale_;
    const Dyadic reach = margin / scale_;
    int found = 0;
    each_crossing([&](const DyadicPolynomial& polynomial, const Dyadic& low, const Dyadic& high,
                      bool entering) {
      const bool is_off = (low - x - reach).sign() > 0 || (x - reach - high).sign() > 0;
      if (is_off || entering != crossing.entering) return;
      ++found;
      refine(polynomial, low, high, crossing);
    });
    return found == 1 && std::isfinite(crossing.t);
  }

 private:
  void expand(const Torus& torus, const ExactLine& line) {
    is_lemon_ = torus.radius < 0;
    const Dyadic shift = Dyadic(shift_.hi) + Dyadic(shift_.lo);
    offset_ = shift * Dyadic(1 / scale_);
    DyadicPolynomial squared_length;
    DyadicPolynomial along;
    Dyadic squared_axis;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const DyadicPolynomial component(
          {line.origin[i] + shift * line.direction[i] - line.weight * Dyadic(torus.center[axis]),
           Dyadic(scale_) * line.direction[i]});
      const Dyadic a(torus.axis[axis]);
      squared_length = squared_length + component * component;
      along = along + a * component;
      squared_axis = squared_axis + square(a);
    }
    const Dyadic ring = Dyadic(torus.radius) * line.weight;
    const Dyadic tube = Dyadic(torus.thickness) * line.weight;
    const DyadicPolynomial squared_rho = squared_axis * squared_length - along * along;
    sum_ = squared_length + DyadicPolynomial({square(ring) - square(tube)});
    quartic_ = squared_axis * (sum_ * sum_) - Dyadic(4) * square(ring) * squared_rho;
  }

  /// Calls take(polynomial, low, high, entering) for each crossing, which is the only root of a
  /// polynomial between low and high.
  template <class Take>
  void each_crossing(const Take& take) const {
    const IsolatedRoots roots = isolated_roots(quartic_);
    bool inside = false;
    for (const auto& [low, high] : roots.brackets) {
      if (is_inside(high) == inside) continue;
      inside = !inside;
      take(roots.polynomial, low, high, inside);
    }
  }

  bool is_inside(const Dyadic& x) const {
    const int sum = sum_.value(x).sign();
    const int product = quartic_.value(x).sign();
    return is_lemon_ ? sum < 0 && product > 0 : sum < 0 || product < 0;
  }

  void refine(const DyadicPolynomial& polynomial, const Dyadic& low, const Dyadic& high,
              Crossing& crossing) const {
    const Dyadic x = refined_root(polynomial, low, high, offset_, [&](const Dyadic& place) {
      return is_inside(place) == crossing.entering;
    });
    crossing = exact_crossing((Dyadic(scale_) * (x + offset_)).rounded().unscaled(), crossing);
  }

  bool is_lemon_ = false;     ///< R < 0
  DyadicPolynomial sum_;      ///< S
  DyadicPolynomial quartic_;  ///< Q
  DoubleDouble shift_;        ///< 0, or as above
  double scale_ = 1;
  Dyadic offset_;  ///< shift / scale
};

class ExactTorusShape final : public ExactShape {
 public:
  explicit ExactTorusShape(const Torus& torus)
      : torus_(torus),
        frame_(frame_about(torus.axis)),
        axis_(scaled_to_one(torus.axis)),
        squared_axis_(accurate_dot(axis_, axis_)),
        unit_(power_of_two_below(std::abs(torus.radius) + torus.thickness)),
        ring_(torus.radius / unit_),
        tube_(torus.thickness / unit_) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    const bool on_surface = ray.near.start.face == 0;
    const NearLine line = on_surface ? NearLine::at_origin(ray.near, torus_.center, unit_)
                                     : NearLine::at_closest(ray.near, torus_.center, unit_);
    TorusLine torus(in_frame(line.point), in_frame(line.direction), ring_, tube_, on_surface);
    const double size = std::abs(ring_) + tube_;
    // These are the roundings of the frame, of turning into it, and of what is added up from there.
    constexpr double roundings = 64;
    const double ray_error = ray.point_error(torus_.center, line.to_t(line.closest())) / unit_;
    const double off = roundings * unit_roundoff * size + 2 * ray_error;
    torus.take_care(off);
    TorusLine::Spans spans = torus.spans();
    spans.certain = spans.certain && std::isfinite(off + largest_component(line.point));
    if (on_surface) {
      obey_side(ray.near.start.side, torus.half_curvature(0) > 0, unit_roundoff * tube_, spans);
      append_from_surface(ray, line, spans, out);
      return false;
    }
    const std::size_t before = out.size();
    if (spans.certain && append(ray, line, spans, out)) return false;
    out.resize(before);
    ExactTorusLine(torus_, ray, line, unit_).append(out);
    return false;
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    if (is_start(ray, crossing)) return RealRoot::at(0);
    if (ray.near.start.face == 0) return std::nullopt;
    return ExactTorusLine(torus_, ray).place(crossing);
  }

  ExactSurface surface(std::uint32_t /*face*/) const override {
    const Vec3& axis = torus_.axis;
    return {.points = {exactly(torus_.center)},
            .numbers = {axis.x, axis.y, axis.z, torus_.radius, torus_.thickness}};
  }

  std::size_t bytes() const override { return sizeof *this; }

 private:
  Vec3 in_frame(const Vec3& v) const {
    return {glm::dot(v, frame_.zero), glm::dot(v, frame_.quarter), glm::dot(v, frame_.along)};
  }

  /// Appends the crossings of spans that are certain. Returns false if it cannot separate them.
  bool append(const ExactRay& ray, const NearLine& line, const TorusLine::Spans& spans,
              CrossingList& out) const {
    std::optional<ExactTorusLine> exact;
    std::uint8_t root = 0;
    for (std::size_t i = 0; i < spans.count; ++i) {
      for (const bool entering : {true, false}) {
        Crossing crossing{.root = root++, .entering = entering};
        const double x = entering ? spans.span[i].enter : spans.span[i].leave;
        if (!polish(ray, line.to_precise_t(x), {}, crossing)) {
          if (!exact) exact.emplace(torus_, ray, line, unit_);
          // The other crossings are farther away than that.
          constexpr double share = 1.0 / 3;
          double margin = spans.span[i].leave - spans.span[i].enter;
          if (spans.count > 1) margin = std::min(margin, spans.span[1].enter - spans.span[0].leave);
          if (!exact->find(line.to_precise_t(x), line.to_t_length(share * margin), crossing))
            return false;
        }
        out.push_back(crossing);
        if (ray.near.is_first_wanted(crossing)) return true;
      }
    }
    return true;
  }

  /// Appends the crossings of a ray from the surface. The root at the start is 0 by identity. The
  /// others are where G is what it is at the start, which rounding has put only nearly on the
  /// surface.
  void append_from_surface(const ExactRay& ray, const NearLine& line, const TorusLine::Spans& spans,
                           CrossingList& out) const {
    const DoubleDouble level =
        precise_level(precise_from_center(ray.near, torus_.center, 0.0)).value;
    std::uint8_t root = 0;
    for (std::size_t i = 0; i < spans.count; ++i) {
      for (const bool entering : {true, false}) {
        const double x = entering ? spans.span[i].enter : spans.span[i].leave;
        Crossing crossing{.root = root++, .entering = entering};
        // Next to the start, where the ray grazes, only the sign of t can be known.
        if (x != 0 && !polish(ray, line.to_precise_t(x), level, crossing)) {
          crossing.t = line.to_t(x);
          crossing.error = std::abs(crossing.t) / 2;
        }
        out.push_back(crossing);
      }
    }
  }

  /// A Level is G in double-double, in units, and what is known beside it.
  struct Level {
    DoubleDouble value;
    double error = 0;  ///< without the error of the point
    Vec3 half_gradient{0, 0, 0};
    double outward = 0;
    double height = 0;
    double rho = 0;
  };

  /// Computes G at `p`, which is relative to the centre, in the units of the ray.
  Level precise_level(PreciseVec3 p) const {
    for (DoubleDouble& component : p) component = {component.hi / unit_, component.lo / unit_};
    const DoubleDouble along = precise_dot(p, {axis_.x, axis_.y, axis_.z});
    const DoubleDouble square_along = along * along / squared_axis_;
    const PreciseVec3 across = precise_cross(p, {axis_.x, axis_.y, axis_.z});
    const DoubleDouble rho = sqrt(precise_dot(across, across) / squared_axis_);
    const DoubleDouble outward = rho - DoubleDouble(ring_);
    Level level;
    level.value = outward * outward + (square_along - two_product(tube_, tube_));
    level.rho = rho.hi;
    level.outward = outward.hi;
    level.height = std::sqrt(square_along.hi);
    // The half gradient is (rho - R) times the unit vector away from the axis, and z along the
    // axis.
    const Vec3 point{p[0].hi, p[1].hi, p[2].hi};
    const Vec3 vertical = axis_ * (along.hi / squared_axis_.hi);
    const Vec3 radial = rho.hi > 0 ? (point - vertical) * (outward.hi / rho.hi) : Vec3(0);
    level.half_gradient = radial + vertical;
    // Each length is off by some roundings. G is off by twice the distance from the ring times
    // that, and by some roundings of its squares.
    const double size = std::abs(outward.hi) + level.height + tube_;
    level.error = precise_roundoff * size * (8 * (std::abs(ring_) + rho.hi + level.height) + size);
    return level;
  }

  /// Takes steps of Newton's iteration for G = goal until t is certain to the last bit. Returns
  /// false if that fails.
  bool polish(const ExactRay& ray, DoubleDouble t, const DoubleDouble& goal,
              Crossing& crossing) const {
    const Vec3 d = ray.near.direction * (1 / unit_);
    const double speed = std::sqrt(glm::dot(d, d));
    constexpr int most_steps = 4;
    for (int step = 0; step < most_steps; ++step) {
      const Level level = precise_level(precise_from_center(ray.near, torus_.center, t));
      const double rate = 2 * glm::dot(level.half_gradient, d);
      const double change = (level.value - goal).value() / rate;
      // No second derivative of G between here and the root, and as far beyond, is larger.
      const double distance_moved = std::abs(change) * speed;
      const double curvature =
          2 * speed * speed * (1 + std::abs(ring_) / (level.rho - 2 * distance_moved));
      const double distance = std::abs(level.outward) + level.height;
      constexpr double rate_rounding = 0x1p-46;
      // Next to the axis cancellation leaves few digits of the direction away from it.
      const double size = std::abs(ring_) + level.rho + level.height;
      const double rate_error =
          rate_rounding * speed * (distance + std::abs(level.outward) * (size / level.rho));
      if (!(level.rho > 4 * distance_moved) || (rate < 0) != crossing.entering) return false;
      t = t + DoubleDouble(-change);
      const double off = ray.point_error(torus_.center, t.hi) / unit_;
      const double level_error = level.error + 2 * off * (distance + distance_moved + off);
      const NewtonStep newton{.change = change,
                              .value_error = level_error,
                              .rate = rate,
                              .rate_error = rate_error,
                              .half_curvature = curvature};
      const double error = newton.error() + precise_roundoff * std::abs(t.hi);
      if (settle(ray, t, error, crossing)) return true;
    }
    return false;
  }

  Torus torus_;
  AxisFrame frame_;
  Vec3 axis_;  ///< with a largest component of about 1
  DoubleDouble squared_axis_;
  double unit_;  ///< a power of two near |radius| + thickness
  double ring_;  ///< R in units
  double tube_;  ///< r in units
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Torus& torus) {
  return std::make_unique<ExactTorusShape>(torus);
}

}  // namespace crt::core
