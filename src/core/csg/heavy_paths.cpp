#include "core/csg/heavy_paths.hpp"

#include <algorithm>
#include <bit>

#include "core/csg/program.hpp"

namespace crt::core {

namespace {

constexpr std::uint32_t word_bits = 64;

std::uint64_t bit_of(std::uint32_t place) {
  return std::uint64_t{1} << (place % word_bits);
}

/// Returns whether a node is forced to a value by its side children. The last of a path has no
/// others.
bool is_forced_to(bool value, std::uint32_t sides, std::uint32_t needed, bool last) {
  if (value) return sides >= needed;
  return sides + (last ? 0 : 1) < needed;
}

std::uint32_t levels_of(std::span<const CsgNode> nodes) {
  std::vector<std::uint32_t> depth(nodes.size(), 1);
  for (std::size_t i = 1; i < nodes.size(); ++i) depth[i] = depth[nodes[i].parent] + 1;
  return nodes.empty() ? 0 : *std::max_element(depth.begin(), depth.end());
}

}  // namespace

HeavyPaths::HeavyPaths(std::span<const CsgNode> nodes, std::uint32_t fewest) {
  if (levels_of(nodes) < fewest) return;
  lay_out(nodes);
  fill_sets();
}

std::size_t HeavyPaths::bytes() const {
  return places_.capacity() * sizeof(Place) + place_of_node_.capacity() * sizeof(std::uint32_t) +
         levels_.capacity() * sizeof(Level) +
         (forced_outside_[0].capacity() + forced_outside_[1].capacity()) * sizeof(std::uint64_t);
}

void HeavyPaths::lay_out(std::span<const CsgNode> nodes) {
  const auto count = static_cast<std::uint32_t>(nodes.size());
  constexpr std::uint32_t no_node = 0xffffffffu;
  std::vector<std::uint32_t> below(count, 1);
  std::vector<std::uint32_t> heavy(count, no_node);
  for (std::uint32_t node = count; node-- > 1;) {
    const std::uint32_t parent = nodes[node].parent;
    below[parent] += below[node];
    std::uint32_t& heaviest = heavy[parent];
    if (heaviest == no_node || below[node] > below[heaviest]) heaviest = node;
  }
  places_.reserve(count);
  place_of_node_.resize(count);
  for (std::uint32_t start = 0; start < count; ++start) {
    if (start > 0 && heavy[nodes[start].parent] == start) continue;
    const auto head = static_cast<std::uint32_t>(places_.size());
    const std::uint32_t above = start == 0 ? 0 : place_of_node_[nodes[start].parent];
    for (std::uint32_t node = start; node != no_node; node = heavy[node]) {
      place_of_node_[node] = static_cast<std::uint32_t>(places_.size());
      Place place{.head = head,
                  .above = above,
                  .needed = nodes[node].needed,
                  .sides_outside = nodes[node].count_outside,
                  .last = heavy[node] == no_node};
      if (!place.last) {
        const CsgNode& next = nodes[heavy[node]];
        if (next.count_outside >= next.needed) --place.sides_outside;
      }
      places_.push_back(place);
    }
  }
}

void HeavyPaths::fill_sets() {
  auto bits = static_cast<std::uint32_t>(places_.size());
  std::uint32_t words = 0;
  do {
    const std::uint32_t count = (bits + word_bits - 1) / word_bits;
    levels_.push_back({.first_word = words, .word_count = count});
    words += count;
    bits = count;
  } while (bits > 1);
  for (const bool value : {false, true}) {
    std::vector<std::uint64_t>& set = forced_outside_[value ? 1 : 0];
    set.assign(words, 0);
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      const Place& place = places_[i];
      if (!is_forced_to(value, place.sides_outside, place.needed, place.last)) continue;
      std::uint32_t bit = i;
      for (const Level& level : levels_) {
        set[level.first_word + bit / word_bits] |= bit_of(bit);
        bit /= word_bits;
      }
    }
  }
}

PathValues::PathValues(const HeavyPaths& paths, PathWorkspace& work, std::uint64_t stamp)
    : paths_(paths), work_(work), stamp_(stamp) {
  if (work.sides.size() < paths.places_.size()) work.sides.resize(paths.places_.size());
  for (std::size_t value = 0; value < 2; ++value) {
    const std::size_t words = paths.forced_outside_[value].size();
    if (work.forced[value].size() < words) work.forced[value].resize(words);
  }
  begin_cluster();
}

std::uint64_t PathValues::word(bool value, std::uint32_t index) const {
  const std::size_t set = value ? 1 : 0;
  const PathWorkspace::Word& word = work_.forced[set][index];
  return word.stamp == stamp_ ? word.bits : paths_.forced_outside_[set][index];
}

std::uint32_t PathValues::next(bool value, std::uint32_t place) const {
  std::uint32_t bit = place;
  for (std::size_t i = 0; i < paths_.levels_.size(); ++i) {
    const HeavyPaths::Level& level = paths_.levels_[i];
    if (bit / word_bits >= level.word_count) return none;
    const std::uint64_t rest = word(value, level.first_word + bit / word_bits) >> (bit % word_bits);
    if (rest == 0) {
      bit = bit / word_bits + 1;
      continue;
    }
    bit += static_cast<std::uint32_t>(std::countr_zero(rest));
    while (i-- > 0) {
      const std::uint64_t below = word(value, paths_.levels_[i].first_word + bit);
      bit = bit * word_bits + static_cast<std::uint32_t>(std::countr_zero(below));
    }
    return bit;
  }
  return none;
}

bool PathValues::is_forced(std::uint32_t place, bool value) const {
  return (word(value, paths_.levels_[0].first_word + place / word_bits) & bit_of(place)) != 0;
}

void PathValues::toggle(std::uint32_t place, bool value) {
  std::uint32_t bit = place;
  for (const HeavyPaths::Level& level : paths_.levels_) {
    const std::uint32_t index = level.first_word + bit / word_bits;
    const std::uint64_t before = word(value, index);
    const std::uint64_t after = before ^ bit_of(bit);
    work_.forced[value ? 1 : 0][index] = {stamp_, after};
    // The levels above only say whether a word has any bit.
    if ((before == 0) == (after == 0)) return;
    bit /= word_bits;
  }
}

void PathValues::force(std::uint32_t place, bool value, bool forced) {
  if (is_forced(place, value) == forced) return;
  toggle(place, value);
  work_.changes.push_back({place, value});
}

void PathValues::set_leaf(std::uint32_t parent, bool value) {
  std::uint32_t place = paths_.place_of_node_[parent];
  bool now = value;
  while (true) {
    const HeavyPaths::Place& node = paths_.places_[place];
    const std::uint32_t head = node.head;
    const bool before = value_at(head);
    PathWorkspace::Sides& sides = work_.sides[place];
    if (sides.stamp != stamp_) sides = {stamp_, node.sides_outside};
    sides.count += now ? 1u : ~0u;
    for (const bool to : {false, true}) {
      force(place, to, is_forced_to(to, sides.count, node.needed, node.last));
    }
    now = value_at(head);
    if (now == before || head == 0) return;
    place = node.above;
  }
}

bool PathValues::is_all(std::uint32_t node, bool value) const {
  std::uint32_t place = paths_.place_of_node_[node];
  while (true) {
    const std::uint32_t head = paths_.places_[place].head;
    const std::uint32_t otherwise = next(!value, head);
    if (otherwise <= place || next(value, place) > otherwise) return false;
    if (head == 0) return true;
    place = paths_.places_[place].above;
  }
}

void PathValues::toggle_cluster() {
  for (const PathWorkspace::Change& change : work_.changes) toggle(change.place, change.value);
}

}  // namespace crt::core
