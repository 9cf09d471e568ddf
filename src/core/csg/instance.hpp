// An instance is an object that shares all but its place with others. What they share is compiled
// once, as a scene of its own: the prototype.
//
// Where a leaf of it lies in the world is found when a ray comes near. It is the same place, to the
// last bit, as that of a leaf which is compiled for the world. So rays find the same as if nothing
// were shared. The boxes around leaves are those of the prototype's space, and rays are taken there
// for them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/csg/program.hpp"
#include "core/geometry/ray_slabs.hpp"
#include "core/ray/world_ray.hpp"

namespace crt::core {

struct Instance {
  const TransformChain* to_world =
      nullptr;  ///< from the prototype's space; null if it is the world
  std::uint32_t prototype = 0;
  std::uint32_t entity_id = 0;  ///< of leaves without one of their own
  std::uint32_t part_id = 0;    ///< of such leaves
  std::uint64_t user = 0;       ///< of such leaves
  bool id_is_of_all = false;    ///< whether entity_id is that of all leaves
  bool has_part_id = false;     ///< whether part_id is not the entity's place in the scene
};

/// A ComposedPlacement is where a leaf of a prototype lies for one of the instances.
class ComposedPlacement {
 public:
  ComposedPlacement() = default;
  ComposedPlacement(const ComposedPlacement&) = delete;
  ComposedPlacement& operator=(const ComposedPlacement&) = delete;

  /// Computes where something is that `first` moves, and then `second`. They must outlive the
  /// placement. Null moves nothing.
  void set(const TransformChain* second, const TransformChain* first, Precision precision);
  const Placement& get() const { return placement_; }

 private:
  TransformChain chain_;
  Placement placement_;
};

/// An InstancePlacements keeps the placements that were computed last. One thread uses it for one
/// scene.
class InstancePlacements {
 public:
  /// Returns the placement of a kind of leaves, by its number, for one of the instances.
  /// `make(placement)` computes it. It is there until others are asked for.
  template <class Make>
  const Placement& find(std::uint32_t instance, std::uint32_t number, const Make& make) {
    if (!entries_) entries_ = std::make_unique<Entry[]>(count);
    constexpr std::uint32_t spread = 0x9e3779b1u;
    Entry& entry = entries_[(instance * spread ^ number) % count];
    if (entry.instance != instance || entry.number != number) {
      make(entry.placement);
      entry.instance = instance;
      entry.number = number;
    }
    return entry.placement.get();
  }

 private:
  static constexpr std::uint32_t count = 64;

  struct Entry {
    std::uint32_t instance = invalid_index;
    std::uint32_t number = invalid_index;
    ComposedPlacement placement;
  };
  std::unique_ptr<Entry[]> entries_;
};

/// PrototypePlacements are where the leaves of a prototype lie in its own space.
struct PrototypePlacements {
  std::span<const Placement> placements;
  std::span<const TransformChain* const> chains;  ///< their maps; null for those that move nothing
  double farthest = 0;  ///< no finite coordinate of the leaves' boxes is larger
  Precision precision = Precision::standard;
};

/// An InstanceFrame takes a ray to the leaves of one instance.
class InstanceFrame {
 public:
  /// All references must outlive it. `number` is that of the instance.
  InstanceFrame(const Instance& instance, std::uint32_t number, PrototypePlacements prototype,
                InstancePlacements& cache)
      : instance_(instance), number_(number), prototype_(prototype), cache_(cache) {}

  /// Returns where a leaf of the prototype is in the world. It is there until another is asked for.
  const Placement& placement_of(const Leaf& leaf) const {
    return placement(static_cast<std::uint32_t>(leaf.placement - prototype_.placements.data()));
  }
  /// Returns a ray of the world for tests against boxes of the prototype's space. These hold what
  /// rounding may make of the ray.
  RaySlabs slabs(const WorldRay& ray) const;

 private:
  const Placement& placement(std::uint32_t number) const {
    if (instance_.to_world == nullptr) return prototype_.placements[number];
    return cache_.find(number_, number, [&](ComposedPlacement& placement) {
      placement.set(instance_.to_world, prototype_.chains[number], prototype_.precision);
    });
  }

  const Instance& instance_;
  std::uint32_t number_;
  PrototypePlacements prototype_;
  InstancePlacements& cache_;
};

}  // namespace crt::core
