#include "core/geometry/implicit/functions.hpp"

#include <algorithm>

#include "core/geometry/implicit/field_part.hpp"

namespace crt::core {

namespace {

/// Evaluates a field in a box. Of one without an end nothing is known.
FieldValues<3> values_in(const FieldProgram& program, const PointOf<Interval>& box) {
  std::array<double, 3> middle{};
  std::array<double, 3> reach{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(box[i].width() < infinity)) return {.may_be_undefined = true};
    middle[i] = std::clamp(box[i].middle(), box[i].lo, box[i].hi);
    reach[i] = rounded_up(std::max(middle[i] - box[i].lo, box[i].hi - middle[i]));
  }
  const auto coordinate = [&](std::size_t axis) {
    FieldValue<3> value{.middle = Interval::of(middle[axis]), .all = box[axis], .slope = {}};
    value.slope.each[axis] = Interval::of(1);
    return value;
  };
  return FieldPart<3>(reach).evaluate(program, coordinate);
}

}  // namespace

void ImplicitFunctions::look(const PointOf<Interval>& box, NearFaces& near) const {
  using enum NearFaces::Kind;
  const Bounds bounds{box_functions.lower, box_functions.upper};
  if (!may_overlap(box, bounds)) return near.say(outside);
  PointOf<Interval> within = box;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    within[i] = {std::max(box[i].lo, bounds.lower[axis]), std::min(box[i].hi, bounds.upper[axis])};
  }
  const FieldValues<3> values = values_in(*program, within);
  const Interval& all = values.value.all;
  if (values.is_undefined || all.lo > 0) return near.say(outside);
  if (values.may_be_undefined) return near.say(unknown);
  near.say(inside);
  if (all.hi > 0) near.keep_within(field);
  for (std::uint32_t side = 0; side < BoxFunctions::face_count(); ++side) {
    const std::size_t i = side / 2;
    const auto axis = static_cast<int>(i);
    const bool crosses =
        side % 2 == 0 ? box[i].lo <= bounds.lower[axis] : box[i].hi >= bounds.upper[axis];
    if (crosses) near.keep_within(1 + side);
  }
}

Interval ImplicitFunctions::value(std::uint32_t face, const PointOf<Interval>& point) const {
  if (face != field) return box_functions.value(face - 1, point);
  const FieldValues<3> values = values_in(*program, point);
  return values.may_be_undefined ? Interval::everything() : values.value.all;
}

Jet ImplicitFunctions::value(std::uint32_t face, const PointOf<Jet>& point) const {
  if (face != field) return box_functions.value(face - 1, point);
  const FieldValues<3> values =
      values_in(*program, {point[0].value, point[1].value, point[2].value});
  const Interval any = Interval::everything();
  if (values.may_be_undefined) return {any, {any, any, any}};
  const auto& along = values.value.slope.each;
  const auto slope = [&](std::size_t i) {
    return along[0] * point[0].slope[i] + along[1] * point[1].slope[i] +
           along[2] * point[2].slope[i];
  };
  return {values.value.all, {slope(0), slope(1), slope(2)}};
}

}  // namespace crt::core
