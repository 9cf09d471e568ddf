// These are closed rooms of every kind, to look for leaks in.
#pragma once

#include <crt/entity.hpp>

#include <string>
#include <vector>

namespace crt::test {

struct Room {
  std::string name;
  std::vector<Entity> walls;
  Vec3 middle{0, 0, 0};         ///< a point inside,
  double free = 0.1;            ///< with so much free space around it
  bool within_solid = true;     ///< whether `middle` may be inside a wall's own solid, besides the
                                ///< free space between walls
  std::vector<Vec3> corners{};  ///< and other points where faces meet
  bool open = false;            ///< whether it is open when seen from far outside

  /// Returns the room with all walls moved by `map`, whose span of lengths is at least
  /// `least_scale`.
  Room placed(const Transform& map, double least_scale) const;
  /// Returns the walls, all with the material.
  std::vector<Entity> with_material(const Material& material) const;
};

/// Returns rooms around the origin, some units wide.
std::vector<Room> all_rooms();

}  // namespace crt::test
