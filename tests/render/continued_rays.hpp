// Convex solids of every kind of primitive, in all kinds of places, and checks of the rays that go
// on from them.
#pragma once

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "support/numbers.hpp"

namespace crt::test {

/// Prepares a scene of some entities.
inline PreparedScene prepared(std::vector<Entity> entities,
                              Precision precision = Precision::standard) {
  Scene scene;
  scene.entities = std::move(entities);
  scene.settings.precision = precision;
  return prepare(scene);
}

/// A ConvexSolid lies within a ball of radius 1 or so about the origin, or reaches far beyond.
struct ConvexSolid {
  std::string name;
  Entity entity;
  bool is_closed = true;  ///< has an inside, and ends
};

/// Returns one of each kind of primitive that may be convex.
std::vector<ConvexSolid> convex_solids();

/// A Placing is a place in the world for something of size 1.
struct Placing {
  std::string name;
  Transform transform;
  double size = 1;  ///< of what was 1

  Vec3 to_world(const Vec3& place) const {
    const auto& [x, y, z, by] = transform;
    return Vec3(glm::dot(x, place), glm::dot(y, place), glm::dot(z, place)) + by;
  }
  /// Returns a ray from nearby to somewhere in a solid.
  Ray ray_at(const ConvexSolid& solid, Numbers& numbers) const;
};

/// Returns places: none, turned, moved far, scaled, sheared, and all of it.
std::vector<Placing> placings(Numbers& numbers);

/// Checks that rays meet nothing, whoever asks.
void check_nothing(RayQueries& queries, std::span<const Ray> rays, const std::string& what);

/// Checks that rays leave the solid once and for all.
void check_leaving(RayQueries& queries, std::span<const Ray> rays, const std::string& what);

}  // namespace crt::test
