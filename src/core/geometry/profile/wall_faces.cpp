#include "core/geometry/profile/wall_faces.hpp"

namespace crt::core {

bool are_on_one_surface(const Profile& profile, std::uint32_t a, std::uint32_t b) {
  if (a < end_count || b < end_count) return a == b;
  const Profile::Wall first = profile.wall(wall_of_face(a));
  const Profile::Wall second = profile.wall(wall_of_face(b));
  if (first.arc == invalid_index || second.arc == invalid_index) {
    return first.arc == second.arc &&
           profile.pieces()[first.piece].first == profile.pieces()[second.piece].first;
  }
  return profile.arcs()[first.arc].first == profile.arcs()[second.arc].first;
}

}  // namespace crt::core
