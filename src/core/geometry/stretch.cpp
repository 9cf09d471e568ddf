#include "core/geometry/stretch.hpp"

#include <limits>

namespace crt::core {

Stretch::Stretch(const RayStart& start, double shortest) : start_(start), shortest_(shortest) {
  enter_.t = -std::numeric_limits<double>::infinity();
  leave_.t = std::numeric_limits<double>::infinity();
}

// A ray that starts on a face starts within what the other faces bound: where rounding says
// otherwise (next to an edge), it is corrected to t = 0, and the face it starts on goes first.

void Stretch::enter(const Crossing& crossing) {
  const bool is_start = crossing.face == start_.face;
  const double t = starts_on_face() ? std::min(crossing.t, 0.0) : crossing.t;
  if (t > enter_.t || (is_start && t == enter_.t)) {
    enter_ = crossing;
    enter_.t = t;
  }
}

void Stretch::leave(const Crossing& crossing) {
  const bool is_start = crossing.face == start_.face;
  const double t = starts_on_face() ? std::max(crossing.t, 0.0) : crossing.t;
  if (t < leave_.t || (is_start && t == leave_.t)) {
    leave_ = crossing;
    leave_.t = t;
  }
}

bool Stretch::finish(CrossingList& out) const {
  if (empty_) return false;
  constexpr double inf = std::numeric_limits<double>::infinity();
  Crossing enter = enter_;
  Crossing leave = leave_;
  if (starts_on_face() && start_.side == Side::inside && !(leave.t > 0)) leave.t = shortest_;
  if (!(enter.t < leave.t)) return false;
  enter.entering = true;
  leave.entering = false;
  if (enter.t > -inf) out.push_back(enter);
  if (leave.t < inf) out.push_back(leave);
  return enter.t == -inf;
}

}  // namespace crt::core
