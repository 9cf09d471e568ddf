#include "core/geometry/capsule/capsule.hpp"

#include <algorithm>
#include <numbers>

#include "core/geometry/capsule/functions.hpp"
#include "core/geometry/near_line.hpp"
#include "core/math/direction_and_length.hpp"
#include "core/math/vector.hpp"

namespace crt::core {
CapsuleShape::CapsuleShape(const Capsule& capsule)
    : cylinder_({.from = capsule.from, .to = capsule.to, .radius = capsule.radius}),
      spheres_{SphereShape({.center = capsule.from, .radius = capsule.radius}),
               SphereShape({.center = capsule.to, .radius = capsule.radius})},
      centers_{capsule.from, capsule.to},
      radius_(capsule.radius),
      frame_(frame_about(capsule.to - capsule.from)),
      unit_(power_of_two_below(capsule.radius)),
      height_(direction_and_length(capsule.to - capsule.from).length / unit_) {
  const double quarter_circle = std::numbers::pi / 2 * (radius_ / unit_);
  tip_share_ = quarter_circle / (2 * quarter_circle + height_);
}

Bounds CapsuleShape::bounds() const {
  Bounds result;
  for (const Vec3& center : centers_) result.include_around(center, Vec3(radius_));
  return result;
}

std::optional<CoreSegment> CapsuleShape::core_segment() const {
  const Vec3 tip = radius_ * frame_.along;
  return CoreSegment{centers_[0] - tip, centers_[1] + tip, radius_, radius_};
}

bool CapsuleShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  const std::array<CapsuleSpan, 3> parts = {span_of(0, ray, out), span_of(1, ray, out),
                                            span_of(2, ray, out)};
  CapsuleSpan whole = united(parts);
  if (parts[0].found) {
    bound_at_seam(ray, parts[0].enter, whole.enter);
    bound_at_seam(ray, parts[0].leave, whole.leave);
  }
  if (ray.start.face != invalid_index && ray.start.on_face) {
    begin_at_start(ray.start, unit_roundoff * (radius_ / largest_component(ray.direction)), whole);
  }
  append(whole, out);
  return false;
}

CapsuleSpan CapsuleShape::span_of(std::uint32_t part, const ObjectRay& ray,
                                  CrossingList& out) const {
  const std::size_t size = out.size();
  const auto append_crossings = [&](const ObjectRay& seen) {
    if (part == side_face) {
      cylinder_.crossings(seen, out);
    } else {
      spheres_[part - 1].crossings(seen, out);
    }
  };
  if (ray.start.face == invalid_index) {
    append_crossings(ray);
  } else {
    ObjectRay seen = ray;
    seen.start = start_on_part(ray.start, part);
    append_crossings(seen);
  }
  return take_span(out, size, part);
}

/// Corrects the error of an end of the span that is on a half sphere, if it is so near to the seam
/// that the true one may be on the side. `of_cylinder` is that end of the cylinder's span.
void CapsuleShape::bound_at_seam(const ObjectRay& ray, const Crossing& of_cylinder,
                                 Crossing& end) const {
  if (end.face == side_face) return;
  const bool is_start = end.face == ray.start.face && end.t == 0;
  const double gap = std::abs(end.t - of_cylinder.t);
  const bool is_apart = of_cylinder.face != side_face && gap > end.error + of_cylinder.error;
  if (is_start || is_apart) return;
  end.error = std::max(end.error, gap + seam_error(ray, end));
}

/// Returns the standard tier's bound on the error of t next to a seam. Both faces have one normal
/// there, and the side curves less.
double CapsuleShape::seam_error(const ObjectRay& ray, const Crossing& crossing) const {
  const Vec3& center = centers_[crossing.face - 1];
  NearLine line = NearLine::at_origin(ray, center, unit_);
  line.move_to(ray, center, crossing.t);
  const Vec3 across = line.point - glm::dot(line.point, frame_.along) * frame_.along;
  const double approach = std::abs(glm::dot(unit_vector(across), line.direction));
  const double r = radius_ / unit_;
  const double reach = height_ + 2 * r;
  const double speed = std::sqrt(line.squared_length);
  const double turning = glm::length(accurate_cross(line.direction, frame_.along));
  const double graze = speed / turning * grazing_error(line, reach, r);
  return standard_error(line, crossing.t, reach, approach, std::min(reach / speed, graze));
}

template <class Real>
void CapsuleShape::set_uv(std::uint32_t face, SurfacePointOf<Real>& point) const {
  const double side_share = 1 - 2 * tip_share_;
  if (face == side_face) {
    point.v = tip_share_ + side_share * point.v;
    return;
  }
  const Vec3Of<Real>& n = point.normal;
  const Real x = dot(n, broadcast<Real>(frame_.zero));
  const Real y = dot(n, broadcast<Real>(frame_.quarter));
  const Real half_share =
      2 * tip_share_ * latitude<Real>(sqrt(x * x + y * y), dot(n, broadcast<Real>(frame_.along)));
  point.u = turn(x, y);
  point.v = face == 1 ? half_share : side_share + half_share;
}

SurfacePoint CapsuleShape::point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                                    bool with_uv) const {
  const bool is_side = face == side_face;
  SurfacePoint point = part(face).point_on(offset, direction, 0, with_uv && is_side);
  if (with_uv) set_uv<double>(face, point);
  return point;
}

void CapsuleShape::points_on(const VectorLanes& offsets, const VectorLanes& directions,
                             std::uint32_t some, std::uint32_t face, bool with_uv,
                             SurfacePointLanes& points) const {
  const bool is_side = face == side_face;
  part(face).points_on(offsets, directions, some, 0, with_uv && is_side, points);
  if (with_uv) set_uv<Lanes>(face, points);
}

std::unique_ptr<const FaceFunctions> CapsuleShape::face_functions() const {
  return face_functions_of(CapsuleFunctions(centers_[0], centers_[1], radius_, unit_));
}

std::unique_ptr<const Shape> make_shape(const Capsule& capsule) {
  return std::make_unique<CapsuleShape>(capsule);
}

}  // namespace crt::core
