// The transparent solids around a ray.
#pragma once

#include <cstdint>
#include <vector>

namespace crt::core {

/// A transparent solid that a ray is inside of.
struct Medium {
  std::uint32_t object = 0;
  std::uint32_t material = 0;  ///< of the surface through which it was entered
};

/// Lists of nested media, innermost first, that share their tails: a ray's list is one number, and a
/// ray that goes on has a list of its own without a copy.
///
/// The innermost medium is the one entered last. Leaving a solid takes it out wherever it is in the
/// list, so that solids which merely overlap work too.
class MediaLists {
 public:
  using List = std::uint32_t;
  static constexpr List empty = 0xffffffffu;

  /// `list` with one more medium around the ray. A solid is never in a list twice.
  List entered(List list, const Medium& medium) {
    nodes_.push_back({medium, left(list, medium.object)});
    return static_cast<List>(nodes_.size() - 1);
  }

  /// `list` without a solid; the same list if it is not in there.
  List left(List list, std::uint32_t object) {
    List found = list;
    inner_.clear();
    while (found != empty && nodes_[found].medium.object != object) {
      inner_.push_back(nodes_[found].medium);
      found = nodes_[found].around;
    }
    if (found == empty) return list;
    List result = nodes_[found].around;
    for (std::size_t i = inner_.size(); i > 0; --i) {
      nodes_.push_back({inner_[i - 1], result});
      result = static_cast<List>(nodes_.size() - 1);
    }
    return result;
  }

  /// The innermost medium of a list that is not empty, and the list of those around it.
  const Medium& innermost(List list) const { return nodes_[list].medium; }
  List around(List list) const { return nodes_[list].around; }

  /// Lists made after a mark() are gone after release(mark).
  std::uint32_t mark() const { return static_cast<std::uint32_t>(nodes_.size()); }
  void release(std::uint32_t mark) { nodes_.resize(mark); }

 private:
  struct Node {
    Medium medium;
    List around = empty;
  };

  std::vector<Node> nodes_;
  std::vector<Medium> inner_;
};

}  // namespace crt::core
