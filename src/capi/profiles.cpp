// This file implements profiles of the C interface, and what is made of them.
#include "capi/structs.hpp"

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
    const auto made = crt::make_profile(profile->contours);
    *out = new crt_entity(crt::extruded(made, to_vec3(from, "from"), to_vec3(to, "to")));
  });
}

crt_status crt_revolution_create(const crt_profile* profile, const double from[3],
                                 const double to[3], double angle, crt_entity** out) {
  return guarded([&] {
    require(profile, "profile");
    require(out, "out");
    const auto made = crt::make_profile(profile->contours);
    *out = new crt_entity(crt::revolved(made, to_vec3(from, "from"), to_vec3(to, "to"), angle));
  });
}
