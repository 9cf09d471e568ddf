// All descriptions are checked here but those of primitives, which geometry/ knows.
#include "crt/validate.hpp"

#include <bit>
#include <cmath>
#include <numbers>
#include <string_view>

#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

constexpr double largest_coordinate = 1e100;
constexpr double largest_factor = 1e30;
constexpr int fewest_samples = 4;
constexpr int most_samples = 65536;
constexpr double pi = std::numbers::pi;

[[noreturn]] void reject(std::string_view field, const std::string& what) {
  throw Error(ErrorCode::invalid_argument, text::format("{} {}", field, what), std::string(field));
}

/// Checks that a number is in [lowest, highest].
void require_between(std::string_view field, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;
  if (!std::isfinite(value))
    reject(field, text::format("must be a finite number (it is {})", value));
  if (highest == largest_factor || highest == largest_coordinate) {
    if (value < lowest)
      reject(field, text::format("must be at least {} (it is {})", lowest, value));
    reject(field, text::format("must be at most {} (it is {})", highest, value));
  }
  reject(field, text::format("must be between {} and {} (it is {})", lowest, highest, value));
}

/// Checks that a number is a power of two in [lowest, highest].
void require_power_of_two(std::string_view field, int value, int lowest, int highest) {
  require_between(field, value, lowest, highest);
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
    if (std::abs(point[axis]) > largest_coordinate)
      reject(field, "must have coordinates of at most 1e100");
  }
}

void require_direction(std::string_view field, const Vec3& direction) {
  require_point(field, direction);
  if (direction == Vec3(0)) reject(field, "must not be zero");
}

void require_different(const Vec3& from, const Vec3& pointing, std::string_view from_name) {
  if (from == pointing) {
    reject("pointing", text::format("must differ from {}, or there is no direction", from_name));
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

void require_image(const std::shared_ptr<const Image>& image) {
  if (!image || image->empty()) reject("image", "must be a picture (there is none)");
}

constexpr int max_nested_patterns = 5;
constexpr std::size_t max_color_stops = 64;

void require_stops(const std::vector<ColorStop>& stops) {
  if (stops.empty()) return;
  if (stops.size() < 2 || stops.size() > max_color_stops)
    reject("colors",
           text::format("must be between 2 and {} (there are {})", max_color_stops, stops.size()));
  double before = 0;
  for (const ColorStop& stop : stops) {
    require_color("colors", stop.color, largest_factor);
    if (!(stop.position >= before && stop.position <= 1))
      reject("colors",
             text::format("must have ascending positions from 0 to 1 (one is {})", stop.position));
    before = stop.position;
  }
}

struct PatternCheck {
  int depth = 1;

  void operator()(const Checker& pattern) const { common(pattern); }
  void operator()(const Stripes& pattern) const {
    common(pattern);
    require_direction("direction", pattern.direction);
  }
  void operator()(const Gradient& pattern) const {
    common(pattern);
    require_direction("direction", pattern.direction);
  }
  void operator()(const Noise& pattern) const {
    common(pattern);
    octaves(pattern.octaves);
  }
  void operator()(const Marble& pattern) const { grained(pattern); }
  void operator()(const Wood& pattern) const { grained(pattern); }
  void operator()(const ImageMap& pattern) const {
    require_image(pattern.image);
    require_positive("repeat_u", pattern.repeat_u, largest_factor);
    require_positive("repeat_v", pattern.repeat_v, largest_factor);
    if (pattern.mapping < ImageMapping::uv || pattern.mapping > ImageMapping::cubic)
      reject("mapping", "must be one of ImageMapping");
    require_direction("direction", pattern.direction);
    require_positive("scale", pattern.scale, largest_coordinate);
    require_point("offset", pattern.offset);
  }

 private:
  template <class P>
  void common(const P& pattern) const {
    require_color("color_a", pattern.color_a, largest_factor);
    require_color("color_b", pattern.color_b, largest_factor);
    nested_pattern("color_a", pattern.pattern_a);
    nested_pattern("color_b", pattern.pattern_b);
    if constexpr (requires { pattern.colors; }) {
      require_stops(pattern.colors);
      if (!pattern.colors.empty() && (pattern.pattern_a || pattern.pattern_b))
        reject("colors", "take the place of both colours, so there can be no patterns in these");
    }
    require_positive("scale", pattern.scale, largest_coordinate);
    require_point("offset", pattern.offset);
  }
  template <class P>
  void grained(const P& pattern) const {
    common(pattern);
    require_direction("direction", pattern.direction);
    require_between("turbulence", pattern.turbulence, 0, largest_factor);
    octaves(pattern.octaves);
  }
  void nested_pattern(std::string_view field, const SharedPattern& inner) const {
    if (!inner) return;
    if (depth >= max_nested_patterns)
      reject(field,
             text::format("has more than {} patterns within one another", max_nested_patterns));
    std::visit(PatternCheck{depth + 1}, inner->pattern);
  }

  static void octaves(int count) { require_between("octaves", count, 1, 16); }
};

struct LightCheck {
  void operator()(const PointLight& light) const {
    require_point("origin", light.origin);
    common(light);
    falloff(light.falloff);
  }
  void operator()(const ParallelLight& light) const {
    require_point("from", light.from);
    require_point("pointing", light.pointing);
    require_different(light.from, light.pointing, "from");
    common(light);
  }
  void operator()(const SpotLight& light) const {
    aimed(light);
    require_positive("angle", light.angle, 2 * pi);
    require_between("penumbra", light.penumbra, 0, light.angle / 2);
  }
  void operator()(const CylinderLight& light) const {
    aimed(light);
    require_positive("radius", light.radius, largest_coordinate);
  }

 private:
  template <class L>
  static void common(const L& light) {
    require_color("color", light.color, largest_factor);
    require_between("ambient", light.ambient, 0, largest_factor);
  }
  template <class L>
  static void aimed(const L& light) {
    require_point("origin", light.origin);
    require_point("pointing", light.pointing);
    require_different(light.origin, light.pointing, "origin");
    common(light);
    falloff(light.falloff);
  }
  // Falloff is proportional to the square of a length. There is none if it is 0 or less.
  static void falloff(double value) { require_between("falloff", value, -1e200, 1e200); }
};

struct BackgroundCheck {
  void operator()(const SolidBackground& background) const {
    require_color("color", background.color, largest_factor);
  }
  void operator()(const GradientBackground& background) const {
    require_color("horizon", background.horizon, largest_factor);
    require_color("sky", background.sky, largest_factor);
  }
  void operator()(const PanoramaBackground& background) const {
    require_image(background.image);
    require_between("angle", background.angle, -largest_factor, largest_factor);
  }
};

}  // namespace

void validate(const Pattern& pattern) {
  std::visit(PatternCheck{}, pattern);
}

void validate(const Material& material) {
  if (const auto* color = std::get_if<Color>(&material.color)) {
    require_color("color", *color, largest_factor);
  } else {
    validate(std::get<Pattern>(material.color));
  }
  require_between("reflectivity", material.reflectivity, 0, 1);
  require_between("transparency", material.transparency, 0, 1);
  require_between("refractive_index", material.refractive_index, 0.01, 100);
  if (material.diffuse) require_between("diffuse", *material.diffuse, 0, largest_factor);
  require_between("specular", material.specular, 0, largest_factor);
  require_between("shininess", material.shininess, 0, largest_factor);
  // Absorption is proportional to the inverse of a length.
  require_color("absorption", material.absorption, largest_coordinate);
  if (material.bump) validate(*material.bump);
  require_between("bump_height", material.bump_height, -largest_coordinate, largest_coordinate);
}

void validate(const Light& light) {
  std::visit(LightCheck{}, light);
}

void validate(const Camera& camera) {
  require_point("position", camera.position);
  require_point("pointing", camera.pointing);
  require_different(camera.position, camera.pointing, "position");
  const bool may_be_pi = camera.projection == Projection::spherical;
  require_positive("fov", camera.fov, pi);
  if (camera.fov == pi && !may_be_pi)
    reject("fov", "must be less than half a turn (180 degrees, pi)");
  require_between("roll", camera.roll, -largest_factor, largest_factor);
  require_between("aperture", camera.aperture, 0, largest_coordinate);
  require_between("lens_radius", camera.lens_radius, 0, largest_coordinate);
  if (camera.aperture > 0 && camera.lens_radius > 0)
    reject("lens_radius", "must be 0 where there is an aperture: both say how large the lens is");
  require_positive("focal_distance", camera.focal_distance, largest_coordinate);
}

void validate(const Background& background) {
  std::visit(BackgroundCheck{}, background);
}

void validate(const Settings& settings) {
  require_between("width", settings.width, 1, 65536);
  require_between("height", settings.height, 1, 65536);
  constexpr std::int64_t most_pixels = std::int64_t{1} << 27;
  if (std::int64_t{settings.width} * settings.height > most_pixels) {
    reject("height", text::format("makes a picture of {} x {}: over 134217728 pixels",
                                  settings.width, settings.height));
  }
  require_between("gamma", settings.gamma, 0.1, 10);
  require_between("supersampling", settings.supersampling, 1, 64);
  require_between("dof_samples", settings.dof_samples, 1, 65536);
  require_between("target_error", settings.target_error, 0, 1);
  require_between("time_budget", settings.time_budget, 0, 1e6);
  require_power_of_two("min_samples", settings.min_samples, fewest_samples, most_samples);
  require_power_of_two("max_samples", settings.max_samples, fewest_samples, most_samples);
  if (settings.max_samples < settings.min_samples) {
    reject("max_samples", text::format("must not be less than min_samples ({}), but is {}",
                                       settings.min_samples, settings.max_samples));
  }
  require_between("filter_width", settings.filter_width, 1, 16);
  require_between("recursion_depth", settings.recursion_depth, 0, 256);
  require_between("min_weight", settings.min_weight, 0, 1);
  if (settings.compat != 0 && settings.compat != compat_2015) {
    reject("compat", text::format("must be 0 or {} (it is {})", compat_2015, settings.compat));
  }
}

SharedMaterial::SharedMaterial(Material material) {
  validate(material);
  material_ = std::make_shared<const Material>(std::move(material));
}

}  // namespace crt
