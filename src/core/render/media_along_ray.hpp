// The media along one straight way, as the ray passes crossing after crossing.
//
// The same as MediaLists for a ray that never splits: so the list may be changed in place, as a
// balanced tree (a treap: Seidel, Aragon, Randomized search trees, 1996) in which each subtree
// knows what it takes to get past it. Entering and leaving cost O(log n) among n solids, however
// they overlap.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/render/media_order.hpp"

namespace crt::core {

class MediaAlongRay {
 public:
  /// Knows the line on which the way is.
  class Line {
   public:
    virtual ~Line() = default;
    /// Where a solid is left that is not left on the way.
    virtual RayHit exit_beyond(std::uint32_t object) const = 0;
  };

  /// Starts anew. `crossings` are those on the way, in order; both are used until the next begin().
  void begin(std::span<const RayHit> crossings, const Line& line);
  /// Puts a medium around all that are there.
  void surround(const Medium& medium) { insert_before(nothing, new_node(medium, 0)); }

  bool empty() const { return root_ == nothing; }
  const Medium& innermost() const { return nodes_[innermost_].medium; }

  /// As entered_in_order(), with all crossings before number `index` passed.
  void enter(const Medium& medium, std::size_t index);
  void leave(std::uint32_t object);
  /// Where a solid is left that the ray is in after the crossings before number `index`.
  RayHit exit_of(std::uint32_t object, std::size_t index);

 private:
  struct Node {
    Medium medium;
    RayHit exit{};
    std::size_t index = 0;  ///< up to where the way was passed when it came in
    bool knows_exit = false;
    bool is_there = true;
    std::uint32_t left = nothing;  ///< more inner ones
    std::uint32_t right = nothing;
    std::uint32_t above = nothing;
    // Of all in the subtree:
    std::uint32_t least_object = 0;
    double farthest = 0;  ///< t of an exit, at most
  };
  /// A crossing of a solid.
  struct Passing {
    std::uint32_t object = 0;
    std::uint32_t index = 0;
    std::uint32_t node = nothing;  ///< of the object, in its first passing
  };

  static double farthest_of(const Node& node);
  /// What tells of many crossings and nodes where those of an object are; not worth it for few.
  void sort_passings();
  std::size_t first_passing(std::uint32_t object, std::size_t index) const;
  /// The first passing of an object, if it has any.
  Passing* passing_of(std::uint32_t object);
  /// The node of an object that is left or entered on the way, if it is there.
  std::uint32_t node_of(std::uint32_t object);
  bool is_inside_of(Node& inner, Node& outer);
  /// The innermost node of a subtree that `entering` is inside of.
  std::uint32_t first_around(std::uint32_t subtree, Node& entering);
  const RayHit& known_exit(Node& node);
  /// One that is in no tree yet. (What is known of its exit means nothing.)
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
  std::vector<Node> nodes_;        ///< made once; so many are in use:
  std::uint32_t node_count_ = 0;
  std::uint32_t root_ = nothing;
  std::uint32_t innermost_ = nothing;
};

}  // namespace crt::core
