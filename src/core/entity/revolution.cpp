#include "core/entity/placed.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/checks.hpp"
#include "crt/entity.hpp"

namespace crt {

Entity revolved(const std::shared_ptr<const Profile>& profile, const Vec3& from, const Vec3& to,
                double angle) {
  core::check_coordinates("from", from);
  core::check_coordinates("to", to);
  core::check_end("to", from, to);
  Entity upright = Revolution{.profile = profile, .angle = angle};
  const auto& [zero, quarter, along] = core::frame_about(to - from);
  if (along == Vec3(0, 1, 0) && from == Vec3(0)) return upright;
  return core::placed(upright, quarter, along, zero, from);
}

}  // namespace crt
