// These tables of the schema are those of lights, the camera and backgrounds, a row a field (see
// crt/schema.hpp).
#pragma once

#include <crt/background.hpp>
#include <crt/camera.hpp>
#include <crt/light.hpp>
#include <crt/schema.hpp>
#include <numbers>

/// @cond tables
namespace crt::schema {

template <>
inline constexpr auto choices<Projection> = choice("Projection", "crt_projection", "CRT_PROJECTION",
                                                   "pinhole", "spherical", "cylindrical",
                                                   "orthographic");
template <>
inline constexpr auto choices<ApertureShape> = choice("ApertureShape", "crt_aperture_shape",
                                                      "CRT_APERTURE", "circle", "uniform",
                                                      "gaussian", "triangle", "square", "pentagon",
                                                      "hexagon", "octagon", "line");
template <>
inline constexpr auto choices<PanoramaProjection> = choice("PanoramaProjection",
                                                           "crt_background_type", "CRT_BACKGROUND",
                                                           "spherical", "cylindrical",
                                                           "equal_area");

/// Lights have some of these rows.
template <class Light>
inline constexpr auto color = field("color", &Light::color, brightness, required, "");
/// It is proportional to the square of a length. There is none if it is 0 or less.
template <class Light>
inline constexpr auto falloff = field("falloff", &Light::falloff, between(-1e200, 1e200), {}, "");
template <class Light>
inline constexpr auto ambient = field("ambient", &Light::ambient, factor, {}, "");

template <>
inline constexpr auto table<PointLight> = Table{
    "PointLight",
    field("origin", &PointLight::origin, point, required, ""),
    color<PointLight>,
    falloff<PointLight>,
    ambient<PointLight>,
    field("radius", &PointLight::radius, between(0, largest_length), {},
          "above 0 it is a ball that softens shadows, which is not seen"),
};

template <>
inline constexpr auto table<ParallelLight> = Table{
    "ParallelLight",
    field("from", &ParallelLight::from, point, {.required = true, .c = "origin"},
          "the direction is that from `from`"),
    field("pointing", &ParallelLight::pointing, apart_from("from"), required,
          "to `pointing`, which is another point"),
    color<ParallelLight>,
    ambient<ParallelLight>,
    field("angle", &ParallelLight::angle, between(0, std::numbers::pi),
          {.degrees = "must be between 0 and 180 degrees"},
          "above 0, how wide it is seen in degrees, at most 180; it softens shadows"),
};

template <>
inline constexpr auto table<SpotLight> = Table{
    "SpotLight",
    field("origin", &SpotLight::origin, point, required, ""),
    field("pointing", &SpotLight::pointing, apart_from("origin"), required,
          "a point on the cone's axis; another than `origin`"),
    color<SpotLight>,
    field("angle", &SpotLight::angle, above_0_to(2 * std::numbers::pi),
          {.degrees = "must be greater than 0 and at most 360 degrees"},
          "the full angle of the cone in degrees, above 0 and at most 360"),
    field("penumbra", &SpotLight::penumbra, any,
          {.degrees = "must be between 0 and half of 'angle' (in degrees)"},
          "how far it fades inwards from the cone, in degrees, 0 to angle / 2"),
    falloff<SpotLight>,
    ambient<SpotLight>,
};

template <>
inline constexpr auto table<CylinderLight> = Table{
    "CylinderLight",
    field("origin", &CylinderLight::origin, point, required, "where the cylinder begins"),
    field("pointing", &CylinderLight::pointing, apart_from("origin"), required,
          "a point on its axis; another than `origin`"),
    color<CylinderLight>,
    field("radius", &CylinderLight::radius, extent, required, "above 0"),
    falloff<CylinderLight>,
    ambient<CylinderLight>,
};

/// Lights with a surface have some of these rows.
template <class Light>
inline constexpr auto radiance = field("color", &Light::color, brightness, required,
                                       "its radiance");
template <class Light>
inline constexpr auto visible = field("visible", &Light::visible, any, {},
                                      "whether it is seen itself");
template <class Light>
inline constexpr auto two_sided = field("two_sided", &Light::two_sided, any, {.script = "twosided"},
                                        "whether it shines to both sides");

template <>
inline constexpr auto table<SphereLight> = Table{
    "SphereLight",
    field("center", &SphereLight::center, point, {.required = true, .c = "origin"}, ""),
    field("radius", &SphereLight::radius, extent, required, "above 0"),
    radiance<SphereLight>,
    visible<SphereLight>,
};

template <>
inline constexpr auto table<DiscLight> = Table{
    "DiscLight",
    field("center", &DiscLight::center, point, {.required = true, .c = "origin"}, ""),
    // C says a point that it faces.
    field("normal", &DiscLight::normal, direction, {.required = true, .in_c = false},
          "the side that it shines to, not 0"),
    field("radius", &DiscLight::radius, extent, required, "above 0"),
    radiance<DiscLight>,
    visible<DiscLight>,
    two_sided<DiscLight>,
};

template <>
inline constexpr auto table<RectangleLight> = Table{
    "RectangleLight",
    field("corner", &RectangleLight::corner, point, {.required = true, .c = "origin"}, ""),
    field("edge_a", &RectangleLight::edge_a, direction, required,
          "from the corner along one side, not 0"),
    field("edge_b", &RectangleLight::edge_b, direction, required,
          "along the other one, not parallel to the first"),
    radiance<RectangleLight>,
    visible<RectangleLight>,
    two_sided<RectangleLight>,
};

template <>
inline constexpr auto table<EnvironmentLight> = Table{
    "EnvironmentLight",
    field("scale", &EnvironmentLight::scale, factor, {}, "factor of the background's light"),
};

template <>
inline constexpr auto table<Camera> = Table{
    "Camera",
    field("position", &Camera::position, point, required, "where it stands"),
    field("pointing", &Camera::pointing, apart_from("position"), required,
          "the point that it looks at; another than `position`"),
    field("fov", &Camera::fov, above_0_to(std::numbers::pi),
          {.degrees = "must be greater than 0 and less than 180 degrees"},
          "vertical field of view in degrees, above 0 and below 180"),
    field("roll", &Camera::roll, radians,
          {.degrees = "must be a number of degrees of at most 1e30"},
          "degrees; positive tips the picture's top to the right"),
    field("projection", &Camera::projection, any, {.in_scripts = false}, ""),
    field("aperture", &Camera::aperture, between(0, largest_length), {.always_written = true},
          "radius of the lens in thousandths of a unit; needs `dofsamples`"),
    field("lens_radius", &Camera::lens_radius, between(0, largest_length), {},
          "the same in units, instead of `aperture`"),
    field("focal_distance", &Camera::focal_distance, extent, {.always_written = true},
          "how far along the view the sharp plane is, above 0"),
    field("aperture_shape", &Camera::aperture_shape, any, {}, "the shape of the lens, see below"),
    field("section_normal", &Camera::section_normal, point, {},
          "cuts solids open by a plane across it, see below"),
    field("section_offset", &Camera::section_offset, between(-largest_length, largest_length), {},
          "how far the plane is from the origin, in units of length"),
    field("section_hatch", &Camera::section_hatch, between(0, largest_length), {},
          "distance of hatching lines; 0: by the size of what is cut"),
};

template <>
inline constexpr auto table<SolidBackground> = Table{
    "SolidBackground",
    field("color", &SolidBackground::color, brightness, {.alpha = "alpha"}, "the same everywhere"),
};

template <>
inline constexpr auto table<GradientBackground> = Table{
    "GradientBackground",
    field("horizon", &GradientBackground::horizon, brightness, {.alpha = "horizon_alpha"},
          "at the height of the camera"),
    field("sky", &GradientBackground::sky, brightness, {.alpha = "sky_alpha"},
          "straight up, and mirrored straight down"),
};

template <>
inline constexpr auto table<PanoramaBackground> = Table{
    "PanoramaBackground",
    field("image", &PanoramaBackground::image, any, {}, "the [file](#files) of a panorama"),
    field("projection", &PanoramaBackground::projection, any, {.in_c = false},
          "how the panorama was taken, see below"),
    field("angle", &PanoramaBackground::angle, radians, {},
          "turns the panorama about y, in radians"),
};

template <>
inline constexpr auto table<SkyBackground> = Table{
    "SkyBackground",
    field("sun", &SkyBackground::sun, direction, {}, "the direction to the sun, not 0"),
    field("turbidity", &SkyBackground::turbidity, between(2, 10), {},
          "how hazy the air is: 2 is very clear, 6 hazy; 2 to 10"),
    field("scale", &SkyBackground::scale, factor, {}, "factor of all of its light"),
    field("ground", &SkyBackground::ground, brightness, {},
          "the colour of what is seen below the horizon"),
    field("shines", &SkyBackground::shines, any, {},
          "whether it lights the scene, or is just seen"),
};

}  // namespace crt::schema
/// @endcond
