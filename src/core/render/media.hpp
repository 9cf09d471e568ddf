// Media are the transparent solids around a ray.
#pragma once

#include <cstdint>
#include <vector>

namespace crt::core {

/// A Medium is a transparent solid that a ray is inside of.
struct Medium {
  std::uint32_t object = 0;
  std::uint32_t material = 0;  ///< of the surface through which it was entered
};

/// MediaLists are lists of nested media, innermost first, that share their tails. A ray's list is
/// one number, and a secondary ray has a list of its own without a copy. Leaving a solid takes it
/// out wherever it is in the list. media_order.hpp says where it goes when it is entered.
class MediaLists {
 public:
  using List = std::uint32_t;
  static constexpr List empty = 0xffffffffu;

  /// Returns `list` with one more medium around the ray. It is outside of those innermost ones for
  /// which `is_inside_of(object)` is false. A solid is never in a list twice.
  template <class IsInsideOf>
  List entered(List list, const Medium& medium, const IsInsideOf& is_inside_of) {
    if (list == empty) return with(list, medium);
    List outer = left(list, medium.object);
    inner_.clear();
    for (; outer != empty && !is_inside_of(nodes_[outer].medium.object);
         outer = nodes_[outer].around) {
      inner_.push_back(nodes_[outer].medium);
    }
    return with_inner(with(outer, medium));
  }

  /// Returns `list` with one more medium, the innermost of all.
  List entered(List list, const Medium& medium) { return with(left(list, medium.object), medium); }

  /// Returns `list` without a solid, or the same list if it is not in there.
  List left(List list, std::uint32_t object) {
    if (list != empty && innermost(list).object == object) return around(list);  // the usual case
    List found = list;
    inner_.clear();
    while (found != empty && nodes_[found].medium.object != object) {
      inner_.push_back(nodes_[found].medium);
      found = nodes_[found].around;
    }
    return found == empty ? list : with_inner(nodes_[found].around);
  }

  bool holds(List list, std::uint32_t object) const {
    while (list != empty && nodes_[list].medium.object != object) list = nodes_[list].around;
    return list != empty;
  }

  /// These are the innermost medium of a list that is not empty, and the list of those around it.
  const Medium& innermost(List list) const { return nodes_[list].medium; }
  List around(List list) const { return nodes_[list].around; }

  /// Lists made after a mark() are gone after release(mark).
  std::uint32_t mark() const { return static_cast<std::uint32_t>(nodes_.size()); }
  void release(std::uint32_t mark) { nodes_.resize(mark); }

 private:
  List with(List list, const Medium& medium) {
    nodes_.push_back({medium, list});
    return static_cast<List>(nodes_.size() - 1);
  }

  /// Returns `list` with the media of inner_ inside of it.
  List with_inner(List list) {
    for (std::size_t i = inner_.size(); i > 0; --i) list = with(list, inner_[i - 1]);
    return list;
  }

  struct Node {
    Medium medium;
    List around = empty;
  };

  std::vector<Node> nodes_;
  std::vector<Medium> inner_;
};

}  // namespace crt::core
