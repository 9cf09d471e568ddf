// What is inside of meshes whose parts overlap, by both rules, and what is said of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "core/geometry/exact_shape.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "core/geometry/shape.hpp"
#include "crt/error.hpp"
#include "crt/mesh.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "crt/transform.hpp"
#include "geometry/cuboids.hpp"
#include "geometry/line_checks.hpp"
#include "geometry/meshes.hpp"
#include "support/scene_of.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr FillRule rules[] = {FillRule::even_odd, FillRule::nonzero};

Entity filled(const TriangleList& list, FillRule fill) {
  return triangle_mesh(list.positions, list.triangles, {}, {.fill = fill});
}

/// Checks that a line enters and leaves by turns. Normals of shells in one another may say less.
void check_alternation(const std::vector<Hit>& hits) {
  REQUIRE(hits.size() % 2 == 0);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    REQUIRE(hits[i].entering == (i % 2 == 0));
    if (i > 0) REQUIRE(hits[i - 1].t <= hits[i].t);
  }
}

std::vector<double> places(const Entity& entity, Precision tier, const Ray& ray) {
  std::vector<double> result;
  const std::vector<Hit> hits = crossings(scene_of(entity, tier), ray);
  check_alternation(hits);
  for (const Hit& hit : hits) result.push_back(hit.t);
  return result;
}

bool is_inside(const std::vector<Cuboid>& boxes, const Vec3& point, FillRule rule) {
  int winding = 0;
  int count = 0;
  for (const Cuboid& box : boxes) {
    if (!box.holds(point)) continue;
    winding += box.outwards ? 1 : -1;
    ++count;
  }
  return rule == FillRule::nonzero ? winding != 0 : count % 2 != 0;
}

}  // namespace

TEST_CASE("a mesh with every facet twice is empty by the even-odd rule, solid by the other") {
  TriangleList twice;
  add_box(twice, {0, 0, 0}, {2, 2, 2});
  add_box(twice, {0, 0, 0}, {2, 2, 2});
  const Ray ray{.origin = {0.5, 0.75, -1}, .direction = {0, 0, 1}};
  for (const Precision tier : tiers) {
    CHECK(places(filled(twice, FillRule::even_odd), tier, ray).empty());
    CHECK(places(filled(twice, FillRule::nonzero), tier, ray) == std::vector<double>{1, 3});
  }
  const MeshReport report = report_of(twice, {});
  CHECK(report.repeated_triangles == 12);
  CHECK(report.overlapping_shells == 0);
  REQUIRE(report.warnings.size() == 1);
  CHECK(report.warnings[0].starts_with("12 of its 24 triangles repeat others, the first at (0, "));
  // One facet twice is a hole in no mesh, but open.
  TriangleList once;
  add_box(once, {0, 0, 0}, {2, 2, 2});
  once.triangles.push_back(once.triangles[5]);
  CHECK(report_of(once, {}).repeated_triangles == 1);
  CHECK_FALSE(once.entity().is_solid());
  CHECK(report_of(mesh_of({{{0, 0, 0}, {1, 1, 1}, true}}), {}).warnings.empty());
}

TEST_CASE("chords of nested and overlapping boxes are as each rule has them, in both tiers") {
  TriangleList nested;
  add_box(nested, {0, 0, 0}, {4, 4, 4});
  add_box(nested, {1, 1, 1}, {2, 2, 2});
  TriangleList cavity;
  add_box(cavity, {0, 0, 0}, {4, 4, 4});
  add_box(cavity, {1, 1, 1}, {2, 2, 2}, false);
  TriangleList chain;
  add_box(chain, {0, 0, 0}, {2, 2, 2});
  add_box(chain, {1, 1, 1}, {3, 3, 3});
  TriangleList against;
  add_box(against, {0, 0, 0}, {2, 2, 2});
  add_box(against, {1, 1, 1}, {3, 3, 4}, false);
  using List = std::vector<double>;
  const Ray ray{.origin = {1.5, 1.25, -1}, .direction = {0, 0, 1}};
  for (const Precision tier : tiers) {
    CHECK(places(filled(nested, FillRule::even_odd), tier, ray) == List{1, 2, 3, 5});
    CHECK(places(filled(nested, FillRule::nonzero), tier, ray) == List{1, 5});
    CHECK(places(filled(cavity, FillRule::even_odd), tier, ray) == List{1, 2, 3, 5});
    CHECK(places(filled(cavity, FillRule::nonzero), tier, ray) == List{1, 2, 3, 5});
    CHECK(places(filled(chain, FillRule::even_odd), tier, ray) == List{1, 2, 3, 4});
    CHECK(places(filled(chain, FillRule::nonzero), tier, ray) == List{1, 4});
    // What is gone about backwards is solid, too, and where both are they cancel.
    CHECK(places(filled(against, FillRule::nonzero), tier, ray) == List{1, 2, 3, 5});
  }
}

TEST_CASE("boxes on a grid are inside where their windings say, alone and cut") {
  Random random(21);
  int inside = 0;
  for (int round = 0; round < 150; ++round) {
    const std::vector<Cuboid> boxes = random_cuboids(random, round % 3 == 2);
    const TriangleList list = mesh_of(boxes);
    for (const FillRule rule : rules) {
      // turn_outwards() may turn all of them, which changes no solid.
      const Entity mesh = filled(list, rule);
      REQUIRE(mesh.is_solid());
      for (const Precision tier : tiers) {
        const Cuboid cutter = random_cuboids(random, false)[0];
        const Entity cut = mesh - mesh_of({cutter}).entity();
        const bool is_cut = random.one_in(2);
        const PreparedScene scene = scene_of(is_cut ? cut : mesh, tier);
        for (int i = 0; i < 40; ++i) {
          Ray ray{.origin = Vec3(3) + 8.0 * random.direction()};
          ray.direction = 6.0 * random.in_cube() + Vec3(0.5) - ray.origin;
          if (random.one_in(2))
            ray.direction =
                Vec3(random.bits() % 6, random.bits() % 6, random.bits() % 6) - ray.origin;
          const std::vector<Hit> hits = crossings(scene, ray);
          check_alternation(hits);
          REQUIRE(occluded(scene, ray) == !hits.empty());
          const std::optional<Hit> first = intersect(scene, ray);
          REQUIRE(first.has_value() == !hits.empty());
          if (first) REQUIRE(first->t == hits.front().t);
          // Places between faces of the grid have one answer.
          std::vector<double> at{0, 4};
          for (int axis = 0; axis < 3; ++axis) {
            for (int plane = 0; plane <= 7; ++plane)
              at.push_back((plane - ray.origin[axis]) / ray.direction[axis]);
          }
          std::erase_if(at, [](double t) { return !(t >= 0 && t <= 4); });
          std::sort(at.begin(), at.end());
          for (std::size_t k = 0; k + 1 < at.size(); ++k) {
            if (at[k + 1] - at[k] < 1e-9) continue;
            const double t = 0.5 * (at[k] + at[k + 1]);
            const Vec3 point = ray.origin + t * ray.direction;
            const bool expected = is_inside(boxes, point, rule) && !(is_cut && cutter.holds(point));
            const auto before =
                std::count_if(hits.begin(), hits.end(), [&](const Hit& hit) { return hit.t < t; });
            REQUIRE((before % 2 != 0) == expected);
            inside += expected ? 1 : 0;
          }
        }
      }
    }
  }
  CHECK(inside > 10000);
}

TEST_CASE("instances of overlapping boxes, and batches of rays, tell the same as the mesh alone") {
  Random random(27);
  for (const Precision tier : tiers) {
    const Entity mesh = filled(mesh_of(random_cuboids(random, true)), FillRule::nonzero);
    const PreparedScene alone = scene_of(mesh, tier);
    // So many that they share one that is compiled once.
    constexpr int count = 1024;
    Scene scene;
    scene.settings.precision = tier;
    for (int i = 0; i < count; ++i)
      scene.entities.push_back(mesh.transformed(translate({128.0 * i, 0, 0})));
    const PreparedScene many = prepare(scene);
    std::vector<Ray> rays;
    std::vector<Ray> moved;
    for (int i = 0; i < 400; ++i) {
      // Whole numbers and eighths stay what they are where rays are moved.
      const auto eighth = [&] { return static_cast<double>(random.bits() % 64) / 8 - 1; };
      Ray ray{.origin = {eighth(), eighth(), -2}, .direction = {eighth(), eighth(), 8}};
      if (random.one_in(2)) std::swap(ray.origin.y, ray.origin.z);
      if (random.one_in(2)) ray.direction = Vec3(eighth(), eighth(), eighth()) - ray.origin;
      if (ray.direction == Vec3(0)) continue;
      ray.t_max = 2;
      rays.push_back(ray);
      ray.origin.x += 128.0 * static_cast<double>(random.bits() % count);
      moved.push_back(ray);
    }
    RayQueries queries(many);
    std::vector<std::optional<Hit>> hits(moved.size());
    queries.intersect(moved, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const std::optional<Hit> expected = intersect(alone, rays[i]);
      REQUIRE(hits[i].has_value() == expected.has_value());
      REQUIRE(occluded(many, moved[i]) == expected.has_value());
      const std::vector<Hit> all = crossings(alone, rays[i]);
      const std::vector<Hit> found = crossings(many, moved[i]);
      REQUIRE(found.size() == all.size());
      for (std::size_t k = 0; k < all.size(); ++k) {
        REQUIRE(found[k].t == doctest::Approx(all[k].t).epsilon(1e-12));
        REQUIRE(found[k].entering == all[k].entering);
      }
      if (expected) REQUIRE(hits[i]->t == doctest::Approx(expected->t).epsilon(1e-12));
    }
  }
}

TEST_CASE("what is left out after the first crossing changes nothing where windings count") {
  Random random(22);
  int ended = 0;
  for (int round = 0; round < 60; ++round) {
    TriangleList mesh;
    const int count = 2 + round % 4;
    for (int i = 0; i < count; ++i)
      mesh.add(ball_mesh(random, 4, 0.1), 0.8 * random.in_cube(), random.uniform(0.2, 1));
    const Primitive primitive = Mesh{.triangles = mesh_triangles(mesh.positions, mesh.triangles, {},
                                                                 {.fill = FillRule::nonzero})};
    const auto shape = core::make_shape(primitive);
    const auto exact = core::make_exact_shape(primitive);
    for (int i = 0; i < 100; ++i) {
      core::ObjectRay line{.origin = 3.0 * random.direction(), .direction = random.direction()};
      if (random.one_in(2)) line.direction = 0.8 * random.in_cube() - line.origin;
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
        line.first_wanted_after = random.uniform(-2, 6);
        REQUIRE(crossings(some) == inside);
        REQUIRE(some.size() <= all.size());
        for (std::size_t k = 0; k < some.size(); ++k) {
          REQUIRE(some[k].t == all[k].t);
          REQUIRE(some[k].entering == all[k].entering);
          REQUIRE(some[k].face == all[k].face);
        }
        ended += some.size() < all.size() ? 1 : 0;
      }
    }
  }
  CHECK(ended > 500);
}

TEST_CASE(
    "rays that start on a mesh of overlapping parts are inside if they leave into the solid") {
  Random random(23);
  int starts = 0;
  for (int round = 0; round < 60; ++round) {
    TriangleList mesh;
    for (int i = 0; i < 3; ++i)
      mesh.add(ball_mesh(random, 3, 0.1), 0.7 * random.in_cube(), random.uniform(0.3, 1));
    if (round % 3 == 0) mesh = mesh_of(random_cuboids(random, false));
    const Primitive primitive = Mesh{.triangles = mesh_triangles(mesh.positions, mesh.triangles, {},
                                                                 {.fill = FillRule::nonzero})};
    const auto shape = core::make_shape(primitive);
    for (int i = 0; i < 200; ++i) {
      const core::ObjectRay ray{.origin = 9.0 * random.direction(),
                                .direction = random.direction()};
      core::ObjectRay aimed = ray;
      aimed.direction = mesh.positions[random.bits() % mesh.positions.size()] +
                        0.3 * random.in_cube() - ray.origin;
      core::CrossingList list;
      shape->crossings(aimed, list);
      if (list.empty()) continue;
      const core::Crossing& crossing = list[random.bits() % list.size()];
      const core::SurfacePoint point = shape->surface_point(aimed, crossing);
      if (std::min({point.u, point.v, 1 - point.u - point.v}) < 1e-6) continue;
      const Vec3 direction = random.in_cube();
      const double along = glm::dot(direction, point.normal);
      if (std::abs(along) < 1e-3) continue;
      // Where windings are below 0 the solid is in front of the normal. Here there are none.
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
      const auto ahead = std::count_if(next.begin(), next.end(),
                                       [](const core::Crossing& met) { return met.t > 0; });
      REQUIRE((ahead % 2 != 0) == inwards);
      ++starts;
    }
  }
  CHECK(starts > 1500);
}

TEST_CASE("meshes without overlaps have the same bits by both rules") {
  Random random(24);
  for (int round = 0; round < 60; ++round) {
    const TriangleList mesh = random_mesh(random);
    const PreparedScene even_odd = scene_of(filled(mesh, FillRule::even_odd));
    const PreparedScene nonzero = scene_of(filled(mesh, FillRule::nonzero));
    for (int i = 0; i < 100; ++i) {
      const Ray ray{.origin = 4.0 * random.in_cube(), .direction = random.in_cube()};
      const std::vector<Hit> hits = crossings(even_odd, ray);
      const std::vector<Hit> others = crossings(nonzero, ray);
      REQUIRE(hits.size() == others.size());
      for (std::size_t k = 0; k < hits.size(); ++k) {
        REQUIRE(hits[k].t == others[k].t);
        REQUIRE(hits[k].normal == others[k].normal);
      }
    }
  }
}

TEST_CASE(
    "boxes that touch within rounding have no gap by the nonzero rule, turned as they may be") {
  Random random(25);
  int touched = 0;
  for (int round = 0; round < 40; ++round) {
    TriangleList row;
    for (int i = 0; i < 6; ++i) add_box(row, {0.1 * i, 0, 0}, {0.1 * i + 0.1, 0.1, 0.1});
    const Transform turned = rotate_degrees({random.uniform(0, 6), random.uniform(0, 6), 1});
    for (Vec3& position : row.positions) {
      const Vec3 p = position;
      position = p.x * turned.row_x + p.y * turned.row_y + p.z * turned.row_z;
    }
    const PreparedScene scene = scene_of(filled(row, FillRule::nonzero));
    const Vec3 middle =
        Vec3(0.3) * turned.row_x + Vec3(0.05) * turned.row_y + Vec3(0.05) * turned.row_z;
    for (int i = 0; i < 50; ++i) {
      const Vec3 aim = middle + 0.02 * random.in_cube();
      Ray ray{.origin = middle + 3.0 * turned.row_x, .direction = {}};
      ray.direction = aim - ray.origin;
      const std::vector<Hit> hits = crossings(scene, ray);
      if (hits.size() != 2) MESSAGE(hits.size());
      REQUIRE(hits.size() == 2);
      ++touched;
    }
  }
  CHECK(touched == 2000);
}

TEST_CASE("by the nonzero rule a mesh whose edges are not turned alike is a surface, and says so") {
  TriangleList list;
  add_box(list, {0, 0, 0}, {1, 1, 1});
  std::swap(list.triangles[3][0], list.triangles[3][1]);
  CHECK(filled(list, FillRule::even_odd).is_solid());
  const Entity entity = filled(list, FillRule::nonzero);
  CHECK_FALSE(entity.is_solid());
  CHECK(entity.solid_fault().starts_with(
      "a mesh is open: 3 of its 18 edges run more often in one direction than in the other"));
}
