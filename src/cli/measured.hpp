// What `crt measure` has found, and how it is written as JSON.
#pragma once

#include <array>
#include <crt/measure.hpp>
#include <crt/section.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/measure_pairs.hpp"
#include "cli/options.hpp"

namespace crt::cli {

/// A Measured has what was found of an entity, or of all together. What was not asked for is empty.
struct Measured {
  std::string name;
  std::string fault;  ///< says why it has no volume
  std::optional<BoundingBox> bounds;
  std::optional<Interval> volume;
  std::optional<Interval> area;
  std::optional<Interval> mass;
  double density = 0;  ///< of its materials, in kg per cubic metre; or 0
  bool mass_is_in_kg = false;
  std::optional<std::array<Interval, 3>> centroid;
  std::optional<std::array<Interval, 6>> inertia;
  std::optional<Section> section{};
  std::optional<Wall> wall;
};

/// Says whether a box is that of nothing.
inline bool is_empty(const BoundingBox& box) {
  return !(box.lower.x <= box.upper.x);
}

/// Returns what all entities together are. Where the materials of some say a density and those of
/// others none, there is a mass only if one was given for these.
Measured sum_of(const std::vector<Measured>& parts, bool has_density);

/// Returns all as JSON, with intervals as [lower, upper].
std::string measures_json(const MeasureRequest& request, const std::string& script,
                          std::string_view unit, const std::vector<Measured>& parts,
                          const MeasuredPairs& pairs);

}  // namespace crt::cli
