// Meshes of solids: whether they are closed, and as near to the surface as they say.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <variant>
#include <vector>

#include "crt/error.hpp"
#include "crt/measure.hpp"
#include "crt/primitives.hpp"
#include "crt/surface_mesh.hpp"
#include "crt/transform.hpp"
#include "geometry/random_instances.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Vec3 corner(const SurfaceMesh& mesh, std::size_t triangle, std::size_t i) {
  return mesh.positions[mesh.triangles[triangle][i]];
}

/// Returns whether beside each edge of a triangle there is exactly one that has it the other way.
bool is_closed(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  return std::ranges::all_of(edges, [&](const auto& edge) {
    const auto back = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != edges.end();
  });
}

/// Returns corners less edges plus triangles: 2 for each piece, less 2 for each hole through it.
int euler_number(const SurfaceMesh& mesh) {
  const auto triangles = static_cast<int>(mesh.triangles.size());
  return static_cast<int>(mesh.positions.size()) - triangles / 2;
}

double volume_of(const SurfaceMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    sum += dot(corner(mesh, t, 0), cross(corner(mesh, t, 1), corner(mesh, t, 2))) / 6;
  return sum;
}

/// Returns the largest distance of points of the triangles from the solid's surface.
double farthest_from_surface(const SurfaceMesh& mesh, const Entity& solid,
                             std::size_t most_points) {
  std::vector<Vec3> points;
  const std::size_t step = 1 + mesh.triangles.size() / most_points;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += step) {
    const Vec3 a = corner(mesh, t, 0);
    const Vec3 b = corner(mesh, t, 1);
    const Vec3 c = corner(mesh, t, 2);
    points.push_back((a + b + c) / 3.0);
    points.push_back(0.5 * (a + b));
    points.push_back(0.7 * a + 0.2 * b + 0.1 * c);
  }
  std::vector<NearestPoint> nearest(points.size());
  nearest_points(solid, points, nearest, {.relative_width = 1e-2});
  double farthest = 0;
  for (const NearestPoint& near : nearest)
    farthest = std::max(farthest, std::max(near.distance.lower, -near.distance.upper));
  return farthest;
}

/// Returns how far a point is from the nearest point of a triangle.
double distance_to(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  double least = infinite;
  const Vec3 corners[] = {a, b, c};
  const Vec3 normal = cross(b - a, c - a);
  bool is_over = true;
  for (int i = 0; i < 3; ++i) {
    const Vec3 from = corners[i];
    const Vec3 side = corners[(i + 1) % 3] - from;
    is_over = is_over && dot(cross(side, p - from), normal) >= 0;
    const double share = std::clamp(dot(p - from, side) / dot(side, side), 0.0, 1.0);
    least = std::min(least, length(p - (from + share * side)));
  }
  return is_over ? std::abs(dot(p - a, normal)) / length(normal) : least;
}

/// Returns the largest distance of some points from the triangles.
double farthest_from_mesh(const std::vector<Vec3>& points, const SurfaceMesh& mesh) {
  double farthest = 0;
  for (const Vec3& point : points) {
    double nearest = infinite;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      nearest = std::min(
          nearest, distance_to(point, corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

/// Returns points of a solid's surface: those that are nearest to points around it.
std::vector<Vec3> points_of_surface(const Entity& solid, Random& random, int count) {
  const BoundingBox box = tight_bounding_box(solid, {.relative_width = 1e-2});
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(0.5 * (box.lower + box.upper) +
                     0.6 * random.in_cube() * (box.upper - box.lower));
  }
  std::vector<NearestPoint> nearest(points.size());
  nearest_points(solid, points, nearest, {.relative_width = 1e-4});
  std::vector<Vec3> result;
  for (const NearestPoint& near : nearest) result.push_back(near.point);
  return result;
}

Entity bored_box() {
  return Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}} -
         Entity(Cylinder{.from = {0, -2, 0}, .to = {0, 2, 0}, .radius = 0.5});
}

}  // namespace

TEST_CASE("a box is twelve triangles, wherever it is and however it is turned") {
  for (const Vec3& degrees : {Vec3(0, 0, 0), Vec3(20, 30, 50)}) {
    const Entity box = Entity(Box{.corner_a = {1, 2, 3}, .corner_b = {2, 4, 6}})
                           .transformed(rotate_degrees(degrees));
    const SurfaceMesh mesh = tessellate(box, 0.01);
    CHECK(mesh.triangles.size() == 12);
    CHECK(mesh.positions.size() == 8);
    CHECK(mesh.deviation == 0.01);
    CHECK(is_closed(mesh));
    CHECK(std::abs(volume_of(mesh) - 6) < 1e-9);
    std::vector<NearestPoint> nearest(8);
    nearest_points(box, mesh.positions, nearest);
    for (const NearestPoint& near : nearest) CHECK(std::abs(near.distance.middle()) < 1e-9);
  }
}

TEST_CASE("meshes are closed, have the solid's holes, and turn outwards") {
  const Entity ring = Torus{.radius = 1, .thickness = 0.3};
  const Entity two = Sphere{.center = {-2, 0, 0}} + Entity(Sphere{.center = {2, 0, 0}});
  const Entity hollow = Sphere{.radius = 1} - Entity(Sphere{.radius = 0.9});
  const std::vector<std::pair<Entity, int>> solids = {{Sphere{}, 2}, {ring, 0},   {bored_box(), 0},
                                                      {two, 4},      {hollow, 4}, {Cone{}, 2}};
  for (const auto& [solid, euler] : solids) {
    CAPTURE(euler);
    const SurfaceMesh mesh = tessellate(solid, 0.02);
    CHECK(mesh.deviation == 0.02);
    CHECK(is_closed(mesh));
    CHECK(euler_number(mesh) == euler);
    const Interval truth = volume(solid, {.relative_width = 1e-4});
    const Interval area = surface_area(solid, {.relative_width = 1e-2});
    CHECK(std::abs(volume_of(mesh) - truth.middle()) < 1.1 * 0.02 * area.upper);
  }
}

TEST_CASE("no point of a mesh is farther from the surface than it says, and the other way round") {
  Random random(7);
  const std::vector<Entity> solids = {
      Sphere{.radius = 1.2},
      Entity(Torus{.radius = 1, .thickness = 0.3}).transformed(rotate_degrees({10, 20, 30})),
      bored_box(),
      bored_box().transformed(rotate_degrees({20, 30, 50})),
      Cone{.from = {0, 0, 0}, .to = {0, 2, 0}, .radius = 1, .radius2 = 0},
      Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}} - Entity(Sphere{.radius = 1.2}),
      Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}} + Entity(Sphere{.radius = 1.2}),
      // The thin edge between a box and a cylinder that touches its side.
      Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 0, 1}} +
          Entity(Cylinder{.from = {0, 1, -1}, .to = {0, 1, 1}, .radius = 1}),
  };
  for (std::size_t i = 0; i < solids.size(); ++i) {
    CAPTURE(i);
    for (const double deviation : {0.1, 0.03}) {
      CAPTURE(deviation);
      const SurfaceMesh mesh = tessellate(solids[i], deviation);
      CHECK(mesh.deviation == deviation);
      CHECK(is_closed(mesh));
      CHECK(farthest_from_surface(mesh, solids[i], 6) <= deviation);
      CHECK(farthest_from_mesh(points_of_surface(solids[i], random, 25), mesh) <= deviation + 1e-3);
    }
  }
}

TEST_CASE("sharp edges stay edges, and their corners lie on them") {
  const SurfaceMesh mesh = tessellate(bored_box(), 0.01);
  const auto is_on_rim = [](const Vec3& p) {
    return std::abs(std::abs(p.y) - 1) < 1e-9 && std::abs(std::hypot(p.x, p.z) - 0.5) < 1e-9;
  };
  int on_rim = 0;
  double angles = 0;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 from = mesh.positions[triangle[i]];
      const Vec3 to = mesh.positions[triangle[(i + 1) % 3]];
      if (!is_on_rim(from) || !is_on_rim(to) || from.y != to.y) continue;
      ++on_rim;
      const double cosine = (from.x * to.x + from.z * to.z) / 0.25;
      angles += std::acos(std::clamp(cosine, -1.0, 1.0));
    }
  }
  // Each rim goes around once, and beside each of its edges are two triangles.
  CHECK(on_rim > 20);
  CHECK(std::abs(angles - 8 * std::acos(-1.0)) < 1e-6);
  for (const Vec3& place : mesh.positions) {
    const bool on_box =
        std::abs(std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)}) - 1) < 1e-9;
    CHECK((on_box || std::abs(std::hypot(place.x, place.z) - 0.5) < 1e-9));
  }
}

TEST_CASE("a mesh takes few triangles") {
  // A circle of so many sides is nowhere farther from its polygon. The middle of a square of a ball
  // of meridians and parallels is twice as far away as its sides.
  const auto sides = [](double deviation) {
    return std::ceil(std::acos(-1.0) / std::acos(1 - deviation));
  };
  for (const double deviation : {0.02, 0.002}) {
    CAPTURE(deviation);
    const auto of_ball = static_cast<double>(tessellate(Sphere{}, deviation).triangles.size());
    CHECK(of_ball <= 1.5 * std::pow(sides(0.5 * deviation), 2));
    const Entity rod = Cylinder{.from = {0, -20, 0}, .to = {0, 20, 0}, .radius = 1};
    const auto of_rod = static_cast<double>(tessellate(rod, deviation).triangles.size());
    CHECK(of_rod <= 2 * (4 * sides(deviation) - 4));
  }
}

TEST_CASE("what is made of triangles has these, wherever it is") {
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  // By the parity rule triangles may be turned inwards.
  const std::vector<TriangleIndices> inwards = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  const Entity mesh = Mesh{mesh_triangles(corners, inwards)};
  const std::vector<double> heights = {0.5, 1, 0.25, 0.75, 0.5, 1, 0.5, 0.25, 1, 0.5, 0.5, 1};
  const Entity field = HeightField{.heights = make_height_grid(heights, 4, 3)};
  for (const Transform& transform :
       {Transform{}, translate({3, -1, 2}), scale({-2, 1, 1}), rotate_degrees({20, 40, 60})}) {
    const SurfaceMesh of_mesh = tessellate(mesh.transformed(transform), 1e-6);
    CHECK(of_mesh.triangles.size() == 4);
    CHECK(of_mesh.positions.size() == 4);
    const SurfaceMesh of_field = tessellate(field.transformed(transform), 1e-6);
    // There are 6 cells, with two triangles each; below, 10 sides with three.
    CHECK(of_field.triangles.size() == 12 + 30);
    for (const auto& [solid, made] : {std::pair(mesh, of_mesh), std::pair(field, of_field)}) {
      CHECK(is_closed(made));
      CHECK(euler_number(made) == 2);
      CHECK(made.deviation == 1e-6);
      const Interval volume = crt::volume(solid.transformed(transform), {.relative_width = 1e-6});
      CHECK(volume_of(made) > volume.lower * (1 - 1e-12));
      CHECK(volume_of(made) < volume.upper * (1 + 1e-12));
    }
  }
}

TEST_CASE("parts that touch but for rounding are one, and that is not called proved") {
  // The bore's arcs have a radius that is not that of the pin to the last bit.
  const double radius = 0.15;
  const double along = radius * std::cos(0.7);
  const double aside = radius * std::sin(0.7);
  const double half = std::tan(std::acos(-1.0) / 4);
  const Contour bore = {{.x = along, .y = aside, .bulge = half},
                        {.x = -along, .y = -aside, .bulge = half}};
  const Contour square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const Entity plate =
      Extrusion{.profile = make_profile(std::vector<Contour>{square, bore}), .to = 0.4};
  const Entity pin = Cylinder{.from = {0, 0, 0}, .to = {0, 0, 0.7}, .radius = radius};
  const SurfaceMesh mesh = tessellate(plate + pin, 1e-3);
  CHECK(is_closed(mesh));
  CHECK(euler_number(mesh) == 2);
  CHECK(mesh.triangles.size() < 1000);
  CHECK(mesh.deviation == infinite);
}

TEST_CASE("contours of many flat arcs that go over into one another take few triangles") {
  // A ring whose radius goes to and fro, of arcs with the same tangents where they meet.
  constexpr int steps = 64;
  const auto place = [](int i) {
    const double angle = 2 * std::acos(-1.0) * i / steps;
    const double radius = 1 + 0.04 * std::cos(5 * angle);
    return std::pair(radius * std::cos(angle), radius * std::sin(angle));
  };
  Contour ring;
  for (int i = 0; i < steps; ++i)
    ring.push_back({.x = place(i).first, .y = place(i).second, .bulge = std::tan(0.02)});
  const Entity solid = Extrusion{.profile = make_profile(std::vector<Contour>{ring}), .to = 0.2};
  const SurfaceMesh mesh = tessellate(solid, 0.004);
  CHECK(is_closed(mesh));
  CHECK(mesh.deviation == 0.004);
  CHECK(mesh.triangles.size() < 8 * steps);
}

TEST_CASE("random solids with faces that coincide have closed meshes that are near") {
  int proved = 0;
  int all = 0;
  for (std::uint32_t seed = 0; seed < 25; ++seed) {
    CAPTURE(seed);
    SolidMaker maker(seed);
    const Entity box = Box{.corner_a = {-3.1, -3.1, -3.1}, .corner_b = {3.1, 3.1, 3.1}};
    const Entity solid = maker.tree(4).entity() ^ box;
    const SurfaceMesh mesh = tessellate(solid, 0.15);
    CHECK(is_closed(mesh));
    ++all;
    if (!(mesh.deviation < infinite)) continue;
    ++proved;
    if (mesh.triangles.empty()) continue;
    CHECK(farthest_from_surface(mesh, solid, 5) <= mesh.deviation);
  }
  // The others have surfaces that touch without crossing.
  CHECK(proved > 0.85 * all);
}

TEST_CASE("every bounded primitive has a closed mesh") {
  for (std::size_t kind = 0; kind < std::variant_size_v<Primitive>; ++kind) {
    CAPTURE(kind);
    Random random(300 + kind);
    const Entity solid = random_instance(kind, random);
    if (!solid.is_solid()) continue;
    const BoundingBox box = bounding_box(solid);
    const double size =
        std::max({box.upper.x - box.lower.x, box.upper.y - box.lower.y, box.upper.z - box.lower.z});
    if (!(size < infinite)) continue;
    const SurfaceMesh mesh = tessellate(solid, 0.05 * size, {.seconds = 2});
    CHECK(is_closed(mesh));
  }
}

TEST_CASE("meshes are as good at any scale, and the same for any number of threads") {
  for (const double factor : {1e-9, 1e9}) {
    const Entity solid = bored_box().transformed(scale(factor));
    const SurfaceMesh mesh = tessellate(solid, 0.02 * factor);
    CHECK(mesh.deviation == 0.02 * factor);
    CHECK(is_closed(mesh));
    CHECK(mesh.triangles.size() < 150);
  }
  const SurfaceMesh one = tessellate(bored_box(), 0.01, {.threads = 1});
  const SurfaceMesh four = tessellate(bored_box(), 0.01, {.threads = 4});
  CHECK(one.positions == four.positions);
  CHECK(one.triangles == four.triangles);
}

TEST_CASE("what has no mesh is refused, and what takes too long ends") {
  CHECK_THROWS_AS(tessellate(Sphere{}, 0), Error);
  CHECK_THROWS_AS(tessellate(Sphere{}, -1), Error);
  CHECK_THROWS_AS(tessellate(Sphere{}, infinite), Error);
  CHECK_THROWS_AS(tessellate(Sphere{}, std::nan("")), Error);
  CHECK_THROWS_AS(tessellate(Plane{}, 0.1), Error);
  CHECK_THROWS_AS(tessellate(Disc{}, 0.1), Error);
  CHECK_THROWS_AS(tessellate(Sphere{}, 0.1, {.go_on = [] { return false; }}), Error);
  const SurfaceMesh nothing = tessellate(Sphere{} ^ Entity(Sphere{.center = {5, 0, 0}}), 0.1);
  CHECK(nothing.triangles.empty());
  CHECK(nothing.deviation == 0.1);
  const SurfaceMesh hasty = tessellate(Sphere{}, 1e-7, {.seconds = 0.05});
  CHECK(hasty.deviation == infinite);
  CHECK(is_closed(hasty));
}
