#include "core/measure/wall_faces.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/measure/nearest.hpp"

namespace crt::core {

namespace {

using IntervalVec = std::array<Interval, 3>;

IntervalVec negated(const IntervalVec& v) {
  return {-v[0], -v[1], -v[2]};
}

Interval product_of(const IntervalVec& a, const IntervalVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns the square of the length of the cross product.
Interval square_across(const IntervalVec& a, const IntervalVec& b) {
  return square(a[1] * b[2] - a[2] * b[1]) + square(a[2] * b[0] - a[0] * b[2]) +
         square(a[0] * b[1] - a[1] * b[0]);
}

/// Says whether two directions may be within an angle, by the square of its tangent.
bool may_be_along(const IntervalVec& a, const IntervalVec& b, double square_of_tangent) {
  const double along = product_of(a, b).hi;
  return along > 0 &&
         square_across(a, b).lo <= rounded_up(square_of_tangent * rounded_up(along * along));
}

/// Returns a bound on how far a face in a box reaches along a direction. For any factor, that is
/// the most that the direction less so many times the slope reaches in the cube, plus what the
/// factor makes of the face's values. The best factor is one for which a component is 0.
double most_of_face(const CellFrame& frame, const CellFace& face, const Vec3& direction) {
  const Vec3 along = direction * frame.half;
  const auto most = [&](double factor) {
    const Vec3 rest = glm::abs(along - factor * face.slope);
    return rest.x + rest.y + rest.z - factor * face.value + std::abs(factor) * face.error;
  };
  double best = most(0);
  for (int axis = 0; axis < 3; ++axis) {
    if (face.slope[axis] == 0) continue;
    const double bound = most(along[axis] / face.slope[axis]);
    if (bound < best) best = bound;
  }
  return glm::dot(direction, frame.middle) + best;
}

}  // namespace

std::vector<WallFace> wall_faces_of(const CellLook& look) {
  std::vector<WallFace> faces;
  if (look.kind != CellLook::Kind::crossed) return faces;
  const std::uint32_t count = 1U << look.faces.size();
  for (std::size_t i = 0; i < look.faces.size(); ++i) {
    const std::uint32_t bit = 1U << i;
    bool is_below = false;  // whether the solid is where the function is below 0
    bool is_above = false;
    for (std::uint32_t m = 0; m < count; ++m) {
      if ((m & bit) == 0 || look.is_inside(m) == look.is_inside(m ^ bit)) continue;
      (look.is_inside(m) ? is_below : is_above) = true;
    }
    const CellFace& face = look.faces[i];
    if (is_below) faces.push_back({.face = &face, .outward = face.slopes, .is_turned = false});
    if (is_above)
      faces.push_back({.face = &face, .outward = negated(face.slopes), .is_turned = true});
  }
  return faces;
}

double most_off(const IntervalVec& a, const IntervalVec& b) {
  const double along = product_of(a, b).lo;
  if (!(along > 0)) return infinity;
  return rounded_up(square_across(a, b).hi / rounded_down(along * along));
}

bool may_be_wall(const Bounds& box_a, const WallFace& a, const Bounds& box_b, const WallFace& b,
                 const WallAngle& angle) {
  const IntervalVec into_a = negated(a.outward);
  // The angles at both sides together, as tangents of sums are at most twice as large up to here.
  const double together = std::sqrt(angle.exact) + std::sqrt(angle.loose);
  if (!may_be_along(into_a, b.outward, 1.1 * together * together)) return false;
  const IntervalVec from_a = intervals_of(box_a);
  const IntervalVec to_b = intervals_of(box_b);
  const IntervalVec way = {to_b[0] - from_a[0], to_b[1] - from_a[1], to_b[2] - from_a[2]};
  if (!may_be_along(way, into_a, angle.loose) || !may_be_along(way, b.outward, angle.loose))
    return false;
  return may_be_along(way, into_a, angle.exact) || may_be_along(way, b.outward, angle.exact);
}

double least_between(const Bounds& box_a, const WallFace& a, const Bounds& box_b,
                     const WallFace& b) {
  const CellFrame frame_a(box_a);
  const CellFrame frame_b(box_b);
  double least = glm::length(way_between(box_a, box_b));
  for (const Vec3& along :
       {-middle_of(a.outward), middle_of(b.outward), frame_b.middle - frame_a.middle}) {
    const double size = glm::length(along);
    if (!(size > 0) || !std::isfinite(size)) continue;
    const Vec3 direction = along / size;
    const double apart =
        -most_of_face(frame_b, *b.face, -direction) - most_of_face(frame_a, *a.face, direction);
    if (apart > least) least = apart;
  }
  return least;
}

}  // namespace crt::core
