// What solids say of boxes at edges, between walls that are close to each other, and where
// functions mislead.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "core/geometry/shape.hpp"
#include "core/math/vector.hpp"
#include "crt/field.hpp"
#include "geometry/face_tools.hpp"
#include "geometry/random.hpp"

using namespace crt;
using namespace crt::test;
using core::Interval;
using core::NearFaces;

TEST_CASE("an edge is known as where both or any of its faces have the solid behind them") {
  // An L, whose inner corner is at (1, 1).
  const auto profile = profile_of({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  const auto shape = core::make_shape(Extrusion{.profile = profile, .from = 0, .to = 1});
  const auto functions = shape->face_functions();
  const auto look = [&](double x, double y, double z) {
    NearFaces near;
    functions->look(box_about({x, y, z}, Vec3(0.125)), near);
    std::sort(near.faces.begin(), near.faces.end());
    return near;
  };
  using enum NearFaces::Kind;
  CHECK(look(1.01, 1.01, 0.5).kind == where_any_negative);
  CHECK(look(1.01, 1.01, 0.5).faces == std::vector<std::uint32_t>{6, 8});
  CHECK(look(1.99, 0.99, 0.5).kind == where_all_negative);
  CHECK(look(1.99, 0.99, 0.5).faces == std::vector<std::uint32_t>{4, 6});
  CHECK(look(1.99, 0.99, 0.99).faces == std::vector<std::uint32_t>{1, 4, 6});
  CHECK(look(1.01, 1.01, 0.99).kind == by_signs);
  CHECK(look(0.5, 0.5, 0.5).kind == inside);
  CHECK(look(1.5, 1.5, 0.5).kind == outside);
  // The plane of a wall goes on within the solid, where there is no wall.
  CHECK(look(0.5, 1.01, 0.5).kind == inside);
}

TEST_CASE("a thin plate and a thin pipe are known between their walls") {
  const auto plate = profile_of({{0, 0}, {2, 0.25}, {2, 0.375}, {0, 0.125}});
  const Contour outer = {{1, 0, 1}, {-1, 0, 1}};
  const Contour inner = {{0.875, 0, 1}, {-0.875, 0, 1}};
  const auto pipe = make_profile(std::vector<Contour>{outer, inner});
  const auto look = [&](const std::shared_ptr<const Profile>& profile, const Vec3& middle) {
    const auto shape = core::make_shape(Extrusion{.profile = profile, .from = 0, .to = 1});
    NearFaces near;
    shape->face_functions()->look(box_about(middle, Vec3(0.2)), near);
    return near;
  };
  for (const NearFaces& near : {look(plate, {1, 0.1875, 0.5}), look(pipe, {0, 0.9375, 0.5}),
                                look(pipe, {0.9375, 0, 0.5})}) {
    CHECK(near.kind == NearFaces::Kind::where_all_negative);
    CHECK(near.faces.size() == 2);
  }
}

TEST_CASE(
    "nothing is said of a field where it may have no value, and where it has none it is empty") {
  const auto shape = core::make_shape(Implicit{.field = sqrt(Field::x()) - 1});
  const auto functions = shape->face_functions();
  const auto kind_at = [&](double x) {
    NearFaces near;
    functions->look(box_about({x, 0, 0}, Vec3(0.125)), near);
    return near.kind;
  };
  CHECK(kind_at(-0.5) == NearFaces::Kind::outside);
  CHECK(kind_at(0) == NearFaces::Kind::unknown);
  CHECK(kind_at(0.5) == NearFaces::Kind::inside);
  CHECK(functions->value(0, core::known_point({0.25, 0, 0})).contains(-0.5));
  const auto at_zero = box_about({0, 0, 0}, Vec3(0.125));
  CHECK(functions->value(0, at_zero).magnitude() == core::infinity);
  CHECK(functions->value(0, as_jets(at_zero)).slope[1].magnitude() == core::infinity);
  const core::PointOf<Interval> endless = {Interval{0.25, core::infinity}, Interval{}, Interval{}};
  CHECK(functions->value(0, endless).hi == core::infinity);
}

TEST_CASE("the second nappe of a cone that is turned is not taken for a part of it") {
  // The function of the cone's side is below 0 beyond the apex, too, where there is nothing.
  const Contour cone = {{0, 0}, {1, 0}, {0, 1}};
  const Contour far_off = {{3, 0}, {4, 0}, {4, 3}, {3, 3}};
  const auto profile = make_profile(std::vector<Contour>{cone, far_off});
  const auto shape = core::make_shape(Revolution{.profile = profile});
  const auto functions = shape->face_functions();
  NearFaces near;
  functions->look({Interval{0.0625, 0.5}, Interval{0.5, 1.75}, Interval{-0.01, 0.01}}, near);
  CHECK(near.kind == NearFaces::Kind::unknown);
  CHECK(near.faces.size() == 1);
  functions->look({Interval{0.0625, 0.5}, Interval{0.5, 0.875}, Interval{-0.01, 0.01}}, near);
  CHECK(near.kind == NearFaces::Kind::where_all_negative);
  functions->look({Interval{0.0625, 0.5}, Interval{1, 1.75}, Interval{-0.01, 0.01}}, near);
  CHECK(near.kind != NearFaces::Kind::inside);
  CHECK(said_of(*functions, near, {0.0625, 1.5, 0}) != true);
}

TEST_CASE("where pieces of a profile go over into each other it is known which of them counts") {
  // A slot: two straight sides, and half circles that go on from them.
  const Contour slot = {{-2, -1, 1}, {2, -1}, {2, 1, 1}, {-2, 1}};
  const Contour ring = {{3, 0, 1}, {4, 0}, {4, 1, 1}, {3, 1}};
  const auto extruded =
      core::make_shape(Extrusion{.profile = make_profile(std::vector<Contour>{slot})});
  const auto turned =
      core::make_shape(Revolution{.profile = make_profile(std::vector<Contour>{ring})});
  struct Place {
    const core::Shape* shape;
    Vec3 joint;
  };
  const std::vector<Place> places = {{extruded.get(), {2, -1, 0.5}},
                                     {extruded.get(), {-2, 1, 0.5}},
                                     {turned.get(), {4, 0, 0}},
                                     {turned.get(), {3, 1, 0}}};
  Random random(4);
  for (const Place& place : places) {
    CAPTURE(place.joint.x);
    const auto functions = place.shape->face_functions();
    for (const double half : {0.05, 1e-3, 1e-6}) {
      CAPTURE(half);
      NearFaces near;
      const Vec3 middle = place.joint + 0.9 * half * Vec3(random.in_cube().x, 0.3, 0);
      functions->look(box_about(middle, Vec3(half)), near);
      REQUIRE(near.kind == NearFaces::Kind::by_signs);
      for (int i = 0; i < 200; ++i) {
        const Vec3 point = middle + half * random.in_cube();
        const double x = place.shape == turned.get() ? std::hypot(point.x, point.z) - 3.5 : point.x;
        const double y = place.shape == turned.get() ? 2 * point.y - 1 : point.y;
        const double scale = place.shape == turned.get() ? 2 : 1;
        const double straight = place.shape == turned.get() ? 1 : 2;
        const double along = std::max(std::abs(scale * x) - straight, 0.0);
        const std::optional<bool> said = said_of(*functions, near, point);
        const double off = std::hypot(along, y) - 1;
        if (std::abs(off) > 1e-12) CHECK(said == (off < 0));
      }
    }
  }
}

TEST_CASE("a corner is known however near it is to the side of a box") {
  const auto profile = profile_of({{1, 0}, {2, 0}, {2, 2.85}, {1.85, 3}, {1, 3}});
  const auto shape = core::make_shape(Revolution{.profile = profile});
  const auto functions = shape->face_functions();
  for (const double share : {0.5, 0.1, 1e-3, 1e-6}) {
    CAPTURE(share);
    NearFaces near;
    functions->look({Interval{1.99, 2 + 0.01 * share}, Interval{2.84, 2.85 + 0.01 * share},
                     Interval{-1e-9, 1e-9}},
                    near);
    CHECK(near.kind == NearFaces::Kind::where_all_negative);
    CHECK(near.faces.size() == 2);
  }
}
