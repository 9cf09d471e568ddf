#include "core/geometry/profile/agree_with_start.hpp"

#include <algorithm>

#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// A StartParts has the parts of the line in the solid: pairs of crossings.
class StartParts {
 public:
  StartParts(const ObjectRay& ray, std::uint8_t root, double farthest, double shortest,
             std::size_t begin, CrossingList& list)
      : shortest_(shortest), begin_(begin), list_(list) {
    here_.face = ray.start.face;
    here_.entering = ray.start.side == Side::inside;
    here_.root = root;
    constexpr double share = 0x1p-30;
    slack_ = share * (largest_component(ray.origin) + farthest) / largest_component(ray.direction);
  }

  void agree() {
    if (here_.entering) {
      go_inside();
    } else {
      go_outside();
    }
  }

 private:
  using Place = CrossingList::iterator;

  Place first() const { return list_.begin() + static_cast<std::ptrdiff_t>(begin_); }
  /// Returns the first part that ends after the start.
  Place part_ahead() const {
    Place part = first();
    while (part != list_.end() && !((part + 1)->t > 0)) part += 2;
    return part;
  }
  Place insert(Place place, const Crossing& enter, const Crossing& leave) {
    return list_.insert(list_.insert(place, leave), enter);
  }
  /// Returns the start's crossing at another place next to it, turned round or not.
  Crossing next_to_start(double t, bool entering) const {
    Crossing crossing = here_;
    crossing.t = t;
    crossing.error = shortest_;
    crossing.entering = entering;
    return crossing;
  }

  void go_inside() {
    Place part = part_ahead();
    if (part != first() && (part - 1)->t == 0) part = list_.erase(part - 2, part);
    if (part != list_.end() && part->t <= slack_) {
      *part = here_;
    } else {
      insert(part, here_, next_to_start(shortest_, false));
    }
  }

  void go_outside() {
    Place part = part_ahead();
    Crossing enter = next_to_start(-shortest_, true);
    if (part != list_.end() && part->t <= 0) {
      // The part ends here. If it is long, the ray enters again at once.
      const Crossing leave = *(part + 1);
      if (part->t < enter.t) enter = *part;
      part = list_.erase(part, part + 2);
      if (leave.t > slack_) part = insert(part, next_to_start(shortest_, true), leave);
    }
    if (part != first() && (part - 1)->t >= enter.t) {
      *(part - 1) = here_;
    } else {
      insert(part, enter, here_);
    }
  }

  double shortest_;
  std::size_t begin_;
  CrossingList& list_;
  Crossing here_;
  double slack_;
};

}  // namespace

void agree_with_start(const ObjectRay& ray, std::uint8_t root, double farthest, double shortest,
                      std::size_t begin, CrossingList& list) {
  StartParts(ray, root, farthest, shortest, begin, list).agree();
}

}  // namespace crt::core
