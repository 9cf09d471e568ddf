#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "core/geometry/exact_shape.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "core/geometry/shape.hpp"
#include "crt/error.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "crt/transform.hpp"
#include "geometry/line_checks.hpp"
#include "geometry/meshes.hpp"
#include "support/scene_of.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns a mesh of several parts, side by side, in one another or passing through one another.
TriangleList parts(Random& random, int count) {
  TriangleList list;
  for (int i = 0; i < count; ++i) {
    list.add(random_mesh(random), 1.5 * random.in_cube(), random.uniform(0.1, 1));
  }
  return list;
}

/// Turns some triangles round, or takes some away.
void spoil(Random& random, TriangleList& mesh, bool open) {
  for (int i = 0; i < 5; ++i) {
    const std::size_t triangle = random.bits() % mesh.triangles.size();
    if (!open) {
      std::swap(mesh.triangles[triangle][0], mesh.triangles[triangle][1]);
    } else if (mesh.triangles.size() > 1) {
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(triangle));
    }
  }
}

}  // namespace

TEST_CASE("lines enter and leave closed meshes by turns, also through corners and along edges") {
  Random random(1);
  for (int round = 0; round < 60; ++round) {
    const TriangleList mesh = random_mesh(random);
    REQUIRE(mesh.entity().is_solid());
    const PreparedScene standard = scene_of(mesh.entity(), Precision::standard);
    const PreparedScene exact = scene_of(mesh.entity(), Precision::exact);
    for (int i = 0; i < 500; ++i) {
      const Ray ray = hard_ray(random, mesh);
      const std::vector<Hit> hits = crossings(standard, ray);
      const std::vector<Hit> exact_hits = crossings(exact, ray);
      check_turns(hits, ray);
      check_turns(exact_hits, ray);
      const std::optional<Hit> first = intersect(standard, ray);
      REQUIRE(first.has_value() == !hits.empty());
      if (first) REQUIRE(first->t == hits.front().t);
      if (first) REQUIRE(first->entering);
      REQUIRE(occluded(exact, ray) == !exact_hits.empty());
    }
  }
}

TEST_CASE("a mesh of cubes is inside exactly where the cubes are filled") {
  Random random(2);
  int inside = 0;
  for (int round = 0; round < 60; ++round) {
    const Voxels voxels(random, 1 + round % 4);
    const TriangleList mesh = voxels.mesh();
    for (const Precision tier : tiers) {
      const PreparedScene scene = scene_of(mesh.entity(), tier);
      for (int i = 0; i < 300; ++i) {
        const Ray ray = hard_ray(random, mesh);
        const std::vector<Hit> hits = crossings(scene, ray);
        for (std::size_t k = 0; k + 1 < hits.size(); ++k) {
          const double t = 0.5 * (hits[k].t + hits[k + 1].t);
          const Vec3 middle = ray.origin + t * ray.direction;
          bool is_plain = true;  // not next to a face of any cube
          for (int axis = 0; axis < 3; ++axis) {
            is_plain = is_plain && std::abs(middle[axis] - std::round(middle[axis])) > 1e-9;
          }
          if (!is_plain) continue;
          REQUIRE(voxels.at(middle) == (k % 2 == 0));
          inside += k % 2 == 0 ? 1 : 0;
        }
      }
    }
  }
  CHECK(inside > 10000);
}

TEST_CASE("a mesh of cubes and their union are one solid, alone and cut flush, to the last bit") {
  Random random(3);
  std::size_t met = 0;
  for (int round = 0; round < 80; ++round) {
    const Voxels voxels(random, 2 + round % 3);
    const Voxels cutter(random, 2);
    Entity by_mesh = voxels.mesh().entity();
    Entity by_boxes = voxels.boxes();
    const auto whole = [&] { return static_cast<double>(random.bits() % 3); };
    const Transform moved = translate({whole(), whole(), whole()});
    switch (round % 4) {
      case 0:
        break;
      case 1: {
        const Box box{.corner_a = {whole(), 0, 0}, .corner_b = {3, whole() + 1, 2}};
        by_mesh = by_mesh - box;
        by_boxes = by_boxes - box;
        break;
      }
      case 2:
        by_mesh = by_mesh - cutter.mesh().entity().transformed(moved);
        by_boxes = by_boxes - cutter.boxes().transformed(moved);
        break;
      default:
        by_mesh = by_mesh ^ cutter.mesh().entity().transformed(moved);
        by_boxes = by_boxes ^ cutter.boxes().transformed(moved);
        break;
    }
    for (const Precision tier : tiers) {
      const PreparedScene mesh_scene = scene_of(by_mesh, tier);
      const PreparedScene box_scene = scene_of(by_boxes, tier);
      for (int i = 0; i < 200; ++i) {
        Ray ray{.origin = 6.0 * random.in_cube(), .direction = random.direction()};
        if (random.one_in(4)) ray.origin = Vec3(whole(), whole(), whole()) + Vec3(0.5);
        const std::vector<Hit> hits = crossings(mesh_scene, ray);
        const std::vector<Hit> expected = crossings(box_scene, ray);
        REQUIRE(hits.size() == expected.size());
        met += hits.size();
        for (std::size_t k = 0; k < hits.size(); ++k) {
          REQUIRE(hits[k].t == expected[k].t);
          REQUIRE(hits[k].normal == expected[k].normal);
          REQUIRE(hits[k].entering == expected[k].entering);
        }
        REQUIRE(occluded(mesh_scene, ray) == !expected.empty());
      }
    }
  }
  CHECK(met > 5000);
}

TEST_CASE("a ray that starts on a triangle is inside at once if it leaves into the solid") {
  Random random(4);
  int starts = 0;
  for (int round = 0; round < 100; ++round) {
    const TriangleList mesh = random_mesh(random);
    const Primitive primitive = Mesh{.triangles = mesh_triangles(mesh.positions, mesh.triangles)};
    const auto shape = core::make_shape(primitive);
    for (int i = 0; i < 200; ++i) {
      const Ray ray = hard_ray(random, mesh);
      core::CrossingList list;
      const core::ObjectRay object_ray{.origin = ray.origin, .direction = ray.direction};
      shape->crossings(object_ray, list);
      if (list.empty()) continue;
      const core::Crossing& crossing = list[random.bits() % list.size()];
      const core::SurfacePoint point = shape->surface_point(object_ray, crossing);
      Vec3 direction = random.in_cube();
      const double along = glm::dot(direction, point.normal);
      if (std::abs(along) < 1e-3) continue;
      const bool inwards = along < 0;
      const core::ObjectRay start{
          .origin = point.position,
          .direction = direction,
          .start = {.face = crossing.face,
                    .side = inwards ? core::Side::inside : core::Side::outside},
          .begin = 0};
      core::CrossingList next;
      shape->crossings(start, next);
      for (std::size_t k = 1; k < next.size(); ++k) {
        REQUIRE(next[k - 1].t <= next[k].t);
        REQUIRE(next[k - 1].entering != next[k].entering);
      }
      const auto is_start = [&](const core::Crossing& met) { return met.t == 0; };
      // On an edge it is as well on the triangle beyond, or leaves past all of them.
      if (std::min({point.u, point.v, 1 - point.u - point.v}) < 1e-6) continue;
      REQUIRE(std::count_if(next.begin(), next.end(), is_start) == 1);
      const auto ahead = std::count_if(next.begin(), next.end(),
                                       [](const core::Crossing& met) { return met.t > 0; });
      REQUIRE((ahead % 2 != 0) == inwards);
      ++starts;
    }
  }
  CHECK(starts > 2000);
}

TEST_CASE("what is left out after the first crossing that is asked for changes nothing before it") {
  Random random(8);
  int ended = 0;
  int asked = 0;
  for (int round = 0; round < 120; ++round) {
    TriangleList mesh = round % 2 == 0 ? random_mesh(random) : parts(random, 1 + round % 5);
    if (round % 6 == 5) spoil(random, mesh, round % 4 == 1);
    const Primitive primitive = Mesh{.triangles = mesh_triangles(mesh.positions, mesh.triangles)};
    const auto shape = core::make_shape(primitive);
    const auto exact = core::make_exact_shape(primitive);
    for (int i = 0; i < 200; ++i) {
      const Ray ray = hard_ray(random, mesh);
      core::ObjectRay line{.origin = ray.origin, .direction = ray.direction};
      for (const bool is_exact : {false, true}) {
        const auto crossings = [&](core::CrossingList& list) {
          const core::ExactRay exact_line{
              .near = line, .world_origin = line.origin, .world_direction = line.direction};
          return is_exact ? exact->crossings(exact_line, list) : shape->crossings(line, list);
        };
        core::CrossingList all;
        line.first_wanted_after = std::numeric_limits<double>::infinity();
        const bool inside = crossings(all);
        core::CrossingList some;
        line.first_wanted_after = random.one_in(3) ? -1e9 : random.uniform(-2, 12);
        REQUIRE(crossings(some) == inside);
        if (!shape->is_solid()) continue;
        REQUIRE(some.size() <= all.size());
        for (std::size_t k = 0; k < some.size(); ++k) REQUIRE(are_alike(some[k], all[k]));
        ++asked;
        if (some.size() == all.size()) continue;
        REQUIRE(line.is_first_wanted(some.back()));
        REQUIRE(some.back().has_rest);
        ++ended;
      }
    }
  }
  CHECK(ended > 5000);
  CHECK(asked > 30000);
}

TEST_CASE(
    "a mesh knows on which side of its triangles the solid is where they do not meet others") {
  using core::Facing;
  Random random(9);
  const auto count = [](const TriangleList& list, Facing facing) {
    const auto mesh = mesh_triangles(list.positions, list.triangles);
    std::uint32_t found = 0;
    for (std::uint32_t i = 0; i < mesh->size(); ++i) {
      found += mesh->plane_of(i).faces() == facing ? 1 : 0;
    }
    return found;
  };
  const TriangleList ball = ball_mesh(random, 5, 0.05);
  const auto size = static_cast<std::uint32_t>(ball.triangles.size());
  CHECK(count(ball, Facing::outwards) == size);
  const TriangleList voxels = Voxels(random, 5).mesh();
  CHECK(count(voxels, Facing::outwards) == voxels.triangles.size());
  SUBCASE("a ball in a ball is a hole") {
    TriangleList nested = ball;
    nested.add(ball, {0.1, 0, 0}, 0.5);
    CHECK(count(nested, Facing::outwards) == size);
    CHECK(count(nested, Facing::inwards) == size);
  }
  SUBCASE("balls that pass through one another have triangles on both sides of each other") {
    TriangleList chain = ball;
    chain.add(ball, {0.8, 0, 0}, 1);
    CHECK(count(chain, Facing::unknown) > 10);
    CHECK(count(chain, Facing::inwards) > size / 5);
    CHECK(count(chain, Facing::outwards) > size);
  }
  SUBCASE("two meshes in one place say nothing, nor does one whose triangles are turned") {
    TriangleList twice = ball;
    twice.add(ball, {0, 0, 0}, 1);
    CHECK(count(twice, Facing::unknown) == 2 * size);
    TriangleList turned = ball;
    std::swap(turned.triangles[7][0], turned.triangles[7][1]);
    CHECK(count(turned, Facing::unknown) == size);
  }
}

TEST_CASE("corners are one where they are equal, and triangles without an area close gaps") {
  // A square pyramid, each triangle with corners of its own. One side is divided by a corner in the
  // middle of its lower edge, where a triangle without an area fills the gap.
  const Vec3 top{0, 1, 0};
  const Vec3 middle{0, 0, -1};
  const std::array<Vec3, 4> base = {Vec3{-1, -0.0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  TriangleList mesh;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  add(Vec3{-1, 0, -1}, top, middle);
  add(middle, top, base[1]);
  for (std::size_t i = 1; i < 4; ++i) add(base[i], top, base[(i + 1) % 4]);
  add(base[0], base[1], base[2]);
  add(base[0], base[2], base[3]);
  CHECK_FALSE(mesh.entity().is_solid());
  add(base[0], middle, base[1]);
  CHECK(mesh.entity().is_solid());
  const PreparedScene scene = scene_of(mesh.entity());
  for (const double x : {-0.5, 0.0, 0.25}) {
    const std::vector<Hit> hits =
        crossings(scene, {.origin = {x, 0.25, -9}, .direction = {0, 0, 1}});
    REQUIRE(hits.size() == 2);
    CHECK(hits[0].t == doctest::Approx(8.25));
    CHECK(hits[1].t == doctest::Approx(9.75));
  }
}

TEST_CASE("an open mesh is a surface, says why, and cannot be cut") {
  Random random(5);
  TriangleList mesh = ball_mesh(random, 3, 0);
  mesh.triangles.pop_back();
  const auto triangles = mesh_triangles(mesh.positions, mesh.triangles);
  const Entity entity(Mesh{.triangles = triangles});
  CHECK(entity.solid_fault().starts_with("a mesh is open: 3 of its 108 edges "));
  CHECK((entity + Sphere{}).with_id(3).solid_fault() == entity.solid_fault());
  CHECK(Entity(Sphere{}).solid_fault() == "");
  CHECK(Entity(Disc{}).solid_fault() == "Disc, Triangle and HalfPlane are surfaces");
  CHECK_FALSE(entity.is_solid());
  CHECK_THROWS_AS(entity - Sphere{}, Error);
  const PreparedScene scene = scene_of(entity);
  const Ray through{.origin = {0.1, 0.2, -9}, .direction = {0.01, 0.02, 1}};
  const std::vector<Hit> hits = crossings(scene, through);
  REQUIRE(hits.size() == 2);
  CHECK(hits[0].entering);
  CHECK_FALSE(hits[1].entering);
  CHECK(intersect(scene, through)->t == hits[0].t);
  mesh.triangles.push_back(mesh.triangles.front());
  CHECK_FALSE(mesh.entity().is_solid());
  CHECK_THROWS_AS(Entity(Mesh{}), Error);
}

TEST_CASE("normals are turned out of a closed mesh") {
  Random random(6);
  TriangleList mesh = ball_mesh(random, 3, 0.1);
  for (TriangleIndices& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  const PreparedScene scene = scene_of(mesh.entity());
  const Ray ray{.origin = {0.1, 0.2, -9}, .direction = {0.01, 0.02, 1}};
  check_turns(crossings(scene, ray), ray);
  CHECK(crossings(scene, ray).size() == 2);
}

TEST_CASE("a turned mesh tells one story in both tiers, and any power of two as its size") {
  Random random(7);
  for (int round = 0; round < 30; ++round) {
    const TriangleList mesh = random_mesh(random);
    const Transform turned = rotate_degrees({random.uniform(0, 6), random.uniform(0, 6), 1});
    const Entity entity = mesh.entity().transformed(turned);
    const PreparedScene standard = scene_of(entity, Precision::standard);
    const PreparedScene exact = scene_of(entity, Precision::exact);
    const double scale = 0x1p-200;
    const PreparedScene small =
        scene_of(entity.transformed({{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}, {0, 0, 0}}));
    for (int i = 0; i < 100; ++i) {
      Ray ray = hard_ray(random, mesh);
      ray.t_min = 0;
      const std::vector<Hit> hits = crossings(standard, ray);
      const std::vector<Hit> exact_hits = crossings(exact, ray);
      // Through a corner or an edge the rounding of the transform decides.
      if (hits.size() == exact_hits.size()) {
        for (std::size_t k = 0; k < hits.size(); ++k) {
          REQUIRE(hits[k].t == doctest::Approx(exact_hits[k].t).epsilon(1e-6));
        }
      }
      ray.origin *= scale;
      ray.direction *= scale;
      const std::vector<Hit> small_hits = crossings(small, ray);
      REQUIRE(small_hits.size() == hits.size());
      for (std::size_t k = 0; k < hits.size(); ++k) REQUIRE(small_hits[k].t == hits[k].t);
    }
  }
}
