// What rays may ask for beside the nearest hit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/ray/ray_hit.hpp"
#include "core/ray/ray_packet.hpp"

namespace crt::core {

/// A solid that a ray is inside of when it starts, and where the ray leaves it (at infinity:
/// never).
struct Stay {
  bool inside = false;
  RayHit exit;
};

/// The nearest crossings of a batch's rays, without what else a hit tells.
struct FirstLeaves {
  RayMask found = 0;  ///< of the others nothing here means anything
  RayBatch::Numbers t;
  std::array<std::uint32_t, packet_size> leaves;
};

/// Which things let no light through.
struct Opacity {
  std::vector<bool> of_materials;
  std::vector<bool> of_objects;  ///< of objects of opaque materials alone
};

/// What is on the paths of a batch's rays to a light.
struct LightPaths {
  RayMask blocked = 0;   ///< those that something opaque is on
  RayMask filtered = 0;  ///< of the others those that anything else is on
};

}  // namespace crt::core
