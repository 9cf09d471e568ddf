// A TorusLine finds all the intervals of one ray's line inside a torus.
#pragma once

#include <array>
#include <limits>

#include "core/geometry/torus/line.hpp"
#include "core/ray/object_ray.hpp"

namespace crt::core {

class TorusLine final : public TorusLineOf<double> {
 public:
  using TorusLineOf::TorusLineOf;

  /// Makes later calls find out, for Spans::certain, whether rounding could have changed the number
  /// of spans. `off` bounds the error of each component of a point near the torus, rounding
  /// included.
  void take_care(double off) { off_ = off; }

  /// Intervals are the spans of the line inside the torus, by brackets around their ends.
  struct Intervals {
    struct Ends {
      Bracket enter;
      Bracket leave;
    };
    std::array<Ends, 2> interval;
    std::size_t count = 0;
    bool certain = true;
  };
  /// Returns the intervals in ascending order.
  Intervals intervals();

  struct Span {
    double enter;
    double leave;
  };
  struct Spans {
    std::array<Span, 2> span;
    std::size_t count = 0;
    bool certain = true;
  };
  /// Returns the intervals by their ends themselves. Ends at x = 0 are exactly 0 if the point is on
  /// the surface. Ends before `begin` are known only roughly.
  Spans spans(double begin = -std::numeric_limits<double>::infinity());

  double level_at_start() const;  ///< G at x = 0, which is rounding if the point is on the surface

 private:
  Search find_rise(const Range& concave, const Search& first, const Search& second) const;
  double place(const Bracket& bracket, double begin) const;
  double inflection_error(const Range& concave) const;
};

/// Makes the spans of a ray that starts on the torus agree with the side it leaves to. They may not
/// where the direction is at odds with it, or grazes so closely that rounding decides. `bulging`
/// says that the surface turns away from the line. `shortest` is the length of a span that rounding
/// would have end at once.
void obey_side(Side side, bool bulging, double shortest, TorusLine::Spans& spans);

}  // namespace crt::core
