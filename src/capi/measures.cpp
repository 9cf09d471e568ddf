// This file implements the measures of the C interface.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "capi/ray_arrays.hpp"
#include "crt/measure.hpp"
#include "text/format.hpp"

static_assert(sizeof(crt_interval) == 16 && offsetof(crt_interval, upper) == 8);

namespace crt::capi {

template <>
std::span<const CField> c_fields<crt_mass>() {
  using S = crt_mass;
  static constexpr std::array fields = {CRT_FIELD(S, reserved), CRT_FIELD(S, volume),
                                        CRT_FIELD(S, area), CRT_FIELD(S, centroid),
                                        CRT_FIELD(S, inertia)};
  return fields;
}

namespace {

MeasureOptions to_measure_options(double relative_width, double seconds) {
  if (!(relative_width > 0 && relative_width <= 1))
    reject("relative_width", "must be above 0 and at most 1");
  if (!(seconds >= 0)) reject("seconds", "must be at least 0");
  const bool has_end = seconds > 0;
  return {.relative_width = relative_width,
          .seconds = has_end ? seconds : std::numeric_limits<double>::infinity()};
}

crt_interval c_interval(const Interval& interval) {
  return {.lower = interval.lower, .upper = interval.upper};
}

/// Answers by one of the C++ functions that give an interval.
crt_status give_interval(Interval (*measure)(const Entity&, const MeasureOptions&),
                         const crt_entity* entity, double relative_width, double seconds,
                         crt_interval* out) {
  return guarded([&] {
    require(entity, "entity");
    require(out, "out");
    *out = c_interval(measure(entity->value, to_measure_options(relative_width, seconds)));
  });
}

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_mass_init(crt_mass* mass, size_t struct_size) {
  return guarded([&] { initialise(mass, struct_size, crt_mass{}); });
}

crt_status crt_entity_mass(crt_entity* entity, double relative_width, double seconds,
                           crt_mass* out) {
  return guarded([&] {
    require(entity, "entity");
    given_size(out, "out");
    const crt::MassProperties found =
        crt::mass_properties(entity->value, to_measure_options(relative_width, seconds));
    crt_mass mass{};
    mass.volume = c_interval(found.volume);
    mass.area = c_interval(found.area);
    for (std::size_t i = 0; i < 3; ++i) mass.centroid[i] = c_interval(found.centroid[i]);
    for (std::size_t i = 0; i < 6; ++i) mass.inertia[i] = c_interval(found.inertia[i]);
    fill_in(out, "out", mass);
  });
}

crt_status crt_entity_volume(crt_entity* entity, double relative_width, double seconds,
                             crt_interval* out) {
  return give_interval(crt::volume, entity, relative_width, seconds, out);
}

crt_status crt_entity_area(crt_entity* entity, double relative_width, double seconds,
                           crt_interval* out) {
  return give_interval(crt::surface_area, entity, relative_width, seconds, out);
}

crt_status crt_entity_bounds(crt_entity* entity, double lower[3], double upper[3]) {
  return guarded([&] {
    require(entity, "entity");
    require(lower, "lower");
    require(upper, "upper");
    const crt::BoundingBox box = crt::tight_bounding_box(entity->value);
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = box.lower[axis];
      upper[axis] = box.upper[axis];
    }
  });
}

crt_status crt_entity_contains(crt_entity* entity, const double* points, size_t stride,
                               size_t count, int8_t* side) {
  return guarded([&] {
    require(entity, "entity");
    const std::vector<crt::Vec3> questions = to_points(points, stride, count);
    if (count > 0) require(side, "side");
    std::vector<crt::PointSide> answers(count);
    crt::contains(entity->value, questions, answers);
    for (std::size_t i = 0; i < count; ++i) side[i] = static_cast<std::int8_t>(answers[i]);
  });
}
