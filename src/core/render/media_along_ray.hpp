// A MediaAlongRay has the media along one straight path, as the ray passes crossing after crossing.
//
// It does what MediaLists does, for a ray that never splits. So the list may be changed in place.
// It is a balanced tree (a treap: Seidel, Aragon, Randomized search trees, 1996) in which each
// subtree knows when it can be passed over. Entering and leaving cost O(log n) among n solids,
// however they overlap.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/render/media_order.hpp"

namespace crt::core {

class MediaAlongRay {
 public:
  /// A Line knows the line on which the path is.
  class Line {
   public:
    virtual ~Line() = default;
    /// Returns where a solid is left that is not left on the path.
    virtual RayHit exit_beyond(std::uint32_t object) const = 0;
  };

  /// Starts a new path. `crossings` are those on the path, in order. Both are used until the next
  /// begin().
  void begin(std::span<const RayHit> crossings, const Line& line);
  /// Puts a medium around all that are there.
  void surround(const Medium& medium) { insert_before(invalid_index, new_node(medium, 0)); }

  bool empty() const { return root_ == invalid_index; }
  const Medium& innermost() const { return nodes_[innermost_].medium; }

  /// Enters a medium as entered_in_order() does, with all crossings before number `index` passed.
  void enter(const Medium& medium, std::size_t index);
  void leave(std::uint32_t object);
  /// Returns where a solid is left that the ray is in after the crossings before number `index`.
  RayHit exit_of(std::uint32_t object, std::size_t index);

 private:
  struct Node {
    Medium medium;
    RayHit exit{};
    std::size_t index = 0;  ///< the number of crossings passed when it was entered
    bool knows_exit = false;
    bool is_there = true;
    std::uint32_t left = invalid_index;  ///< the inner ones
    std::uint32_t right = invalid_index;
    std::uint32_t above = invalid_index;
    // These are of all in the subtree:
    std::uint32_t least_object = 0;
    double farthest = 0;  ///< a bound on t of the exits
  };
  /// A Passing is a crossing of a solid.
  struct Passing {
    std::uint32_t object = 0;
    std::uint32_t index = 0;
    std::uint32_t node = invalid_index;  ///< of the object, in its first passing
  };

  static double farthest_of(const Node& node);
  /// Sorts the passings, so that crossings and nodes of an object are found fast among many. It is
  /// not worth it for few.
  void sort_passings();
  std::size_t first_passing(std::uint32_t object, std::size_t index) const;
  /// Returns the first passing of an object, if it has any.
  Passing* passing_of(std::uint32_t object);
  /// Returns the node of an object that is left or entered on the path, if it is there.
  std::uint32_t node_of(std::uint32_t object);
  bool is_inside_of(Node& inner, Node& outer);
  /// Returns the innermost node of a subtree that `entering` is inside of.
  std::uint32_t first_around(std::uint32_t subtree, Node& entering);
  const RayHit& known_exit(Node& node);
  /// Returns a node that is in no tree yet. Its exit means nothing.
  std::uint32_t new_node(const Medium& medium, std::size_t index);
  void insert_before(std::uint32_t place, std::uint32_t node);
  void remove(std::uint32_t node);
  std::uint32_t& link_to(std::uint32_t node);
  void lift(std::uint32_t node);
  void update(std::uint32_t index);
  void update_up(std::uint32_t node);

  std::span<const RayHit> crossings_;
  const Line* line_ = nullptr;
  std::vector<Passing> passings_;  ///< by object, then in order; empty until they are sorted
  std::vector<Node> nodes_;        ///< made once, of which node_count_ are in use
  std::uint32_t node_count_ = 0;
  std::uint32_t root_ = invalid_index;
  std::uint32_t innermost_ = invalid_index;
};

}  // namespace crt::core
