// Profiles are put together piece by piece, and drawn out to solids.
#include <array>
#include <cmath>
#include <vector>

#include "support.hpp"

using namespace crt::test;

namespace {

/// Returns the parameters at which a ray meets an entity that is alone in a scene.
std::vector<double> crossings(crt_entity* entity, const Numbers& origin, const Numbers& direction) {
  const SceneHandle scene = new_scene();
  REQUIRE(crt_scene_add_entity(scene.get(), entity) == CRT_OK);
  const PreparedHandle prepared = prepare(scene.get());
  const crt_ray ray = {
      {origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}, 0, infinity};
  std::array<crt_hit, 8> hits = {};
  std::size_t count = 0;
  REQUIRE(crt_crossings(prepared.get(), &ray, hits.data(), hits.size(), &count) == CRT_OK);
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(hits[i].t);
  return result;
}

EntityHandle extrusion(const crt_profile* profile, const Numbers& from, const Numbers& to) {
  return made<EntityHandle>(
      [&](crt_entity** out) { return crt_extrusion_create(profile, from.data(), to.data(), out); });
}

}  // namespace

TEST_CASE("a profile is drawn out along any axis, with x where angles about that begin") {
  const ProfileHandle profile = new_profile();
  CHECK(crt_profile_move_to(profile.get(), 0, 0) == CRT_OK);
  CHECK(crt_profile_line_to(profile.get(), 2, 0) == CRT_OK);
  CHECK(crt_profile_arc_to(profile.get(), 2, 1, 1) == CRT_OK);
  CHECK(crt_profile_line_to(profile.get(), 0, 1) == CRT_OK);
  using List = std::vector<double>;
  const EntityHandle upright = extrusion(profile.get(), {1, 0, 3}, {1, 0, 4});
  CHECK(crossings(upright.get(), {0, 0.5, 3.5}, {1, 0, 0}) == List{1, 3.5});
  CHECK(crossings(upright.get(), {2, 0.5, 0}, {0, 0, 1}) == List{3, 4});
  const EntityHandle along_x = extrusion(profile.get(), {0, 0, 0}, {2, 0, 0});
  CHECK(crossings(along_x.get(), {-1, -0.5, 1}, {1, 0, 0}) == List{1, 3});
  CHECK(crossings(along_x.get(), {1, -0.5, -1}, {0, 0, 1}) == List{1, 3.5});
  const EntityHandle turned = extrusion(profile.get(), {0, 0, 1}, {0, 0, -1});
  CHECK(crossings(turned.get(), {-1, -0.5, 0}, {1, 0, 0}) == List{1, 3.5});
}

TEST_CASE("a profile is turned about any axis, from where angles about that begin") {
  const ProfileHandle profile = new_profile();
  CHECK(crt_profile_move_to(profile.get(), 1, 0) == CRT_OK);
  CHECK(crt_profile_line_to(profile.get(), 2, 0) == CRT_OK);
  CHECK(crt_profile_line_to(profile.get(), 2, 1) == CRT_OK);
  CHECK(crt_profile_line_to(profile.get(), 1, 1) == CRT_OK);
  using List = std::vector<double>;
  const auto turned = [&](const Numbers& from, const Numbers& to, double angle) {
    return made<EntityHandle>([&](crt_entity** out) {
      return crt_revolution_create(profile.get(), from.data(), to.data(), angle, out);
    });
  };
  const double quarter = std::acos(0.0);
  const EntityHandle ring = turned({0, 3, 0}, {0, 8, 0}, 4 * quarter);
  CHECK(crossings(ring.get(), {-3, 3.5, 0}, {1, 0, 0}) == List{1, 2, 4, 5});
  CHECK(crossings(ring.get(), {1.5, 0, 0}, {0, 1, 0}) == List{3, 4});
  const EntityHandle along_z = turned({0, 0, 3}, {0, 0, 1}, 4 * quarter);
  CHECK(crossings(along_z.get(), {1.5, 0, 0}, {0, 0, 1}) == List{2, 3});
  const EntityHandle part = turned({0, 3, 0}, {0, 8, 0}, quarter);
  CHECK(crossings(part.get(), {-3, 3.5, 1.5}, {1, 0, 0}).size() == 2);
  CHECK(crossings(part.get(), {-3, 3.5, 1.5}, {1, 0, 0}).front() == 3);
  CHECK(crossings(part.get(), {-3, 3.5, -0.5}, {1, 0, 0}) == List{});
  crt_entity* entity = nullptr;
  const Numbers from = {0, 0, 0};
  const Numbers to = {0, 1, 0};
  CHECK(crt_revolution_create(profile.get(), from.data(), to.data(), 0, &entity) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("angle"));
  CHECK(crt_profile_line_to(profile.get(), -1, 1) == CRT_OK);
  CHECK(crt_revolution_create(profile.get(), from.data(), to.data(), 1, &entity) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("corner 4 of contour 0"));
}

TEST_CASE("entities keep a profile as it was when they were made") {
  const ProfileHandle profile = new_profile();
  CHECK(crt_profile_move_to(profile.get(), 1, 0) == CRT_OK);
  CHECK(crt_profile_arc_to(profile.get(), -1, 0, 1) == CRT_OK);
  CHECK(crt_profile_arc_to(profile.get(), 1, 0, 1) == CRT_OK);
  const EntityHandle whole = extrusion(profile.get(), {0, 0, 0}, {0, 0, 1});
  CHECK(crt_profile_move_to(profile.get(), 0.5, 0) == CRT_OK);
  CHECK(crt_profile_arc_to(profile.get(), -0.5, 0, 1) == CRT_OK);
  CHECK(crt_profile_arc_to(profile.get(), 0.5, 0, 1) == CRT_OK);
  const EntityHandle pipe = extrusion(profile.get(), {0, 0, 0}, {0, 0, 1});
  CHECK(crossings(whole.get(), {-2, 0, 0.5}, {1, 0, 0}).size() == 2);
  CHECK(crossings(pipe.get(), {-2, 0, 0.5}, {1, 0, 0}).size() == 4);
}

TEST_CASE("an error of a profile says where it is") {
  const ProfileHandle profile = new_profile();
  crt_entity* entity = nullptr;
  const Numbers from = {0, 0, 0};
  const Numbers to = {0, 0, 1};
  const auto fails = [&](const char* text) {
    CHECK(crt_extrusion_create(profile.get(), from.data(), to.data(), &entity) ==
          CRT_ERROR_INVALID_ARGUMENT);
    INFO(message());
    CHECK(says(text));
  };
  CHECK(crt_profile_line_to(profile.get(), 1, 0) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("crt_profile_move_to"));
  fails("must have a contour");
  CHECK(crt_profile_move_to(profile.get(), 0, 0) == CRT_OK);
  CHECK(crt_profile_line_to(profile.get(), 1, 0) == CRT_OK);
  fails("contour 0 must enclose an area");
  CHECK(crt_profile_line_to(profile.get(), 1, std::nan("")) == CRT_OK);
  fails("corner 2 of contour 0");
}
