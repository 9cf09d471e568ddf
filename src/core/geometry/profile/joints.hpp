// A joint is where a piece of a profile ends and the next begins. Solids that are made of a profile
// have a function for each: it is below 0 before the joint. So where pieces go on without a corner
// it says which of them bounds the region.
#pragma once

#include "core/geometry/face_functions.hpp"
#include "core/geometry/profile/wall_faces.hpp"

namespace crt::core {

/// Joints have the numbers of the pieces that end there. Their functions are numbered after the
/// faces of walls.
inline std::uint32_t face_of_joint(const Profile& profile, std::uint32_t joint) {
  return face_of_wall(profile.wall_count(), false) + joint;
}
inline bool is_joint(const Profile& profile, std::uint32_t face) {
  return face >= face_of_joint(profile, 0);
}
inline std::uint32_t joint_of_face(const Profile& profile, std::uint32_t face) {
  return face - face_of_joint(profile, 0);
}

/// A Joint has unit vectors along the end of a piece, along the beginning of the next, and along
/// both, rounded.
struct Joint {
  Vec3 place{0, 0, 0};
  Vec3 before{0, 0, 0};
  Vec3 after{0, 0, 0};
  Vec3 along{0, 0, 0};
};

/// Returns the piece after one in its contour, or before it.
std::uint32_t piece_after(const Profile& profile, std::uint32_t piece);
std::uint32_t piece_before(const Profile& profile, std::uint32_t piece);

/// Returns the joint between two pieces that follow one another.
Joint joint_of(const Profile& profile, std::uint32_t piece, std::uint32_t next);
/// Returns that at the end of a piece.
Joint joint_of(const Profile& profile, std::uint32_t piece);

}  // namespace crt::core
