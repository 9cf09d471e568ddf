// A program may have GLM align its vectors, and uses the library as any other does.
#define GLM_FORCE_INTRINSICS
#define GLM_FORCE_DEFAULT_ALIGNED_GENTYPES
#include <doctest/doctest.h>

#include <crt/crt.hpp>
#include <crt/query.hpp>
#include <glm/vec3.hpp>

using namespace crt;

TEST_CASE("a program with aligned vectors of GLM makes scenes and asks rays") {
#ifdef __x86_64__  // where GLM knows how
  REQUIRE(sizeof(glm::dvec3) > 3 * sizeof(double));
#endif
  const glm::dvec3 center(1, 2, 3);
  Scene scene;
  scene.entities.push_back(Sphere{.center = center, .radius = 1});
  scene.entities.push_back(Box{.corner_a = {4, 1, 2}, .corner_b = {6, 3, 4}});
  const PreparedScene prepared = prepare(scene);
  const std::optional<Hit> hit =
      intersect(prepared, {.origin = {-9, 2, 3}, .direction = {1, 0, 0}});
  REQUIRE(hit);
  CHECK(hit->t == 9);
  CHECK(hit->normal == Vec3(-1, 0, 0));
  const glm::dvec3 position = hit->position;
  CHECK(position == glm::dvec3(0, 2, 3));
}
