#include "cli/measure_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/intervals.hpp"
#include "cli/option_values.hpp"

namespace crt::cli {

namespace {

/// Returns the place of an entity that is called by it, or by how the command prints it.
std::size_t place_of_entity(const std::string& text, std::span<const std::string> names) {
  const auto named = std::find(names.begin(), names.end(), text);
  if (named != names.end()) return static_cast<std::size_t>(named - names.begin());
  constexpr std::string_view word = "entity ";
  std::size_t place = 0;
  const bool has_word = text.starts_with(word);
  if (parse_whole(std::string_view(text).substr(has_word ? word.size() : 0), place) &&
      place < names.size())
    return place;
  throw Error(ErrorCode::invalid_argument,
              fmt::format("--distance: there is no entity '{}': the script has {}, which count "
                          "from 0",
                          text, names.size()));
}

std::string distance_text(const Clearance& found, std::string_view unit) {
  if (found.overlap)
    return fmt::format("  overlap   both hold {} {}\n", point_text(found.on_a), unit);
  return fmt::format(
      "  clearance {} {}, {}\n"
      "  from      {} {}\n"
      "  to        {} {}\n",
      number_text(found.distance), unit, bounds_text(found.distance), point_text(found.on_a), unit,
      point_text(found.on_b), unit);
}

std::string overlaps_text(const std::vector<Overlap>& overlaps, std::span<const std::string> names,
                          std::string_view unit) {
  std::string text = fmt::format("interference of {} entities\n", names.size());
  if (overlaps.empty()) text += "  none      no two of them overlap\n";
  for (const Overlap& overlap : overlaps)
    text += fmt::format("  {} and {}\n    volume  {} {}3, {}\n", names[overlap.first],
                        names[overlap.second], number_text(overlap.volume), unit,
                        bounds_text(overlap.volume));
  return text;
}

}  // namespace

std::string point_text(const Vec3& point) {
  constexpr double rounding = 1e-12;
  const double size = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_zero = std::abs(point[axis]) <= rounding * size;
    text += fmt::format("{}{:.9g}", axis == 0 ? "(" : ", ", is_zero ? 0 : point[axis]);
  }
  return text + ")";
}

MeasuredPairs measure_pairs(const MeasureRequest& request, std::span<const Entity> entities,
                            std::span<const std::string> names, const MeasureOptions& options) {
  MeasuredPairs pairs;
  pairs.distances.reserve(request.distances.size());
  for (const auto& [first, second] : request.distances)
    pairs.distances.push_back({.first = place_of_entity(first, names),
                               .second = place_of_entity(second, names),
                               .clearance = {}});
  for (MeasuredDistance& found : pairs.distances)
    found.clearance = clearance(entities[found.first], entities[found.second], options);
  if (request.interference) pairs.overlaps = interference(entities, options);
  return pairs;
}

std::string pairs_text(const MeasuredPairs& pairs, std::span<const std::string> names,
                       std::string_view unit) {
  std::string text;
  for (const MeasuredDistance& found : pairs.distances)
    text += fmt::format("distance of {} and {}\n", names[found.first], names[found.second]) +
            distance_text(found.clearance, unit);
  if (pairs.overlaps) text += overlaps_text(*pairs.overlaps, names, unit);
  return text;
}

}  // namespace crt::cli
