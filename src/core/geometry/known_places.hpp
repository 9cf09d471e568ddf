// The places of crossings without rounding take long to find, and each is compared with several.
#pragma once

#include <forward_list>
#include <optional>

#include "core/geometry/shape.hpp"
#include "core/math/real_root.hpp"

namespace crt::core {

/// KnownPlaces are those of the crossings of one ray that have been asked for.
class KnownPlaces {
 public:
  /// Returns the sign of the place of a crossing less that of another. `find` finds places that
  /// have not been asked for before. Where it cannot, t decides.
  template <class Find>
  int order(const Crossing& first, const Crossing& second, const Find& find) {
    std::optional<RealRoot>& a = of(first, find);
    std::optional<RealRoot>& b = of(second, find);
    if (a && b) return core::order(*a, *b);
    return first.t < second.t ? -1 : (first.t > second.t ? 1 : 0);
  }

 private:
  /// Returns the place of a crossing. Comparing it may make it narrower.
  template <class Find>
  std::optional<RealRoot>& of(const Crossing& crossing, const Find& find) {
    for (Known& known : known_) {
      const Crossing& other = known.crossing;
      if (other.face == crossing.face && other.root == crossing.root && other.t == crossing.t &&
          other.t_low == crossing.t_low && other.error == crossing.error) {
        return known.place;
      }
    }
    known_.push_front({crossing, find(crossing)});
    return known_.front().place;
  }

  struct Known {
    Crossing crossing;
    std::optional<RealRoot> place;
  };

  std::forward_list<Known> known_;  ///< which leaves them where they are
};

}  // namespace crt::core
