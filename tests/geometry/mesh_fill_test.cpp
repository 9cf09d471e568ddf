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
#include "geometry/line_checks.hpp"
#include "geometry/meshes.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr Precision tiers[] = {Precision::standard, Precision::exact};
constexpr FillRule rules[] = {FillRule::even_odd, FillRule::nonzero};

PreparedScene scene_of(const Entity& entity, Precision precision = Precision::standard) {
  Scene scene;
  scene.entities = {entity};
  scene.settings.precision = precision;
  return prepare(scene);
}

/// Adds the twelve triangles of a box, turned outwards or not.
void add_box(TriangleList& list, const Vec3& lower, const Vec3& upper, bool outwards = true) {
  const auto first = static_cast<std::uint32_t>(list.positions.size());
  for (int i = 0; i < 8; ++i) {
    list.positions.emplace_back((i & 1) != 0 ? upper.x : lower.x, (i & 2) != 0 ? upper.y : lower.y,
                                (i & 4) != 0 ? upper.z : lower.z);
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : sides) {
    for (const auto& [p, q, r] : {TriangleIndices{a, b, c}, TriangleIndices{a, c, d}}) {
      list.triangles.push_back(outwards ? TriangleIndices{first + p, first + q, first + r}
                                        : TriangleIndices{first + p, first + r, first + q});
    }
  }
}

void add(TriangleList& list, const TriangleList& other, const Vec3& place, double scale) {
  const auto first = static_cast<std::uint32_t>(list.positions.size());
  for (const Vec3& position : other.positions) list.positions.push_back(place + scale * position);
  for (const auto& [a, b, c] : other.triangles)
    list.triangles.push_back({first + a, first + b, first + c});
}

Entity filled(const TriangleList& list, FillRule fill) {
  return triangle_mesh(list.positions, list.triangles, {}, {.fill = fill});
}

MeshReport report_of(const TriangleList& list, const MeshOptions& options) {
  return mesh_report(*mesh_triangles(list.positions, list.triangles, {}, options));
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

/// A Cuboid is a box of whole numbers, with how often it is gone about.
struct Cuboid {
  std::array<int, 3> lower;
  std::array<int, 3> upper;
  bool outwards;

  /// Says whether a point is inside. Points on faces are as those at somewhat higher coordinates,
  /// as lines in faces are moved to there (passing_line.hpp).
  bool holds(const Vec3& point) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      if (point[axis] < lower[i] || point[axis] >= upper[i]) return false;
    }
    return true;
  }
};

/// Returns some boxes on a grid, most of which overlap, touch or lie in one another.
std::vector<Cuboid> random_cuboids(Random& random, bool some_inwards) {
  std::vector<Cuboid> boxes(2 + random.bits() % 5);
  for (Cuboid& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.lower[axis] = static_cast<int>(random.bits() % 4);
      box.upper[axis] = box.lower[axis] + 1 + static_cast<int>(random.bits() % 3);
    }
    box.outwards = !some_inwards || !random.one_in(3);
  }
  return boxes;
}

TriangleList mesh_of(const std::vector<Cuboid>& boxes) {
  TriangleList list;
  for (const Cuboid& box : boxes) {
    const auto corner = [](const std::array<int, 3>& c) { return Vec3(c[0], c[1], c[2]); };
    add_box(list, corner(box.lower), corner(box.upper), box.outwards);
  }
  return list;
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

TEST_CASE("boxes on a grid are inside where their windings say, through CSG and instances too") {
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
          if (random.one_in(2)) ray.direction = Vec3(random.bits() % 6, random.bits() % 6, random.bits() % 6) - ray.origin;
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
            const auto before = std::count_if(hits.begin(), hits.end(),
                                              [&](const Hit& hit) { return hit.t < t; });
            REQUIRE((before % 2 != 0) == expected);
            inside += expected ? 1 : 0;
          }
        }
      }
    }
  }
  CHECK(inside > 10000);
}

TEST_CASE("what is left out after the first crossing changes nothing where windings count") {
  Random random(22);
  int ended = 0;
  for (int round = 0; round < 60; ++round) {
    TriangleList mesh;
    const int count = 2 + round % 4;
    for (int i = 0; i < count; ++i)
      add(mesh, ball_mesh(random, 4, 0.1), 0.8 * random.in_cube(), random.uniform(0.2, 1));
    const Primitive primitive =
        Mesh{.triangles = mesh_triangles(mesh.positions, mesh.triangles, {}, {.fill = FillRule::nonzero})};
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
        line.first_above = std::numeric_limits<double>::infinity();
        const bool inside = crossings(all);
        core::CrossingList some;
        line.first_above = random.uniform(-2, 6);
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

TEST_CASE("rays that start on a mesh of overlapping parts are inside if they leave into the solid") {
  Random random(23);
  int starts = 0;
  for (int round = 0; round < 60; ++round) {
    TriangleList mesh;
    for (int i = 0; i < 3; ++i)
      add(mesh, ball_mesh(random, 3, 0.1), 0.7 * random.in_cube(), random.uniform(0.3, 1));
    if (round % 3 == 0) mesh = mesh_of(random_cuboids(random, false));
    const Primitive primitive =
        Mesh{.triangles = mesh_triangles(mesh.positions, mesh.triangles, {}, {.fill = FillRule::nonzero})};
    const auto shape = core::make_shape(primitive);
    for (int i = 0; i < 200; ++i) {
      const core::ObjectRay ray{.origin = 9.0 * random.direction(), .direction = random.direction()};
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

TEST_CASE("boxes that touch within rounding have no gap by the nonzero rule, turned as they may be") {
  Random random(25);
  int touched = 0;
  for (int round = 0; round < 40; ++round) {
    TriangleList row;
    for (int i = 0; i < 6; ++i) add_box(row, {0.1 * i, 0, 0}, {0.1 * i + 0.1, 0.1, 0.1});
    const Transform turned = rotate({random.uniform(0, 6), random.uniform(0, 6), 1});
    for (Vec3& position : row.positions) {
      const Vec3 p = position;
      position = p.x * turned.row_x + p.y * turned.row_y + p.z * turned.row_z;
    }
    const PreparedScene scene = scene_of(filled(row, FillRule::nonzero));
    const Vec3 middle = Vec3(0.3) * turned.row_x + Vec3(0.05) * turned.row_y + Vec3(0.05) * turned.row_z;
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

TEST_CASE("shells in others and shells that overlap are counted, and one of the places is told") {
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
  CHECK(in_another.warnings[0].starts_with("1 of its 2 shells lie in others or overlap, the first"));
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

TEST_CASE("random boxes are told to overlap if and only if they do") {
  Random random(26);
  int told = 0;
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
    told += overlap ? 1 : 0;
  }
  CHECK(told > 30);
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

TEST_CASE("warnings go to who asks for them, and else come with the prepared scene") {
  TriangleList list;
  add_box(list, {0, 0, 0}, {4, 4, 4});
  add_box(list, {1, 1, 1}, {2, 2, 2});
  std::vector<std::string> told;
  const Entity asked = triangle_mesh(
      list.positions, list.triangles, {},
      {.warn = [&](const std::string& warning) { told.push_back(warning); }});
  CHECK(told.size() == 1);
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
