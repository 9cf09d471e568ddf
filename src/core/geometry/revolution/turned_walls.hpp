// The walls that a line crosses, and the ends of a turn that is not whole, become the crossings of
// a revolution in both tiers.
//
// Each wall is a part of the boundary of a body, which is another primitive: of a plane, a cone, a
// cylinder, a sphere or a torus. So where a line crosses it is known from there, to the same bits.
// Whether it is in the part of the wall follows from its height and its distance from the axis.
// Where rounding leaves that open, or where a line passes a corner, the walls beside are decided
// without rounding (exact_walls.hpp), and all of them if it then seems to cross an odd number.
#pragma once

#include <cmath>

#include "core/geometry/exact_ray.hpp"
#include "core/geometry/profile/wall_faces.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

/// Bodies are numbered like the faces they make: first the ends, then one for each wall.
constexpr std::uint32_t body_of_face(std::uint32_t face) {
  return face < end_count ? face : end_count + wall_of_face(face);
}

/// Returns the distance from the axis of an arc's center, which is negative beyond it. It is 0 for
/// a center that is on the axis to 2^-48 of the radius: such an arc makes a part of a sphere.
inline double ring_of(const Profile::Arc& arc) {
  constexpr double nearly = 0x1p-48;
  return std::abs(arc.center.x) <= nearly * arc.radius ? 0 : arc.center.x;
}

/// A TurnedProfile is what the tiers have in common.
struct TurnedProfile {
  std::shared_ptr<const Profile> profile;
  /// These are the normals of the ends, whose planes pass through the axis. They point out of the
  /// solid. The ends are in one plane if the angle is half a turn. A whole turn has none.
  std::array<Vec3, end_count> normals{Vec3(-1, 0, 0), Vec3(-1, 0, 0)};
  std::uint32_t planes = 0;
  bool is_union = false;  ///< the angle is more than half a turn

  explicit TurnedProfile(const Revolution& revolution);

  /// Returns a body, whose face 0 is what the wall is a part of. What is no boundary has any body:
  /// a wall along the axis, and an end that is not there.
  Primitive body(std::uint32_t number) const;
  std::uint32_t body_count() const { return end_count + profile->wall_count(); }
  /// Returns the body that has the surface of a face: that of the first wall on it.
  std::uint32_t body_of_surface(std::uint32_t face) const;
  /// Returns the largest of its sizes.
  double size() const;
  Bounds bounds() const;

  /// Returns the start of a ray as a body has it. It is none if the ray starts elsewhere.
  FaceStart start_on(std::uint32_t body, const FaceStart& start) const;
  static bool is_on_axis(const Profile::Piece& piece) {
    return piece.from.x == 0 && piece.to.x == 0;
  }

 private:
  std::uint32_t plane_of_end(std::uint32_t end) const { return end < planes ? end : 0; }

  double angle_ = 0;
};

/// A RevolutionTier is what the tiers do differently.
class RevolutionTier {
 public:
  RevolutionTier() = default;
  RevolutionTier(const RevolutionTier&) = delete;
  RevolutionTier& operator=(const RevolutionTier&) = delete;
  virtual ~RevolutionTier() = default;

  /// Appends where the line crosses a body, as Shape::crossings() does.
  virtual bool meet(std::uint32_t body, const FaceStart& start, CrossingList& out) const = 0;
  /// Returns the sign of the first t less the second, and 0 if they are equal.
  virtual int order(const Crossing& first, const Crossing& second) const = 0;
  /// Returns the line as the tier has it, without rounding.
  virtual ExactLine exact() const = 0;
  /// Gives a crossing a t that is known to about 100 bits.
  virtual void place(const DoubleDouble& t, Crossing& crossing) const = 0;
};

/// Appends the crossings of a line with a revolution, as Shape::crossings() does.
void append_crossings(const TurnedProfile& turned, const ObjectRay& ray, const RevolutionTier& tier,
                      CrossingList& out);

}  // namespace crt::core
