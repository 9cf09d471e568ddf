// The functions of a rounded box's faces, for questions about boxes (face_functions.hpp). Those of
// the round faces are one: the squared distance from the inner box. So they have one number, that
// of the first.
#pragma once

#include "core/geometry/box/functions.hpp"
#include "core/geometry/rounded_box/walk.hpp"

namespace crt::core {

struct RoundedBoxFunctions {
  static constexpr std::uint32_t round = flat_faces_of_box;

  BoxFunctions flat;
  double inverse_unit = 1;
  Interval radius;                ///< in units
  PointOf<Interval> inner_lower;  ///< in scene units
  PointOf<Interval> inner_upper;

  RoundedBoxFunctions(const BoxFunctions& box, double size, double unit);

  static constexpr int max_crossings(std::uint32_t face) { return face < round ? 1 : 2; }
  void look(const PointOf<Interval>& box, NearFaces& near) const;
  template <class Number>
  Number value(std::uint32_t face, const PointOf<Number>& point) const {
    if (face < round) return flat.value(face, point);
    const Interval unit = Interval::of(inverse_unit);
    const auto squared_part = [&](std::size_t i) {
      return square(positive_part(-(point[i] - inner_lower[i])) * unit) +
             square(positive_part(point[i] - inner_upper[i]) * unit);
    };
    return squared_part(0) + squared_part(1) + squared_part(2) - square(radius);
  }
};

}  // namespace crt::core
