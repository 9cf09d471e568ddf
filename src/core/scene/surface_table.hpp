#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include "core/csg/placement.hpp"
#include "core/csg/program.hpp"
#include "core/geometry/surface.hpp"

namespace crt::core {

/// Gives every different surface of a scene a number, and equal surfaces (bit-equal after bringing
/// them to a canonical form in the world) the same one. Opposite planes are the same surface.
class SurfaceTable {
 public:
  FaceSurface find(const Surface& surface, const Placement& placement);

 private:
  // Kind, then up to 8 numbers of the surface and 12 of a placement that does more than move.
  using Key = std::array<double, 21>;
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };

  std::uint32_t number(const Key& key);

  std::unordered_map<Key, std::uint32_t, KeyHash> numbers_;
};

}  // namespace crt::core
