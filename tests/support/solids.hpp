// These are random CSG trees of boxes, spheres, half-spaces and cylinders, with an independent
// answer to "is this point inside?": by the definition of each solid, in quadruple precision.
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "crt/entity.hpp"
#include "support/quad.hpp"

namespace crt::test {

struct QuadPoint {
  Quad x = 0;
  Quad y = 0;
  Quad z = 0;
};

/// A Solid knows itself twice: as an entity, and by definition.
struct Solid {
  enum class Kind { box, sphere, half_space, cylinder, set_union, intersection, difference };

  Kind kind = Kind::box;
  // A box has corners; a sphere has centre and radius; a half_space has a point and a normal; a
  // cylinder along z has base, radius and height.
  Vec3 a{0};
  Vec3 b{0};
  double size = 0;
  std::vector<Solid> parts;

  bool contains(const QuadPoint& p) const {
    switch (kind) {
      case Kind::box:
        return p.x > a.x && p.x < b.x && p.y > a.y && p.y < b.y && p.z > a.z && p.z < b.z;
      case Kind::sphere: {
        const Quad x = p.x - a.x;
        const Quad y = p.y - a.y;
        const Quad z = p.z - a.z;
        return x * x + y * y + z * z < Quad(size) * size;
      }
      case Kind::half_space:
        return (p.x - a.x) * b.x + (p.y - a.y) * b.y + (p.z - a.z) * b.z < 0;
      case Kind::cylinder: {
        const Quad x = p.x - a.x;
        const Quad y = p.y - a.y;
        return x * x + y * y < Quad(size) * size && p.z > a.z && p.z < b.z;
      }
      case Kind::set_union:
        for (const Solid& part : parts) {
          if (part.contains(p)) return true;
        }
        return false;
      case Kind::intersection:
        for (const Solid& part : parts) {
          if (!part.contains(p)) return false;
        }
        return true;
      case Kind::difference:
        for (std::size_t i = 1; i < parts.size(); ++i) {
          if (parts[i].contains(p)) return false;
        }
        return parts[0].contains(p);
    }
    return false;
  }

  Entity entity() const {
    std::vector<Entity> made;
    for (const Solid& part : parts) made.push_back(part.entity());
    switch (kind) {
      case Kind::box:
        return Box{.corner_a = a, .corner_b = b};
      case Kind::sphere:
        return Sphere{.center = a, .radius = size};
      case Kind::half_space:
        return Plane{.normal = b, .position = a};
      case Kind::cylinder:
        return Cylinder{.from = a, .to = {a.x, a.y, b.z}, .radius = size};
      case Kind::set_union:
        return csg_union(made);
      case Kind::intersection:
        return csg_intersection(made);
      case Kind::difference:
        break;
    }
    return csg_difference(made[0], std::span(made).subspan(1));
  }

  /// Collects every t at which the ray passes a surface of any part, unsorted. Membership may
  /// change there.
  void candidate_ts(const Vec3& o, const Vec3& d, std::vector<Quad>& out) const {
    const auto plane = [&](int axis, double at) {
      if (d[axis] != 0) out.push_back((Quad(at) - o[axis]) / d[axis]);
    };
    const auto quadric = [&](int axes) {
      Quad qa = 0;
      Quad qb = 0;
      Quad qc = -Quad(size) * size;
      for (int axis = 0; axis < axes; ++axis) {
        const Quad f = Quad(o[axis]) - a[axis];
        qa += Quad(d[axis]) * d[axis];
        qb += f * d[axis];
        qc += f * f;
      }
      const Quad discriminant = qb * qb - qa * qc;
      if (qa == 0 || discriminant <= 0) return;
      const Quad root = square_root(discriminant);
      out.push_back((-qb - root) / qa);
      out.push_back((-qb + root) / qa);
    };
    if (kind == Kind::box) {
      for (int axis = 0; axis < 3; ++axis) {
        plane(axis, a[axis]);
        plane(axis, b[axis]);
      }
    } else if (kind == Kind::sphere) {
      quadric(3);
    } else if (kind == Kind::cylinder) {
      quadric(2);
      plane(2, a.z);
      plane(2, b.z);
    } else if (kind == Kind::half_space) {
      const Quad across = Quad(d.x) * b.x + Quad(d.y) * b.y + Quad(d.z) * b.z;
      const Quad height =
          (Quad(a.x) - o.x) * b.x + (Quad(a.y) - o.y) * b.y + (Quad(a.z) - o.z) * b.z;
      if (across != 0) out.push_back(height / across);
    }
    for (const Solid& part : parts) part.candidate_ts(o, d, out);
  }

  static Quad square_root(Quad value) {
    // Newton's iteration doubles the digits of the double-precision root twice over.
    Quad root = __builtin_sqrt(static_cast<double>(value));
    for (int i = 0; i < 3; ++i) root = (root + value / root) / 2;
    return root;
  }
};

/// Returns what of a solid is in a box, so that it is finite.
inline Solid in_room(const Solid& solid) {
  Solid room;
  room.a = Vec3(-4);
  room.b = Vec3(4);
  return {.kind = Solid::Kind::intersection, .a = {}, .b = {}, .size = 0, .parts = {solid, room}};
}

/// A SolidMaker makes random solids whose numbers are small integers, so that most of their faces
/// coincide.
class SolidMaker {
 public:
  explicit SolidMaker(std::uint32_t seed) : random_(seed) {}

  int integer(int lowest, int highest) {
    return std::uniform_int_distribution<int>(lowest, highest)(random_);
  }
  double real(double lowest, double highest) {
    return std::uniform_real_distribution<double>(lowest, highest)(random_);
  }
  Vec3 grid_point() { return {integer(-3, 3), integer(-3, 3), integer(-3, 3)}; }

  Solid leaf() {
    Solid solid;
    solid.a = grid_point();
    switch (integer(0, 9)) {
      case 0:
      case 1:
        solid.kind = Solid::Kind::sphere;
        solid.size = integer(1, 3);
        break;
      case 2:
        solid.kind = Solid::Kind::half_space;
        solid.b = {0, 0, 0};
        solid.b[integer(0, 2)] = integer(0, 1) == 0 ? -1 : 1;
        break;
      case 3:
      case 4:
        solid.kind = Solid::Kind::cylinder;
        solid.size = integer(1, 3);
        solid.b.z = solid.a.z + integer(1, 3);
        break;
      default:
        solid.b = solid.a + Vec3(integer(1, 4), integer(1, 4), integer(1, 4));
    }
    return solid;
  }

  Solid tree(int depth) {
    if (depth == 0 || integer(0, 5) == 0) return leaf();
    Solid solid;
    const Solid::Kind kinds[] = {Solid::Kind::set_union, Solid::Kind::intersection,
                                 Solid::Kind::difference};
    solid.kind = kinds[integer(0, 2)];
    const int count = integer(2, 3);
    for (int i = 0; i < count; ++i) solid.parts.push_back(tree(depth - 1));
    return solid;
  }

 private:
  std::mt19937 random_;
};

}  // namespace crt::test
