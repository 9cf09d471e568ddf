#include "core/geometry/rounded_box/functions.hpp"

#include "core/math/vector.hpp"

namespace crt::core {

RoundedBoxFunctions::RoundedBoxFunctions(const BoxFunctions& box, double size, double unit)
    : flat(box),
      inverse_unit(inverse_of_power(unit)),
      radius(Interval::of(size) * Interval::of(inverse_unit)) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    inner_lower[i] = Interval::of(box.lower[axis]) + Interval::of(size);
    inner_upper[i] = Interval::of(box.upper[axis]) - Interval::of(size);
  }
}

void RoundedBoxFunctions::look(const PointOf<Interval>& box, NearFaces& near) const {
  near.say(NearFaces::Kind::inside);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    if (box[axis].lo > inner_lower[axis].hi && box[axis].hi < inner_upper[axis].lo) continue;
    if (near.kind == NearFaces::Kind::where_all_negative) return near.say(near.kind, {round});
    near.say(NearFaces::Kind::where_all_negative, {2 * axis, 2 * axis + 1});
  }
}

}  // namespace crt::core
