// Closed rooms of every kind, to look for leaks in.
#pragma once

#include <crt/entity.hpp>

#include <string>
#include <vector>

namespace crt::test {

struct Room {
  std::string name;
  std::vector<Entity> walls;
  Vec3 middle{0, 0, 0};      ///< somewhere inside,
  double free = 0.1;         ///< with so much free space around it
  bool within_solid = true;  ///< inside of a wall's own solid, or in the free space between walls
  std::vector<Vec3> corners{};  ///< and other points where faces meet
  bool open = false;            ///< seen from far outside it is no room any more

  /// The room with all walls moved by `map`, whose span of lengths is at least `least_scale`.
  Room placed(const Transform& map, double least_scale) const;
  /// With the material on all its walls.
  std::vector<Entity> with_material(const Material& material) const;
};

/// Rooms around the origin, some units wide.
std::vector<Room> all_rooms();

}  // namespace crt::test
