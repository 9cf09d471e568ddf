// Which hits of a few rays are on the same face.
#pragma once

#include <cstdint>
#include <span>

#include "core/math/lanes.hpp"
#include "core/scene/prepared_data.hpp"

namespace crt::core {

/// What hits are on, by lane.
struct HitFaces {
  LaneMask faces;
  LaneMask entering;

  explicit HitFaces(std::span<const RayHit, lane_count> hits)
      : faces{of(hits[0]), of(hits[1]), of(hits[2]), of(hits[3])},
        entering{hits[0].entering, hits[1].entering, hits[2].entering, hits[3].entering} {}

  LaneMask like(const RayHit& hit) const {
    return (faces == of(hit)) & (entering == static_cast<std::int64_t>(hit.entering));
  }

 private:
  static std::int64_t of(const RayHit& hit) {
    return static_cast<std::int64_t>(std::uint64_t{hit.face} << 32 | hit.leaf);
  }
};

}  // namespace crt::core
