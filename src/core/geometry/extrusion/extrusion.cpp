#include "core/geometry/extrusion/extrusion.hpp"

#include <algorithm>
#include <limits>

#include "core/geometry/checks.hpp"
#include "core/geometry/extrusion/functions.hpp"
#include "core/geometry/frustum/start.hpp"
#include "core/geometry/profile/contour_share.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

class StandardTier final : public ExtrusionTier {
 public:
  StandardTier(const ExtrusionShape& shape, const ObjectRay& ray, double shortest)
      : shape_(shape), ray_(ray), shortest_(shortest) {}

  EndMeeting meet_end(std::uint32_t end) const override {
    const PlaneFace& plane = shape_.end(end);
    const PlaneFace::Meeting meeting = plane.meet(ray_);
    return {.side = sign_of(meeting.rate),
            .found = meeting.found,
            .behind = !meeting.found && plane.behind(ray_),
            .crossing = {.t = meeting.t, .error = meeting.error}};
  }

  bool meet(std::uint32_t piece, Crossing& crossing) const override {
    const PlaneFace::Meeting meeting = shape_.plane(piece).meet(ray_);
    crossing.t = meeting.t;
    crossing.error = meeting.error;
    return meeting.found;
  }

  std::array<Crossing, 2> meet_circle(std::uint32_t arc, const EndSpan& ends) const override {
    ClippedSpan span(ray_.start, shortest_);
    span.enter(ends.enter);
    span.leave(ends.leave);
    return shape_.cylinder(arc).side_crossings(ray_, span);
  }

  Crossing meet_circle_again(std::uint32_t arc) const override {
    return shape_.cylinder(arc).side_start(ray_, ClippedSpan(ray_.start, shortest_)).other;
  }

  void place(const DoubleDouble& t, Crossing& crossing) const override {
    constexpr double last_rounding = 1 + 0x1p-40;
    crossing.t = t.hi;
    crossing.error = rounding_of(t.hi) * last_rounding;
  }

  int order(const Crossing& first, const Crossing& second) const override {
    return first.t < second.t ? -1 : (first.t > second.t ? 1 : 0);
  }

 private:
  const ExtrusionShape& shape_;
  const ObjectRay& ray_;
  double shortest_;
};

}  // namespace

ExtrusionShape::ExtrusionShape(const Extrusion& extrusion)
    : profile_(extrusion.profile),
      bounds_(extrusion.profile->bounds()),
      ends_{PlaneFace({0, 0, -1}, {0, 0, 0}), PlaneFace({0, 0, 1}, {0, 0, 0})} {
  bounds_.lower.z = std::min(extrusion.from, extrusion.to);
  bounds_.upper.z = std::max(extrusion.from, extrusion.to);
  ends_ = {PlaneFace({0, 0, -1}, bounds_.lower),
           PlaneFace({0, 0, 1}, {bounds_.lower.x, bounds_.lower.y, bounds_.upper.z})};
  shortest_ = unit_roundoff * largest_component(bounds_.upper - bounds_.lower);
  planes_.reserve(profile_->pieces().size());
  for (std::uint32_t i = 0; i < profile_->pieces().size(); ++i) {
    const Profile::Piece& piece = profile_->pieces()[i];
    const Vec3 along = piece.to - piece.from;
    planes_.emplace_back(Vec3(along.y, -along.x, 0) + Vec3(0.0), box_of(i).lower);
  }
  cylinders_.resize(profile_->arcs().size());
  for (std::uint32_t i = 0; i < cylinders_.size(); ++i) {
    const Profile::Arc& arc = profile_->arcs()[i];
    if (arc.first != i) continue;
    cylinders_[i] = std::make_unique<CylinderShape>(
        Cylinder{.from = {arc.center.x, arc.center.y, bounds_.lower.z},
                 .to = {arc.center.x, arc.center.y, bounds_.upper.z},
                 .radius = arc.radius});
  }
}

bool ExtrusionShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  const double shortest = shortest_ / largest_component(ray.direction);
  PlaneLine line(ray);
  append_crossings(*profile_, line, StandardTier(*this, ray, shortest), shortest, out);
  return false;
}

Vec3 ExtrusionShape::anchor(std::uint32_t face) const {
  if (face < end_count) return ends_[face].position();
  const Profile::Wall wall = profile_->wall(wall_of_face(face));
  if (wall.arc != invalid_index) {
    return cylinder(profile_->arcs()[wall.arc].first).anchor(FrustumShape::side_face);
  }
  return planes_[wall.piece].position();
}

/// Returns the box between the ends of a piece. Its lower corner is the position of the plane, if
/// that is across an axis.
Bounds ExtrusionShape::box_of(std::uint32_t number) const {
  const Profile::Piece& piece = profile_->pieces()[number];
  Bounds box;
  box.include(piece.from);
  box.include(piece.to);
  if (piece.from.x != piece.to.x && piece.from.y != piece.to.y) box = {piece.from, piece.to};
  box.lower.z = bounds_.lower.z;
  box.upper.z = bounds_.upper.z;
  return box;
}

template <class Real>
void ExtrusionShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction,
                                 std::uint32_t face, bool with_uv,
                                 SurfacePointOf<Real>& point) const {
  if (face < end_count) return write_end_point(offset, face, with_uv, point);
  const Profile::Wall wall = profile_->wall(wall_of_face(face));
  if (wall.arc != invalid_index) {
    write_round_point(offset, direction, wall.arc, with_uv, point);
  } else {
    write_flat_point(offset, wall.piece, with_uv, point);
  }
  if (is_turned(face)) point.normal = -point.normal;
}

template <class Real>
void ExtrusionShape::write_end_point(const Vec3Of<Real>& offset, std::uint32_t end, bool with_uv,
                                     SurfacePointOf<Real>& point) const {
  using Vector = Vec3Of<Real>;
  const Vector size = broadcast<Real>(bounds_.upper - bounds_.lower);
  const Vector within = clamp(offset, broadcast<Real>(Vec3(0)), size);
  point.position = min(broadcast<Real>(bounds_.upper), broadcast<Real>(bounds_.lower) + within);
  point.position.z = broadcast<Real>(ends_[end].position().z);
  point.normal = broadcast<Real>(ends_[end].unit_normal());
  if (!with_uv) return;
  point.u = within.x / size.x;
  point.v = within.y / size.y;
}

template <class Real>
void ExtrusionShape::write_flat_point(const Vec3Of<Real>& offset, std::uint32_t number,
                                      bool with_uv, SurfacePointOf<Real>& point) const {
  using Vector = Vec3Of<Real>;
  const PlaneFace& plane = planes_[number];
  const Profile::Piece& piece = profile_->pieces()[number];
  const Real height = broadcast<Real>(bounds_.upper.z - bounds_.lower.z);
  if (plane.axis() >= 0) {
    const Bounds box = box_of(number);
    const Vector within =
        clamp(offset, broadcast<Real>(Vec3(0)), broadcast<Real>(box.upper - box.lower));
    point.position = min(broadcast<Real>(box.upper), broadcast<Real>(box.lower) + within);
    point.position[plane.axis()] = broadcast<Real>(plane.position()[plane.axis()]);
    point.normal = broadcast<Real>(plane.unit_normal());
  } else {
    plane.write_point(plane.onto_plane(offset), point);
  }
  if (!with_uv) return;
  point.u = share_of_piece<Real>(piece, point.position);
  point.v = clamp((point.position.z - bounds_.lower.z) / height, Real{}, broadcast<Real>(1));
}

template <class Real>
void ExtrusionShape::write_round_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction,
                                       std::uint32_t number, bool with_uv,
                                       SurfacePointOf<Real>& point) const {
  const Profile::Arc& arc = profile_->arcs()[number];
  cylinder(arc.first).template write_point<Real>(offset, direction, FrustumShape::side_face, false,
                                                 point);
  if (!with_uv) return;
  const Real height = broadcast<Real>(bounds_.upper.z - bounds_.lower.z);
  point.v = clamp((point.position.z - bounds_.lower.z) / height, Real{}, broadcast<Real>(1));
  point.u = share_of_arc<Real>(*profile_, arc, point.normal.x, point.normal.y);
}

Surface ExtrusionShape::surface(std::uint32_t face) const {
  if (face < end_count) return ends_[face].surface();
  const Profile::Wall wall = profile_->wall(wall_of_face(face));
  if (wall.arc != invalid_index) {
    Surface surface = cylinder(profile_->arcs()[wall.arc].first).surface(FrustumShape::side_face);
    surface.is_hollow = is_turned(face);
    return surface;
  }
  const Profile::Piece& piece = profile_->pieces()[wall.piece];
  Surface surface = planes_[piece.first].surface();
  if (piece.turned != is_turned(face)) surface.direction = -surface.direction;
  return surface;
}

std::unique_ptr<const FaceFunctions> ExtrusionShape::face_functions() const {
  return face_functions_of(
      ExtrusionFunctions{.profile = profile_, .lower = bounds_.lower.z, .upper = bounds_.upper.z});
}

std::size_t ExtrusionShape::bytes() const {
  std::size_t bytes = sizeof *this + profile_->bytes() + planes_.capacity() * sizeof(PlaneFace) +
                      cylinders_.capacity() * sizeof(cylinders_[0]);
  for (const auto& cylinder : cylinders_) bytes += cylinder ? sizeof *cylinder : 0;
  return bytes;
}

void validate(const Extrusion& extrusion) {
  const auto check = [](const char* name, double height) {
    check_coordinates(name, {0, 0, height});
  };
  check("from", extrusion.from);
  check("to", extrusion.to);
  check_end("to", {0, 0, extrusion.from}, {0, 0, extrusion.to});
}

std::unique_ptr<const Shape> make_shape(const Extrusion& extrusion) {
  return std::make_unique<ExtrusionShape>(extrusion);
}

}  // namespace crt::core
