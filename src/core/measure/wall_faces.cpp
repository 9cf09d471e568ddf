#include "core/measure/wall_faces.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/measure/nearest.hpp"
#include "crt/elementary.hpp"

namespace crt::core {

namespace {

/// Angles are rounded by less than this, in radians.
constexpr double angle_rounding = 0x1p-40;

/// A surface with normals in a small cell that differ by more than this, in radians, has a radius
/// or a point that is as small.
constexpr double largest_turn = 0.25;

constexpr Directions every_direction{.middle = {1, 0, 0}, .spread = std::numbers::pi};

Directions reversed(const Directions& directions) {
  return {-directions.middle, directions.spread};
}

double angle_between(const Vec3& a, const Vec3& b) {
  return elementary::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
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

/// Returns the length of a vector's part across another one.
double length_across(const Vec3& v, const Vec3& along) {
  const double square_of_length = glm::dot(along, along);
  return glm::length(square_of_length > 0 ? v - glm::dot(v, along) / square_of_length * along : v);
}

/// A Side is the half space of a face's function, above 0.
struct Side {
  double value;
  Vec3 slope;
  double error;

  Side(const CellFace& face, bool is_negative)
      : value(is_negative ? -face.value : face.value),
        slope(is_negative ? -face.slope : face.slope),
        error(face.error) {}
};

/// Returns a bound on a function in a cell where a face is and where another function is above 0.
/// For any factor of the face's function, and one above 0 of the other's, the sum of the three is
/// not below the function there. The best factors leave the least of the slope.
double most_within(const Side& side, const CellFace& on, const Side& other) {
  const double of_on = glm::dot(on.slope, on.slope);
  const double of_other = glm::dot(other.slope, other.slope);
  const double of_both = glm::dot(on.slope, other.slope);
  const double determinant = of_on * of_other - of_both * of_both;
  const double along_on = glm::dot(side.slope, on.slope);
  const double along_other = glm::dot(side.slope, other.slope);
  double factor_of_on = of_on > 0 ? -along_on / of_on : 0;
  double factor = 0;
  if (determinant > 0) {
    const double wanted = (of_both * along_on - of_on * along_other) / determinant;
    if (wanted > 0) {
      factor = wanted;
      factor_of_on = (of_both * along_other - of_other * along_on) / determinant;
    }
  }
  const Vec3 rest = glm::abs(side.slope + factor_of_on * on.slope + factor * other.slope);
  return rest.x + rest.y + rest.z + side.value + factor_of_on * on.value + factor * other.value +
         side.error + std::abs(factor_of_on) * on.error + factor * other.error;
}

/// Says whether a face, where the other functions have given signs, is nowhere in a cell, or
/// between two of them that are no farther apart than `narrow`.
bool is_narrow(const CellLook& look, std::size_t face, std::uint32_t negative, const Vec3& half,
               double narrow) {
  const CellFace& on = look.faces[face];
  for (std::size_t i = 0; i < look.faces.size(); ++i) {
    if (i == face) continue;
    const Side side(look.faces[i], ((negative >> i) & 1U) != 0);
    const double rise = length_across(side.slope / half, on.slope / half);
    for (std::size_t k = 0; k < look.faces.size(); ++k) {
      if (k == i || k == face) continue;
      const Side other(look.faces[k], ((negative >> k) & 1U) != 0);
      if (most_within(side, on, other) < narrow * rise) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<WallFace> wall_faces_of(const CellLook& look, const Vec3& half, double narrow) {
  const bool is_small = largest_component(half) <= narrow;
  std::vector<WallFace> faces;
  if (look.kind == CellLook::Kind::unknown) faces.push_back({.outward = every_direction});
  if (look.kind != CellLook::Kind::crossed) return faces;
  const std::uint32_t count = 1U << look.faces.size();
  for (std::size_t i = 0; i < look.faces.size(); ++i) {
    const CellFace& face = look.faces[i];
    const Directions along = directions_of(face.slopes);
    if (!face.is_surface || (is_small && along.spread > largest_turn)) continue;
    const std::uint32_t bit = 1U << i;
    bool is_below = false;  // whether the solid is where the function is below 0
    bool is_above = false;
    for (std::uint32_t m = 0; m < count; ++m) {
      if ((m & bit) == 0 || look.is_inside(m) == look.is_inside(m ^ bit)) continue;
      bool& is_found = look.is_inside(m) ? is_below : is_above;
      if (!is_found) is_found = !is_narrow(look, i, m, half, narrow);
    }
    if (is_below) faces.push_back({.face = &face, .outward = along, .is_turned = false});
    if (is_above) faces.push_back({.face = &face, .outward = reversed(along), .is_turned = true});
  }
  return faces;
}

Directions directions_of(const std::array<Interval, 3>& vectors) {
  const Vec3 middle = middle_of(vectors);
  Vec3 off{0, 0, 0};
  for (int axis = 0; axis < 3; ++axis) {
    const Interval& side = vectors[static_cast<std::size_t>(axis)];
    off[axis] = std::max(side.hi - middle[axis], middle[axis] - side.lo);
  }
  const double scale = largest_component(glm::abs(middle));
  const double share = glm::length(off / scale) / glm::length(middle / scale);
  if (!(share < 1)) return every_direction;
  return {.middle = middle / scale / glm::length(middle / scale),
          .spread = elementary::asin(share) + angle_rounding};
}

double least_angle(const Directions& a, const Directions& b) {
  return angle_between(a.middle, b.middle) - a.spread - b.spread - angle_rounding;
}

double most_angle(const Directions& a, const Directions& b) {
  return angle_between(a.middle, b.middle) + a.spread + b.spread + angle_rounding;
}

namespace {

/// Says whether all of a face is behind all of another, along directions that are no farther from
/// one than `off`. Neither is unknown.
bool is_behind(const Bounds& box_a, const WallFace& a, const Bounds& box_b, const WallFace& b,
               const Directions& along, double off) {
  if (!(along.spread + off < 0.5 * std::numbers::pi - angle_rounding)) return false;
  const double farthest = most_of_face(CellFrame(box_b), *b.face, along.middle) +
                          most_of_face(CellFrame(box_a), *a.face, -along.middle);
  return farthest < -distance_rounding * std::max(box_a.farthest(), box_b.farthest());
}

}  // namespace

bool may_be_wall(const Bounds& box_a, const WallFace& a, const Bounds& box_b, const WallFace& b,
                 const WallAngle& angle) {
  const Directions into_a = reversed(a.outward);
  if (least_angle(into_a, b.outward) > angle.exact + angle.loose) return false;
  const std::array<Interval, 3> from_a = intervals_of(box_a);
  const std::array<Interval, 3> to_b = intervals_of(box_b);
  const Directions way =
      directions_of({to_b[0] - from_a[0], to_b[1] - from_a[1], to_b[2] - from_a[2]});
  const double off_a = least_angle(way, into_a);
  const double off_b = least_angle(way, b.outward);
  if (std::min(off_a, off_b) > angle.exact || std::max(off_a, off_b) > angle.loose) return false;
  if (a.face == nullptr || b.face == nullptr) return true;
  return !is_behind(box_a, a, box_b, b, into_a, angle.loose) &&
         !is_behind(box_a, a, box_b, b, b.outward, angle.loose);
}

double least_between(const Bounds& box_a, const WallFace& a, const Bounds& box_b,
                     const WallFace& b) {
  double least = glm::length(way_between(box_a, box_b));
  if (a.face == nullptr || b.face == nullptr) return least;
  const CellFrame frame_a(box_a);
  const CellFrame frame_b(box_b);
  for (const Vec3& along : {-a.outward.middle, b.outward.middle, frame_b.middle - frame_a.middle}) {
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
