// The fuzzer of the C interface measures solids.
#pragma once

#include <crt/crt.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "fuzz_input.hpp"

namespace crt::test {

inline void require_order(const crt_interval& interval) {
  require(interval.lower <= interval.upper);
}

/// Cuts an entity by a plane.
inline void cut_entity(Input& input, crt_entity* entity) {
  const auto normal = input.vector();
  auto how = scrambled<crt_measure_options>(input, crt_measure_options_init);
  how.poll = nullptr;
  const bool is_asked = input.below(2) == 0;
  crt_section* section = nullptr;
  if (crt_section_create_with(entity, normal.data(), input.number(), input.number(),
                              is_asked ? &how : nullptr, &section) != CRT_OK)
    return require(section == nullptr);
  crt_interval area;
  require(crt_section_area(section, &area) == CRT_OK);
  require_order(area);
  std::size_t count = 0;
  const std::size_t* first = nullptr;
  const double* points = nullptr;
  require(crt_section_contours(section, &count, &first, &points) == CRT_OK);
  for (std::size_t i = 0; i < count; ++i) require(first[i] < first[i + 1]);
  crt_section_release(section);
}

/// Asks how far away a point and the entity itself are.
inline void measure_distances(Input& input, crt_entity* entity,
                              const std::array<double, 3>& point) {
  // Where much is equally near, a search takes long.
  if (crt_entity_primitive_count(entity) > 4 || input.below(16) != 0) return;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double distance = infinity;
  double nearest[3];
  const crt_status asked =
      crt_entity_distance(entity, point.data(), 0, 1, &distance, nearest, input.below(64));
  require((asked == CRT_OK) == (distance < infinity));
  crt_overlap overlap;
  std::size_t count = 0;
  crt_entity* const twice[2] = {entity, entity};
  if (crt_interference(twice, 2, 0.1, 0.01, &overlap, 1, &count) != CRT_OK || count == 0) return;
  require(count == 1 && overlap.first == 0 && overlap.second == 1);
  require_order(overlap.volume);
}

/// Asks all that can be asked of an entity, for little time.
inline void measure_entity(Input& input, crt_entity* entity) {
  constexpr std::uint64_t enough = 64;
  if (crt_entity_primitive_count(entity) > enough) return;
  const auto point = input.vector();
  double lower[3];
  double upper[3];
  crt_entity_bounds(entity, lower, upper);
  if (input.below(8) == 0) cut_entity(input, entity);
  std::int8_t side = 7;
  const crt_status asked = crt_entity_contains(entity, point.data(), 0, 1, &side);
  require(asked == CRT_OK ? side >= -1 && side <= 1 : side == 7);
  measure_distances(input, entity, point);
  constexpr double width = 0.1;
  constexpr double seconds = 0.01;
  crt_interval found = {1, -1};
  const crt_status status =
      crt_entity_volume(entity, input.below(8) == 0 ? input.number() : width, seconds, &found);
  if (status == CRT_OK) require_order(found);
  require(status == CRT_OK || (found.lower == 1 && found.upper == -1));
  if (crt_entity_area(entity, width, seconds, &found) == CRT_OK) require_order(found);
  auto mass = scrambled<crt_mass>(input, crt_mass_init);
  const bool is_whole = mass.struct_size >= sizeof mass;
  if (crt_entity_mass(entity, width, seconds, &mass) != CRT_OK || !is_whole) return;
  require_order(mass.volume);
  for (const crt_interval& number : mass.centroid) require_order(number);
}

}  // namespace crt::test
