// Of a custom shape nothing is known but its bounds, for questions about boxes
// (face_functions.hpp).
#pragma once

#include "core/geometry/face_functions.hpp"

namespace crt::core {

struct CustomFunctions {
  static constexpr bool has_series = false;
  Bounds bounds;

  static constexpr int max_crossings(std::uint32_t) { return 0; }
  void look(const PointOf<Interval>& box, NearFaces& near) const {
    near.say(may_overlap(box, bounds) ? NearFaces::Kind::unknown : NearFaces::Kind::outside);
  }
  static Interval value(std::uint32_t, const PointOf<Interval>&) { return Interval::everything(); }
  static Jet value(std::uint32_t, const PointOf<Jet>&) {
    const Interval any = Interval::everything();
    return {any, {any, any, any}};
  }
};

}  // namespace crt::core
