#include "extremes/rooms.hpp"

#include <array>
#include <map>
#include <numbers>

#include "extremes/support.hpp"

namespace crt::test {

namespace {

std::vector<Vec3> box_corners(const Vec3& a, const Vec3& b) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 27; ++i) {
    const int steps[] = {i % 3, i / 3 % 3, i / 9};
    Vec3 corner;
    for (int axis = 0; axis < 3; ++axis)
      corner[axis] = a[axis] + 0.5 * steps[axis] * (b[axis] - a[axis]);
    corners.push_back(corner);
  }
  return corners;
}

/// Returns points on a circle about the y axis.
std::vector<Vec3> circle(double y, double radius) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    const double angle = i * std::numbers::pi / 4;
    points.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
  }
  return points;
}

std::vector<Room> primitive_rooms() {
  const Vec3 low(-1, -0.8, -1.2);
  const Vec3 high(0.9, 1, 1.1);
  std::vector<Room> rooms;
  rooms.push_back({"sphere", {Sphere{}}});
  rooms.push_back({"box",
                   {Box{.corner_a = low, .corner_b = high}},
                   {0, 0, 0},
                   0.1,
                   true,
                   box_corners(low, high)});
  rooms.push_back({"cylinder", {Cylinder{.from = {0, -1, 0}}}, {0, 0, 0}, 0.1, true, circle(1, 1)});
  rooms.push_back({"cone", {Cone{.from = {0, -1, 0}}}, {0, 0, 0}, 0.1, true, circle(-1, 1)});
  rooms.back().corners.emplace_back(0, 1, 0);
  rooms.push_back({"frustum",
                   {Cone{.from = {0, -1, 0}, .radius2 = 0.5}},
                   {0, 0, 0},
                   0.1,
                   true,
                   circle(1, 0.5)});
  rooms.push_back({"ring", {Torus{}}, {1, 0, 0}, 0.1, true, circle(0, 0.75)});
  rooms.push_back({"horn", {Torus{.thickness = 1}}, {1, 0, 0}, 0.1, true, {Vec3(0, 0, 0)}});
  rooms.push_back({"spindle", {Torus{.radius = 0.5, .thickness = 1}}});
  rooms.back().corners = {Vec3(0, std::sqrt(0.75), 0), Vec3(0, -std::sqrt(0.75), 0)};
  return rooms;
}

/// Returns cavities in a block.
std::vector<Room> hollow_rooms() {
  std::vector<Room> rooms;
  for (const Room& filled : primitive_rooms()) {
    Room hollow = filled;
    hollow.name = "hollow " + filled.name;
    hollow.walls = {Entity(Box{.corner_a = {-3, -3, -3}, .corner_b = {3, 3, 3}}) - filled.walls[0]};
    hollow.within_solid = false;
    rooms.push_back(hollow);
  }
  return rooms;
}

std::vector<Room> csg_rooms() {
  const Entity block = Box{};
  const Entity ball = Sphere{.radius = 1.3};
  const Entity pillar = Cylinder{.from = {0, -1, 0}, .to = {0, 1, 0}, .radius = 1.2};
  const std::vector<Vec3> corners = box_corners({-1, -1, -1}, {1, 1, 1});
  std::vector<Room> rooms;
  rooms.push_back({"intersection", {block ^ ball ^ pillar}, {0, 0, 0}, 0.1, true, circle(1, 1)});
  rooms.push_back({"union", {block + ball + pillar}, {0, 0, 0}, 0.1, true, corners});
  const Entity left = Box{.corner_a = {-1, -1, -1}, .corner_b = {0.25, 1, 1}};
  const Entity right = Box{.corner_a = {0.25, -1, -1}, .corner_b = {1, 1, 1}};
  rooms.push_back({"touching boxes", {left + right}, {0, 0, 0}, 0.1, true, corners});
  rooms.push_back({"flush cutter",
                   {block - Entity(Box{.corner_a = {-1, 0.5, -1}, .corner_b = {1, 1, 1}})},
                   {0, 0, 0},
                   0.1,
                   true,
                   corners});
  const Entity half = Plane{.normal = {0.6, 0.8, 0}, .position = {0.3, 0, 0}};
  const Entity sphere = Sphere{};
  rooms.push_back({"half a ball", {sphere ^ half}});
  rooms.push_back({"ball of two halves", {(sphere ^ half) + (sphere - half)}});
  rooms.push_back({"a ball and itself", {sphere + sphere, sphere}});
  // These are slabs butted against each other.
  rooms.push_back({"slabs",
                   {Box{.corner_a = {1, -2, -2}, .corner_b = {2, 2, 2}},
                    Box{.corner_a = {-2, -2, -2}, .corner_b = {-1, 2, 2}},
                    Box{.corner_a = {-1, 1, -2}, .corner_b = {1, 2, 2}},
                    Box{.corner_a = {-1, -2, -2}, .corner_b = {1, -1, 2}},
                    Box{.corner_a = {-1, -1, 1}, .corner_b = {1, 1, 2}},
                    Box{.corner_a = {-1, -1, -2}, .corner_b = {1, 1, -1}}},
                   {0, 0, 0},
                   0.1,
                   false,
                   corners});
  rooms.push_back(
      {"union of slabs", {csg_union(rooms.back().walls)}, {0, 0, 0}, 0.1, false, corners});
  return rooms;
}

std::vector<Entity> six_planes() {
  std::vector<Entity> planes;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 normal(0);
      normal[axis] = -side;
      planes.push_back(Plane{.normal = normal, .position = -normal});
    }
  }
  return planes;
}

/// Returns four half planes like the sails of a windmill, between two discs.
std::vector<Entity> windmill() {
  std::vector<Entity> walls = {Disc{.center = {0, -1, 0}, .radius = 50},
                               Disc{.center = {0, 1, 0}, .radius = 50}};
  Vec3 normal(1, 0, 0);
  Vec3 along(0, 0, 1);
  for (int i = 0; i < 4; ++i) {
    walls.push_back(HalfPlane{.normal = normal, .position = normal - along, .direction = along});
    const Vec3 next(-normal.z, 0, normal.x);
    along = Vec3(-along.z, 0, along.x);
    normal = next;
  }
  return walls;
}

struct Mesh {
  std::vector<Vec3> positions;
  std::vector<TriangleIndices> triangles;
};

/// Returns a ball of 20 * 4^n triangles.
Mesh ball_mesh(int subdivisions) {
  const double g = std::numbers::phi;
  Mesh mesh{{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Vec3& p : mesh.positions) p = glm::normalize(p);
  for (int i = 0; i < subdivisions; ++i) {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, added] = middles.try_emplace(
          {std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(mesh.positions.size()));
      if (added) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
      return entry->second;
    };
    std::vector<TriangleIndices> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      for (const TriangleIndices& triangle :
           {TriangleIndices{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
        finer.push_back(triangle);
      }
    }
    mesh.triangles = finer;
  }
  return mesh;
}

std::vector<Room> surface_rooms() {
  const std::vector<Vec3> corners = box_corners({-1, -1, -1}, {1, 1, 1});
  std::vector<Room> rooms;
  rooms.push_back({"planes", six_planes(), {0, 0, 0}, 0.1, false, corners, true});
  rooms.push_back(
      {"union of planes", {csg_union(six_planes())}, {0, 0, 0}, 0.1, false, corners, true});
  rooms.push_back({"half planes", windmill(), {0, 0, 0}, 0.1, false, corners, true});
  const Mesh mesh = ball_mesh(2);
  std::vector<Vec3> points = mesh.positions;
  for (const auto& [a, b, c] : mesh.triangles)
    points.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
  rooms.push_back(
      {"mesh", {triangle_mesh(mesh.positions, mesh.triangles)}, {0, 0, 0}, 0.1, false, points});
  return rooms;
}

}  // namespace

Room Room::placed(const Transform& map, double least_scale) const {
  Room result = *this;
  for (Entity& wall : result.walls) wall = wall.transformed(map);
  result.middle = apply(map, middle);
  result.free = free * least_scale;
  for (Vec3& corner : result.corners) corner = apply(map, corner);
  return result;
}

std::vector<Entity> Room::with_material(const Material& material) const {
  const SharedMaterial shared(material);
  std::vector<Entity> result;
  for (const Entity& wall : walls) result.push_back(wall.with_material(shared));
  return result;
}

std::vector<Room> all_rooms() {
  std::vector<Room> rooms;
  for (const auto& some : {primitive_rooms(), hollow_rooms(), csg_rooms(), surface_rooms()}) {
    rooms.insert(rooms.end(), some.begin(), some.end());
  }
  return rooms;
}

}  // namespace crt::test
