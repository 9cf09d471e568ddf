#include "core/geometry/placed_solid.hpp"

#include <bit>

#include "core/geometry/ray_slabs.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

namespace {

/// A box in which a solid is somewhere.
struct EnclosedBounds {
  Bounds box;
};

template <class Real>
bool enclose(const EnclosedBounds& bounds, const FilterLine<Real>& line, const MaskOf<Real>& asked,
             Enclosure<Real>& part) {
  const auto span = RaySlabs::spans(line, bounds.box, mask_of(asked), line.start_error);
  const MaskOf<Real> misses = span.enter > span.leave;
  if (!any(asked && !misses)) return false;
  const Real never = broadcast<Real>(infinity);
  part = {
      .enter_from = span.enter, .enter_to = never, .leave_from = -never, .leave_to = span.leave};
  if (any(misses)) part.set_outside(misses);
  return true;
}

/// A convex shape that is asked for the crossings of each line.
struct AskedShape {
  const Shape& shape;
  const Placement& placement;
  EnclosedBounds bounds;
};

template <class Real>
bool enclose(const AskedShape& asked_shape, const FilterLine<Real>& line, const MaskOf<Real>& asked,
             Enclosure<Real>& part) {
  if (!enclose(asked_shape.bounds, line, asked, part)) return false;
  CrossingList crossings;
  std::uint32_t near = mask_of(asked && part.enter_from <= part.leave_to);
  for (std::uint32_t left = near; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    crossings.clear();
    const auto of_lane = [&](const std::array<Real, 3>& v) {
      return Vec3(lane_of(v[0], lane), lane_of(v[1], lane), lane_of(v[2], lane));
    };
    const ObjectRay ray =
        asked_shape.placement.to_object(of_lane(line.origin), of_lane(line.direction));
    const bool is_inside_first = asked_shape.shape.crossings(ray, crossings);
    Enclosure<double> one{infinity, infinity, -infinity, -infinity};
    if (is_inside_first) one = {-infinity, -infinity, infinity, infinity};
    for (const Crossing& crossing : crossings) {
      const double from = crossing.t - crossing.error;
      const double to = crossing.t + crossing.error;
      if (crossing.entering) {
        one = {from, to, infinity, infinity};
      } else {
        one.leave_from = from;
        one.leave_to = to;
      }
    }
    if (crossings.size() <= 2) set_lane(part, lane, one);
    if (one.enter_from > one.leave_to) near &= ~(std::uint32_t{1} << lane);
  }
  return near != 0;
}

/// Returns a box around a shape in the world, and a little more than what rounding may do to
/// crossings with the shape.
EnclosedBounds bounds_of(const Shape& shape, const Placement& placement) {
  constexpr double roundings = 0x1p-40;
  const Bounds box = placement.bounds_to_world(shape.bounds());
  return {box.finite() ? box.grown(roundings * box.farthest()) : box};
}

}  // namespace

std::unique_ptr<const PlacedSolid> place_box(const Shape& shape, const Placement& placement) {
  return std::make_unique<const PlacedSolidOf<EnclosedBounds>>(bounds_of(shape, placement));
}

std::unique_ptr<const PlacedSolid> place_by_crossings(const Shape& shape,
                                                      const Placement& placement) {
  return std::make_unique<const PlacedSolidOf<AskedShape>>(
      AskedShape{shape, placement, bounds_of(shape, placement)});
}

}  // namespace crt::core
