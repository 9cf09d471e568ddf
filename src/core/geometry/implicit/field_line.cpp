#include "core/geometry/implicit/field_line.hpp"

#include "core/geometry/implicit/field_part.hpp"

namespace crt::core {

FieldLine::Values FieldLine::evaluate(double from, double to) const {
  const double middle = middle_of(from, to);
  const Interval part{from, to};
  FieldPart<1> field_part({rounded_up(std::max(middle - from, to - middle))});
  const auto coordinate = [&](std::size_t axis) {
    const Interval& place = place_[axis];
    const Interval& direction = direction_[axis];
    return FieldValue<1>{
        place + direction * Interval::of(middle), place + direction * part, {{direction}}};
  };
  const FieldValues<1> values = field_part.evaluate(program_, coordinate);
  return {.middle = values.value.middle,
          .all = values.value.all,
          .slope = values.value.slope.each[0],
          .may_be_undefined = values.may_be_undefined,
          .is_undefined = values.is_undefined};
}

}  // namespace crt::core
