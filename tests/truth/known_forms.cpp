#include "truth/known_forms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "crt/primitives.hpp"
#include "geometry/custom_shapes.hpp"

namespace crt::truth {

using namespace test;

namespace {

constexpr double pi = std::numbers::pi;

double size(Random& random) {
  return random.one_in(2) ? 0.25 * static_cast<double>(1 + random.bits() % 12)
                          : random.uniform(0.1, 3);
}

Vec3 sizes(Random& random) {
  const double x = size(random);
  const double y = size(random);
  return {x, y, size(random)};
}

Vec3 place(Random& random) {
  const Vec3 at = 4.0 * random.in_cube();
  return random.one_in(2) ? glm::round(at) : at;
}

/// Returns one that is symmetric about a point, and reaches so far along the axes.
Known symmetric(const char* name, const Entity& solid, double volume, double area,
                const Vec3& middle, const Vec3& reach) {
  return {.name = name,
          .solid = solid,
          .volume = volume,
          .area = area,
          .centroid = middle,
          .has_centroid = true,
          .lower = middle - reach,
          .upper = middle + reach};
}

Known box(Random& random) {
  const Vec3 a = place(random);
  const Vec3 s = sizes(random);
  const Vec3 b = a + s;
  return symmetric("box", Box{.corner_a = a, .corner_b = b}, s.x * s.y * s.z,
                   2 * (s.x * s.y + s.y * s.z + s.z * s.x), 0.5 * (a + b), 0.5 * (b - a));
}

Known sphere(Random& random) {
  const Vec3 at = place(random);
  const double r = size(random);
  return symmetric("sphere", Sphere{.center = at, .radius = r}, 4 * pi / 3 * r * r * r,
                   4 * pi * r * r, at, Vec3(r));
}

/// Returns how far a disc reaches across a direction, along the axes.
Vec3 reach_of_disc(const Vec3& normal, double radius) {
  const Vec3 n = normal / glm::length(normal);
  return radius * glm::sqrt(glm::max(Vec3(1) - n * n, Vec3(0)));
}

Known cylinder(Random& random) {
  const Vec3 from = place(random);
  const Vec3 axis = 2.0 * random.direction();
  const double r = size(random);
  const double h = glm::length(axis);
  return symmetric("cylinder", Cylinder{.from = from, .to = from + axis, .radius = r},
                   pi * r * r * h, 2 * pi * r * (r + h), from + 0.5 * axis,
                   0.5 * glm::abs(axis) + reach_of_disc(axis, r));
}

Known frustum(Random& random) {
  const Vec3 from = place(random);
  const Vec3 axis = 2.0 * random.direction();
  const double r = size(random);
  const double q = random.one_in(3) ? 0 : size(random);
  const double h = glm::length(axis);
  const double squares = r * r + r * q + q * q;
  const Vec3 one = reach_of_disc(axis, r);
  const Vec3 other = reach_of_disc(axis, q);
  return {.name = "cone",
          .solid = Cone{.from = from, .to = from + axis, .radius = r, .radius2 = q},
          .volume = pi * h * squares / 3,
          .area = pi * (r * r + q * q + (r + q) * std::hypot(h, r - q)),
          .centroid = from + (r * r + 2 * r * q + 3 * q * q) / (4 * squares) * axis,
          .has_centroid = true,
          .lower = glm::min(from - one, from + axis - other),
          .upper = glm::max(from + one, from + axis + other)};
}

Known torus(Random& random) {
  const Vec3 at = place(random);
  const Vec3 axis = random.direction();
  const double ring = size(random);
  const double tube = ring * random.uniform(0.05, 0.95);
  return symmetric("torus", Torus{.center = at, .axis = axis, .radius = ring, .thickness = tube},
                   2 * pi * pi * ring * tube * tube, 4 * pi * pi * ring * tube, at,
                   reach_of_disc(axis, ring) + Vec3(tube));
}

Known capsule(Random& random) {
  const Vec3 from = place(random);
  const Vec3 axis = 2.0 * random.direction();
  const double r = size(random);
  const double h = glm::length(axis);
  return symmetric("capsule", Capsule{.from = from, .to = from + axis, .radius = r},
                   pi * r * r * (h + 4 * r / 3), 2 * pi * r * (h + 2 * r), from + 0.5 * axis,
                   0.5 * glm::abs(axis) + Vec3(r));
}

Known rounded_box(Random& random) {
  const Vec3 a = place(random);
  const Vec3 s = sizes(random);
  const double r = std::min({s.x, s.y, s.z}) * random.uniform(0.01, 0.49);
  const Vec3 t = s - Vec3(2 * r);
  const double flat = t.x * t.y + t.y * t.z + t.z * t.x;
  const double edges = t.x + t.y + t.z;
  return symmetric("rounded box", RoundedBox{.corner_a = a, .corner_b = a + s, .radius = r},
                   t.x * t.y * t.z + 2 * r * flat + pi * r * r * edges + 4 * pi / 3 * r * r * r,
                   2 * flat + 2 * pi * r * edges + 4 * pi * r * r, a + 0.5 * s, 0.5 * s);
}

/// Returns a quadric whose area is not asked for.
Known ellipsoid(Random& random) {
  const Vec3 s = sizes(random);
  const Vec3 at = place(random);
  const Vec3 squares = Vec3(1) / (s * s);
  return symmetric("ellipsoid",
                   Quadric{.squares = squares,
                           .linear = -2.0 * squares * at,
                           .constant = glm::dot(squares, at * at) - 1},
                   4 * pi / 3 * s.x * s.y * s.z, NAN, at, s);
}

/// Returns what two spheres have in common, one without the other, or both.
Known two_spheres(Random& random) {
  const double r = size(random);
  const double q = r * random.uniform(0.5, 1);
  const double d = random.uniform(r - q + 0.05 * r, r + q - 0.05 * r);
  const Vec3 at = place(random);
  const Vec3 way = random.direction();
  const Entity a = Sphere{.center = at, .radius = r};
  const Entity b = Sphere{.center = at + d / glm::length(way) * way, .radius = q};
  const double height_a = r - (d * d + r * r - q * q) / (2 * d);
  const double height_b = q - (d * d + q * q - r * r) / (2 * d);
  const auto cap = [](double radius, double h) { return pi * h * h * (3 * radius - h) / 3; };
  const double common = cap(r, height_a) + cap(q, height_b);
  const double common_area = 2 * pi * (r * height_a + q * height_b);
  const double volume_a = 4 * pi / 3 * r * r * r;
  const double area_a = 4 * pi * r * r;
  switch (random.bits() % 3) {
    case 0:
      return {.name = "lens", .solid = a ^ b, .volume = common, .area = common_area};
    case 1:
      return {.name = "bitten ball",
              .solid = a - b,
              .volume = volume_a - common,
              .area = area_a - 2 * pi * r * height_a + 2 * pi * q * height_b};
    default:
      return {.name = "two balls",
              .solid = a + b,
              .volume = volume_a + 4 * pi / 3 * q * q * q - common,
              .area = area_a + 4 * pi * q * q - common_area};
  }
}

/// Returns a plate with holes through both faces, whose ends are flush or beyond.
Known drilled_plate(Random& random) {
  const int holes = 1 + static_cast<int>(random.bits() % 8);
  const double height = size(random);
  const double r = random.uniform(0.05, 0.45);
  const double beyond = random.one_in(2) ? 0 : size(random);
  Entity plate = Box{.corner_a = {0, 0, 0}, .corner_b = {static_cast<double>(holes), height, 1}};
  for (int i = 0; i < holes; ++i) {
    plate = plate - Entity(Cylinder{.from = {i + 0.5, -beyond, 0.5},
                                    .to = {i + 0.5, height + beyond, 0.5},
                                    .radius = r});
  }
  const double flat = holes - holes * pi * r * r;
  return symmetric("drilled plate", plate, flat * height,
                   2 * flat + 2 * height * (holes + 1) + holes * 2 * pi * r * height,
                   {0.5 * holes, 0.5 * height, 0.5}, {0.5 * holes, 0.5 * height, 0.5});
}

Known steinmetz(Random& random) {
  const double r = size(random);
  const Cylinder along_x{.from = {-2 * r, 0, 0}, .to = {2 * r, 0, 0}, .radius = r};
  const Cylinder along_y{.from = {0, -2 * r, 0}, .to = {0, 2 * r, 0}, .radius = r};
  return symmetric("Steinmetz's solid", Entity(along_x) ^ Entity(along_y), 16 * r * r * r / 3,
                   16 * r * r, Vec3(0), {r, r, r});
}

/// Returns a tube that turns by an angle, of a rectangle or a circle: by Guldin's rules.
Known turned(Random& random) {
  const bool is_round = random.one_in(2);
  const double r = size(random);
  const double middle = r * random.uniform(1.1, 3);
  const double h = size(random);
  const bool is_whole = random.one_in(2);
  const double angle = is_whole ? 2 * pi : random.uniform(0.3, 6);
  const Contour circle = {{middle + r, 0, 1}, {middle - r, 0, 1}};
  const Contour rectangle = {{middle - r, -h}, {middle + r, -h}, {middle + r, h}, {middle - r, h}};
  const double section = is_round ? pi * r * r : 4 * r * h;
  const double around = is_round ? 2 * pi * r : 4 * (r + h);
  return {.name = "turned",
          .solid = Revolution{.profile = make_profile(std::array{is_round ? circle : rectangle}),
                              .angle = angle},
          .volume = section * middle * angle,
          .area = around * middle * angle + (is_whole ? 0 : 2 * section)};
}

/// Returns a prism of a polygon with arcs, one of which may be a hole.
Known prism(Random& random) {
  const double h = size(random);
  const double r = size(random);
  const double half = r * random.uniform(1.1, 3);
  // A slot has two half circles, and a hole in its middle.
  const Contour slot = {{half, -r}, {half, r, 1}, {-half, r}, {-half, -r, 1}};
  const double q = random.uniform(0.1, 0.9) * r;
  const Contour hole = {{q, 0, 1}, {-q, 0, 1}};
  const double flat = 4 * half * r + pi * r * r - pi * q * q;
  const double around = 4 * half + 2 * pi * r + 2 * pi * q;
  return symmetric("slotted prism",
                   Extrusion{.profile = make_profile(std::array{slot, hole}), .from = -h, .to = h},
                   2 * h * flat, 2 * flat + 2 * h * around, Vec3(0), {half + r, r, h});
}

/// Returns a tetrahedron, as a mesh.
Known tetrahedron(Random& random) {
  std::array<Vec3, 4> c{};
  double volume = 0;
  while (volume < 0.05) {
    for (Vec3& corner : c) corner = place(random);
    volume = std::abs(glm::dot(c[1] - c[0], glm::cross(c[2] - c[0], c[3] - c[0]))) / 6;
  }
  constexpr std::array<TriangleIndices, 4> sides = {
      TriangleIndices{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  double area = 0;
  for (const auto& [i, j, k] : sides)
    area += 0.5 * glm::length(glm::cross(c[j] - c[i], c[k] - c[i]));
  return {.name = "tetrahedron",
          .solid = Mesh{.triangles = mesh_triangles(c, sides)},
          .volume = volume,
          .area = area,
          .centroid = 0.25 * (c[0] + c[1] + c[2] + c[3]),
          .has_centroid = true,
          .lower = glm::min(glm::min(c[0], c[1]), glm::min(c[2], c[3])),
          .upper = glm::max(glm::max(c[0], c[1]), glm::max(c[2], c[3]))};
}

/// Returns a field of heights that rise evenly. Its area is that of a cut box.
Known ramp(Random& random) {
  const Vec3 a = place(random);
  const Vec3 s = sizes(random);
  const double low = random.uniform(0.1, 0.9);
  const double front = 0.5 * (low + 1) * s.x * s.y;
  const double top = std::hypot(s.x, (1 - low) * s.y) * s.z;
  return {.name = "ramp",
          .solid = HeightField{.heights = make_height_grid({low, 1, low, 1}, 2, 2),
                               .corner_a = a,
                               .corner_b = a + s},
          .volume = front * s.z,
          .area = 2 * front + top + s.x * s.z + (1 + low) * s.y * s.z,
          .lower = a,
          .upper = a + s};
}

Known custom(Random& random) {
  Known known = sphere(random);
  known.name = "custom";
  known.solid =
      as_custom(Sphere{.center = known.centroid, .radius = 0.5 * (known.upper.x - known.lower.x)});
  return known;
}

// ---- bodies of unit cubes ----

/// A Cubes is a tree of boxes with whole numbers, and which unit cubes are in it.
class Cubes {
 public:
  explicit Cubes(Random& random) : random_(random) {}

  static constexpr int reach = 6;
  using Filled = std::vector<bool>;

  std::pair<Entity, Filled> tree(int levels) {
    if (levels == 0 || random_.one_in(5)) return leaf();
    auto [entity, filled] = tree(levels - 1);
    const int count = 1 + static_cast<int>(random_.bits() % 2);
    for (int i = 0; i < count; ++i) {
      const auto [other, others] = tree(static_cast<int>(random_.bits() % levels));
      const std::uint64_t tenth = random_.bits() % 10;
      entity = tenth < 5 ? entity + other : tenth < 9 ? entity - other : entity ^ other;
      for (std::size_t k = 0; k < filled.size(); ++k) {
        filled[k] = tenth < 5   ? filled[k] || others[k]
                    : tenth < 9 ? filled[k] && !others[k]
                                : filled[k] && others[k];
      }
    }
    return {entity, filled};
  }
  static std::size_t index(int x, int y, int z) {
    constexpr int side = 2 * reach;
    return static_cast<std::size_t>(((x + reach) * side + y + reach) * side + z + reach);
  }
  static bool is_filled(const Filled& filled, const std::array<int, 3>& at) {
    for (const int i : at)
      if (i < -reach || i >= reach) return false;
    return filled[index(at[0], at[1], at[2])];
  }

 private:
  int whole(int low, int high) {
    return low + static_cast<int>(random_.bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  std::pair<Entity, Filled> leaf() {
    Vec3 a(0);
    Vec3 b(0);
    for (int axis = 0; axis < 3; ++axis) {
      a[axis] = whole(-4, 3);
      b[axis] = a[axis] + whole(1, 3);
    }
    Filled filled(8 * reach * reach * reach);
    for (int x = static_cast<int>(a.x); x < b.x; ++x)
      for (int y = static_cast<int>(a.y); y < b.y; ++y)
        for (int z = static_cast<int>(a.z); z < b.z; ++z) filled[index(x, y, z)] = true;
    return {Box{.corner_a = a, .corner_b = b}, filled};
  }

  Random& random_;
};

Known cubes(Random& random) {
  const auto [entity, filled] = Cubes(random).tree(static_cast<int>(random.bits() % 7));
  Known known{.name = "cubes", .solid = entity};
  Vec3 first(0);
  for (int x = -Cubes::reach; x < Cubes::reach; ++x) {
    for (int y = -Cubes::reach; y < Cubes::reach; ++y) {
      for (int z = -Cubes::reach; z < Cubes::reach; ++z) {
        if (!Cubes::is_filled(filled, {x, y, z})) continue;
        const Vec3 corner(x, y, z);
        known.lower = known.volume == 0 ? corner : glm::min(known.lower, corner);
        known.upper =
            known.volume == 0 ? corner + Vec3(1) : glm::max(known.upper, corner + Vec3(1));
        known.volume += 1;
        first += corner + Vec3(0.5);
        for (const std::array<int, 3>& next : {std::array{x - 1, y, z},
                                               {x + 1, y, z},
                                               {x, y - 1, z},
                                               {x, y + 1, z},
                                               {x, y, z - 1},
                                               {x, y, z + 1}})
          known.area += Cubes::is_filled(filled, next) ? 0 : 1;
      }
    }
  }
  known.has_centroid = known.volume > 0;
  if (known.has_centroid) known.centroid = first / known.volume;
  return known;
}

}  // namespace

Known random_known(Random& random) {
  using Make = Known (*)(Random&);
  constexpr std::array<Make, 17> makers = {
      box,         sphere,    cylinder,      frustum, torus,  capsule,
      rounded_box, ellipsoid, two_spheres,   prism,   turned, ramp,
      tetrahedron, steinmetz, drilled_plate, custom,  cubes};
  // Half of all are of unit cubes, whose faces coincide, or of plates with flush holes.
  if (random.one_in(2)) return random.one_in(4) ? drilled_plate(random) : cubes(random);
  return makers[random.bits() % makers.size()](random);
}

}  // namespace crt::truth
