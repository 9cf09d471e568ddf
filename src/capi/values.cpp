// This file converts materials, lights, cameras and backgrounds from C to C++ and back. The
// defaults are converted from the C++ structs, never written down a second time. What fields there
// are says the schema.
#include <variant>

#include "capi/fields.hpp"
#include "capi/numbers.hpp"
#include "capi/structs.hpp"
#include "crt/schema_materials.hpp"
#include "crt/schema_scene.hpp"
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

namespace {

template <class C, class Kind>
C defaults_of_material() {
  C out{};
  out.struct_size = sizeof out;
  put_fields(out, Kind{});
  return out;
}

template <class Kind, class C>
Kind material_of(const C* material) {
  const auto given = taken(material, "material");
  Kind result;
  take_fields(result, given, "material");
  take_patterns(result, given, "material");
  return result;
}

}  // namespace

template <>
crt_material defaults<crt_material>() {
  return defaults_of_material<crt_material, Material>();
}

template <>
crt_principled defaults<crt_principled>() {
  return defaults_of_material<crt_principled, PrincipledMaterial>();
}

Material to_material(const crt_material* material) {
  return material_of<Material>(material);
}

PrincipledMaterial to_material(const crt_principled* material) {
  return material_of<PrincipledMaterial>(material);
}

// ---- lights -------------------------------------------------------------------------------------

// The types of C are the kinds of C++ in their order.
static_assert(CRT_LIGHT_ENVIRONMENT + 1 == std::variant_size_v<Light>);

namespace {

/// In version 1.0, whose struct ends before this field, only cylinders had a radius and only spot
/// lights an angle.
constexpr std::size_t size_of_light_in_1_0 = offsetof(crt_light, edge_a);

}  // namespace

crt_light to_c(const Light& light) {
  crt_light out{};
  out.struct_size = sizeof out;
  // Fields that this type does not use have their defaults.
  put_defaults<Light>(out);
  out.type = static_cast<std::int32_t>(light.index());
  std::visit([&out](const auto& kind) { put_fields(out, kind); }, light);
  if (const auto* disc = std::get_if<DiscLight>(&light)) {
    const Vec3 faced = disc->center + disc->normal;
    for (int axis = 0; axis < 3; ++axis) out.pointing[axis] = faced[axis];
  }
  return out;
}

crt_light default_light(std::int32_t type) {
  Light light;
  with_kind<Light>(type, "type", "crt_light_type", [&](const auto& kind) { light = kind; });
  return to_c(light);
}

template <>
crt_light defaults<crt_light>() {
  return default_light(CRT_LIGHT_POINT);
}

template <>
crt_light defaults_of_size<crt_light>(std::size_t size) {
  crt_light light = defaults<crt_light>();
  if (size != size_of_light_in_1_0) return light;
  light.radius = CylinderLight().radius;
  light.angle = SpotLight().angle;
  return light;
}

Light to_light(const crt_light* light) {
  auto given = taken(light, "light");
  const bool is_of_1_0 = given.struct_size == size_of_light_in_1_0;
  Light result;
  with_kind<Light>(given.type, "light.type", "crt_light_type", [&]<class Kind>(Kind kind) {
    const Kind standard = kind;
    take_fields(kind, given, "light");
    // What crt_light_init() writes into fields that kinds share is of a point light.
    if constexpr (requires { kind.radius; }) {
      const bool has_default = std::is_same_v<Kind, PointLight> ? is_of_1_0 : kind.radius == 0;
      if (has_default) kind.radius = standard.radius;
    }
    if constexpr (requires { kind.angle; }) {
      const bool has_default = std::is_same_v<Kind, ParallelLight> ? is_of_1_0 : kind.angle == 0;
      if (has_default) kind.angle = standard.angle;
    }
    if constexpr (std::is_same_v<Kind, DiscLight>) {
      for (int axis = 0; axis < 3; ++axis)
        kind.normal[axis] = given.pointing[axis] - given.origin[axis];
    }
    result = kind;
  });
  return result;
}

// ---- cameras ------------------------------------------------------------------------------------

crt_camera to_c(const Camera& camera) {
  crt_camera out{};
  out.struct_size = sizeof out;
  put_fields(out, camera);
  return out;
}

template <>
crt_camera defaults<crt_camera>() {
  return to_c(Camera{});
}

static_assert(static_cast<int>(Projection::orthographic) == CRT_PROJECTION_ORTHOGRAPHIC);
static_assert(static_cast<int>(ApertureShape::line) == CRT_APERTURE_LINE);

Camera to_camera(const crt_camera* camera) {
  Camera result;
  take_fields(result, taken(camera, "camera"), "camera");
  return result;
}

// ---- backgrounds --------------------------------------------------------------------------------

constexpr int panorama_type(PanoramaProjection projection) {
  return CRT_BACKGROUND_SPHERICAL + static_cast<int>(projection);
}
static_assert(panorama_type(PanoramaProjection::spherical) == CRT_BACKGROUND_SPHERICAL);
static_assert(panorama_type(PanoramaProjection::cylindrical) == CRT_BACKGROUND_CYLINDRICAL);
static_assert(panorama_type(PanoramaProjection::equal_area) == CRT_BACKGROUND_EQUAL_AREA);

crt_background to_c(const Background& background, const crt_image* image) {
  crt_background out{};
  out.struct_size = sizeof out;
  put_fields(out, SolidBackground{});
  put_fields(out, GradientBackground{});
  put_fields(out, SkyBackground{});
  std::visit([&out](const auto& kind) { put_fields(out, kind); }, background);
  if (const auto* panorama = std::get_if<PanoramaBackground>(&background)) {
    out.type = panorama_type(panorama->projection);
    out.image = image;
  } else if (std::holds_alternative<SolidBackground>(background)) {
    out.type = CRT_BACKGROUND_SOLID;
  } else {
    out.type = std::holds_alternative<SkyBackground>(background) ? CRT_BACKGROUND_SKY
                                                                 : CRT_BACKGROUND_GRADIENT;
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
    case CRT_BACKGROUND_SKY: {
      SkyBackground sky;
      take_fields(sky, given, "background");
      return sky;
    }
    default:
      reject_value("background.type", given.type, "crt_background_type");
  }
}

}  // namespace crt::capi
