// Each thread keeps a workspace from ray to ray.
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

/// A RayWorkspace has memory and counters that one thread reuses from ray to ray.
struct RayWorkspace {
  std::uint64_t intersection_tests = 0;  ///< rays against objects
  std::uint64_t leaf_escalations = 0;    ///< those of lone primitives: see escalations()
  CsgWorkspace csg;                      ///< counts its events itself
  NearLeavesWorkspace near_leaves;
  InstancePlacements placements;
  CrossingList crossings;
  CrossingList end_crossings;  ///< of the surface that a ray ends on
  /// These are about the last hit that has coincident ones. `here` has the crossings at its place
  /// in the order in which their objects were written. `near` has those so near that rounding may
  /// put a ray which starts there on either side of them.
  std::vector<RayHit> here;
  std::vector<RayHit> near;
  // sort_crossings() uses these.
  std::vector<std::uint32_t> numbers;
  std::vector<std::pair<std::uint32_t, RayHit>> turns;
  std::vector<NearCrossing> near_crossings;
  std::vector<RayHit> unsorted;
  /// Holds what paths_to_light() finds, by ray of a packet.
  std::array<std::vector<RayHit>, packet_size> on_paths;

  std::uint64_t interval_events() const { return csg.events; }
  /// Returns how many questions of the exact tier only exact arithmetic answered.
  std::uint64_t escalations() const { return leaf_escalations + csg.escalations; }
  /// Returns how often a ray could not be decided along an Implicit.
  std::uint64_t undecided() const { return crossings.undecided + csg.undecided(); }
  void forget_undecided() {
    crossings.undecided = 0;
    csg.forget_undecided();
  }
};

}  // namespace crt::core
