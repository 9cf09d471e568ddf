#include "core/geometry/frustum/functions.hpp"

#include <algorithm>

#include "core/math/vector.hpp"

namespace crt::core {

FrustumFunctions::FrustumFunctions(const Vec3& from_end, const Vec3& to_end, const Vec3& narrow_end,
                                   double narrow_size, double wide_size)
    : narrow(narrow_end),
      from(from_end),
      to(to_end),
      along(unit_vector(from_end, to_end)),
      axis(narrow_end == from_end ? along : unit_vector(to_end, from_end)),
      has_apex(narrow_size == 0) {
  inverse_unit = inverse_of_power(power_of_two_below(wide_size));
  const Interval unit = Interval::of(inverse_unit);
  narrow_radius = Interval::of(narrow_size) * unit;
  if (narrow_size == wide_size) {
    cosine = Interval::of(1);
    sine = Interval::of(0);
    return;
  }
  const Interval growth = (Interval::of(wide_size) - Interval::of(narrow_size)) * unit;
  const Interval height = distance(from, to) * unit;
  const Interval slant = root(square(growth) + square(height));
  cosine = height / slant;
  sine = growth / slant;
}

void FrustumFunctions::look(const PointOf<Interval>& box, NearFaces& near) const {
  near.kind = NearFaces::Kind::where_all_negative;
  near.faces.assign({side, 1U});
  if (!has_apex) {
    near.faces.push_back(2);
    return;
  }
  // The cap is at the wide end, whichever it is. There is none at the apex, which the other nappe
  // begins at.
  near.faces[1] = narrow == from ? 2U : 1U;
  const Interval height = component_along(relative_to(box, narrow), axis);
  if (height.hi < 0) near.kind = NearFaces::Kind::outside;
  if (height.lo < 0 && height.hi >= 0)
    near.kind = value(side, box).lo > 0 ? NearFaces::Kind::outside : NearFaces::Kind::unknown;
}

}  // namespace crt::core
