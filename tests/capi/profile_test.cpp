// Profiles are put together piece by piece, and drawn out to solids.
#include <array>
#include <cmath>
#include <string>
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

TEST_CASE("curves and SVG paths become contours, whose corners can be read") {
  const ProfileHandle profile = new_profile();
  CHECK(crt_profile_move_to(profile.get(), 0, 0) == CRT_OK);
  CHECK(crt_profile_cubic_to(profile.get(), 0, 1, 1, 1, 1, 0, 1e-3) == CRT_OK);
  CHECK(crt_profile_quadratic_to(profile.get(), 1, -1, 0, 0, 0) == CRT_OK);
  const std::string path = "M10 0A1 1 0 0 1 12 0z M20 0h1v1z";
  CHECK(crt_profile_svg_path(profile.get(), path.data(), path.size(), CRT_FILL_NONZERO, 0) ==
        CRT_OK);
  std::size_t count = 0;
  CHECK(crt_profile_contour_count(profile.get(), &count) == CRT_OK);
  CHECK(count == 3);
  std::array<double, 9> corners = {};
  CHECK(crt_profile_contour(profile.get(), 2, corners.data(), 3, &count) == CRT_OK);
  CHECK(count == 3);
  CHECK(corners == std::array<double, 9>{20, 0, 0, 21, 0, 0, 21, -1, 0});
  corners = {};
  CHECK(crt_profile_contour(profile.get(), 1, corners.data(), 1, &count) == CRT_OK);
  CHECK(count == 2);
  CHECK(corners == std::array<double, 9>{10, 0, 0});
  CHECK(crt_profile_contour(profile.get(), 0, nullptr, 0, &count) == CRT_OK);
  CHECK(count > 6);
  const EntityHandle entity = extrusion(profile.get(), {0, 0, 0}, {0, 0, 1});
  // The cubic's highest point is at 3/4.
  CHECK(crossings(entity.get(), {0.5, 2, 0.5}, {0, -1, 0})[0] ==
        doctest::Approx(1.25).epsilon(2e-3));
  CHECK(crossings(entity.get(), {11, -1, 0.5}, {0, 1, 0}) == std::vector<double>{1, 2});
}

TEST_CASE("a profile grows and shrinks by an offset") {
  const ProfileHandle profile = new_profile();
  CHECK(crt_profile_svg_path(profile.get(), "M0 0h4v4h-4z", 12, CRT_FILL_NONZERO, 0) == CRT_OK);
  CHECK(crt_profile_offset(profile.get(), 1) == CRT_OK);
  const EntityHandle entity = extrusion(profile.get(), {0, 0, 0}, {0, 0, 1});
  CHECK(crossings(entity.get(), {-3, -2, 0.5}, {1, 0, 0}) == std::vector<double>{2, 8});
  CHECK(crt_profile_line_to(profile.get(), 1, 1) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_profile_offset(profile.get(), not_a_number) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("distance"));
  CHECK(crt_profile_offset(nullptr, 1) == CRT_ERROR_INVALID_ARGUMENT);
  std::size_t count = 9;
  CHECK(crt_profile_contour_count(profile.get(), &count) == CRT_OK);
  CHECK(count == 1);
  CHECK(crt_profile_offset(profile.get(), -4) == CRT_OK);
  CHECK(crt_profile_contour_count(profile.get(), &count) == CRT_OK);
  CHECK(count == 0);
}

TEST_CASE("a wrong curve or path changes nothing, and says why") {
  const ProfileHandle profile = new_profile();
  const auto refuses = [](crt_status status, const char* text) {
    CHECK(status == CRT_ERROR_INVALID_ARGUMENT);
    INFO(message());
    CHECK(says(text));
  };
  std::size_t count = 0;
  double corner[3];
  refuses(crt_profile_cubic_to(nullptr, 0, 0, 1, 0, 1, 1, 0), "profile");
  refuses(crt_profile_quadratic_to(nullptr, 0, 0, 1, 1, 0), "profile");
  refuses(crt_profile_cubic_to(profile.get(), 0, 0, 1, 0, 1, 1, 0), "crt_profile_move_to");
  CHECK(crt_profile_move_to(profile.get(), 0, 0) == CRT_OK);
  refuses(crt_profile_cubic_to(profile.get(), 0, infinity, 1, 0, 1, 1, 0), "control1");
  refuses(crt_profile_quadratic_to(profile.get(), 0, not_a_number, 1, 1, 0), "control");
  refuses(crt_profile_quadratic_to(profile.get(), 0, 1, 1, 1, -1), "deviation");
  refuses(crt_profile_svg_path(nullptr, "", 0, 0, 0), "profile");
  refuses(crt_profile_svg_path(profile.get(), nullptr, 1, 0, 0), "path");
  refuses(crt_profile_svg_path(profile.get(), "M0 0h1v1", 8, 2, 0), "fill");
  refuses(crt_profile_svg_path(profile.get(), "M0 0h1v1", 8, -1, 0), "fill");
  refuses(crt_profile_svg_path(profile.get(), "M0 0h1x1", 8, 0, 0), "character 7");
  refuses(crt_profile_contour_count(nullptr, &count), "profile");
  refuses(crt_profile_contour_count(profile.get(), nullptr), "count");
  refuses(crt_profile_contour(nullptr, 0, corner, 1, &count), "profile");
  refuses(crt_profile_contour(profile.get(), 0, nullptr, 1, &count), "corners");
  refuses(crt_profile_contour(profile.get(), 0, corner, 1, nullptr), "count");
  refuses(crt_profile_contour(profile.get(), 1, corner, 1, &count), "index");
  CHECK(crt_profile_contour_count(profile.get(), &count) == CRT_OK);
  CHECK(count == 1);
  CHECK(crt_profile_svg_path(profile.get(), "M0 0h1v1", 8, CRT_FILL_EVEN_ODD, 0) == CRT_OK);
  refuses(crt_profile_line_to(profile.get(), 1, 1), "crt_profile_move_to");
}

TEST_CASE("text becomes contours, with a font of one's own or the library's") {
  const ProfileHandle profile = new_profile();
  std::size_t missing = 9;
  const std::string text = "IL\xe6\xbc\xa2";
  const auto add = [&](const char* font, double size, std::int32_t alignment, double spacing) {
    return crt_profile_text(profile.get(), text.data(), text.size(), font, size, alignment, spacing,
                            0, &missing);
  };
  CHECK(add(nullptr, 1, CRT_TEXT_CENTER, 1) == CRT_OK);
  CHECK(missing == 1);
  std::size_t count = 0;
  CHECK(crt_profile_contour_count(profile.get(), &count) == CRT_OK);
  CHECK(count == 4);  // a box has two
  CHECK(crt_profile_line_to(profile.get(), 1, 1) == CRT_ERROR_INVALID_ARGUMENT);
  const std::string file = std::string(CRT_SOURCE_DIR) + "/share/fonts/LiberationSans-Regular.ttf";
  CHECK(add(file.c_str(), 1, CRT_TEXT_LEFT, 1) == CRT_OK);
  CHECK(crt_profile_contour_count(profile.get(), &count) == CRT_OK);
  CHECK(count == 8);
  CHECK(add("no such.ttf", 1, 0, 1) == CRT_ERROR_IO);
  CHECK(says("no such.ttf"));
  CHECK(add(nullptr, 0, 0, 1) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("size"));
  CHECK(add(nullptr, 1, 3, 1) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("alignment"));
  CHECK(add(nullptr, 1, 0, infinity) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("line_spacing"));
  CHECK(crt_profile_text(nullptr, "", 0, nullptr, 1, 0, 1, 0, nullptr) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_profile_text(profile.get(), nullptr, 1, nullptr, 1, 0, 1, 0, nullptr) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_profile_text(profile.get(), "", 0, nullptr, 1, 0, 1, 0, nullptr) == CRT_OK);
}
