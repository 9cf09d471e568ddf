// A span is the part of a line inside a convex solid. It is the whole line at first, and is then
// cut by one face after another.
#pragma once

#include <algorithm>
#include <limits>

#include "core/geometry/shape.hpp"

namespace crt::core {

/// A ClippedSpan also keeps the promises about rays that start on a surface (Shape::crossings). A
/// ray that starts on a face starts within what the other faces bound. Where rounding says
/// otherwise (next to an edge), it is corrected to t = 0, and the face it starts on goes first. All
/// is inline, so that crossings stay in registers.
class ClippedSpan {
 public:
  /// `shortest` is the length in t that remains for a ray that starts into the solid, if rounding
  /// would have it leave at once. A direction at odds with its side may do so, too.
  ClippedSpan(const FaceStart& start, double shortest) : start_(start), shortest_(shortest) {
    enter_.t = -infinity;
    leave_.t = infinity;
  }

  /// Says that the line is inside only after this crossing.
  void enter(const Crossing& crossing) {
    const bool is_start = crossing.face == start_.face;
    const double t = starts_on_face() ? std::min(crossing.t, 0.0) : crossing.t;
    if (t > enter_.t || (is_start && t == enter_.t)) {
      enter_ = crossing;
      enter_.t = t;
    }
  }

  /// Says that the line is inside only before this crossing.
  void leave(const Crossing& crossing) {
    const bool is_start = crossing.face == start_.face;
    const double t = starts_on_face() ? std::max(crossing.t, 0.0) : crossing.t;
    if (t < leave_.t || (is_start && t == leave_.t)) {
      leave_ = crossing;
      leave_.t = t;
    }
  }

  /// Says that the line is nowhere inside.
  void clear() { empty_ = true; }

  bool empty() const { return empty_ || !(enter_.t < leave_.t); }
  double enter_t() const { return enter_.t; }
  double leave_t() const { return leave_.t; }

  /// Appends the finite ends and returns whether the line is inside at t = -inf. It must be called
  /// last.
  bool finish(CrossingList& out) {
    if (empty_) return false;
    if (starts_on_face() && start_.side == Side::inside && !(leave_.t > 0)) leave_.t = shortest_;
    if (!(enter_.t < leave_.t)) return false;
    enter_.entering = true;
    leave_.entering = false;
    if (enter_.t > -infinity) out.push_back(enter_);
    if (leave_.t < infinity) out.push_back(leave_);
    return enter_.t == -infinity;
  }

 private:
  bool starts_on_face() const { return start_.face != invalid_index && start_.on_face; }

  FaceStart start_;
  double shortest_;
  bool empty_ = false;
  Crossing enter_;
  Crossing leave_;
};

}  // namespace crt::core
