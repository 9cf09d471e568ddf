// The stretch of a line inside a convex solid: the whole line at first, then cut by one face after
// another. It also keeps the promises about rays that start on a surface (Shape::crossings).
#pragma once

#include "core/geometry/shape.hpp"

namespace crt::core {

class Stretch {
 public:
  /// `shortest` is what a ray still has to go, in units of t, when it starts into the solid and
  /// rounding (or a direction at odds with its side) would have it leave at once.
  Stretch(const RayStart& start, double shortest);

  /// The line is inside only after this crossing.
  void enter(const Crossing& crossing);
  /// The line is inside only before this crossing.
  void leave(const Crossing& crossing);
  /// The line is nowhere inside.
  void clear() { empty_ = true; }

  bool empty() const { return empty_ || !(enter_.t < leave_.t); }
  double enter_t() const { return enter_.t; }
  double leave_t() const { return leave_.t; }

  /// Appends the finite ends; whether the line is inside at t = -inf.
  bool finish(CrossingList& out) const;

 private:
  bool starts_on_face() const { return start_.face != no_face && start_.on_face; }

  RayStart start_;
  double shortest_;
  bool empty_ = false;
  Crossing enter_;
  Crossing leave_;
};

}  // namespace crt::core
