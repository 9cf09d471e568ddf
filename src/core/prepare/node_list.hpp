// The entities of a scene are remembered, so that an edited scene is compared with it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/invalid_index.hpp"
#include "core/entity/entity_node.hpp"

namespace crt::core {

/// A NodeList holds the nodes of a scene's entities, so that no other entity gets their address.
/// Lists of edited scenes share what did not change, as to count references takes time.
class NodeList {
 public:
  NodeList() = default;
  /// Shares with an earlier list, which may be empty, the blocks that are the same.
  NodeList(std::span<const Entity> entities, const NodeList& earlier);

  std::size_t size() const { return size_; }
  const EntityPointer& operator[](std::size_t i) const {
    return (*blocks_[i / block_size])[i % block_size];
  }
  /// Returns for each entity of an edited scene its place in this list, or invalid_index if it is
  /// not there, or not in the order of the others.
  std::vector<std::uint32_t> places_of(std::span<const Entity> entities) const;
  /// Returns the nodes that have none of these places, which ascend but for invalid_index.
  std::vector<const EntityNode*> others_than(std::span<const std::uint32_t> places) const;
  /// Returns the bytes of memory that it takes.
  std::uint64_t bytes() const { return size_ * sizeof(EntityPointer); }

 private:
  static constexpr std::size_t block_size = 1024;
  using Block = std::vector<EntityPointer>;

  bool is_at(std::size_t place, const Entity& entity) const {
    return place < size_ && (*this)[place] == entity.shared_node();
  }
  /// Fills in the places of entities from `begin` to `end`, which may be those from `from` to `to`.
  void match_by_nodes(std::span<const Entity> entities, std::size_t begin, std::size_t end,
                      std::size_t from, std::size_t to, std::span<std::uint32_t> places) const;

  std::vector<std::shared_ptr<const Block>> blocks_;
  std::size_t size_ = 0;
};

}  // namespace crt::core
