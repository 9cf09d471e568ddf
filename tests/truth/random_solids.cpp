#include "truth/random_solids.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "crt/field.hpp"
#include "crt/implicit_shapes.hpp"
#include "oracle/number_vec.hpp"

namespace crt::truth {

using namespace test;

namespace {

constexpr int most_levels = 6;
constexpr double room = 4;  ///< trees are within so far from the origin

Vec3 apply(const Transform& map, const Vec3& v) {
  return {glm::dot(map.row_x, v), glm::dot(map.row_y, v), glm::dot(map.row_z, v)};
}

Transform compose(const Transform& second, const Transform& first) {
  const auto row = [&](const Vec3& r) {
    return r.x * first.row_x + r.y * first.row_y + r.z * first.row_z;
  };
  return {row(second.row_x), row(second.row_y), row(second.row_z),
          apply(second, first.translation) + second.translation};
}

/// A Maker makes the parts of one tree.
class Maker {
 public:
  Maker(std::uint64_t number, Leaves leaves)
      : random_(7919 * number + 1), on_grid_(number % 2 == 0), leaves_(leaves) {}

  SolidTree tree() {
    SolidTree whole;
    whole.kind = SolidTree::Kind::intersection;
    SolidTree box;
    box.primitive = Box{.corner_a = Vec3(-room), .corner_b = Vec3(room)};
    whole.parts = {part(integer(0, most_levels - 1), Transform{}), box};
    return whole;
  }

 private:
  int integer(int low, int high) {
    return low + static_cast<int>(random_.bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  /// Returns a length, which is a whole number of halves on the grid.
  double length(double low, double high) {
    if (!on_grid_) return random_.uniform(low, high);
    return integer(static_cast<int>(std::ceil(2 * low)), static_cast<int>(2 * high)) / 2.0;
  }
  Vec3 place() {
    const double x = length(-2, 2);
    const double y = length(-2, 2);
    return {x, y, length(-2, 2)};
  }
  Vec3 axis() {
    Vec3 along(0);
    along[integer(0, 2)] = random_.one_in(2) ? 1 : -1;
    return on_grid_ ? along : random_.direction();
  }
  Vec3 sizes() {
    const double x = length(0.5, 3);
    const double y = length(0.5, 3);
    return {x, y, length(0.5, 3)};
  }

  SolidTree part(int levels, const Transform& outer) {
    SolidTree tree;
    tree.own = own_map();
    tree.to_world = compose(outer, tree.own);
    if (levels == 0 || random_.one_in(5)) {
      tree.primitive = leaf();
      return tree;
    }
    const int tenth = integer(0, 9);
    tree.kind = tenth < 4   ? SolidTree::Kind::set_union
                : tenth < 8 ? SolidTree::Kind::difference
                            : SolidTree::Kind::intersection;
    const int count = random_.one_in(4) ? 3 : 2;
    for (int i = 0; i < count; ++i) {
      // The same part comes twice now and then, which makes much of what coincides.
      const bool again = i > 0 && random_.one_in(10);
      tree.parts.push_back(again
                               ? tree.parts[0]
                               : part(i == 0 ? levels - 1 : integer(0, levels - 1), tree.to_world));
    }
    return tree;
  }

  Transform own_map() {
    if (!random_.one_in(4)) return {};
    if (!on_grid_) {
      double factor = 1;
      Transform map = random_.one_in(2) ? random_map(random_) : random_even_map(random_, factor);
      map.row_x /= factor;
      map.row_y /= factor;
      map.row_z /= factor;
      map.translation = random_.in_cube();
      return map;
    }
    const double x = 90.0 * integer(0, 3);
    const double y = 90.0 * integer(0, 3);
    Transform map = rotate_degrees({x, y, 90.0 * integer(0, 3)});
    if (random_.one_in(3)) map = compose(scale(Vec3(-1, 1, 1)), map);
    if (random_.one_in(4)) map = compose(scale(random_.one_in(2) ? 0.5 : 2.0), map);
    const double shift = integer(-2, 2) / 2.0;
    map.translation = {shift, integer(-2, 2) / 2.0, integer(-2, 2) / 2.0};
    return map;
  }

  Quadric quadric() {
    const Vec3 at = place();
    const Vec3 n = axis();
    const Vec3 along = n * n / glm::dot(n, n);
    const double size = length(0.5, 2);
    // Balls, cylinders, hyperboloids, and slabs.
    const int kind = integer(0, 3);
    const Vec3 squares = kind < 3 ? Vec3(1) - static_cast<double>(kind) * along : along;
    return {.squares = squares,
            .linear = -2.0 * squares * at,
            .constant = glm::dot(squares, at * at) - size * size};
  }

  Extrusion extrusion() {
    const double low = length(-2, 1);
    return {.profile = profile(-2), .from = low, .to = low + length(0.5, 2)};
  }
  std::shared_ptr<const Profile> profile(double least_x) {
    while (true) {
      std::array<Vec3, 3> corners{};
      for (Vec3& corner : corners) corner = {length(least_x, 2), length(-2, 2), 0};
      const double bulge = on_grid_ ? (random_.one_in(2) ? 1 : -1) : random_.uniform(-1, 1);
      const auto made = arched_triangle(corners, bulge);
      const auto is_right_of_axis = [&] {
        const ArchedTriangle known(*made);
        return known.center.x - known.radius >= 0;
      };
      if (made && (least_x < 0 || is_right_of_axis())) return made;
    }
  }

  Primitive leaf() {
    const Vec3 at = place();
    switch (integer(0, leaves_ == Leaves::all ? 16 : 14)) {
      case 0:
        return Sphere{.center = at, .radius = length(0.5, 2)};
      case 1:
        return Plane{.normal = axis(), .position = at};
      case 2:
        return Cylinder{.from = at, .to = at + length(0.5, 3) * axis(), .radius = length(0.5, 2)};
      case 3:
        return Cone{.from = at,
                    .to = at + length(0.5, 3) * axis(),
                    .radius = length(0.5, 2),
                    .radius2 = length(0, 2)};
      case 4:
        return Torus{.center = at,
                     .axis = axis(),
                     .radius = length(0.5, 2),
                     .thickness = on_grid_ ? integer(1, 4) / 4.0 : random_.uniform(0.1, 1.5)};
      case 5:
        return Capsule{.from = at, .to = at + length(0.5, 2) * axis(), .radius = length(0.5, 1.5)};
      case 6:
        return quadric();
      case 7:
        return RoundedBox{.corner_a = at,
                          .corner_b = at + sizes(),
                          .radius = on_grid_ ? integer(0, 1) / 4.0 : random_.uniform(0, 0.25)};
      case 8:
        return extrusion();
      case 9:
        return Revolution{
            .profile = profile(0),
            .angle = random_.one_in(2) ? 2 * std::numbers::pi : random_.uniform(0.5, 6)};
      case 10:
        return HeightField{.heights = make_height_grid({share(), share(), share(), 1}, 2, 2),
                           .corner_a = at,
                           .corner_b = at + sizes()};
      case 11:
        return some_tetrahedron();
      case 15:
        return superellipsoid(random_.uniform(0.5, 1.5), random_.uniform(0.5, 1.5));
      case 16:
        return wave();
      default:
        return Box{.corner_a = at, .corner_b = at + sizes()};
    }
  }
  double share() { return on_grid_ ? integer(0, 4) / 4.0 : random_.uniform(0, 1); }

  Mesh some_tetrahedron() {
    while (true) {
      const Mesh mesh = tetrahedron({place(), place(), place(), place()});
      if (mesh.triangles == nullptr) continue;
      const std::vector<Triangle> sides = triangles_of(mesh);
      const Vec3 a = sides[0].a;
      const double volume = glm::dot(sides[0].b - a, glm::cross(sides[0].c - a, sides[1].c - a));
      if (std::abs(volume) > 0.1) return mesh;
    }
  }
  Implicit wave() {
    const double strength = random_.uniform(0.2, 0.9);
    const Field field = Field::y() - strength * sin(2 * Field::x()) * cos(Field::z());
    return {.field = field, .lower = Vec3(-2), .upper = Vec3(2)};
  }

  Random random_;
  bool on_grid_;
  Leaves leaves_;
};

Transform turn(Random& random) {
  const Vec3 x = random.direction();
  Vec3 y = random.direction();
  while (std::abs(glm::dot(x, y)) > 0.9 * glm::length(x) * glm::length(y)) y = random.direction();
  const Vec3 along = glm::normalize(x);
  const Vec3 up = glm::normalize(glm::cross(along, y));
  const Vec3 beside = glm::cross(up, along);
  Transform map;
  map.row_x = {along.x, beside.x, up.x};
  map.row_y = {along.y, beside.y, up.y};
  map.row_z = {along.z, beside.z, up.z};
  if (random.one_in(2)) map = compose(scale(Vec3(1, 1, -1)), map);
  return map;
}

}  // namespace

SolidTree random_solid(std::uint64_t number, Leaves leaves) {
  return Maker(number, leaves).tree();
}

Transform random_even_map(Random& random, double& factor) {
  factor = random.power_of_ten(-3, 3);
  Transform map = compose(scale(factor), turn(random));
  map.translation = factor * random.power_of_ten(-2, 2) * random.in_cube();
  return map;
}

Transform random_map(Random& random) {
  const auto factor = [&] { return random.uniform(0.5, 2); };
  const double x = factor();
  const double y = factor();
  Transform map = compose(turn(random), compose(scale(Vec3(x, y, factor())), turn(random)));
  map.translation = random.in_cube();
  return map;
}

double determinant_of(const Transform& map) {
  return glm::dot(map.row_x, glm::cross(map.row_y, map.row_z));
}

Vec3 moved(const Transform& map, const Vec3& point) {
  return apply(map, point) + map.translation;
}

}  // namespace crt::truth
