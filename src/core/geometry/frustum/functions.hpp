// The functions of the faces of cylinders and cones, for questions about boxes
// (face_functions.hpp). That of the side is |P|^2 - s^2 in the words of frustum.hpp. It is below 0
// on both nappes of a cone, of which a cap cuts off the second, or else the apex.
#pragma once

#include "core/geometry/face_functions.hpp"

namespace crt::core {

struct FrustumFunctions {
  static constexpr std::uint32_t side = 0;

  Vec3 narrow{0, 0, 0};
  Vec3 from{0, 0, 0};
  Vec3 to{0, 0, 0};
  PointOf<Interval> along;  ///< from `from` to `to`, of length 1
  PointOf<Interval> axis;   ///< from the narrow end to the wide one, of length 1
  double inverse_unit = 1;
  Interval narrow_radius;  ///< in units
  Interval cosine;         ///< of the angle between axis and side
  Interval sine;
  bool has_apex = false;

  /// `narrow_end` is one of the two ends.
  FrustumFunctions(const Vec3& from_end, const Vec3& to_end, const Vec3& narrow_end,
                   double narrow_size, double wide_size);

  static constexpr int max_crossings(std::uint32_t face) { return face == side ? 2 : 1; }
  void look(const PointOf<Interval>& box, NearFaces& near) const;
  template <class Number>
  Number value(std::uint32_t face, const PointOf<Number>& point) const {
    if (face == side) {
      const PointOf<Number> p = scaled(relative_to(point, narrow), inverse_unit);
      return squared_length_across(p, axis) * square(cosine) -
             square(component_along(p, axis) * sine + cosine * narrow_radius);
    }
    return face == 1 ? -component_along(relative_to(point, from), along)
                     : component_along(relative_to(point, to), along);
  }
};

}  // namespace crt::core
