#include "core/geometry/triangle/triangle.hpp"

#include <algorithm>

#include "core/geometry/checks.hpp"
#include "core/geometry/exact_plane.hpp"
#include "core/math/vector.hpp"

namespace crt::core {
namespace {

/// Returns to - from exactly, times `scale` (a power of two).
PreciseVec3 difference(const Vec3& to, const Vec3& from, double scale) {
  PreciseVec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    const DoubleDouble exact = two_sum(to[axis], -from[axis]);
    result[static_cast<std::size_t>(axis)] = {exact.hi * scale, exact.lo * scale};
  }
  return result;
}

double inverse_length_scale(const Vec3& v) {
  return 1 / power_of_two_below(largest_component(v));
}

/// Returns on which side of the edge from `from` to `to` the line passes: the sign of from . (edge
/// x d), relative to the line's point at t. It is 0 if the line is closer to the edge than
/// double-double can resolve.
int side_of_edge(const ObjectRay& ray, const Vec3& from, const Vec3& to, double t) {
  const Vec3 d = scaled_to_one(ray.direction);
  const Vec3 edge = to - from;
  const Vec3 start = -ray.from_center(from, t);
  const double volume = glm::dot(start, accurate_cross(edge, d));
  constexpr double filter = 16 * unit_roundoff;
  if (std::abs(volume) >
      filter * largest_component(start) * largest_component(edge) * largest_component(d)) {
    return volume > 0 ? 1 : -1;
  }

  const double scale =
      1 / power_of_two_below(std::max(largest_component(edge), largest_component(start)));
  const double direction_scale = 1 / power_of_two_below(largest_component(ray.direction));
  PreciseVec3 direction;
  PreciseVec3 offset;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    direction[i] =
        two_sum(ray.direction[axis] * direction_scale, ray.direction_low[axis] * direction_scale);
    const DoubleDouble exact = two_sum(ray.origin[axis], -from[axis]);
    const DoubleDouble origin = DoubleDouble(exact.hi * scale, exact.lo * scale) +
                                DoubleDouble(ray.origin_low[axis] * scale);
    offset[i] = -(origin + direction[i] * DoubleDouble(t / direction_scale * scale));
  }
  const PreciseVec3 moment = cross(difference(to, from, scale), direction);
  const DoubleDouble precise = dot(offset, moment);
  constexpr double rounding = 0x1p-96;
  if (std::abs(precise.hi) <= rounding) return 0;
  return precise.hi > 0 ? 1 : -1;
}

}  // namespace

PreciseVec3 precise_normal_of(const Triangle& triangle) {
  const Vec3 ab = triangle.b - triangle.a;
  const Vec3 ac = triangle.c - triangle.a;
  if (largest_component(ab) == 0 || largest_component(ac) == 0) return {};
  const PreciseVec3 normal = cross(difference(triangle.b, triangle.a, inverse_length_scale(ab)),
                                   difference(triangle.c, triangle.a, inverse_length_scale(ac)));
  constexpr double rounding = 0x1p-98;
  if (largest_component(rounded(normal)) > rounding) return normal;
  // Double-double cannot distinguish the corners from points on a line.
  return rounded_direction(exact_normal(triangle.a, triangle.b, triangle.c));
}

TriangleShape::TriangleShape(const Triangle& triangle)
    : corners_{triangle.a, triangle.b, triangle.c},
      precise_normal_(precise_normal_of(triangle)),
      face_(rounded(precise_normal_), triangle.a) {}

Bounds TriangleShape::bounds() const {
  Bounds result;
  for (const Vec3& corner : corners_) result.include(corner);
  return result;
}

bool TriangleShape::passes_edges(const ObjectRay& ray) const {
  // The sides are found from a point of the line next to the triangle. A line nearly in the
  // triangle's plane may meet that plane so far away that no side could be resolved.
  const double scale = inverse_length_scale(ray.direction);
  const Vec3 d = ray.direction * scale;
  const double t = -glm::dot(ray.from_center(corners_[0], 0), d) / glm::dot(d, d) * scale;
  bool left = false;
  bool right = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = side_of_edge(ray, corners_[i], corners_[(i + 1) % 3], t);
    left = left || side > 0;
    right = right || side < 0;
  }
  return !(left && right);
}

/// Finds where a line meets the triangle's plane. If the line is parallel to it but for little more
/// than the rounding of the normal, the normal's further digits decide.
PlaneFace::Meeting TriangleShape::meet(const ObjectRay& ray) const {
  const PlaneFace::Meeting meeting = face_.meet_surface(ray);
  constexpr double nearly_parallel = 0x1p-40;
  const double size = largest_component(face_.normal()) * largest_component(ray.direction);
  if (ray.start.face == 0 || !(std::abs(meeting.rate) < nearly_parallel * size)) return meeting;
  PreciseVec3 direction;
  PreciseVec3 offset;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    direction[i] = two_sum(ray.direction[axis], ray.direction_low[axis]);
    const DoubleDouble exact = two_sum(ray.origin[axis], -corners_[0][axis]);
    offset[i] = exact + DoubleDouble(ray.origin_low[axis]);
  }
  const PreciseVec3& n = precise_normal_;
  const DoubleDouble rate = dot(n, direction);
  const DoubleDouble height = dot(n, offset);
  PlaneFace::Meeting result = meeting;
  result.rate = rate.hi;
  const DoubleDouble t = -height / rate;
  result.found = rate.hi != 0 && std::isfinite(t.hi);
  if (!result.found) return result;
  result.t = t.hi;
  result.t_low = t.lo;
  const double reach = glm::length(ray.from_center(corners_[0], t.hi, t.lo));
  result.error = PlaneFace::meeting_error(t.hi, reach, glm::length(rounded(n)), rate.hi);
  return result;
}

bool TriangleShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  const PlaneFace::Meeting meeting = meet(ray);
  if (!meeting.found) return false;
  if (PlaneFace::starts_here(ray) || passes_edges(ray)) PlaneFace::emit(meeting, out);
  return false;
}

template <class Real>
void write_weights(const Triangle& triangle, const Vec3Of<Real>& relative, Real& u, Real& v) {
  using Vector = Vec3Of<Real>;
  const Vec3 ab = triangle.b - triangle.a;
  const Vec3 ac = triangle.c - triangle.a;
  const double scale = inverse_length_scale(ab);
  const double scale_c = inverse_length_scale(ac);
  const Vec3 area = accurate_cross(ab * scale, ac * scale_c);
  const double squared_area = glm::dot(area, area);
  if (!(squared_area > 0)) {
    u = v = Real{};
    return;
  }
  const Vector across = broadcast<Real>(area);
  const Vector scaled = broadcast<Real>(scale) * relative;
  const Real of_b =
      dot(accurate_cross(scaled, broadcast<Real>(ac * scale_c)), across) / squared_area;
  const Real of_c =
      dot(accurate_cross(broadcast<Real>(ab * scale), broadcast<Real>(scale_c) * relative),
          across) /
      squared_area;
  u = clamp(of_b, Real{}, broadcast<Real>(1));
  v = clamp(of_c, Real{}, 1 - u);
}

template void write_weights<double>(const Triangle&, const Vec3&, double&, double&);

template <class Real>
void TriangleShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>&, std::uint32_t,
                                bool with_uv, SurfacePointOf<Real>& point) const {
  using Vector = Vec3Of<Real>;
  const Vector relative = face_.onto_plane(offset);
  face_.write_point(relative, point);
  const Bounds box = bounds();
  point.position = clamp(point.position, broadcast<Real>(box.lower), broadcast<Real>(box.upper));
  if (with_uv)
    write_weights({.a = corners_[0], .b = corners_[1], .c = corners_[2]}, relative, point.u,
                  point.v);
}

// Meshes ask for points of triangles, too.
template void TriangleShape::write_point<double>(const Vec3&, const Vec3&, std::uint32_t, bool,
                                                 SurfacePoint&) const;
template void TriangleShape::write_point<Lanes>(const VectorLanes&, const VectorLanes&,
                                                std::uint32_t, bool, SurfacePointLanes&) const;

bool has_area(const Triangle& triangle) {
  return largest_component(rounded(precise_normal_of(triangle))) != 0;
}

bool is_in_plane(const Triangle& triangle, const Triangle& of_plane) {
  const Vec3* const corners[] = {&triangle.a, &triangle.b, &triangle.c};
  const auto shares_coordinate = [&](int axis) {
    const double place = of_plane.a[axis];
    return of_plane.b[axis] == place && of_plane.c[axis] == place &&
           std::all_of(std::begin(corners), std::end(corners),
                       [&](const Vec3* corner) { return (*corner)[axis] == place; });
  };
  if (shares_coordinate(0) || shares_coordinate(1) || shares_coordinate(2)) return true;
  const DyadicVector origin = exactly(of_plane.a);
  const DyadicVector normal = exact_normal(of_plane.a, of_plane.b, of_plane.c);
  return std::all_of(std::begin(corners), std::end(corners), [&](const Vec3* corner) {
    return *corner == of_plane.a || *corner == of_plane.b || *corner == of_plane.c ||
           dot(normal, exactly(*corner) - origin).sign() == 0;
  });
}

void validate(const Triangle& triangle) {
  if (!has_area(triangle))
    reject("c", "must not be on a line with a and b (the triangle has no area)");
}

SurfacePieces TriangleShape::pieces() const {
  return {{.kind = SurfacePiece::Kind::triangle,
           .origin = corners_[0],
           .edge_a = corners_[1] - corners_[0],
           .edge_b = corners_[2] - corners_[0],
           .normal = face_.unit_normal()}};
}

std::unique_ptr<const Shape> make_shape(const Triangle& triangle) {
  return std::make_unique<TriangleShape>(triangle);
}

}  // namespace crt::core
