// These tests check which faces of a scene count as one surface.
#include "core/compile/surface_table.hpp"

#include <doctest/doctest.h>

#include "core/geometry/shape.hpp"

using namespace crt;
using namespace crt::core;

namespace {

Placement placed(std::initializer_list<Transform> steps) {
  PreciseTransform all;
  for (const Transform& step : steps) all = compose(PreciseTransform(step), all);
  return Placement(all);
}

CanonicalSurface surface_of(const Primitive& primitive, std::uint32_t face,
                            const Placement& placement = {}) {
  return canonical_surface(make_shape(primitive)->surface(face), placement);
}

/// Says whether some face of `a` lies on the same surface as some face of `b`.
bool share(const Primitive& a, const Placement& a_place, const Primitive& b,
           const Placement& b_place) {
  for (std::uint32_t i = 0; i < make_shape(a)->face_count(); ++i) {
    for (std::uint32_t k = 0; k < make_shape(b)->face_count(); ++k) {
      const CanonicalSurface first = surface_of(a, i, a_place);
      const CanonicalSurface second = surface_of(b, k, b_place);
      if (first.key == second.key) {
        CHECK(first.hash() == second.hash());
        return true;
      }
    }
  }
  return false;
}

}  // namespace

TEST_CASE("opposite planes are one surface, turned round") {
  const CanonicalSurface up = surface_of(Plane{.normal = {1, 2, 3}, .position = {1, 1, 1}}, 0);
  const CanonicalSurface down = surface_of(Plane{.normal = {-2, -4, -6}, .position = {3, 0, 1}}, 0);
  CHECK(up.key == down.key);
  CHECK(up.flipped != down.flipped);
  const CanonicalSurface other =
      surface_of(Plane{.normal = {1, 2, 3}, .position = {1, 1, 1.000000000000001}}, 0);
  CHECK(other.key != up.key);
}

TEST_CASE("faces of different primitives that lie in one plane are one surface") {
  const Box box{.corner_a = {-1, 0, -1}, .corner_b = {1, 1, 1}};
  CHECK(share(box, {}, Plane{}, {}));
  CHECK(share(box, {}, Cylinder{.from = {5, 1, 5}, .to = {5, 9, 5}}, {}));
  CHECK(share(box, {}, Disc{.center = {0, 0, 0}}, {}));
  CHECK(share(box, {}, Box{.corner_a = {1, 3, 3}, .corner_b = {4, 4, 4}}, {}));
  CHECK_FALSE(share(box, {}, Box{.corner_a = {5, 5, 5}, .corner_b = {6, 6, 6}}, {}));
}

TEST_CASE("transforms that lead to one plane give one surface") {
  const Box box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}};
  CHECK(share(box, placed({translate({0, 3, 0})}), Plane{.position = {0, 4, 0}}, {}));
  CHECK(share(box, placed({scale(4)}), Plane{.normal = {0, 0, 1}, .position = {0, 0, 4}}, {}));
  CHECK(share(box, placed({rotate_degrees({90, 0, 0}), translate({0, 2, 0})}),
              Plane{.position = {0, 2, 0}}, {}));
  const Placement turned = placed({rotate_degrees({10, 20, 30}), translate({0.1, 0.2, 0.3})});
  CHECK(share(box, turned, Box{.corner_a = {1, 1, 1}, .corner_b = {2, 2, 2}}, turned));
}

TEST_CASE("round surfaces are one where all their numbers agree") {
  const Sphere ball{.center = {1, 2, 3}, .radius = 0.5};
  CHECK(share(ball, {}, ball, {}));
  CHECK(
      share(ball, {}, Sphere{.center = {0, 2, 3}, .radius = 0.5}, placed({translate({1, 0, 0})})));
  CHECK_FALSE(share(ball, {}, Sphere{.center = {1, 2, 3}, .radius = 0.6}, {}));
  CHECK_FALSE(share(ball, placed({scale(Vec3(1, 1, 2))}), ball, {}));
  const Torus ring{};
  CHECK(
      share(ring, placed({rotate_degrees({1, 2, 3})}), ring, placed({rotate_degrees({1, 2, 3})})));
}
