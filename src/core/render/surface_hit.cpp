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
             SurfaceHit& surface, const SurfaceLane& lit) {
  const PreparedMaterial& material = data.materials()[data.hit_material(hit)];
  surface.material = &material;
  data.start_point(ray, hit, hit.entering ? Side::outside : Side::inside, surface.start);
  PhongSurfaces& phong = lit.group.phong;
  const int lane = static_cast<int>(lit.lane);
  phong.specular[lane] = material.description->specular;
  phong.shininess[lane] = material.description->shininess;
  phong.view.set(lit.lane, ray.direction);
  const double to_viewer = hit.entering ? 1 : -1;
  if (material.plain) {
    const WorldPoint place = data.world_point(ray, hit);
    const Vec3 normal = to_viewer * place.normal;
    lit.group.position.set(lit.lane, place.position);
    lit.group.face_normal.set(lit.lane, normal);
    phong.normal.set(lit.lane, normal);
    phong.color.set(lit.lane, rgb(material.color));
    phong.diffuse[lane] = material.diffuse(0);
    return;
  }

  HitPoint& point = surface.point;
  data.hit_point(ray, hit, material.pattern || material.bump, point);
  const Color color = material_color(material, point, work.stats);
  surface.transparency = material.opaque ? 0 : material.transparency(color.a);
  const Vec3 face_normal = to_viewer * point.normal;
  lit.group.position.set(lit.lane, point.position);
  lit.group.face_normal.set(lit.lane, face_normal);
  phong.normal.set(lit.lane, material.bump
                                 ? visible_normal(to_viewer * bumped_normal(data, material, point, work), ray.direction)
                                 : face_normal);
  phong.color.set(lit.lane, rgb(color));
  phong.diffuse[lane] = material.diffuse(surface.transparency);
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
