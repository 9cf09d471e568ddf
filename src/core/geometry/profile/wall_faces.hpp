// Solids that are made of a profile number their faces by its walls.
#pragma once

#include "core/geometry/profile/profile.hpp"

namespace crt::core {

/// Faces 0 and 1 are the flat ends. Each wall has two faces: one whose normal points to the right
/// of its direction, or away from what is round, and the same turned round.
inline constexpr std::uint32_t end_count = 2;
constexpr std::uint32_t face_of_wall(std::uint32_t wall, bool turned) {
  return end_count + 2 * wall + (turned ? 1 : 0);
}
constexpr std::uint32_t wall_of_face(std::uint32_t face) {
  return (face - end_count) / 2;
}
constexpr bool is_turned(std::uint32_t face) {
  return face % 2 != 0;
}

/// Returns whether two faces are pieces of one surface.
bool are_on_one_surface(const Profile& profile, std::uint32_t a, std::uint32_t b);

}  // namespace crt::core
