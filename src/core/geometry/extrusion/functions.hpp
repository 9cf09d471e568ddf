// The functions of an extrusion's faces, for questions about boxes (face_functions.hpp).
#pragma once

#include <memory>

#include "core/geometry/face_functions.hpp"
#include "core/geometry/profile/joints.hpp"
#include "core/geometry/profile/near_walls.hpp"
#include "core/geometry/profile/wall_faces.hpp"

namespace crt::core {

struct ExtrusionFunctions {
  std::shared_ptr<const Profile> profile;
  double lower = 0;
  double upper = 1;

  int max_crossings(std::uint32_t face) const {
    if (is_joint(*profile, face)) return 1;
    return face >= end_count && profile->wall(wall_of_face(face)).arc != invalid_index ? 2 : 1;
  }
  bool is_surface(std::uint32_t face) const { return !is_joint(*profile, face); }
  void look(const PointOf<Interval>& box, NearFaces& near) const;
  template <class Number>
  Number value(std::uint32_t face, const PointOf<Number>& point) const {
    if (face == 0) return -(point[2] - Interval::of(lower));
    if (face == 1) return point[2] - Interval::of(upper);
    if (is_joint(*profile, face)) {
      const Joint joint = joint_of(*profile, joint_of_face(*profile, face));
      const auto [x, y, z] = relative_to(point, joint.place);
      return x * Interval::of(joint.along.x) + y * Interval::of(joint.along.y);
    }
    const Number outwards = value_of_wall(profile->wall(wall_of_face(face)), point);
    return is_turned(face) ? -outwards : outwards;
  }

 private:
  template <class Number>
  Number value_of_wall(const Profile::Wall& wall, const PointOf<Number>& point) const {
    if (wall.arc != invalid_index) {
      const Profile::Arc& arc = profile->arcs()[wall.arc];
      const auto [x, y, z] = relative_to(point, arc.center);
      return square(x) + square(y) - square(Interval::of(arc.radius));
    }
    const Profile::Piece& piece = profile->pieces()[wall.piece];
    const PointOf<Interval> along = way_along(piece);
    const auto [x, y, z] = relative_to(point, piece.from);
    return x * along[1] - y * along[0];
  }
};

}  // namespace crt::core
