// All descriptions are checked here by the rules of the schema, but those of primitives, which
// geometry/ knows.
#include "crt/validate.hpp"

#include <bit>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "crt/schema_materials.hpp"
#include "crt/schema_scene.hpp"
#include "crt/schema_settings.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

using schema::Rule;

[[noreturn]] void reject(std::string_view field, const std::string& what) {
  throw Error(ErrorCode::invalid_argument, text::format("{} {}", field, what), std::string(field));
}

/// Checks that a number is in [lowest, highest].
void require_between(std::string_view field, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;
  if (!std::isfinite(value))
    reject(field, text::format("must be a finite number (it is {})", value));
  if (highest == schema::largest_factor || highest == schema::largest_length) {
    if (value < lowest)
      reject(field, text::format("must be at least {} (it is {})", lowest, value));
    reject(field, text::format("must be at most {} (it is {})", highest, value));
  }
  reject(field, text::format("must be between {} and {} (it is {})", lowest, highest, value));
}

/// Checks that a number is a power of two within a range.
void require_power_of_two(std::string_view field, int value, const Rule& rule) {
  require_between(field, value, rule.low, rule.high);
  if (!std::has_single_bit(static_cast<unsigned>(value))) {
    reject(field, text::format("must be a power of 2, such as 16 or 64 (it is {})", value));
  }
}

/// Checks that a number is in (0, highest].
void require_positive(std::string_view field, double value, double highest) {
  if (value > 0 && value <= highest) return;
  if (!std::isfinite(value))
    reject(field, text::format("must be a finite number (it is {})", value));
  if (value <= 0) reject(field, text::format("must be greater than 0 (it is {})", value));
  reject(field, text::format("must be at most {} (it is {})", highest, value));
}

void require_point(std::string_view field, const Vec3& point) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(point[axis])) reject(field, "must consist of finite numbers");
    if (std::abs(point[axis]) > schema::largest_length)
      reject(field, "must have coordinates of at most 1e100");
  }
}

/// Checks that channels are in [0, highest], and alpha is in [0, 1].
void require_color(std::string_view field, const Color& color, double highest) {
  for (const double channel : {color.r, color.g, color.b}) {
    if (!std::isfinite(channel)) reject(field, "must consist of finite numbers");
    if (channel < 0 || channel > highest) {
      reject(field, text::format("must not have negative or absurd channels (one is {})", channel));
    }
  }
  if (!(color.a >= 0 && color.a <= 1))
    reject(field, text::format("must have an alpha between 0 and 1 (it is {})", color.a));
}

void require_image(std::string_view field, const std::shared_ptr<const Image>& image) {
  if (!image || image->empty()) reject(field, "must be a picture (there is none)");
}

constexpr int max_nested_patterns = 5;
constexpr std::size_t max_color_stops = 64;

void require_stops(std::string_view field, const std::vector<ColorStop>& stops) {
  if (stops.empty()) return;
  if (stops.size() < 2 || stops.size() > max_color_stops)
    reject(field,
           text::format("must be between 2 and {} (there are {})", max_color_stops, stops.size()));
  double before = 0;
  for (const ColorStop& stop : stops) {
    require_color(field, stop.color, schema::largest_factor);
    if (!(stop.position >= before && stop.position <= 1))
      reject(field,
             text::format("must have ascending positions from 0 to 1 (one is {})", stop.position));
    before = stop.position;
  }
}

/// Checks a number by the rule of its field.
void check(std::string_view field, const Rule& rule, double value) {
  if (rule.kind == Rule::between) require_between(field, value, rule.low, rule.high);
  if (rule.kind == Rule::above) require_positive(field, value, rule.high);
}
void check(std::string_view field, const Rule& rule, int value) {
  if (rule.kind == Rule::power_of_two) return require_power_of_two(field, value, rule);
  check(field, rule, static_cast<double>(value));
}
void check(std::string_view field, const Rule& rule, const std::optional<double>& value) {
  if (value) check(field, rule, *value);
}
void check(std::string_view field, const Rule& rule, const Color& value) {
  require_color(field, value, rule.high);
}
void check(std::string_view field, const Rule& rule, const std::variant<Color, Pattern>& value) {
  if (const auto* pattern = std::get_if<Pattern>(&value)) return validate(*pattern);
  check(field, rule, std::get<Color>(value));
}
void check(std::string_view field, const Rule& rule, const Share& value) {
  if (const auto* pattern = std::get_if<Pattern>(&value)) return validate(*pattern);
  check(field, rule, std::get<double>(value));
}
void check(std::string_view, const Rule&, const std::optional<Pattern>& value) {
  if (value) validate(*value);
}
void check(std::string_view field, const Rule&, const std::vector<ColorStop>& value) {
  require_stops(field, value);
}
void check(std::string_view field, const Rule&, const std::shared_ptr<const Image>& value) {
  require_image(field, value);
}
template <class Enum>
requires std::is_enum_v<Enum>
void check(std::string_view field, const Rule&, Enum value) {
  if (!schema::is_choice(value))
    reject(field, text::format("must be one of {}", schema::choices<Enum>.type));
}
// These may be anything, or are checked with their struct.
void check(std::string_view, const Rule&, bool) {}
void check(std::string_view, const Rule&, std::uint64_t) {}
void check(std::string_view, const Rule&, const std::string&) {}
void check(std::string_view, const Rule&, const SharedPattern&) {}

/// Checks a point or direction, and that it is not where the field is that the rule names.
template <class Struct>
void check_vector(const Struct& object, std::string_view field, const Rule& rule,
                  const Vec3& value) {
  require_point(field, value);
  if (rule.kind == Rule::direction && value == Vec3(0)) reject(field, "must not be zero");
  if (rule.kind == Rule::apart && value == schema::value_of<Vec3>(object, rule.other))
    reject(field, text::format("must differ from {}, or there is no direction", rule.other));
}

/// Checks each field of a struct by the rule of its row.
template <class Struct>
void check_fields(const Struct& object) {
  schema::for_each_field<Struct>([&](const auto& row) {
    const auto& value = object.*row.member;
    if constexpr (std::is_same_v<decltype(value), const Vec3&>) {
      check_vector(object, row.name, row.rule, value);
    } else {
      check(row.name, row.rule, value);
    }
  });
}

/// Checks a pattern that lies in so many others, and itself.
void check_pattern(const Pattern& pattern, int depth) {
  const auto check_nested = [depth](std::string_view field, const SharedPattern& inner) {
    if (!inner) return;
    if (depth >= max_nested_patterns)
      reject(field,
             text::format("has more than {} patterns within one another", max_nested_patterns));
    check_pattern(inner->pattern, depth + 1);
  };
  std::visit(
      [&](const auto& kind) {
        check_fields(kind);
        if constexpr (requires { kind.pattern_a; }) {
          check_nested("color_a", kind.pattern_a);
          check_nested("color_b", kind.pattern_b);
        }
        if constexpr (requires { kind.colors; }) {
          if (!kind.colors.empty() && (kind.pattern_a || kind.pattern_b))
            reject("colors",
                   "take the place of both colours, so there can be no patterns in these");
        }
      },
      pattern);
}

}  // namespace

void validate(const Pattern& pattern) {
  check_pattern(pattern, 1);
}

void validate(const Material& material) {
  check_fields(material);
}

void validate(const PrincipledMaterial& material) {
  check_fields(material);
}

void validate(const Light& light) {
  std::visit([](const auto& kind) { check_fields(kind); }, light);
  if (const auto* spot = std::get_if<SpotLight>(&light))
    require_between("penumbra", spot->penumbra, 0, spot->angle / 2);
  if (const auto* rectangle = std::get_if<RectangleLight>(&light)) {
    const Vec3 a = rectangle->edge_a / core::largest_component(rectangle->edge_a);
    const Vec3 b = rectangle->edge_b / core::largest_component(rectangle->edge_b);
    constexpr double least_sine = 0x1p-30;
    if (!(core::largest_component(glm::cross(a, b)) > least_sine))
      reject("edge_b", "must not be parallel to edge_a");
  }
}

void validate(const Camera& camera) {
  check_fields(camera);
  if (camera.fov == std::numbers::pi && camera.projection != Projection::spherical)
    reject("fov", "must be less than half a turn (180 degrees, pi)");
  if (camera.aperture > 0 && camera.lens_radius > 0)
    reject("lens_radius", "must be 0 where there is an aperture: both say how large the lens is");
}

void validate(const Background& background) {
  std::visit([](const auto& kind) { check_fields(kind); }, background);
}

void validate(const Settings& settings) {
  check_fields(settings);
  constexpr std::int64_t most_pixels = std::int64_t{1} << 27;
  if (std::int64_t{settings.width} * settings.height > most_pixels) {
    reject("height", text::format("makes a picture of {} x {}: over 134217728 pixels",
                                  settings.width, settings.height));
  }
  if (settings.max_samples < settings.min_samples) {
    reject("max_samples", text::format("must not be less than min_samples ({}), but is {}",
                                       settings.min_samples, settings.max_samples));
  }
  if (settings.clamp > 0 && settings.target_error > 0)
    reject("clamp", "must be 0 with a target_error: of clamped light no accuracy can be claimed");
  if (settings.compat != 0 && settings.compat != compat_2015) {
    reject("compat", text::format("must be 0 or {} (it is {})", compat_2015, settings.compat));
  }
}

}  // namespace crt
