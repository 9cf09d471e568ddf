// This file converts materials, lights, cameras and backgrounds from C to C++ and back. The
// defaults are converted from the C++ structs, never written down a second time.
#include <fmt/format.h>

#include <type_traits>

#include "capi/structs.hpp"
#include "crt/pattern.hpp"

namespace crt::capi {

namespace {

Color to_color(const double (&rgb)[3], double alpha = 1) {
  return {rgb[0], rgb[1], rgb[2], alpha};
}

Vec3 to_vec3(const double (&numbers)[3]) {
  return {numbers[0], numbers[1], numbers[2]};
}

void put(double (&out)[3], const Vec3& v) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = v[axis];
}

void put(double (&out)[3], const Color& color) {
  out[0] = color.r;
  out[1] = color.g;
  out[2] = color.b;
}

std::shared_ptr<const Image> to_image(const crt_image* image, const char* argument) {
  require(image, argument);
  return image->value;
}

/// Converts the fields that nearly every pattern has.
template <class Type>
void take_colors(Type& pattern, const crt_pattern& given) {
  pattern.color_a = to_color(given.color_a, given.alpha_a);
  pattern.color_b = to_color(given.color_b, given.alpha_b);
  pattern.scale = given.scale;
  pattern.offset = to_vec3(given.offset);
  if constexpr (requires { pattern.direction; }) pattern.direction = to_vec3(given.direction);
  if constexpr (requires { pattern.octaves; }) pattern.octaves = given.octaves;
  if constexpr (requires { pattern.turbulence; }) pattern.turbulence = given.turbulence;
}

template <class Type>
Pattern colored(const crt_pattern& given) {
  Type pattern;
  take_colors(pattern, given);
  return pattern;
}

Pattern to_pattern(const crt_pattern* pattern, const char* argument) {
  const auto given = taken(pattern, argument);
  switch (given.type) {
    case CRT_PATTERN_CHECKER:
      return colored<Checker>(given);
    case CRT_PATTERN_STRIPES:
      return colored<Stripes>(given);
    case CRT_PATTERN_GRADIENT:
      return colored<Gradient>(given);
    case CRT_PATTERN_NOISE:
      return colored<Noise>(given);
    case CRT_PATTERN_MARBLE:
      return colored<Marble>(given);
    case CRT_PATTERN_WOOD:
      return colored<Wood>(given);
    case CRT_PATTERN_IMAGE:
      return ImageMap{.image = to_image(given.image, "pattern.image"),
                      .repeat_u = given.repeat_u,
                      .repeat_v = given.repeat_v};
    default:
      reject_value("pattern.type", given.type, "crt_pattern_type");
  }
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

void reject_value(const char* argument, std::int32_t value, const char* list) {
  reject(argument, fmt::format("is {}, which is no {}", value, list));
}

Vec3 to_vec3(const double* numbers, const char* argument) {
  require(numbers, argument);
  return {numbers[0], numbers[1], numbers[2]};
}

// ---- patterns and materials
// -----------------------------------------------------------------------

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
    case CRT_PATTERN_IMAGE:
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

/// This value stands for a diffuse factor that follows from the others.
constexpr double automatic_diffuse = -1;

template <>
crt_material defaults<crt_material>() {
  const Material material;
  crt_material out{};
  out.struct_size = sizeof out;
  const Color& color = std::get<Color>(material.color);
  put(out.color, color);
  out.alpha = color.a;
  out.reflectivity = material.reflectivity;
  out.transparency = material.transparency;
  out.refractive_index = material.refractive_index;
  out.diffuse = automatic_diffuse;
  out.specular = material.specular;
  out.shininess = material.shininess;
  put(out.absorption, material.absorption);
  out.bump_height = material.bump_height;
  return out;
}

Material to_material(const crt_material* material) {
  const auto given = taken(material, "material");
  Material result;
  if (given.pattern != nullptr) {
    result.color = to_pattern(given.pattern, "material.pattern");
  } else {
    result.color = to_color(given.color, given.alpha);
  }
  result.reflectivity = given.reflectivity;
  result.transparency = given.transparency;
  result.refractive_index = given.refractive_index;
  if (given.diffuse != automatic_diffuse) result.diffuse = given.diffuse;
  result.specular = given.specular;
  result.shininess = given.shininess;
  result.absorption = to_color(given.absorption);
  if (given.bump != nullptr) result.bump = to_pattern(given.bump, "material.bump");
  result.bump_height = given.bump_height;
  return result;
}

// ---- lights
// ---------------------------------------------------------------------------------------

namespace {

/// Visits the fields of a light of C that this type of C++ has.
template <class Type>
Light light_of(const crt_light& given) {
  Type light;
  if constexpr (requires { light.origin; }) light.origin = to_vec3(given.origin);
  if constexpr (requires { light.from; }) light.from = to_vec3(given.origin);
  if constexpr (requires { light.pointing; }) light.pointing = to_vec3(given.pointing);
  if constexpr (requires { light.angle; }) light.angle = given.angle;
  if constexpr (requires { light.penumbra; }) light.penumbra = given.penumbra;
  if constexpr (requires { light.radius; }) light.radius = given.radius;
  if constexpr (requires { light.falloff; }) light.falloff = given.falloff;
  light.color = to_color(given.color);
  light.ambient = given.ambient;
  return light;
}

template <class Type>
void put_light(crt_light& out, const Type& light) {
  if constexpr (requires { light.origin; }) put(out.origin, light.origin);
  if constexpr (requires { light.from; }) put(out.origin, light.from);
  if constexpr (requires { light.pointing; }) put(out.pointing, light.pointing);
  if constexpr (requires { light.angle; }) out.angle = light.angle;
  if constexpr (requires { light.penumbra; }) out.penumbra = light.penumbra;
  if constexpr (requires { light.radius; }) out.radius = light.radius;
  if constexpr (requires { light.falloff; }) out.falloff = light.falloff;
  put(out.color, light.color);
  out.ambient = light.ambient;
}

template <class Type>
constexpr std::int32_t light_type = std::is_same_v<Type, PointLight>      ? CRT_LIGHT_POINT
                                    : std::is_same_v<Type, ParallelLight> ? CRT_LIGHT_PARALLEL
                                    : std::is_same_v<Type, SpotLight>     ? CRT_LIGHT_SPOT
                                                                          : CRT_LIGHT_CYLINDER;

}  // namespace

crt_light to_c(const Light& light) {
  crt_light out{};
  out.struct_size = sizeof out;
  // Fields that this type does not use still have their defaults.
  put_light(out, SpotLight{});
  put_light(out, CylinderLight{});
  put_light(out, PointLight{});
  put(out.pointing, Vec3(0));
  std::visit(
      [&out]<class Type>(const Type& given) {
        out.type = light_type<Type>;
        put_light(out, given);
      },
      light);
  return out;
}

crt_light default_light(std::int32_t type) {
  switch (type) {
    case CRT_LIGHT_POINT:
      return to_c(PointLight{});
    case CRT_LIGHT_PARALLEL:
      return to_c(ParallelLight{});
    case CRT_LIGHT_SPOT:
      return to_c(SpotLight{});
    case CRT_LIGHT_CYLINDER:
      return to_c(CylinderLight{});
    default:
      reject_value("type", type, "crt_light_type");
  }
}

template <>
crt_light defaults<crt_light>() {
  return default_light(CRT_LIGHT_POINT);
}

Light to_light(const crt_light* light) {
  const auto given = taken(light, "light");
  switch (given.type) {
    case CRT_LIGHT_POINT:
      return light_of<PointLight>(given);
    case CRT_LIGHT_PARALLEL:
      return light_of<ParallelLight>(given);
    case CRT_LIGHT_SPOT:
      return light_of<SpotLight>(given);
    case CRT_LIGHT_CYLINDER:
      return light_of<CylinderLight>(given);
    default:
      reject_value("light.type", given.type, "crt_light_type");
  }
}

// ---- cameras
// ----------------------------------------------------------------------------------------

crt_camera to_c(const Camera& camera) {
  crt_camera out{};
  out.struct_size = sizeof out;
  out.projection = static_cast<std::int32_t>(camera.projection);
  put(out.position, camera.position);
  put(out.pointing, camera.pointing);
  out.fov = camera.fov;
  out.roll = camera.roll;
  out.aperture = camera.aperture;
  out.focal_distance = camera.focal_distance;
  out.aperture_shape = static_cast<std::int32_t>(camera.aperture_shape);
  return out;
}

template <>
crt_camera defaults<crt_camera>() {
  return to_c(Camera{});
}

static_assert(static_cast<int>(Projection::pinhole) == CRT_PROJECTION_PINHOLE);
static_assert(static_cast<int>(Projection::orthographic) == CRT_PROJECTION_ORTHOGRAPHIC);
static_assert(static_cast<int>(ApertureShape::circle) == CRT_APERTURE_CIRCLE);
static_assert(static_cast<int>(ApertureShape::line) == CRT_APERTURE_LINE);

Camera to_camera(const crt_camera* camera) {
  const auto given = taken(camera, "camera");
  return {.position = to_vec3(given.position),
          .pointing = to_vec3(given.pointing),
          .fov = given.fov,
          .roll = given.roll,
          .projection = to_enum(given.projection, Projection::orthographic, "camera.projection",
                                "crt_projection"),
          .aperture = given.aperture,
          .focal_distance = given.focal_distance,
          .aperture_shape = to_enum(given.aperture_shape, ApertureShape::line,
                                    "camera.aperture_shape", "crt_aperture_shape")};
}

// ---- backgrounds
// ------------------------------------------------------------------------------------

constexpr int panorama_type(PanoramaProjection projection) {
  return CRT_BACKGROUND_SPHERICAL + static_cast<int>(projection);
}
static_assert(panorama_type(PanoramaProjection::spherical) == CRT_BACKGROUND_SPHERICAL);
static_assert(panorama_type(PanoramaProjection::cylindrical) == CRT_BACKGROUND_CYLINDRICAL);
static_assert(panorama_type(PanoramaProjection::equal_area) == CRT_BACKGROUND_EQUAL_AREA);

crt_background to_c(const Background& background, const crt_image* image) {
  crt_background out{};
  out.struct_size = sizeof out;
  const auto put_solid = [&out](const SolidBackground& solid) {
    put(out.color, solid.color);
    out.alpha = solid.color.a;
  };
  const auto put_gradient = [&out](const GradientBackground& gradient) {
    put(out.horizon, gradient.horizon);
    out.horizon_alpha = gradient.horizon.a;
    put(out.sky, gradient.sky);
    out.sky_alpha = gradient.sky.a;
  };
  put_solid({});
  put_gradient({});
  if (const auto* solid = std::get_if<SolidBackground>(&background)) {
    out.type = CRT_BACKGROUND_SOLID;
    put_solid(*solid);
  } else if (const auto* gradient = std::get_if<GradientBackground>(&background)) {
    out.type = CRT_BACKGROUND_GRADIENT;
    put_gradient(*gradient);
  } else {
    const auto& panorama = std::get<PanoramaBackground>(background);
    out.type = panorama_type(panorama.projection);
    out.image = image;
    out.angle = panorama.angle;
  }
  return out;
}

template <>
crt_background defaults<crt_background>() {
  return to_c(Background{SolidBackground{}}, nullptr);
}

Background to_background(const crt_background* background) {
  const auto given = taken(background, "background");
  switch (given.type) {
    case CRT_BACKGROUND_SOLID:
      return SolidBackground{.color = to_color(given.color, given.alpha)};
    case CRT_BACKGROUND_GRADIENT:
      return GradientBackground{.horizon = to_color(given.horizon, given.horizon_alpha),
                                .sky = to_color(given.sky, given.sky_alpha)};
    case CRT_BACKGROUND_SPHERICAL:
    case CRT_BACKGROUND_CYLINDRICAL:
    case CRT_BACKGROUND_EQUAL_AREA:
      return PanoramaBackground{
          .image = to_image(given.image, "background.image"),
          .projection = static_cast<PanoramaProjection>(given.type - CRT_BACKGROUND_SPHERICAL),
          .angle = given.angle};
    default:
      reject_value("background.type", given.type, "crt_background_type");
  }
}

}  // namespace crt::capi
