// What `crt measure` says of two entities: how near they are, and what they have in common.
#pragma once

#include <crt/measure.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options.hpp"

namespace crt::cli {

/// A MeasuredDistance says how near two entities are, by their places.
struct MeasuredDistance {
  std::size_t first = 0;
  std::size_t second = 0;
  Clearance clearance;
};

/// MeasuredPairs have what was found of pairs. What was not asked for is empty.
struct MeasuredPairs {
  std::vector<MeasuredDistance> distances;
  std::optional<std::vector<Overlap>> overlaps;
};

/// Finds what was asked for of pairs. Throws Error (invalid_argument) for an entity that is not
/// there. `names` are what the entities are called.
MeasuredPairs measure_pairs(const MeasureRequest& request, std::span<const Entity> entities,
                            std::span<const std::string> names, const MeasureOptions& options);

/// Returns a point with as many digits as say where it is.
std::string point_text(const Vec3& point);

/// Returns it as text, by the names of the entities.
std::string pairs_text(const MeasuredPairs& pairs, std::span<const std::string> names,
                       std::string_view unit);

}  // namespace crt::cli
