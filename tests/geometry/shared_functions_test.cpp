// Faces on one surface, also those of different solids, have one function for whole boxes: by
// surfaces CSG tells faces that coincide.
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <variant>
#include <vector>

#include "core/compile/surface_table.hpp"
#include "core/geometry/face_functions.hpp"
#include "core/geometry/placement.hpp"
#include "geometry/face_tools.hpp"
#include "geometry/random_instances.hpp"

using namespace crt;
using namespace crt::test;
using core::FaceFunctions;
using core::Interval;
using core::PointOf;

namespace {

/// A KeyedFace is a face with its surface in the form in which surfaces are compared.
struct KeyedFace {
  std::size_t solid;
  std::uint32_t face;
  core::CanonicalSurface surface;
};

/// Requires that the functions of faces on one surface have the same sign at random points, or the
/// opposite one if just one of them is flipped. Returns how many pairs of faces are of two solids.
int check_shared_surfaces(const std::vector<Primitive>& primitives, Random& random) {
  std::vector<std::unique_ptr<const core::Shape>> shapes;
  std::vector<std::unique_ptr<const FaceFunctions>> functions;
  std::vector<KeyedFace> faces;
  for (const Primitive& primitive : primitives) {
    shapes.push_back(core::make_shape(primitive));
    functions.push_back(shapes.back()->face_functions());
    if (functions.back() == nullptr || std::holds_alternative<Custom>(primitive)) continue;
    for (std::uint32_t face = 0; face < std::min(shapes.back()->face_count(), 60U); ++face) {
      faces.push_back({shapes.size() - 1, face,
                       core::canonical_surface(shapes.back()->surface(face), core::Placement{})});
    }
  }
  int shared = 0;
  for (const KeyedFace& a : faces) {
    for (const KeyedFace& b : faces) {
      if (&a == &b || a.surface.key != b.surface.key) continue;
      if (a.solid != b.solid) ++shared;
      for (int i = 0; i < 10; ++i) {
        const PointOf<Interval> point = core::known_point(2.0 * random.in_cube());
        const Interval of_a = functions[a.solid]->value(a.face, point);
        const Interval of_b = functions[b.solid]->value(b.face, point);
        if (of_a.contains(0) || of_b.contains(0)) continue;
        REQUIRE(((of_a.lo > 0) == (of_b.lo > 0)) == (a.surface.flipped == b.surface.flipped));
      }
    }
  }
  return shared;
}

}  // namespace

TEST_CASE("all solids: functions of faces on one surface are one function") {
  for_instances(60, [](const Primitive& primitive, const core::Shape&, Random& random) {
    check_shared_surfaces({primitive}, random);
  });
}

TEST_CASE("solids of different kinds have one function for a surface that they share") {
  Random random(1);
  const auto disc = profile_of({{0.75, 0.25, 1}, {-0.25, 0.25, 1}});
  const auto half_disc = profile_of({{0, -1}, {0, 1, 1}, {0, -1}});
  const auto ring = profile_of({{1.25, 0, 1}, {0.75, 0, 1}});
  const auto triangle = profile_of({{0, 0}, {1, 0}, {0, 2}});
  const auto downwards = profile_of({{0, 2}, {1, 0}, {0, 0}});
  const auto square = profile_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const std::vector<Primitive> pairs[] = {
      {Sphere{.center = {0, 0, 1}, .radius = 0.5},
       Capsule{.from = {0, 0, 1}, .to = {1, 1, 0}, .radius = 0.5}},
      {Cylinder{.from = {0, 0, 1}, .to = {1, 1, 0}, .radius = 0.5},
       Capsule{.from = {0, 0, 1}, .to = {1, 1, 0}, .radius = 0.5}},
      {Cylinder{.from = {0.25, 0.25, 0}, .to = {0.25, 0.25, 1}, .radius = 0.5},
       Extrusion{.profile = disc, .from = 0, .to = 1}},
      {Sphere{.center = {0, 0, 0}, .radius = 1}, Revolution{.profile = half_disc}},
      {Torus{.center = {0, 0, 0}, .radius = 1, .thickness = 0.25}, Revolution{.profile = ring}},
      {Cone{.from = {0, 0, 0}, .to = {0, 2, 0}, .radius = 1, .radius2 = 0},
       Revolution{.profile = triangle}},
      {Revolution{.profile = downwards}, Revolution{.profile = triangle}},
      {Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}},
       Extrusion{.profile = square, .from = 0, .to = 1}},
      {Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}},
       RoundedBox{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}, .radius = 0.25}},
      {Plane{.normal = {1, 2, 0}, .position = {0, 1, 0}},
       Extrusion{.profile = profile_of({{0, 1}, {2, 0}, {2, 2}}), .from = 0, .to = 1}},
  };
  for (const std::vector<Primitive>& pair : pairs) {
    CAPTURE(pair[0].index());
    CAPTURE(pair[1].index());
    CHECK(check_shared_surfaces(pair, random) > 0);
  }
}
