// The intervals of a line inside a torus, one ray's: all of them.
#pragma once

#include <array>
#include <limits>

#include "core/geometry/torus/line.hpp"
#include "core/ray/object_ray.hpp"

namespace crt::core {

class TorusLine final : public TorusLineOf<double> {
 public:
  using TorusLineOf::TorusLineOf;

  /// From now on tells in Spans::certain whether rounding could have changed how many spans there
  /// are. `off` is what each component of a point near the torus may be off by, rounding included.
  void take_care(double off) { off_ = off; }

  /// A span of the line inside the torus, by brackets around its ends.
  struct Intervals {
    struct Ends {
      Bracket enter;
      Bracket leave;
    };
    std::array<Ends, 2> interval;
    std::size_t count = 0;
    bool certain = true;
  };
  /// In ascending order.
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
  /// The same with the ends themselves; those at x = 0 are exactly 0 if the point is on the
  /// surface. Those before `begin` are only told roughly.
  Spans spans(double begin = -std::numeric_limits<double>::infinity());

  double level_at_start()
      const;  ///< what G is at x = 0, by rounding, if the point is on the surface

 private:
  Search find_rise(const Range& concave, const Search& first, const Search& second) const;
  double place(const Bracket& bracket, double begin) const;
  double inflection_error(const Range& concave) const;
};

/// Makes the spans of a ray that starts on the torus agree with the side it leaves to, where the
/// direction is at odds with it or grazes so closely that rounding decides. `bulging` tells that
/// the surface turns away from the line, `shortest` what is left of a span that rounding would have
/// end at once.
void obey_side(Side side, bool bulging, double shortest, TorusLine::Spans& spans);

}  // namespace crt::core
