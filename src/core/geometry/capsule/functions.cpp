#include "core/geometry/capsule/functions.hpp"

#include "core/math/vector.hpp"

namespace crt::core {

CapsuleFunctions::CapsuleFunctions(const Vec3& from_center, const Vec3& to_center, double size,
                                   double unit)
    : from(from_center),
      to(to_center),
      inverse_unit(inverse_of_power(unit)),
      along(unit_vector(from_center, to_center)),
      height(distance(from_center, to_center) * Interval::of(inverse_unit)),
      radius(Interval::of(size) * Interval::of(inverse_unit)) {}

void CapsuleFunctions::look(const PointOf<Interval>& box, NearFaces& near) const {
  const Interval place = component_along(scaled(relative_to(box, from), inverse_unit), along);
  std::uint32_t face = whole;
  if (place.hi < 0) face = 1;
  if (place.lo > height.hi) face = 2;
  if (place.lo > 0 && place.hi < height.lo) face = side;
  near.say(NearFaces::Kind::where_all_negative, {face});
}

}  // namespace crt::core
