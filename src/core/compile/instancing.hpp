// Which entities are compiled once, however often they are placed.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/compile/part.hpp"
#include "crt/entity.hpp"

namespace crt::core {

/// Returns whether a part of an operation is the one before it once more. Without this test
/// a = a + a, done n times, would be 2^n parts.
bool repeats(const CsgOperation& operation, std::size_t part);

/// An Instancing counts how often nodes are used that are objects of a scene: entities, and parts
/// of unions at the top. What has several primitives, as a mesh has, and is used often is worth
/// sharing. A single primitive is not: rays meet it faster where it is compiled for its place.
class Instancing {
 public:
  /// Shares nothing.
  Instancing() = default;
  /// It takes O(n) for n entities and different nodes, which must outlive it.
  explicit Instancing(std::span<const Entity> entities);

  /// Returns whether all uses of a node share what it is compiled to.
  bool is_shared(const EntityNode& node) const {
    return !uses_.empty() && uses_.find(&node) != uses_.end();
  }

  /// Returns the nodes that are shared, sorted by where they are in memory.
  std::vector<const EntityNode*> shared_nodes() const;

  /// A Count is of what is compiled.
  struct Count {
    std::uint64_t primitives = 0;  ///< of shared nodes once
    std::uint64_t instances = 0;   ///< the uses of shared nodes
    std::uint64_t in_several =
        0;  ///< primitives of entities that have several; nothing else is shared
  };
  /// Counts what is compiled of entities. It stops at more than `most` of either.
  Count count(std::span<const Entity> entities, std::uint64_t most) const;

  /// Changes the count of a scene in which nothing is shared by one entity that comes or goes.
  static void add(const EntityNode& entity, Count& count);
  static void remove(const EntityNode& entity, Count& count);
  /// Returns whether some nodes may be worth sharing in a scene of which this was counted.
  static bool may_share(const Count& count);

 private:
  /// Holds the nodes that are shared, and how often they are used.
  std::unordered_map<const EntityNode*, std::uint32_t> uses_;
};

}  // namespace crt::core
