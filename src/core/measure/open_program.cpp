#include "core/measure/open_program.hpp"

#include "core/base/invalid_index.hpp"

namespace crt::core {

OpenProgram OpenProgram::of_leaf() {
  return {.nodes = {{}}, .leaves = {{}}};
}

OpenProgram OpenProgram::of(const CsgProgram& program) {
  // Programs need not have parents before children.
  const std::size_t count = program.nodes.size();
  std::vector<std::vector<std::uint32_t>> children(count);
  for (std::uint32_t node = 1; node < count; ++node)
    children[program.nodes[node].parent].push_back(node);
  OpenProgram result;
  std::vector<std::uint32_t> places(count, 0);
  std::vector<std::uint32_t> order = {0};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t node = order[i];
    places[node] = static_cast<std::uint32_t>(i);
    const auto open = static_cast<std::uint32_t>(children[node].size());
    result.nodes.push_back({places[program.nodes[node].parent], program.nodes[node].needed, open});
    order.insert(order.end(), children[node].begin(), children[node].end());
  }
  for (std::uint32_t leaf = 0; leaf < program.leaf_count(); ++leaf) {
    const std::uint32_t parent = places[program.leaf_parents[leaf]];
    ++result.nodes[parent].open;
    result.leaves.push_back({leaf, parent});
  }
  return result;
}

bool OpenProgram::value(std::span<const bool> leaves_true) const {
  std::vector<std::uint32_t> counts(nodes.size(), 0);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (leaves_true[i]) ++counts[leaves[i].parent];
  }
  for (std::size_t node = nodes.size() - 1; node > 0; --node) {
    if (counts[node] >= nodes[node].needed) ++counts[nodes[node].parent];
  }
  return counts[0] >= nodes[0].needed;
}

std::optional<bool> decide(const OpenProgram& program, std::span<const LeafValue> values,
                           OpenProgram& rest) {
  std::vector<OpenProgram::Node> nodes = program.nodes;
  std::vector<bool> decided(nodes.size(), false);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == LeafValue::open) continue;
    bool value = values[i] == LeafValue::always_true;
    std::uint32_t at = program.leaves[i].parent;
    while (!decided[at]) {
      OpenProgram::Node& node = nodes[at];
      --node.open;
      if (value) --node.needed;
      if (node.needed > 0 && node.open >= node.needed) break;
      value = node.needed == 0;
      decided[at] = true;
      if (at == 0) return value;
      at = node.parent;
    }
  }
  rest.nodes.clear();
  rest.leaves.clear();
  std::vector<std::uint32_t> places(nodes.size(), invalid_index);
  for (std::size_t at = 0; at < nodes.size(); ++at) {
    const std::uint32_t parent = places[nodes[at].parent];
    if (decided[at] || (at > 0 && parent == invalid_index)) continue;
    places[at] = static_cast<std::uint32_t>(rest.nodes.size());
    rest.nodes.push_back({at > 0 ? parent : 0, nodes[at].needed, nodes[at].open});
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint32_t parent = places[program.leaves[i].parent];
    if (values[i] == LeafValue::open && parent != invalid_index)
      rest.leaves.push_back({program.leaves[i].leaf, parent});
  }
  return {};
}

}  // namespace crt::core
