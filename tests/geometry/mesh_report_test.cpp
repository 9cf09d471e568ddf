// What is said of meshes whose parts overlap, lie in one another or are repeated.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/geometry/mesh/triangles.hpp"
#include "crt/mesh.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/scene.hpp"
#include "crt/transform.hpp"
#include "geometry/cuboids.hpp"
#include "geometry/meshes.hpp"

using namespace crt;
using namespace crt::test;

TEST_CASE(
    "shells in others and shells that overlap are counted, and one of the places is reported") {
  const auto overlap = [](const TriangleList& list) { return report_of(list, {}); };
  const std::vector<Cuboid> apart = {{{0, 0, 0}, {1, 1, 1}, true}, {{2, 0, 0}, {3, 1, 1}, true}};
  CHECK(overlap(mesh_of(apart)).shells == 2);
  CHECK(overlap(mesh_of(apart)).overlapping_shells == 0);
  CHECK(overlap(mesh_of(apart)).warnings.empty());
  const std::vector<Cuboid> touching = {{{0, 0, 0}, {1, 2, 1}, true}, {{1, 1, 0}, {3, 3, 1}, true}};
  CHECK(overlap(mesh_of(touching)).overlapping_shells == 0);
  const std::vector<Cuboid> nested = {{{0, 0, 0}, {4, 4, 4}, true}, {{1, 1, 1}, {2, 2, 2}, true}};
  const MeshReport in_another = overlap(mesh_of(nested));
  CHECK(in_another.overlapping_shells == 1);
  CHECK(nested[1].holds(in_another.first_overlap));
  REQUIRE(in_another.warnings.size() == 1);
  CHECK(
      in_another.warnings[0].starts_with("1 of its 2 shells lie in others or overlap, the first"));
  CHECK(in_another.warnings[0].ends_with("by 'evenodd' what two of them share is hollow"));
  const std::vector<Cuboid> hollow = {{{0, 0, 0}, {4, 4, 4}, true}, {{1, 1, 1}, {2, 2, 2}, false}};
  CHECK(overlap(mesh_of(hollow)).overlapping_shells == 0);
  const std::vector<Cuboid> chain = {{{0, 0, 0}, {2, 2, 2}, true}, {{1, 1, 1}, {3, 3, 3}, true}};
  const MeshReport overlapping = overlap(mesh_of(chain));
  CHECK(overlapping.overlapping_shells == 2);
  CHECK(chain[0].holds(overlapping.first_overlap));
  CHECK(chain[1].holds(overlapping.first_overlap));
  const std::vector<Cuboid> flush = {{{0, 0, 0}, {2, 1, 1}, true}, {{1, 0, 0}, {3, 1, 1}, true}};
  CHECK(overlap(mesh_of(flush)).overlapping_shells == 2);
}

TEST_CASE("random boxes are reported to overlap if and only if they do") {
  Random random(26);
  int found = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<Cuboid> boxes = random_cuboids(random, false);
    boxes.resize(2);
    const auto share = [&](std::size_t axis) {
      return std::min(boxes[0].upper[axis], boxes[1].upper[axis]) >
             std::max(boxes[0].lower[axis], boxes[1].lower[axis]);
    };
    const bool overlap = share(0) && share(1) && share(2);
    const bool equal = boxes[0].lower == boxes[1].lower && boxes[0].upper == boxes[1].upper;
    const MeshReport report = report_of(mesh_of(boxes), {});
    CHECK((report.overlapping_shells > 0 || equal) == overlap);
    found += overlap ? 1 : 0;
  }
  CHECK(found > 30);
}

TEST_CASE("warnings go to who asks for them, and else come with the prepared scene") {
  TriangleList list;
  add_box(list, {0, 0, 0}, {4, 4, 4});
  add_box(list, {1, 1, 1}, {2, 2, 2});
  std::vector<std::string> received;
  const Entity asked =
      triangle_mesh(list.positions, list.triangles, {},
                    {.warn = [&](const std::string& warning) { received.push_back(warning); }});
  CHECK(received.size() == 1);
  const auto about_meshes = [](const Entity& entity) {
    Scene scene;
    for (int i = 0; i < 20; ++i)
      scene.entities.push_back(entity.transformed(translate({9.0 * i, 0, 0})));
    const std::vector<std::string> warnings = prepare(scene).warnings();
    return std::count_if(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.starts_with("a mesh: 1 of its 2 shells");
    });
  };
  CHECK(about_meshes(asked) == 0);
  CHECK(about_meshes(list.entity()) == 1);
  CHECK(mesh_report(list.entity().transformed(translate({1, 0, 0})))->shells == 2);
  CHECK(mesh_report(Entity(Sphere{})) == nullptr);
}
