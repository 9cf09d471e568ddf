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

/// In some of the lanes.
void set_material(const PreparedMaterial& material, const Rgb& color, double transparency, RayMask lanes,
                  PhongSurfaces& surfaces) {
  const LaneMask mask = lanes_with(lanes);
  const auto set = [&](Lanes& values, double value) { values = mask ? lanes_of(value) : values; };
  surfaces.color = chosen(mask, lanes_of(color), surfaces.color);
  set(surfaces.diffuse, material.diffuse(transparency));
  set(surfaces.specular, material.description->specular);
  set(surfaces.shininess, material.description->shininess);
}

/// Likewise; the normals are the solids'.
void set_points(const SurfacePointLanes& points, bool entering, RayMask lanes, SurfaceGroup& group) {
  const LaneMask mask = lanes_with(lanes);
  group.position = chosen(mask, points.position, group.position);
  group.face_normal = chosen(mask, entering ? points.normal : -points.normal, group.face_normal);
  group.phong.normal = chosen(mask, group.face_normal, group.phong.normal);
}

void look_up_one(const PreparedData& data, const WorldRay& ray, const RayHit& hit, Workspace& work,
                 const SurfaceLane& surface) {
  const PreparedMaterial& material = *surface.hit().material;
  HitPoint point;
  data.hit_point(ray, hit, material.pattern || material.bump, point);
  const Color color = material_color(material, point, work.stats);
  const double transparency = material.opaque ? 0 : material.transparency(color.a);
  surface.hit().transparency = transparency;

  SurfaceGroup& group = surface.group;
  set_material(material, rgb(color), transparency, RayMask{1} << surface.lane, group.phong);
  const double to_viewer = point.entering ? 1 : -1;
  const Vec3 face_normal = to_viewer * point.normal;
  group.position.set(surface.lane, point.position);
  group.face_normal.set(surface.lane, face_normal);
  if (material.bump) {
    const Vec3 bumped = to_viewer * bumped_normal(data, material, point, work);
    group.phong.normal.set(surface.lane, visible_normal(bumped, ray.direction));
  } else {
    group.phong.normal.set(surface.lane, face_normal);
  }
}

/// Those of a group of rays that hit the same face of the same leaf, from the same side.
RayMask rays_like(const RayHit& first, std::span<const RayHit, lane_count> hits) {
  RayMask alike = 0;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const RayHit& hit = hits[lane];
    const bool is_alike = hit.leaf == first.leaf && hit.face == first.face && hit.entering == first.entering;
    alike |= static_cast<RayMask>(is_alike) << lane;
  }
  return alike;
}

}  // namespace

void look_up(const PreparedData& data, std::span<const WorldRay, lane_count> rays,
             std::span<const RayHit, lane_count> hits, RayMask seen, SurfaceGroup& group, Workspace& work) {
  const RayLanes lines = ray_lanes(rays);
  const Lanes t = {hits[0].t, hits[1].t, hits[2].t, hits[3].t};
  const Lanes start_errors = start_rounding * largest_component(lines.at(t));
  group.phong.view = lines.direction;
  for (RayMask to_come = seen; to_come != 0;) {
    const RayHit& hit = hits[first_ray(to_come)];
    const RayMask alike = rays_like(hit, hits) & to_come;
    to_come &= ~alike;
    const PreparedMaterial& material = data.materials()[data.hit_material(hit)];
    const double transparency = material.opaque ? 0 : material.transparency(material.color.a);
    const StartPoint start = data.start_face(hit, hit.entering ? Side::outside : Side::inside);
    for_each_ray(alike, [&](std::size_t lane) {
      group.hits[lane] = {&material, transparency, start};
      group.hits[lane].start.t_error = start_errors[static_cast<int>(lane)];
    });
    if (!material.uniform()) {
      for_each_ray(alike, [&](std::size_t lane) {
        look_up_one(data, rays[lane], hits[lane], work, {group, lane});
      });
      continue;
    }
    SurfacePointLanes points;
    data.hit_points(rays, hits, lines, t, alike, points);
    set_points(points, hit.entering, alike, group);
    set_material(material, rgb(material.color), transparency, alike, group.phong);
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
