// This file converts materials, lights, cameras and backgrounds from C to C++ and back. The
// defaults are converted from the C++ structs, never written down a second time.
#include <type_traits>

#include "capi/numbers.hpp"
#include "capi/structs.hpp"
#include "text/format.hpp"

namespace crt::capi {

void reject_value(const char* argument, std::int32_t value, const char* list) {
  reject(argument, text::format("is {}, which is no {}", value, list));
}

void give_text(const std::string& from, const char* argument, char* text, std::size_t capacity,
               std::size_t* length) {
  require(length, "length");
  if (capacity > 0) require(text, argument);
  *length = from.size();
  if (capacity == 0) return;
  const std::size_t fitting = std::min(from.size(), capacity - 1);
  std::copy_n(from.data(), fitting, text);
  text[fitting] = 0;
}

Vec3 to_vec3(const double* numbers, const char* argument) {
  require(numbers, argument);
  return {numbers[0], numbers[1], numbers[2]};
}

// ---- materials ----------------------------------------------------------------------------------

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
  out.lens_radius = camera.lens_radius;
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
          .lens_radius = given.lens_radius,
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
