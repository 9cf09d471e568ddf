// What one thread keeps from ray to ray.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/csg/evaluate.hpp"
#include "core/csg/near_leaves.hpp"
#include "core/ray/ray_hit.hpp"
#include "core/ray/ray_packet.hpp"

namespace crt::core {

/// Memory and counters that one thread reuses from ray to ray.
struct RayWorkspace {
  std::uint64_t intersection_tests = 0;  ///< rays against objects
  std::uint64_t leaf_escalations = 0;    ///< of lone primitives: see escalations()
  CsgWorkspace csg;                      ///< counts its events itself
  NearLeavesWorkspace near_leaves;
  CrossingList crossings;
  /// Of the last hit that has company: the crossings at its place in the order in which their
  /// objects were written, and those so near that rounding may put a ray which starts there on
  /// either side of them.
  std::vector<RayHit> here;
  std::vector<RayHit> near;
  std::vector<std::uint32_t> numbers;                   ///< of what is sorted
  std::vector<std::pair<std::uint32_t, RayHit>> turns;  ///< of what is at one place
  std::vector<NearCrossing> near_crossings;             ///< of what t does not tell apart
  std::vector<RayHit> unsorted;  ///< the same as it was before that is sorted
  /// By ray of a packet: what paths_to_light() finds.
  std::array<std::vector<RayHit>, packet_size> on_paths;

  std::uint64_t interval_events() const { return csg.events; }
  /// Questions of the exact tier that only exact arithmetic answered.
  std::uint64_t escalations() const { return leaf_escalations + csg.escalations; }
};

}  // namespace crt::core
