// Cheap tests that spare most exact ones: whether a line surely misses an object, or surely meets
// it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/csg/evaluate.hpp"
#include "core/intersect/proxy_box.hpp"
#include "core/math/lanes.hpp"
#include "core/ray/filter_line.hpp"

namespace crt::core {

/// An object as the cheap tests see it. Few objects have an proxy: those that scenes have many of
/// and whose exact test costs much more. Small, as rays come by many of them.
struct BoundingProxy {
  enum class Kind : std::uint8_t { unknown, sphere, moved_sphere, plane, torus, cylinder, box };

  Kind kind = Kind::unknown;
  /// Whether there is a cheap test that may say of a line that it misses or meets the object.
  bool has_test = false;
  /// The object is somewhere within: only what misses it is sure.
  bool encloses = false;
  std::uint32_t object = nothing;
  std::uint32_t surface =
      nothing;  ///< its whole surface, or that of what encloses it; a box has six
  /// Of a sphere its leaf, if the proxy alone tells its crossings (in the standard tier, without a
  /// transform); of others the number of their ProxyAxis or ProxyBox.
  std::uint32_t detail = nothing;
  Vec3 place{0, 0, 0};  ///< the center, or a point of the plane
  double radius = 0;    ///< the torus's is that of its ring

  bool has_axis() const {
    return kind != Kind::unknown && kind != Kind::sphere && kind != Kind::box;
  }
  bool is_sphere() const { return kind == Kind::sphere || kind == Kind::moved_sphere; }
};

/// What more there is to tell of some.
struct ProxyAxis {
  Vec3 normal{
      0, 0,
      0};  ///< of the plane, its largest component about 1; the axis of the torus or the cylinder
  double thickness =
      0;  ///< of the torus, and a little more for all roundings on the offset to the world
  /// Of a plane across a coordinate axis, of a torus, a moved sphere, a cylinder and a cone: as
  /// BoundingProxy::detail of a sphere.
  std::uint32_t leaf = nothing;
  /// Of a cylinder or cone the surfaces of the caps, if it has them.
  std::array<std::uint32_t, 2> caps = {nothing, nothing};
  const Leaf* moved = nullptr;  ///< that leaf, but for planes, moved or not; the scene owns it
  TypedShape typed;             ///< its shape
};

struct CompiledScene;

struct BoundingProxies {
  std::vector<BoundingProxy> list;
  std::vector<ProxyAxis> axes;
  std::vector<ProxyBox> boxes;

  /// Those of some objects, in their order; of unknown kind where there is none.
  BoundingProxies() = default;
  BoundingProxies(const CompiledScene& scene, std::span<const std::uint32_t> objects,
                  const Workers& workers = {});

  const ProxyAxis& axis(const BoundingProxy& proxy) const { return axes[proxy.detail]; }
  const ProxyBox& box(const BoundingProxy& proxy) const { return boxes[proxy.detail]; }

  /// The leaf of an object whose proxy alone tells its crossings; else nothing.
  std::uint32_t resolved_leaf(const BoundingProxy& proxy) const {
    switch (proxy.kind) {
      case BoundingProxy::Kind::sphere:
        return proxy.detail;
      case BoundingProxy::Kind::moved_sphere:
      case BoundingProxy::Kind::plane:
      case BoundingProxy::Kind::torus:
      case BoundingProxy::Kind::cylinder:
        return axis(proxy).leaf;
      case BoundingProxy::Kind::box:
        return box(proxy).is_resolved ? box(proxy).leaf : nothing;
      default:
        return nothing;
    }
  }
};

namespace filter_detail {

template <class Real>
Real along(const Vec3& axis, const std::array<Real, 3>& v) {
  return axis.x * v[0] + axis.y * v[1] + axis.z * v[2];
}

template <class Real>
std::array<Real, 3> offset_to(const FilterLine<Real>& line, const Vec3& place) {
  return {place.x - line.origin[0], place.y - line.origin[1], place.z - line.origin[2]};
}

}  // namespace filter_detail

/// A sphere against the part of a line up to `limit`.
///
/// With w the offset to the center, the closest approach is at c = w . d / d^2, at a squared
/// distance of q^2, and half the chord is h with h^2 d^2 = r^2 - q^2. Roundings change that by less
/// than 32 u (w^2 + r^2), and the bound on the error of an exact test's t is of that size as well:
/// the chord's ends are compared by their squares, with four times as much added.
template <class Real>
auto test_sphere(const BoundingProxy& sphere, const FilterLine<Real>& line, const Real& limit,
                 bool any_will_do) {
  using namespace filter_detail;
  const std::array<Real, 3> offset = offset_to(line, sphere.place);
  const Real squared_offset = dot(offset, offset);
  const Real closest = dot(offset, line.direction) * line.inverse_squared_length;
  const std::array<Real, 3> across = {offset[0] - closest * line.direction[0],
                                      offset[1] - closest * line.direction[1],
                                      offset[2] - closest * line.direction[2]};
  const double squared_radius = sphere.radius * sphere.radius;
  const Real margin = squared_radius - dot(across, across);
  const Real error = slack * (squared_offset + squared_radius);
  const Real longest = margin + error;

  const Real reach = abs(closest) + sphere.radius * line.inverse_length;
  const auto beyond_chord = [&](const Real& distance) {
    return distance > 0.0 && distance * distance * line.squared_length > longest;
  };
  const auto from = [&](const Real& t) { return (closest - t) - slack * (reach + abs(t)); };
  const auto up_to = [&](const Real& t) { return (t - closest) - slack * (reach + abs(t)); };

  using Mask = decltype(margin < error);
  const Mask rejected =
      longest < 0.0 || beyond_chord(from(limit)) || beyond_chord(up_to(line.begin));
  if (sphere.encloses || !any_will_do) return Decision<Mask>{.rejected = rejected, .accepted = {}};
  const Real to_end = up_to(line.certain_to);
  const auto before_end = to_end > 0.0 || to_end * to_end * line.squared_length < margin - error;
  return Decision<Mask>{
      .rejected = rejected,
      .accepted = margin > error && beyond_chord(from(line.certain_from)) && before_end};
}

/// A plane likewise; `last` is set to a t up to which it surely has been met, if it is met at all.
template <class Real>
auto test_plane(const BoundingProxy& plane, const ProxyAxis& axis, const FilterLine<Real>& line,
                const Real& limit, Real& last) {
  using namespace filter_detail;
  const std::array<Real, 3> offset = offset_to(line, plane.place);
  const Vec3& n = axis.normal;
  const Real rate = n.x * line.direction[0] + n.y * line.direction[1] + n.z * line.direction[2];
  const Real t = (n.x * offset[0] + n.y * offset[1] + n.z * offset[2]) / rate;
  const auto sum_of_sizes = [](const std::array<Real, 3>& v) {
    return abs(v[0]) + abs(v[1]) + abs(v[2]);
  };
  constexpr double normal_size = 6;  // of three components below 2
  const Real speed = sum_of_sizes(line.direction);
  const Real error = (normal_size * slack) * (sum_of_sizes(offset) + abs(t) * speed) / abs(rate);
  // So flat that the rate itself is not known, nor the error: nothing is certain.
  constexpr double flattest = 0x1p-30;
  const auto known = abs(rate) > flattest * speed;
  last = t + error;
  using Mask = decltype(t < error);
  return Decision<Mask>{
      .rejected = known && (last < line.begin || t - error > limit),
      .accepted = known && t - error > line.certain_from && last < line.certain_to};
}

/// From farther away than so many sizes the roundings are not covered by what proxies are larger
/// than objects.
inline constexpr double farthest_proxy = 0x1p16;

/// A line relative to a torus's center, with x = 0 where it is closest to that.
template <class Real>
struct TorusPass {
  Real squared_length;
  Real squared_across;  ///< its distance from the center at x = 0
  Real height;          ///< along the axis at x = 0
  Real climb;           ///< and what x adds to it
  Real from;            ///< only from here
  Real to;              ///< up to here it can be in the torus

  Real height_at(const Real& x) const { return height + x * climb; }
  /// From the axis.
  Real squared_distance_at(const Real& x) const {
    const Real at = height_at(x);
    return squared_across + x * x * squared_length - at * at;
  }
};

/// What is certain of a line within the bounds of a torus.
template <class Mask>
struct TorusDecision {
  Mask rejected;
  Mask enters;  ///< it is in the torus at `inside`, and not at the pass's `from`
};

/// A torus within the sphere and the slab around it, by G in the middle of the line's offset
/// through them (see geometry/torus.hpp).
///
/// G'' / 2 = d^2 - R D / rho^3 is least where rho is, so there is a parabola below G all the
/// offset: with G's value and slope in the middle, and that curvature.
template <class Real>
auto test_torus_closely(const TorusPass<Real>& pass, double ring, double tube, const Real& middle) {
  using namespace filter_detail;
  const double squared_sphere = (ring + tube) * (ring + tube);
  const Real height = pass.height_at(middle);
  const Real squared_rho = pass.squared_distance_at(middle);
  const Real rho = sqrt(select(squared_rho > 0.0, squared_rho, 0.0 * squared_rho));
  const Real outward = rho - ring;
  const Real level = outward * outward + height * height - tube * tube;
  const Real lateral = middle * pass.squared_length - height * pass.climb;
  const Real slope = abs(outward * lateral / rho + height * pass.climb);

  const Real squared_lateral_speed = pass.squared_length - pass.climb * pass.climb;
  const Real next_to_axis = pass.height * pass.climb / squared_lateral_speed;
  const Real after_from = select(next_to_axis > pass.from, next_to_axis, pass.from);
  const Real squared_least =
      pass.squared_distance_at(select(after_from < pass.to, after_from, pass.to));
  const Real least = sqrt(squared_least);
  // Roundings are less than a sixteenth of that.
  const double error = 0x1p-30 * squared_sphere;
  const Real turning =
      abs((pass.squared_across - pass.height * pass.height) * squared_lateral_speed -
          pass.height * pass.height * pass.climb * pass.climb) +
      error * pass.squared_length;
  const Real bend = pass.squared_length - ring * turning / (squared_least * least);
  const Real half_length = (pass.to - pass.from) * 0.5;
  const Real to_lowest = select(slope < bend * half_length, slope / bend, half_length);
  const Real lowest = level - (2.0 * slope - bend * to_lowest) * to_lowest;
  using Mask = decltype(lowest > level);
  // The torus itself is thinner: its G is less than twice that error larger.
  return TorusDecision<Mask>{.rejected = lowest > error, .enters = level < -4.0 * error};
}

/// A torus: missed if the line passes by the sphere and the slab around it, or through the hole in
/// its middle, or else if it stays outside all the offset through these. The proxy is thicker than
/// the torus by more than all roundings here.
template <class Real>
auto test_torus(const BoundingProxy& torus, const ProxyAxis& of_torus, const FilterLine<Real>& line,
                const Real& limit) {
  using namespace filter_detail;
  const std::array<Real, 3> offset = offset_to(line, torus.place);
  const Real closest = dot(offset, line.direction) * line.inverse_squared_length;
  const std::array<Real, 3> across = {closest * line.direction[0] - offset[0],
                                      closest * line.direction[1] - offset[1],
                                      closest * line.direction[2] - offset[2]};
  const double thickness = of_torus.thickness;
  const double sphere = torus.radius + thickness;
  TorusPass<Real> pass{.squared_length = line.squared_length,
                       .squared_across = dot(across, across),
                       .height = along(of_torus.normal, across),
                       .climb = along(of_torus.normal, line.direction),
                       .from = {},
                       .to = {}};
  const Real margin = sphere * sphere - pass.squared_across;
  const Real half = sqrt(select(margin > 0.0, margin, 0.0 * margin) * line.inverse_squared_length);
  // The part of the line in the slab, as far as it is in the sphere. Where the line is parallel to
  // the slab the quotients are huge or no numbers, and comparing leaves the sphere's.
  const Real first = (-thickness - pass.height) / pass.climb;
  const Real second = (thickness - pass.height) / pass.climb;
  const Real low = select(first < second, first, second);
  const Real high = select(first < second, second, first);
  pass.from = select(low > -half, low, -half);
  pass.to = select(high < half, high, half);
  // Next to the axis the squared distance from it is little more than its rounding, and may be
  // negative.
  const double hole = std::max(torus.radius - thickness, 0.0);
  const double squared_hole = hole * hole - 0x1p-30 * sphere * sphere;
  using Mask = decltype(margin < half);
  const Mask through_hole = pass.squared_distance_at(pass.from) < squared_hole &&
                            pass.squared_distance_at(pass.to) < squared_hole;
  // More than the bound on the error of a root that is grazed.
  const Real gap = 0x1p-20 * sphere * line.inverse_length;
  const Real squared_offset = dot(offset, offset);
  const Mask known = squared_offset < farthest_proxy * farthest_proxy * sphere * sphere;
  const Mask rejected = margin < 0.0 || pass.from > pass.to || through_hole ||
                        closest + pass.from - gap > limit || closest + pass.to + gap < line.begin;
  const Decision<Mask> roughly{.rejected = known && rejected, .accepted = {}};
  if (all(roughly.rejected)) return roughly;

  const Real middle = (pass.from + pass.to) * 0.5;
  const TorusDecision<Mask> closely = test_torus_closely(pass, torus.radius, thickness, middle);
  // No bound on a root's error is larger than the whole offset through.
  const Real earliest = closest + pass.from - (pass.to - pass.from) - gap;
  const Mask on_path = earliest > line.certain_from && closest + middle + gap < line.certain_to;
  return Decision<Mask>{.rejected = roughly.rejected || (known && closely.rejected),
                        .accepted = known && closely.enters && on_path};
}

/// Whether a ray that starts on a torus and goes outwards leaves it for good: it starts farther
/// from the axis than the ring is, where the torus is its own convex hull, and plainly goes away
/// from there.
template <class Real>
auto leaves_torus(const BoundingProxy& torus, const ProxyAxis& of_torus,
                  const FilterLine<Real>& line) {
  using namespace filter_detail;
  const std::array<Real, 3> offset = offset_to(line, torus.place);
  // Both negative, as is the offset to the center.
  const Real height = along(of_torus.normal, offset);
  const Real rho = sqrt(dot(offset, offset) - height * height);
  const Real climb = along(of_torus.normal, line.direction);
  const Real lateral = height * climb - dot(offset, line.direction);
  // Far more than what rounding can have done to the start.
  constexpr double plainly = 0x1p-20;
  const double least = plainly * (torus.radius + of_torus.thickness);
  const Real outward = rho - torus.radius;
  const Real away = outward * lateral / rho - height * climb;
  return outward > least && away * line.inverse_length > least && line.begin >= 0.0;
}

/// A cylinder, which is somewhere in the endless cylinder about its axis: only whether the line
/// misses that.
///
/// With m = d x n for the axis n, the two lines are |w . m| / |m| apart. Roundings change w . m and
/// r |m| by less than 16 u (|w| + r) |d|; and whatever they make of the axis, it passes the
/// cylinder as near as the radius says.
template <class Real>
auto test_cylinder(const BoundingProxy& cylinder, const ProxyAxis& of_cylinder,
                   const FilterLine<Real>& line) {
  using namespace filter_detail;
  const std::array<Real, 3> offset = offset_to(line, cylinder.place);
  const std::array<Real, 3>& d = line.direction;
  const Vec3& n = of_cylinder.normal;
  const std::array<Real, 3> across = {d[1] * n.z - d[2] * n.y, d[2] * n.x - d[0] * n.z,
                                      d[0] * n.y - d[1] * n.x};
  const Real speed = line.squared_length * line.inverse_length;
  const Real error =
      slack * (abs(offset[0]) + abs(offset[1]) + abs(offset[2]) + cylinder.radius) * speed;
  const Real distance = abs(dot(offset, across)) - error;
  const double squared_radius = cylinder.radius * cylinder.radius;
  using Mask = decltype(distance > 0.0);
  return Decision<Mask>{
      .rejected = distance > 0.0 && distance * distance > squared_radius * dot(across, across),
      .accepted = {}};
}

/// Whatever it is, if it is judged and no box; `last` as of planes. A sphere is not told to be met
/// unless `any_will_do`, as nothing else asks for it.
template <class Real>
auto test_proxy(const BoundingProxy& proxy, const BoundingProxies& proxies,
                const FilterLine<Real>& line, const Real& limit, bool any_will_do, Real& last) {
  switch (proxy.kind) {
    case BoundingProxy::Kind::sphere:
    case BoundingProxy::Kind::moved_sphere:
      return test_sphere(proxy, line, limit, any_will_do);
    case BoundingProxy::Kind::torus:
      return test_torus(proxy, proxies.axis(proxy), line, limit);
    case BoundingProxy::Kind::cylinder:
      return test_cylinder(proxy, proxies.axis(proxy), line);
    default:
      return test_plane(proxy, proxies.axis(proxy), line, limit, last);
  }
}

}  // namespace crt::core
