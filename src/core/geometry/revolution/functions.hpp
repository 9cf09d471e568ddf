// The functions of a revolution's faces, for questions about boxes (face_functions.hpp). They are
// those of the bodies, in the distance from the axis or in its square.
#pragma once

#include "core/geometry/profile/joints.hpp"
#include "core/geometry/profile/near_walls.hpp"
#include "core/geometry/revolution/turned_walls.hpp"

namespace crt::core {

class RevolutionFunctions {
 public:
  explicit RevolutionFunctions(const TurnedProfile& turned);

  int max_crossings(std::uint32_t face) const;
  bool is_surface(std::uint32_t face) const { return !is_joint(*turned_.profile, face); }
  void look(const PointOf<Interval>& box, NearFaces& near) const;
  template <class Number>
  Number value(std::uint32_t face, const PointOf<Number>& point) const {
    if (face < end_count) return component_along(point, ends_[face]);
    if (is_joint(*turned_.profile, face)) return value_of_joint(face, point);
    const Number outwards = value_of_wall(turned_.profile->wall(wall_of_face(face)), point);
    return is_turned(face) ? -outwards : outwards;
  }

 private:
  template <class Number>
  Number value_of_joint(std::uint32_t face, const PointOf<Number>& point) const {
    const Joint joint = joint_of(*turned_.profile, joint_of_face(*turned_.profile, face));
    const Number squared_distance = square(point[0]) + square(point[2]);
    const Interval place = Interval::of(joint.place.x);
    const Number height = point[1] - Interval::of(joint.place.y);
    if (joint.along.x == 0) return height * Interval::of(joint.along.y);
    if (joint.along.y == 0) return (squared_distance - square(place)) * Interval::of(joint.along.x);
    return (root(squared_distance) - place) * Interval::of(joint.along.x) +
           height * Interval::of(joint.along.y);
  }
  template <class Number>
  Number value_of_wall(const Profile::Wall& wall, const PointOf<Number>& point) const {
    const Number squared_distance = square(point[0]) + square(point[2]);
    if (wall.arc != invalid_index) {
      const Profile::Arc& arc = turned_.profile->arcs()[wall.arc];
      const Interval ring = Interval::of(ring_of(arc));
      const Number across =
          ring_of(arc) == 0 ? squared_distance : square(root(squared_distance) - ring);
      return across + square(point[1] - Interval::of(arc.center.y)) -
             square(Interval::of(arc.radius));
    }
    const Profile::Piece& piece = turned_.profile->pieces()[wall.piece];
    if (TurnedProfile::is_on_axis(piece)) return component_along(point, ends_[0]);
    const Number height = point[1] - Interval::of(piece.from.y);
    if (piece.from.y == piece.to.y) return height;
    // A cone has both nappes: the square of the distance from the axis less that of its radius.
    const PointOf<Interval> along = way_along(piece);
    return squared_distance * square(along[1]) -
           square(height * along[0] + Interval::of(piece.from.x) * along[1]);
  }

  void look_between_ends(const PointOf<Interval>& box, NearFaces& near) const;
  /// Turns the faces of walls as bodies have them. Says that no more is known if a rectangle of the
  /// profile's plane may have a point of the second nappe of a cone.
  void take_walls_of_bodies(const PointOf<Interval>& rectangle, NearFaces& near) const;

  TurnedProfile turned_;
  std::array<PointOf<Interval>, end_count> ends_;
  double moved_ = 0;  ///< no arc's center has been moved onto the axis by more
};

}  // namespace crt::core
