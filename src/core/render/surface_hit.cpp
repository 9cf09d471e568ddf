#include "core/render/surface_hit.hpp"

#include <cmath>

#include "core/shading/bump.hpp"

namespace crt::core {

namespace {

PatternPoint pattern_point(const HitPoint& point) {
  return {.position = point.object_position, .normal = point.object_normal, .u = point.u, .v = point.v};
}

Color material_color(const PreparedMaterial& material, const HitPoint& point, RenderStats& stats) {
  if (!material.pattern) return material.color;
  ++stats.pattern_lookups;
  return material.pattern->color(pattern_point(point));
}

/// The outward normal in the world, tilted by the material's bumps.
Vec3 bumped_normal(const PreparedData& data, const PreparedMaterial& material, const HitPoint& point,
                   Workspace& work) {
  const Leaf& leaf = data.leaf(point);
  const LuminanceGradient luminance =
      luminance_gradient(*material.bump, pattern_point(point), *leaf.shape, point.face, work.scratch);
  work.stats.pattern_lookups += static_cast<std::uint64_t>(luminance.lookups);
  const Vec3 height_gradient =
      material.description->bump_height * leaf.placement->covector_to_world(luminance.gradient);
  return tilted_normal(point.normal, height_gradient);
}

/// exp(-absorption * length), also where the length is infinite.
double left_of(double absorption, double length) {
  return absorption > 0 ? std::exp(-absorption * length) : 1;
}

}  // namespace

void look_up(const PreparedData& data, const WorldRay& ray, const RayHit& hit, Workspace& work,
             SurfaceHit& surface) {
  const PreparedMaterial& material = data.materials()[data.hit_material(hit)];
  HitPoint& point = surface.point;
  PhongSurface& phong = surface.phong;
  data.hit_point(ray, hit, material.pattern || material.bump, point);
  surface.material = &material;

  const Color color = material_color(material, point, work.stats);
  phong.color = rgb(color);
  surface.transparency = material.opaque ? 0 : material.transparency(color.a);
  phong.diffuse = material.diffuse(surface.transparency);
  phong.specular = material.description->specular;
  phong.shininess = material.description->shininess;
  phong.view = ray.direction;

  const double to_viewer = point.entering ? 1 : -1;
  data.start_point(ray, hit, point.entering ? Side::outside : Side::inside, surface.start);
  surface.face_normal = to_viewer * point.normal;
  if (material.bump) {
    phong.normal = visible_normal(to_viewer * bumped_normal(data, material, point, work), ray.direction);
  } else {
    phong.normal = to_viewer * point.normal;
  }
}

CrossingFilter crossing_filter(const PreparedData& data, const WorldRay& ray, const RayHit& crossing,
                               RenderStats& stats) {
  const PreparedMaterial& material = data.materials()[data.hit_material(crossing)];
  Color color = material.color;
  if (material.pattern) {
    HitPoint point;
    data.hit_point(ray, crossing, true, point);
    color = material_color(material, point, stats);
  }
  return {.transparency = material.transparency(color.a), .color = rgb(color)};
}

Rgb transmittance(const PreparedMaterial& medium, double length) {
  const Color& absorption = medium.description->absorption;
  return {left_of(absorption.r, length), left_of(absorption.g, length), left_of(absorption.b, length)};
}

}  // namespace crt::core
