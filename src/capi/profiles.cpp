// This file implements profiles of the C interface, and what is made of them.
#include "capi/structs.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/checks.hpp"
#include "core/math/direction_and_length.hpp"

namespace crt::capi {

namespace {

crt_status add_piece(crt_profile* profile, const ProfilePoint& corner) {
  return guarded([&] {
    require(profile, "profile");
    if (profile->contours.empty()) {
      reject("profile", "must have the begin of a contour first: call crt_profile_move_to");
    }
    profile->contours.back().push_back(corner);
  });
}

/// Makes an extrusion along z, and puts it where it is wanted.
Entity to_extrusion(const crt_profile& profile, const Vec3& from, const Vec3& to) {
  core::check_coordinates("from", from);
  core::check_coordinates("to", to);
  core::check_end("to", from, to);
  const core::AxisFrame frame = core::frame_about(to - from);
  Extrusion extrusion{.profile = make_profile(profile.contours)};
  if (frame.along == Vec3(0, 0, 1)) {
    extrusion.from = from.z;
    extrusion.to = to.z;
    const Entity upright(extrusion);
    if (from.x == 0 && from.y == 0) return upright;
    return upright.transformed({.translation = {from.x, from.y, 0}});
  }
  extrusion.from = 0;
  extrusion.to = core::direction_and_length(to - from).length;
  const auto& [x, y, z] = frame;
  return Entity(extrusion).transformed({.row_x = {x.x, y.x, z.x},
                                        .row_y = {x.y, y.y, z.y},
                                        .row_z = {x.z, y.z, z.z},
                                        .translation = from});
}

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_profile_create(crt_profile** out) {
  return guarded([&] {
    require(out, "out");
    *out = new crt_profile;
  });
}

crt_status crt_profile_move_to(crt_profile* profile, double x, double y) {
  return guarded([&] {
    require(profile, "profile");
    profile->contours.push_back({{.x = x, .y = y}});
  });
}

crt_status crt_profile_line_to(crt_profile* profile, double x, double y) {
  return add_piece(profile, {.x = x, .y = y});
}

crt_status crt_profile_arc_to(crt_profile* profile, double x, double y, double bulge) {
  return add_piece(profile, {.x = x, .y = y, .bulge = bulge});
}

crt_status crt_extrusion_create(const crt_profile* profile, const double from[3],
                                const double to[3], crt_entity** out) {
  return guarded([&] {
    require(profile, "profile");
    require(out, "out");
    *out = new crt_entity(to_extrusion(*profile, to_vec3(from, "from"), to_vec3(to, "to")));
  });
}
