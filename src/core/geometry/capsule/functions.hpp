// The functions of a capsule's faces, for questions about boxes (face_functions.hpp). Those of the
// side and of the half spheres are of the whole cylinder and the whole spheres. A box at a seam has
// a function of its own, the squared distance from the line between the centers.
#pragma once

#include "core/geometry/face_functions.hpp"

namespace crt::core {

struct CapsuleFunctions {
  static constexpr std::uint32_t side = 0;
  static constexpr std::uint32_t whole = 3;  ///< the number of the function at seams

  Vec3 from{0, 0, 0};
  Vec3 to{0, 0, 0};
  double inverse_unit = 1;
  PointOf<Interval> along;  ///< of length 1
  Interval height;          ///< in units
  Interval radius;

  CapsuleFunctions(const Vec3& from_center, const Vec3& to_center, double size, double unit);

  static constexpr int max_crossings(std::uint32_t) { return 2; }
  void look(const PointOf<Interval>& box, NearFaces& near) const;
  template <class Number>
  Number value(std::uint32_t face, const PointOf<Number>& point) const {
    const auto offset_from = [&](const Vec3& center) {
      return scaled(relative_to(point, center), inverse_unit);
    };
    if (face == 1 || face == 2)
      return squared_length(offset_from(face == 1 ? from : to)) - square(radius);
    const PointOf<Number> p = offset_from(from);
    const Number across = squared_length_across(p, along) - square(radius);
    if (face == side) return across;
    const Number place = component_along(p, along);
    return across + square(positive_part(-place)) + square(positive_part(place - height));
  }
};

}  // namespace crt::core
