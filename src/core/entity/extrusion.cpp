#include "core/entity/placed.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/checks.hpp"
#include "core/math/direction_and_length.hpp"
#include "crt/entity.hpp"

namespace crt {

Entity extruded(const std::shared_ptr<const Profile>& profile, const Vec3& from, const Vec3& to) {
  core::check_coordinates("from", from);
  core::check_coordinates("to", to);
  core::check_end("to", from, to);
  const auto& [x, y, z] = core::frame_about(to - from);
  if (z == Vec3(0, 0, 1)) {
    Entity upright = Extrusion{.profile = profile, .from = from.z, .to = to.z};
    if (from.x == 0 && from.y == 0) return upright;
    return upright.transformed({.translation = {from.x, from.y, 0}});
  }
  const double length = core::direction_and_length(to - from).length;
  return core::placed(Extrusion{.profile = profile, .from = 0, .to = length}, x, y, z, from);
}

}  // namespace crt
