// The values of the nodes of deep programs are compared with values by definition.
#include "core/csg/heavy_paths.hpp"

#include <doctest/doctest.h>

#include <random>

#include "core/csg/program.hpp"

using namespace crt;
using namespace crt::core;

namespace {

/// A Tree has a random program's nodes with leaves below them. All leaves are outside, and so are
/// false unless complemented.
struct Tree {
  std::vector<CsgNode> nodes;
  std::vector<std::uint32_t> leaf_parents;
  std::vector<bool> leaf_values;
  std::mt19937 random;

  std::uint32_t below(std::size_t count) {
    return std::uniform_int_distribution<std::uint32_t>(
        0, static_cast<std::uint32_t>(count - 1))(random);
  }

  /// Each node is put below one of the last `reach` nodes: 1 makes a chain, many make a bush.
  Tree(std::size_t count, std::size_t reach, std::uint32_t seed) : random(seed) {
    nodes.resize(count);
    std::vector<std::uint32_t> children(count, 0);
    for (std::size_t i = 1; i < count; ++i) {
      nodes[i].parent = static_cast<std::uint32_t>(i - 1 - below(std::min(i, reach)));
      ++children[nodes[i].parent];
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      do {
        leaf_parents.push_back(i);
        leaf_values.push_back(below(4) == 0);
        ++children[i];
      } while (children[i] < 2 || below(3) == 0);
    }
    for (std::size_t i = 0; i < count; ++i) {
      // AND and OR alternate as in programs, seen from the root.
      const bool parent_is_or = i > 0 && nodes[nodes[i].parent].needed == 1;
      nodes[i].needed = parent_is_or || (i == 0 && below(2) == 0) ? children[i] : 1;
    }
    count_true_children();
  }

  void count_true_children() {
    for (CsgNode& node : nodes) node.count_outside = 0;
    for (std::size_t i = 0; i < leaf_parents.size(); ++i)
      nodes[leaf_parents[i]].count_outside += leaf_values[i];
    for (std::size_t i = nodes.size(); i-- > 1;) {
      nodes[nodes[i].parent].count_outside += nodes[i].count_outside >= nodes[i].needed;
    }
  }

  /// Returns the values by definition, from the present values of the leaves.
  std::vector<bool> values() {
    count_true_children();
    std::vector<bool> result;
    for (const CsgNode& node : nodes) result.push_back(node.count_outside >= node.needed);
    return result;
  }

  bool is_all(const std::vector<bool>& values, std::uint32_t node, bool value) const {
    while (values[node] == value) {
      if (node == 0) return true;
      node = nodes[node].parent;
    }
    return false;
  }

  std::uint32_t flip(PathValues& paths) {
    // Half of the time it is one of the lowest leaves, whose changes have the longest path.
    const std::uint32_t leaf =
        static_cast<std::uint32_t>(leaf_parents.size()) - 1 -
        below(below(2) == 0 ? leaf_parents.size() : std::min<std::size_t>(30, leaf_parents.size()));
    leaf_values[leaf] = !leaf_values[leaf];
    paths.set_leaf(leaf_parents[leaf], leaf_values[leaf]);
    return leaf;
  }
};

void check_rays(Tree tree, int rays, int clusters, PathWorkspace& work, std::uint64_t& stamp) {
  const HeavyPaths paths(tree.nodes, 1);
  REQUIRE_FALSE(paths.empty());
  const Tree outside = tree;
  for (int ray = 0; ray < rays; ++ray) {
    tree.leaf_values = outside.leaf_values;
    PathValues values(paths, work, ++stamp);
    std::vector<bool> before = tree.values();
    REQUIRE(values.root() == before[0]);
    for (int cluster = 0; cluster < clusters; ++cluster) {
      values.begin_cluster();
      for (std::uint32_t flips = 0; flips <= tree.below(5); ++flips) tree.flip(values);
      const std::vector<bool> after = tree.values();
      REQUIRE(values.root() == after[0]);
      const std::uint32_t node = tree.leaf_parents[tree.flip(values)];
      const std::vector<bool> last = tree.values();
      for (const bool value : {false, true})
        REQUIRE(values.is_all(node, value) == tree.is_all(last, node, value));
      values.toggle_cluster();
      REQUIRE(values.root() == before[0]);
      for (const bool value : {false, true})
        REQUIRE(values.is_all(node, value) == tree.is_all(before, node, value));
      values.toggle_cluster();
      REQUIRE(values.root() == last[0]);
      before = last;
    }
  }
}

}  // namespace

TEST_CASE("paths know the values of all nodes, in chains and in bushes") {
  PathWorkspace work;
  std::uint64_t stamp = 0;
  std::uint32_t seed = 0;
  for (const std::size_t count :
       std::initializer_list<std::size_t>{1, 2, 3, 5, 20, 63, 64, 65, 129, 500}) {
    for (const std::size_t reach : std::initializer_list<std::size_t>{1, 2, 5, 1000}) {
      for (int i = 0; i < 4; ++i) {
        CAPTURE(count);
        CAPTURE(reach);
        check_rays(Tree(count, reach, ++seed), 3, 20, work, stamp);
      }
    }
  }
}

TEST_CASE("paths know the values of very many nodes") {
  PathWorkspace work;
  std::uint64_t stamp = 0;
  for (const std::size_t reach : std::initializer_list<std::size_t>{1, 3})
    check_rays(Tree(20'000, reach, 99), 2, 60, work, stamp);
}

TEST_CASE("flat programs do without paths") {
  CHECK(HeavyPaths(Tree(500, 500, 1).nodes).empty());
  CHECK_FALSE(HeavyPaths(Tree(500, 1, 1).nodes).empty());
  CHECK(HeavyPaths(std::vector<CsgNode>{}).empty());
}
