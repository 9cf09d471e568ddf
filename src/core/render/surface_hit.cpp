#include "core/render/surface_hit.hpp"

#include <bit>
#include <numbers>

#include "core/math/power.hpp"
#include "core/prepare/hit_faces.hpp"
#include "core/shading/bump.hpp"

namespace crt::core {

namespace {

/// Returns the colours of a material in the lanes that have their bit in `same`. The points are in
/// object space.
ColorLanes material_colors(const PreparedMaterial& material, const SurfacePointLanes& points,
                           RayMask same, RenderStats& stats) {
  if (!material.pattern) return lanes_of(material.color);
  stats.pattern_lookups += static_cast<unsigned>(std::popcount(same));
  return material.pattern->colors(points, same);
}

/// Returns a normal for shading in the world, tilted by the material's bumps. `normal` and the
/// point are in object space.
Vec3 bumped_normal(const LeafOfHit& hit, std::uint32_t face, const PreparedMaterial& material,
                   const SurfacePoint& point, const Vec3& normal, Workspace& work) {
  const LuminanceGradient luminance =
      luminance_gradient(*material.bump, point, *hit.leaf().shape, face, work.scratch);
  work.stats.pattern_lookups += static_cast<std::uint64_t>(luminance.lookups);
  const Vec3 height_gradient =
      material.description->bump_height * hit.placement().covector_to_world(luminance.gradient);
  return tilted_normal(hit.placement().normal_to_world(normal), height_gradient);
}

/// Returns such a normal that is tilted by the material's normal map, too.
Vec3 mapped_normal(const LeafOfHit& hit, std::uint32_t face, const PreparedMaterial& material,
                   const SurfacePoint& point, const Vec3& normal, Workspace& work) {
  const UvGradient in_object =
      uv_gradient(*hit.leaf().shape, face, point.position, point.normal, work.scratch);
  ++work.stats.pattern_lookups;
  const UvGradient uv = {.u = hit.placement().covector_to_world(in_object.u),
                         .v = hit.placement().covector_to_world(in_object.v)};
  return mapped_normal(normal, uv, rgb(material.principled->normal_map->color(point)));
}

/// SameSideHits are rays of a group that hit one face, or spheres of one material, from the same
/// side.
struct SameSideHits {
  std::span<const RayHit, lane_count> hits;
  const RayHit& first;
  const PreparedMaterial& material;
  RayMask rays;
  LaneMask lanes = lanes_with(rays);

  void set(Lanes& values, const Lanes& value) const { values = select(lanes, value, values); }
  void set(VectorLanes& values, const VectorLanes& value) const {
    values = select(lanes, value, values);
  }
};

void set_material(const SameSideHits& same, const VectorLanes& color, const Lanes& transparency,
                  SurfaceGroup& group) {
  const Material& description = *same.material.description;
  same.set(group.phong.color, color);
  same.set(group.phong.diffuse, same.material.diffuse(transparency));
  same.set(group.phong.specular, lanes_of(description.specular));
  same.set(group.phong.shininess, lanes_of(description.shininess));
  same.set(group.reflectivity, lanes_of(description.reflectivity));
  same.set(group.transparency, transparency);
  if (!same.material.ends_paths) group.sending_on |= same.rays;
}

/// Returns the luminances of a pattern, kept within [0, 1], or the number in its place.
Lanes share_at(const Share& share, const std::optional<PreparedPattern>& pattern,
               const SurfacePointLanes& points, RayMask same, RenderStats& stats) {
  if (!pattern) return lanes_of(std::get<double>(share));
  stats.pattern_lookups += static_cast<unsigned>(std::popcount(same));
  const Lanes shares = luminances(pattern->colors(points, same).color);
  return clamp(shares, Lanes{}, lanes_of(1));
}

/// Sets what a principled material is at points in object space.
void set_principled(const SameSideHits& same, const SurfacePointLanes& points,
                    const VectorLanes& color, RenderStats& stats, SurfaceGroup& group) {
  const PreparedPrincipled& prepared = *same.material.principled;
  const PrincipledMaterial& description = *same.material.description.principled();
  PrincipledSurface<Lanes>& surface = group.principled;
  group.principled_rays |= same.rays;
  const bool transmits = description.transmission > 0;
  const bool is_outside = same.first.entering || !transmits;
  const auto set = [&same](Lanes& lanes, double value) { same.set(lanes, lanes_of(value)); };
  same.set(surface.color, color);
  same.set(surface.metallic,
           share_at(description.metallic, prepared.metallic, points, same.rays, stats));
  same.set(surface.roughness,
           share_at(description.roughness, prepared.roughness, points, same.rays, stats));
  set(surface.relative_index,
      is_outside ? description.refractive_index : 1 / description.refractive_index);
  set(surface.transmission, description.transmission);
  set(surface.coat, is_outside ? description.coat : 0);
  set(surface.coat_roughness, is_outside ? description.coat_roughness : 0);
  set(surface.sheen, is_outside ? description.sheen : 0);
  const SharesTable& outside = prepared.tables->outside();
  const SharesTable& inside = prepared.tables->inside();
  for_each_ray(same.rays, [&](std::size_t lane) {
    surface.before[lane] = is_outside ? &outside : &inside;
    surface.behind[lane] = is_outside ? &inside : &outside;
  });
}

/// Sets the light that a material gives off at points in object space.
void set_emission(const SameSideHits& same, const SurfacePointLanes& points, RenderStats& stats,
                  SurfaceGroup& group) {
  const auto& principled = same.material.principled;
  if (principled && principled->emission) {
    stats.pattern_lookups += static_cast<unsigned>(std::popcount(same.rays));
    same.set(group.emission, principled->emission->colors(points, same.rays).color);
  } else {
    same.set(group.emission, lanes_of(rgb(same.material.description->emission)));
  }
}

/// Sets the normals of surfaces that are bumped or have normals for shading, seen along the rays'
/// directions. The points are in object space.
void set_shading_normals(const PreparedData& data, const SameSideHits& same,
                         const SurfacePointLanes& points, SurfaceGroup& group, Workspace& work) {
  const double to_viewer = same.first.entering ? 1 : -1;
  for_each_ray(same.rays, [&](std::size_t lane) {
    const RayHit& hit = same.hits[lane];
    const LeafOfHit in_place = data.placed_leaf(hit);
    const SurfacePoint point = lane_of(points, lane);
    const auto [plain, horizon] =
        in_place.leaf().shape->shading_normal(hit.face, point.position, point.normal);
    group.horizons[lane] = horizon;
    const bool is_mapped = same.material.principled && same.material.principled->normal_map;
    const Vec3 raised = same.material.bump
                            ? bumped_normal(in_place, hit.face, same.material, point, plain, work)
                            : in_place.placement().normal_to_world(plain);
    const Vec3 normal =
        is_mapped ? mapped_normal(in_place, hit.face, same.material, point, raised, work) : raised;
    group.phong.normal.set(lane, visible_normal(to_viewer * normal, group.phong.view.lane(lane)));
  });
}

}  // namespace

void look_up(const PreparedData& data, const RayLanes& rays,
             std::span<const RayHit, lane_count> hits, RayMask seen, SurfaceGroup& group,
             Workspace& work) {
  const Lanes t = lanes_of(hits[0].t, hits[1].t, hits[2].t, hits[3].t);
  group.phong.view = rays.direction;
  group.sending_on = 0;
  group.smooth = 0;
  const Features& features = data.features();
  if (features.principled) {
    group.principled_rays = 0;
    group.principled.before.fill(nullptr);
    group.principled.behind.fill(nullptr);
  }
  const HitFaces faces(data, hits);
  SurfacePointLanes& points = work.points;
  for (RayMask to_come = seen; to_come != 0;) {
    const RayHit& first = hits[first_ray(to_come)];
    const PreparedMaterial& material = data.materials()[data.hit_material(first)];
    const SameSideRays same_rays = faces.on_same_side(to_come);
    const SameSideHits same = {hits, first, material, same_rays.all()};
    to_come &= ~same.rays;

    const Side side = first.entering ? Side::outside : Side::inside;
    const StartPoint start = data.start_face(first, side);
    for_each_ray(same_rays.on_face, [&](std::size_t lane) { group.starts[lane].set_face(start); });
    for_each_ray(same_rays.on_others, [&](std::size_t lane) {
      group.starts[lane].set_face(data.start_face(hits[lane], side));
    });
    faces.object_points(same_rays, rays, t, material.uses_uv, points);
    const ColorLanes colors = material_colors(material, points, same.rays, work.stats);
    const Lanes transparency = material.opaque ? Lanes{} : material.transparency(colors.alpha);
    set_material(same, colors.color, transparency, group);
    if (features.principled && material.principled)
      set_principled(same, points, colors.color, work.stats, group);
    if (features.emission) set_emission(same, points, work.stats, group);
    const bool is_smooth = data.leaf(first).has_normals;
    const bool has_own_normals = is_smooth || material.tilts();
    if (is_smooth) group.smooth |= same.rays;
    if (has_own_normals) set_shading_normals(data, same, points, group, work);
    data.take_to_world(first, points);
    same.set(group.position, points.position);
    same.set(group.face_normal, first.entering ? points.normal : -points.normal);
    if (!has_own_normals) same.set(group.phong.normal, group.face_normal);
  }
  group.start_errors = start_rounding * largest_component(rays.at(t));
}

CrossingFilter patterned_filter(const PreparedData& data, const WorldRay& ray,
                                const RayHit& crossing, RenderStats& stats) {
  const PreparedMaterial& material = data.materials()[data.hit_material(crossing)];
  ++stats.pattern_lookups;
  const bool with_uv = material.pattern->uses_uv();
  const Color color = material.pattern->color(data.object_point(ray, crossing, with_uv));
  return {.transparency = material.transparency(color.a), .color = rgb(color)};
}

Rgb transmittance(const PreparedMaterial& medium, double length) {
  const Color& absorption = medium.description->absorption;
  const Lanes by_channel = lanes_of(absorption.r, absorption.g, absorption.b, 0);
  // A channel without absorption keeps everything, even if the path is infinite.
  const Lanes left = select(by_channel > 0.0,
                            exponential2<Lanes>(-std::numbers::log2e * (by_channel * length)), 1.0);
  return {left[0], left[1], left[2]};
}

}  // namespace crt::core
