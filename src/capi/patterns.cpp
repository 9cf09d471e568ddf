// This file converts patterns from C to C++. The defaults are converted from the C++ structs.
#include <vector>

#include "capi/numbers.hpp"
#include "capi/structs.hpp"
#include "crt/pattern.hpp"

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

/// Converts the fields that nearly every pattern has.
template <class Type>
void take_colors(Type& pattern, const crt_pattern& given, int depth) {
  pattern.pattern_a = to_nested(given.pattern_a, "pattern.pattern_a", depth);
  pattern.pattern_b = to_nested(given.pattern_b, "pattern.pattern_b", depth);
  if constexpr (requires { pattern.colors; }) pattern.colors = to_stops(given);
  pattern.color_a = to_color(given.color_a, given.alpha_a);
  pattern.color_b = to_color(given.color_b, given.alpha_b);
  pattern.scale = given.scale;
  pattern.offset = to_vec3(given.offset);
  if constexpr (requires { pattern.direction; }) pattern.direction = to_vec3(given.direction);
  if constexpr (requires { pattern.octaves; }) pattern.octaves = given.octaves;
  if constexpr (requires { pattern.turbulence; }) pattern.turbulence = given.turbulence;
}

template <class Type>
Pattern colored(const crt_pattern& given, int depth) {
  Type pattern;
  take_colors(pattern, given, depth);
  return pattern;
}

/// Writes the values that this type of pattern starts with. Fields that it does not use keep their
/// values.
template <class Type>
void put_defaults(crt_pattern& out) {
  const Type pattern;
  put(out.color_a, pattern.color_a);
  put(out.color_b, pattern.color_b);
  out.scale = pattern.scale;
  put(out.offset, pattern.offset);
  if constexpr (requires { pattern.direction; }) put(out.direction, pattern.direction);
  if constexpr (requires { pattern.octaves; }) out.octaves = pattern.octaves;
  if constexpr (requires { pattern.turbulence; }) out.turbulence = pattern.turbulence;
}

}  // namespace

Pattern to_pattern(const crt_pattern* pattern, const char* argument, int depth) {
  const auto given = taken(pattern, argument);
  switch (given.type) {
    case CRT_PATTERN_CHECKER:
      return colored<Checker>(given, depth);
    case CRT_PATTERN_STRIPES:
      return colored<Stripes>(given, depth);
    case CRT_PATTERN_GRADIENT:
      return colored<Gradient>(given, depth);
    case CRT_PATTERN_NOISE:
      return colored<Noise>(given, depth);
    case CRT_PATTERN_MARBLE:
      return colored<Marble>(given, depth);
    case CRT_PATTERN_WOOD:
      return colored<Wood>(given, depth);
    case CRT_PATTERN_IMAGE:
      return ImageMap{.image = to_image(given.image, "pattern.image"),
                      .repeat_u = given.repeat_u,
                      .repeat_v = given.repeat_v,
                      .mapping = to_enum(given.mapping, ImageMapping::cubic, "pattern.mapping",
                                         "crt_image_mapping"),
                      .direction = to_vec3(given.direction),
                      .scale = given.scale,
                      .offset = to_vec3(given.offset)};
    default:
      reject_value("pattern.type", given.type, "crt_pattern_type");
  }
}

crt_pattern default_pattern(std::int32_t type) {
  crt_pattern out{};
  out.struct_size = sizeof out;
  out.alpha_a = out.alpha_b = 1;
  const ImageMap map;
  out.repeat_u = map.repeat_u;
  out.repeat_v = map.repeat_v;
  put_defaults<Marble>(out);  // has every field
  switch (type) {
    case CRT_PATTERN_CHECKER:
      put_defaults<Checker>(out);
      break;
    case CRT_PATTERN_STRIPES:
      put_defaults<Stripes>(out);
      break;
    case CRT_PATTERN_GRADIENT:
      put_defaults<Gradient>(out);
      break;
    case CRT_PATTERN_NOISE:
      put_defaults<Noise>(out);
      break;
    case CRT_PATTERN_MARBLE:
      break;
    case CRT_PATTERN_IMAGE:
      put(out.direction, map.direction);
      break;
    case CRT_PATTERN_WOOD:
      put_defaults<Wood>(out);
      break;
    default:
      reject_value("type", type, "crt_pattern_type");
  }
  out.type = type;
  return out;
}

template <>
crt_pattern defaults<crt_pattern>() {
  return default_pattern(CRT_PATTERN_CHECKER);
}

}  // namespace crt::capi
