#include "core/prepare/node_list.hpp"

#include <algorithm>
#include <unordered_map>

namespace crt::core {

NodeList::NodeList(std::span<const Entity> entities, const NodeList& earlier)
    : size_(entities.size()) {
  for (std::size_t begin = 0; begin < entities.size(); begin += block_size) {
    const auto some = entities.subspan(begin, std::min(block_size, entities.size() - begin));
    const std::size_t number = begin / block_size;
    if (number < earlier.blocks_.size() &&
        std::ranges::equal(*earlier.blocks_[number], some, {}, {}, &Entity::shared_node)) {
      blocks_.push_back(earlier.blocks_[number]);
      continue;
    }
    auto block = std::make_shared<Block>();
    block->reserve(some.size());
    for (const Entity& entity : some) block->push_back(entity.shared_node());
    blocks_.push_back(std::move(block));
  }
}

std::vector<const EntityNode*> NodeList::others_than(std::span<const std::uint32_t> places) const {
  std::vector<const EntityNode*> others;
  std::size_t next = 0;
  const auto add_to = [&](std::size_t end) {
    for (; next < end; ++next) others.push_back((*this)[next].get());
  };
  for (const std::uint32_t place : places) {
    if (place == invalid_index) continue;
    add_to(place);
    ++next;
  }
  add_to(size_);
  return others;
}

std::vector<std::uint32_t> NodeList::places_of(std::span<const Entity> entities) const {
  std::vector<std::uint32_t> places(entities.size(), invalid_index);
  const std::size_t count = entities.size();
  if (count == size_) {
    for (std::size_t i = 0; i < count; ++i) {
      if (is_at(i, entities[i])) places[i] = static_cast<std::uint32_t>(i);
    }
    return places;
  }
  // What is alike at the beginning and at the end is left out of the comparison.
  const std::size_t most = std::min(count, size_);
  std::size_t begin = 0;
  for (; begin < most && is_at(begin, entities[begin]); ++begin)
    places[begin] = static_cast<std::uint32_t>(begin);
  std::size_t same = 0;
  for (; same < most - begin && is_at(size_ - same - 1, entities[count - same - 1]); ++same)
    places[count - same - 1] = static_cast<std::uint32_t>(size_ - same - 1);
  match_by_nodes(entities, begin, count - same, begin, size_ - same, places);
  return places;
}

void NodeList::match_by_nodes(std::span<const Entity> entities, std::size_t begin, std::size_t end,
                              std::size_t from, std::size_t to,
                              std::span<std::uint32_t> places) const {
  if (begin == end || from == to) return;
  // An entity that occurs more than once counts where it occurs last.
  std::unordered_map<const EntityNode*, std::size_t> of_nodes;
  for (std::size_t i = from; i < to; ++i) of_nodes[(*this)[i].get()] = i;
  for (std::size_t i = begin; i < end; ++i) {
    const auto found = of_nodes.find(entities[i].shared_node().get());
    if (found == of_nodes.end() || found->second < from) continue;
    places[i] = static_cast<std::uint32_t>(found->second);
    from = found->second + 1;
  }
}

}  // namespace crt::core
