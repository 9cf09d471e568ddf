// Boxes show which leaves of a CSG object a ray can leave out.
#include <doctest/doctest.h>

#include "core/compile/compile.hpp"

using namespace crt;
using namespace crt::core;

namespace {

std::vector<Bounds> boxes_of_leaves(const Entity& entity) {
  std::vector<Bounds> boxes;
  for (const Leaf& leaf : compile(std::span(&entity, 1)).leaves) boxes.push_back(leaf.bounds);
  return boxes;
}

bool within(const Bounds& inner, const Bounds& outer) {
  constexpr double rounding = 1e-12;
  for (int axis = 0; axis < 3; ++axis) {
    if (inner.lower[axis] < outer.lower[axis] - rounding) return false;
    if (inner.upper[axis] > outer.upper[axis] + rounding) return false;
  }
  return true;
}

const Entity plate = Box{.corner_a = {-5, 0, -5}, .corner_b = {5, 1, 5}};
const Bounds plate_box{{-5, 0, -5}, {5, 1, 5}};
const Entity slope = Plane{.normal = {1, 1, 0}, .position = {2, 0, 0}};

}  // namespace

TEST_CASE("what only shapes a cutter matters only where the cutter is") {
  const Entity cutter = Box{.corner_a = {1, 0.5, 1}, .corner_b = {2, 0.75, 2}};
  const Bounds cutter_box{{1, 0.5, 1}, {2, 0.75, 2}};

  const auto boxes = boxes_of_leaves(plate - (cutter ^ slope));
  REQUIRE(boxes.size() == 3);
  CHECK_FALSE(within(boxes[0], cutter_box));
  CHECK(within(plate_box, boxes[0]));
  CHECK(within(boxes[2], cutter_box));
  CHECK(within(cutter_box, boxes[2]));
}

TEST_CASE("a cutter matters only where there is something to cut") {
  const Entity drill = Cylinder{.from = {0, -9, 0}, .to = {0, 9, 0}, .radius = 0.5};
  const auto boxes = boxes_of_leaves(plate - drill);
  CHECK(within(boxes[1], {{-0.5, 0, -0.5}, {0.5, 1, 0.5}}));
}

TEST_CASE("the parts of a union matter all over") {
  const Entity sphere = Sphere{.center = {0, 1, 0}, .radius = 2};
  const auto boxes = boxes_of_leaves(plate + sphere);
  CHECK(within(plate_box, boxes[0]));
  CHECK(within({{-2, -1, -2}, {2, 3, 2}}, boxes[1]));

  // A union that is endless, cut from a plate, makes all of the plate matter, but no more.
  const auto cut = boxes_of_leaves(plate - (sphere + slope));
  CHECK(within(cut[2], plate_box));
  CHECK(within(plate_box, cut[2]));
}

TEST_CASE("parts that have nothing in common matter nowhere") {
  const Entity far_away = Sphere{.center = {100, 0, 0}, .radius = 1};
  for (const Bounds& box : boxes_of_leaves(plate - (far_away ^ Sphere{}))) {
    if (!within(plate_box, box)) CHECK(box.empty());
  }
  CHECK(compile(std::vector<Entity>{plate ^ far_away}).objects.empty());
}
