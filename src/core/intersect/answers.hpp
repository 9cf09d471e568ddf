// Rays may ask for these things beside the nearest hit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/ray/ray_hit.hpp"
#include "core/ray/ray_packet.hpp"

namespace crt::core {

/// A SolidExit says whether a ray starts inside of a solid, and where it leaves that; at infinity
/// if never.
struct SolidExit {
  bool inside = false;
  RayHit exit;
};

/// A ContainingSolid is the innermost solid around a point, with the first of its leaves that hold
/// the point. There is none if `object` is nothing.
struct ContainingSolid {
  std::uint32_t object = invalid_index;
  std::uint32_t leaf = invalid_index;
};

struct MaterialTable;

/// An Opacity says which things let no light through.
struct Opacity {
  const MaterialTable* materials = nullptr;
  std::vector<bool> of_materials;
  std::vector<bool> of_objects;  ///< true for objects of opaque materials alone
};

/// A LightPaths says what is on the paths of a batch's rays to a light.
struct LightPaths {
  RayMask blocked = 0;   ///< rays that meet something opaque
  RayMask filtered = 0;  ///< other rays that meet anything
};

}  // namespace crt::core
