#include "core/geometry/revolution/revolution.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/geometry/checks.hpp"
#include "core/geometry/profile/contour_share.hpp"
#include "core/geometry/revolution/functions.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

class StandardTier final : public RevolutionTier {
 public:
  StandardTier(const std::vector<std::unique_ptr<const Shape>>& bodies, const ObjectRay& ray)
      : bodies_(bodies), ray_(ray) {}

  bool meet(std::uint32_t body, const FaceStart& start, CrossingList& out) const override {
    ObjectRay ray = ray_;
    ray.start = start;
    ray.begin = -std::numeric_limits<double>::infinity();
    ray.first_wanted_after = std::numeric_limits<double>::infinity();
    return bodies_[body]->crossings(ray, out);
  }

  int order(const Crossing& first, const Crossing& second) const override {
    return first.t < second.t ? -1 : (first.t > second.t ? 1 : 0);
  }

  ExactLine exact() const override { return exact_line(ray_); }

  void place(const DoubleDouble& t, Crossing& crossing) const override {
    constexpr double last_rounding = 1 + 0x1p-40;
    // Without its last bits the low part cannot round one place to two doubles.
    constexpr double coarsely = 0x1.8p-40;
    const double coarse = coarsely * power_of_two_below(std::abs(t.hi));
    crossing.t = t.hi + ((t.lo + coarse) - coarse);
    crossing.error = rounding_of(t.hi) * last_rounding;
  }

 private:
  const std::vector<std::unique_ptr<const Shape>>& bodies_;
  const ObjectRay& ray_;
};

}  // namespace

RevolutionShape::RevolutionShape(const Revolution& revolution)
    : turned_(revolution),
      turns_(std::min(revolution.angle / (2 * std::numbers::pi), 1.0)),
      bounds_(turned_.bounds()),
      bodies_(turned_.body_count()) {
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i] = make_shape(turned_.body(i));
  }
}

bool RevolutionShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  append_crossings(turned_, ray, StandardTier(bodies_, ray), out);
  return false;
}

template <class Real>
void RevolutionShape::finish_point(std::uint32_t face, bool with_uv,
                                   SurfacePointOf<Real>& point) const {
  if (face >= end_count && is_turned(face)) point.normal = -point.normal;
  if (!with_uv) return;
  const Profile& profile = *turned_.profile;
  const Real x = sqrt(point.position.x * point.position.x + point.position.z * point.position.z);
  if (face < end_count) {
    const Bounds& box = profile.bounds();
    const Vec3 size = box.upper - box.lower;
    point.u = clamp((x - box.lower.x) / size.x, Real{}, broadcast<Real>(1));
    point.v = clamp((point.position.y - box.lower.y) / size.y, Real{}, broadcast<Real>(1));
    return;
  }
  // Rounding may have put a point before the begin of the turn.
  const Real turned = turn(point.position.z, point.position.x);
  point.u = select(turned > 0.5 + 0.5 * turns_, Real{}, min(turned / turns_, broadcast<Real>(1)));
  const Profile::Wall wall = profile.wall(wall_of_face(face));
  if (wall.arc != invalid_index) {
    const Profile::Arc& arc = profile.arcs()[wall.arc];
    point.v = share_of_arc<Real>(profile, arc, (x - arc.center.x) / arc.radius,
                                 (point.position.y - arc.center.y) / arc.radius);
  } else {
    point.v = share_of_piece<Real>(profile.pieces()[wall.piece],
                                   {x, point.position.y, broadcast<Real>(0)});
  }
}

SurfacePoint RevolutionShape::point_on(const Vec3& offset, const Vec3& direction,
                                       std::uint32_t face, bool with_uv) const {
  SurfacePoint point = body(face).point_on(offset, direction, 0, false);
  finish_point<double>(face, with_uv, point);
  return point;
}

void RevolutionShape::points_on(const VectorLanes& offsets, const VectorLanes& directions,
                                std::uint32_t some, std::uint32_t face, bool with_uv,
                                SurfacePointLanes& points) const {
  body(face).points_on(offsets, directions, some, 0, false, points);
  finish_point<Lanes>(face, with_uv, points);
}

Surface RevolutionShape::surface(std::uint32_t face) const {
  Surface surface = bodies_[turned_.body_of_surface(face)]->surface(0);
  if (face < end_count || !is_turned(face)) return surface;
  if (surface.kind == SurfaceKind::plane) {
    surface.direction = -surface.direction;
  } else {
    surface.is_hollow = true;
  }
  return surface;
}

std::unique_ptr<const FaceFunctions> RevolutionShape::face_functions() const {
  return face_functions_of(RevolutionFunctions(turned_));
}

std::size_t RevolutionShape::bytes() const {
  std::size_t bytes =
      sizeof *this + turned_.profile->bytes() + bodies_.capacity() * sizeof(bodies_[0]);
  for (const auto& body : bodies_) bytes += body->bytes();
  return bytes;
}

namespace {

/// A CornerPlace says where in a profile something is.
struct CornerPlace {
  std::size_t contour;
  std::size_t corner;
};

[[noreturn]] void reject_profile(const CornerPlace& place, const std::string& rule) {
  throw Error(
      ErrorCode::invalid_argument,
      text::format("profile: corner {} of contour {} {}", place.corner, place.contour, rule),
      "profile");
}

void check_corner(const ProfilePoint& corner, const CornerPlace& place) {
  if (corner.x < 0) {
    reject_profile(place, text::format("must be at x >= 0, as x is the distance from the axis (it "
                                       "is at x = {})",
                                       corner.x));
  }
  if (corner.x != 0 && corner.x < smallest_length) {
    reject_profile(place, text::format("must be on the axis or at least 1e-100 from it (it is at "
                                       "x = {})",
                                       corner.x));
  }
}

/// Checks the piece that leads to a corner, and its arc.
void check_piece(const Profile& profile, const Profile::Piece& piece, const CornerPlace& place) {
  const double rise = std::abs(piece.to.y - piece.from.y);
  if (rise != 0 && rise < smallest_length) {
    reject_profile(place, "must be as high as the corner before, or at least 1e-100 off");
  }
  if (piece.arc == invalid_index) return;
  const Profile::Arc& arc = profile.arcs()[piece.arc];
  // Rounding may have put the nearest point of a circle that touches the axis beyond it.
  constexpr double rounding = 0x1p-40;
  const double nearest = arc.center.x - arc.radius;
  const Vec3 along = piece.to - piece.from;
  const double left = along.x * (arc.center.y - piece.from.y) - along.y * (nearest - piece.from.x);
  if (nearest < -rounding * arc.radius && left != 0 && (left < 0) == arc.is_right) {
    reject_profile(place, text::format("must not be reached by an arc beyond the axis (it goes to "
                                       "x = {})",
                                       nearest));
  }
}

}  // namespace

void validate(const Revolution& revolution) {
  // Degrees may have been turned into radians with a rounding.
  constexpr double largest = 2 * std::numbers::pi * (1 + 0x1p-50);
  if (!(revolution.angle >= smallest_length && revolution.angle <= largest)) {
    reject("angle", text::format("must be above 0 and at most a whole turn, which is 2 pi (it is "
                                 "{})",
                                 revolution.angle)
                        .c_str());
  }
  const Profile& profile = *revolution.profile;
  const Profile::Piece* piece = profile.pieces().data();
  for (std::size_t i = 0; i < profile.contours().size(); ++i) {
    const Contour& contour = profile.contours()[i];
    const std::vector<std::size_t> corners = corners_of(contour).kept;
    for (const std::size_t corner : corners) check_corner(contour[corner], {i, corner});
    for (std::size_t k = 0; k < corners.size(); ++k)
      check_piece(profile, *piece++, {i, corners[(k + 1) % corners.size()]});
  }
}

std::unique_ptr<const Shape> make_shape(const Revolution& revolution) {
  return std::make_unique<RevolutionShape>(revolution);
}

}  // namespace crt::core
