// The nodes of a deep CSG program are cut into paths, so that a leaf deep down changes the root in
// O(log^2 n) steps.
//
// The path of a node continues to that of its children which has most below it (heavy paths:
// Sleator, Tarjan, A data structure for dynamic trees, 1983). The others are its *side* children,
// and there are O(log n) of those above any leaf. On a path a node is *forced* to a value if its
// side children decide it, whatever comes from below. Otherwise it has the value of the next node.
// So a node has the value of the first forced one from there on, and the last of a path is always
// forced. The nodes that are forced to a value are a set of bits with summaries, one set for each
// value. In these the next one is found in O(log_64 n).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace crt::core {

struct CsgNode;

/// HeavyPaths are the paths of a program, which do not change from ray to ray.
class HeavyPaths {
 public:
  /// A program with this many levels is deep enough to be worth it: from there on a flip costs less
  /// than walking up.
  static constexpr std::uint32_t fewest_levels = 48;

  HeavyPaths() = default;
  /// Makes the paths of nodes that come after their parents. There are none if the nodes are less
  /// deep than `fewest`.
  explicit HeavyPaths(std::span<const CsgNode> nodes, std::uint32_t fewest = fewest_levels);

  bool empty() const { return places_.empty(); }
  /// Returns the bytes of memory that it takes beside the object itself.
  std::size_t bytes() const;

 private:
  friend class PathValues;

  /// A Place is that of a node in the order of paths, each from its head down.
  struct Place {
    std::uint32_t head = 0;           ///< of the path
    std::uint32_t above = 0;          ///< the parent of the head
    std::uint32_t needed = 1;         ///< as in CsgNode
    std::uint32_t sides_outside = 0;  ///< true side children where every leaf is outside
    bool last = false;                ///< of its path
  };
  /// A Level has the words of one level in a set of bits. Each bit above says whether a word below
  /// has any.
  struct Level {
    std::uint32_t first_word = 0;
    std::uint32_t word_count = 0;
  };

  void lay_out(std::span<const CsgNode> nodes);
  void fill_sets();

  std::vector<Place> places_;
  std::vector<std::uint32_t> place_of_node_;
  std::vector<Level> levels_;
  /// These are the places forced to false, and those forced to true, where every leaf is outside.
  std::array<std::vector<std::uint64_t>, 2> forced_outside_;
};

/// A PathWorkspace is memory that one thread reuses from ray to ray. What has an earlier stamp
/// counts as that outside of all leaves.
struct PathWorkspace {
  struct Sides {
    std::uint64_t stamp = 0;
    std::uint32_t count = 0;
  };
  struct Word {
    std::uint64_t stamp = 0;
    std::uint64_t bits = 0;
  };
  /// A Change is a place that came into a set or left it.
  struct Change {
    std::uint32_t place = 0;
    bool value = false;  ///< of which set
  };

  std::vector<Sides> sides;
  std::array<std::vector<Word>, 2> forced;
  std::vector<Change> changes;  ///< since begin_cluster()
};

/// PathValues are the values of nodes along one ray.
class PathValues {
 public:
  /// Begins where every leaf is outside. No stamp that the workspace has seen may reach `stamp`.
  PathValues(const HeavyPaths& paths, PathWorkspace& work, std::uint64_t stamp);

  bool root() const { return value_at(0); }

  /// Begins a cluster, from where on changes are remembered.
  void begin_cluster() { work_.changes.clear(); }

  /// Changes a leaf below a node to a value, which it must not have yet.
  void set_leaf(std::uint32_t parent, bool value);

  /// Returns whether all nodes from one up to the root have a value.
  bool is_all(std::uint32_t node, bool value) const;

  /// Takes the changes of the cluster back, or makes them again. Done twice, it changes nothing.
  void toggle_cluster();

 private:
  static constexpr std::uint32_t none = 0xffffffffu;

  bool value_at(std::uint32_t place) const { return next(true, place) < next(false, place); }
  /// Returns the first place from `place` on that is forced to a value, be it of another path.
  std::uint32_t next(bool value, std::uint32_t place) const;
  void force(std::uint32_t place, bool value, bool forced);
  void toggle(std::uint32_t place, bool value);
  bool is_forced(std::uint32_t place, bool value) const;
  std::uint64_t word(bool value, std::uint32_t index) const;

  const HeavyPaths& paths_;
  PathWorkspace& work_;
  std::uint64_t stamp_;
};

}  // namespace crt::core
