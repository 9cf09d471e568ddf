// This file converts patterns from C to C++. The defaults are converted from the C++ structs.
#include <variant>
#include <vector>

#include "capi/fields.hpp"
#include "capi/numbers.hpp"
#include "capi/structs.hpp"
#include "crt/pattern.hpp"
#include "crt/schema_materials.hpp"

namespace crt::capi {

namespace {

/// More patterns than so many within one another are refused, as they may be a circle.
constexpr int max_nested_patterns = 5;

/// Returns the pattern in the place of a colour, if there is one.
SharedPattern to_nested(const crt_pattern* pattern, const char* argument, int depth) {
  if (pattern == nullptr) return nullptr;
  if (depth >= max_nested_patterns) reject(argument, "has more than 5 patterns within one another");
  return nested(to_pattern(pattern, argument, depth + 1));
}

std::vector<ColorStop> to_stops(const crt_pattern& given) {
  constexpr std::uint64_t max_stops = 64;
  std::vector<ColorStop> stops;
  if (given.color_count == 0) return stops;
  require(given.colors, "pattern.colors");
  if (given.color_count > max_stops) reject("pattern.color_count", "must be at most 64");
  for (std::uint64_t i = 0; i < given.color_count; ++i) {
    const crt_color_stop& stop = given.colors[i];
    stops.push_back({stop.position, to_color(stop.color, stop.alpha)});
  }
  return stops;
}

}  // namespace

// The types of C are the kinds of C++ in their order.
static_assert(CRT_PATTERN_IMAGE + 1 == std::variant_size_v<Pattern>);

Pattern to_pattern(const crt_pattern* pattern, const char* argument, int depth) {
  const auto given = taken(pattern, argument);
  Pattern result;
  with_kind<Pattern>(given.type, "pattern.type", "crt_pattern_type", [&](auto kind) {
    if constexpr (requires { kind.image; }) {
      kind.image = to_image(given.image, "pattern.image");
    } else {
      kind.pattern_a = to_nested(given.pattern_a, "pattern.pattern_a", depth);
      kind.pattern_b = to_nested(given.pattern_b, "pattern.pattern_b", depth);
    }
    if constexpr (requires { kind.colors; }) kind.colors = to_stops(given);
    take_fields(kind, given, "pattern");
    result = kind;
  });
  return result;
}

crt_pattern default_pattern(std::int32_t type) {
  crt_pattern out{};
  out.struct_size = sizeof out;
  put_defaults<Pattern>(out);
  out.type = type;
  with_kind<Pattern>(type, "type", "crt_pattern_type",
                     [&out](const auto& kind) { put_fields(out, kind); });
  return out;
}

template <>
crt_pattern defaults<crt_pattern>() {
  return default_pattern(CRT_PATTERN_CHECKER);
}

}  // namespace crt::capi
