// This file implements the measures of the C interface.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "capi/ray_arrays.hpp"
#include "capi/structs.hpp"
#include "crt/measure.hpp"
#include "text/format.hpp"

static_assert(sizeof(crt_interval) == 16 && offsetof(crt_interval, upper) == 8);
static_assert(sizeof(crt_overlap) == 32 && offsetof(crt_overlap, volume) == 16);

namespace crt::capi {

template <>
std::span<const CField> c_fields<crt_mass>() {
  using S = crt_mass;
  static constexpr std::array fields = {CRT_FIELD(S, reserved), CRT_FIELD(S, volume),
                                        CRT_FIELD(S, area), CRT_FIELD(S, centroid),
                                        CRT_FIELD(S, inertia)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_measure_options>() {
  using S = crt_measure_options;
  static constexpr std::array fields = {CRT_FIELD(S, threads), CRT_FIELD(S, relative_width),
                                        CRT_FIELD(S, seconds), CRT_FIELD(S, poll),
                                        CRT_FIELD(S, poll_user)};
  return fields;
}

template <>
crt_measure_options defaults<crt_measure_options>() {
  return {};
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

void copy_to(double* out, const Vec3& point) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = point[axis];
}

void give_clearance(const crt_entity* a, const crt_entity* b, const MeasureOptions& options,
                    crt_interval* distance, double* on_a, double* on_b) {
  require(a, "a");
  require(b, "b");
  require(distance, "distance");
  require(on_a, "on_a");
  require(on_b, "on_b");
  const Clearance found = clearance(a->value, b->value, options);
  *distance = c_interval(found.distance);
  copy_to(on_a, found.on_a);
  copy_to(on_b, found.on_b);
}

void give_thickness(const crt_entity* entity, const MeasureOptions& options, crt_interval* least,
                    double* from, double* to) {
  require(entity, "entity");
  require(least, "least");
  require(from, "from");
  require(to, "to");
  const Wall wall = least_wall(entity->value, {.measure = options});
  *least = c_interval(wall.thickness);
  copy_to(from, wall.from);
  copy_to(to, wall.to);
}

std::vector<Entity> overlapping_entities(crt_entity* const* entities, std::size_t count) {
  if (count > 0) require(entities, "entities");
  std::vector<Entity> list;
  list.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (entities[i] == nullptr) reject(text::format("entities[{}]", i), "must not be NULL");
    list.push_back(entities[i]->value);
  }
  return list;
}

}  // namespace

std::function<bool()> to_go_on(crt_poll_fn call, void* user, const CancelValue& cancel_value) {
  if (call == nullptr) return {};
  return [call, user, cancel_value] {
    const int answer = call(user);
    if (answer != 0) *cancel_value = answer;
    return answer == 0;
  };
}

MeasureOptions to_options(const crt_measure_options* options, const CancelValue& cancel_value,
                          double usual_width) {
  const crt_measure_options given = taken_or_default(options, "options");
  MeasureOptions result = to_measure_options(
      given.relative_width == 0 ? usual_width : given.relative_width, given.seconds);
  result.threads = given.threads;
  result.go_on = to_go_on(given.poll, given.poll_user, cancel_value);
  return result;
}

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_mass_init(crt_mass* mass, size_t struct_size) {
  return guarded([&] { initialise(mass, struct_size, crt_mass{}); });
}

crt_status crt_measure_options_init(crt_measure_options* options, size_t struct_size) {
  return guarded([&] { initialise(options, struct_size, defaults<crt_measure_options>()); });
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

crt_status crt_entity_density(crt_entity* entity, double* out) {
  return guarded([&] {
    require(entity, "entity");
    require(out, "out");
    *out = crt::density(entity->value);
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

crt_status crt_entity_centroid(crt_entity* entity, double relative_width, double seconds,
                               crt_interval out[3]) {
  return guarded([&] {
    require(entity, "entity");
    require(out, "out");
    const auto found = crt::centroid(entity->value, to_measure_options(relative_width, seconds));
    std::transform(found.begin(), found.end(), out, c_interval);
  });
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

crt_status crt_entity_distance(crt_entity* entity, const double* points, size_t stride,
                               size_t count, double* signed_distance, double* nearest,
                               size_t nearest_stride) {
  return crt_entity_distance_with(entity, nullptr, points, stride, count, signed_distance, nearest,
                                  nearest_stride);
}

crt_status crt_entity_distance_with(crt_entity* entity, const crt_measure_options* options,
                                    const double* points, size_t stride, size_t count,
                                    double* signed_distance, double* nearest,
                                    size_t nearest_stride) {
  return guarded_with_cancel([&](const CancelValue& cancel_value) {
    const crt::MeasureOptions how = to_options(options, cancel_value);
    require(entity, "entity");
    const std::vector<crt::Vec3> questions = to_points(points, stride, count);
    if (count > 0) require(signed_distance, "signed_distance");
    const bool wants_points = nearest != nullptr && count > 0;
    const Places<std::byte> places(reinterpret_cast<std::byte*>(nearest), nearest_stride,
                                   sizeof(crt::Vec3), wants_points ? count : 0, "nearest");
    std::vector<crt::NearestPoint> answers(count);
    crt::nearest_points(entity->value, questions, answers, how);
    for (std::size_t i = 0; i < count; ++i) {
      signed_distance[i] = answers[i].signed_distance();
      if (wants_points) std::memcpy(places[i], &answers[i].point, sizeof(crt::Vec3));
    }
  });
}

crt_status crt_entity_clearance(crt_entity* a, crt_entity* b, double relative_width,
                                crt_interval* distance, double on_a[3], double on_b[3]) {
  return guarded(
      [&] { give_clearance(a, b, to_measure_options(relative_width, 0), distance, on_a, on_b); });
}

crt_status crt_entity_clearance_with(crt_entity* a, crt_entity* b,
                                     const crt_measure_options* options, crt_interval* distance,
                                     double on_a[3], double on_b[3]) {
  return guarded_with_cancel([&](const CancelValue& cancel_value) {
    give_clearance(a, b, to_options(options, cancel_value), distance, on_a, on_b);
  });
}

crt_status crt_interference(crt_entity* const* entities, size_t entity_count, double relative_width,
                            double seconds, crt_overlap* overlaps, size_t capacity, size_t* count) {
  return guarded([&] {
    require(count, "count");
    if (capacity > 0) require(overlaps, "overlaps");
    const std::vector<crt::Entity> list = overlapping_entities(entities, entity_count);
    const std::vector<crt::Overlap> found =
        crt::interference(list, to_measure_options(relative_width, seconds));
    for (std::size_t i = 0; i < std::min(found.size(), capacity); ++i)
      overlaps[i] = {found[i].first, found[i].second, c_interval(found[i].volume)};
    *count = found.size();
  });
}

crt_status crt_entity_thickness(crt_entity* entity, double relative_width, crt_interval* least,
                                double from[3], double to[3]) {
  return guarded(
      [&] { give_thickness(entity, to_measure_options(relative_width, 0), least, from, to); });
}

crt_status crt_entity_thickness_with(crt_entity* entity, const crt_measure_options* options,
                                     crt_interval* least, double from[3], double to[3]) {
  return guarded_with_cancel([&](const CancelValue& cancel_value) {
    give_thickness(entity,
                   to_options(options, cancel_value, crt::WallOptions().measure.relative_width),
                   least, from, to);
  });
}
