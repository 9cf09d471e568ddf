#include "core/prepare/prepared_data.hpp"

#include <algorithm>
#include <chrono>
#include <climits>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/compile/memory.hpp"
#include "core/compile/primitive_limit.hpp"
#include "core/intersect/accelerator.hpp"
#include "core/math/float_environment.hpp"
#include "core/prepare/geometry.hpp"
#include "core/shading/texture.hpp"
#include "crt/error.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/section.hpp"
#include "crt/validate.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// Checks a light. An error says which of them it is.
void check_light(const Light& light, std::size_t index) {
  try {
    validate(light);
  } catch (const Error& error) {
    const std::string place = text::format("lights[{}]", index);
    throw Error(error.code(), text::format("{}: {}", place, error.what()),
                text::format("{}.{}", place, error.argument()));
  }
}

void check_scene(const Scene& scene) {
  for (std::size_t i = 0; i < scene.lights.size(); ++i) check_light(scene.lights[i], i);
  validate(scene.camera);
  validate(scene.background);
  validate(scene.settings);
}

bool is_environment(const Light& light) {
  return std::holds_alternative<EnvironmentLight>(light);
}

/// Adds a sky that shines to the lights.
void add_sky(const Background& background, const Sky* sky, std::vector<Light>& lights) {
  if (sky == nullptr || !std::get<SkyBackground>(background).shines) return;
  if (std::none_of(lights.begin(), lights.end(), is_environment))
    lights.emplace_back(EnvironmentLight{});
  if (sky->has_sun()) lights.emplace_back(sky->sunlight());
}

/// Returns the lights of a scene, or a head light where nothing gives light off and it is wanted.
std::vector<Light> lights_of(const Scene& scene, const Sky* sky, bool emits) {
  std::vector<Light> lights = scene.lights;
  add_sky(scene.background, sky, lights);
  if (!lights.empty() || emits || !scene.settings.head_light || scene.settings.compat != 0)
    return lights;
  if (scene.camera.projection == Projection::orthographic)
    return {ParallelLight{.from = scene.camera.position, .pointing = scene.camera.pointing}};
  return {PointLight{.origin = scene.camera.position}};
}

/// Returns what takes the place of a material, which is mostly the material itself.
SharedMaterial stand_in(const SharedMaterial& material, const PrepareOptions& options) {
  const HostFloatEnvironment host;
  return options.material ? options.material(material) : material;
}

Opacity opacity_of(const CompiledScene& scene, const MaterialTable& table,
                   std::span<const PreparedMaterial> materials) {
  Opacity opacity{.materials = &table, .of_materials = {}, .of_objects = {}};
  for (const PreparedMaterial& material : materials)
    opacity.of_materials.push_back(material.opaque);
  const auto end = opacity.of_materials.end();
  if (std::find(opacity.of_materials.begin(), end, false) == end) {
    opacity.of_objects.assign(scene.objects.size(), true);
    return opacity;
  }
  const auto are_opaque = [&](std::span<const Leaf> leaves, const std::uint32_t* numbers) {
    return std::all_of(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
      const auto first = opacity.of_materials.begin() + numbers[&leaf - leaves.data()];
      return std::find(first, first + leaf.material_count(), false) ==
             first + leaf.material_count();
    });
  };
  std::vector<bool> of_prototypes;
  for (std::size_t i = 0; i < scene.prototypes.size(); ++i) {
    const CompiledScene& prototype = *scene.prototypes[i].scene;
    std::vector<std::uint32_t> numbers = prototype.materials->of_leaves;
    for (std::uint32_t& number : numbers) number += table.of_prototypes[i];
    of_prototypes.push_back(are_opaque(prototype.leaves, numbers.data()));
  }
  for (const SceneObject& object : scene.objects) {
    opacity.of_objects.push_back(
        object.is_instance()
            ? of_prototypes[scene.instances[object.instance].prototype]
            : are_opaque(scene.leaves_of(object), &table.of_leaves[object.first_leaf]));
  }
  return opacity;
}

}  // namespace

template <class Pool>
const Pool* PreparedData::of_earlier(Pool PreparedData::*pool, const PrepareOptions& options) {
  return options.earlier == nullptr ? nullptr : &(options.earlier->data().*pool);
}

PreparedData::PreparedData(const Scene& scene, const PrepareOptions& options,
                           const Workers& workers)
    : textures_(scene.settings.gamma, of_earlier(&PreparedData::textures_, options)),
      normals_(1, of_earlier(&PreparedData::normals_, options)),
      layer_tables_(of_earlier(&PreparedData::layer_tables_, options)) {
  const auto begin = std::chrono::steady_clock::now();
  const PreparedData* const earlier =
      options.earlier == nullptr ? nullptr : &options.earlier->data();
  check_scene(scene);
  scene_ = {.entities = {},
            .lights = {},
            .camera = scene.camera,
            .background = scene.background,
            .settings = scene.settings};

  entities_ = PreparedEntities::of(scene, earlier == nullptr ? nullptr : &earlier->entities_,
                                   options.max_primitives, workers);
  accelerator_ = &entities_.geometry->accelerator;
  compiled_ = &accelerator_->compiled();
  if (scene.settings.precision == Precision::standard) {
    input_tolerance_ = {.rounding = start_rounding,
                        .max_size_error = start_rounding * accelerator_->largest_radius(),
                        .farthest = accelerator_->farthest()};
  }
  entity_ids_ = compiled_->entity_ids;
  for (const SharedMaterial& material : entities_.materials->list) {
    workers.poll();
    materials_.emplace_back(stand_in(material, options),
                            MaterialPools{textures_, normals_, layer_tables_});
  }
  const bool emits = std::any_of(materials_.begin(), materials_.end(),
                                 [](const PreparedMaterial& material) { return material.emits; });
  background_ =
      std::make_unique<PreparedBackground>(scene.background, textures_, scene.settings.compat);
  scene_.lights = lights_of(scene, background_->sky(), emits);
  chosen_lights_ =
      ChosenLights::of(*compiled_, *entities_.materials, materials_, emits, scene_.lights);
  opacity_ = opacity_of(*compiled_, *entities_.materials, materials_);
  if (std::any_of(scene_.lights.begin(), scene_.lights.end(), is_environment))
    environment_ = std::make_unique<Environment>(*background_);
  textures_.settle();
  normals_.settle();
  layer_tables_.settle();
  features_ = find_features(scene_, materials_, entities_.geometry->has_csg);
  features_.unseen = (accelerator_->kinds_that_pass() & passing_camera) != 0;
  features_.shadowless = (accelerator_->kinds_that_pass() & passing_shadow) != 0;

  warnings_ = textures_.warnings();
  for (std::string& warning : normals_.warnings()) warnings_.push_back(std::move(warning));
  if (compiled_->leaves.empty() && !has_instances()) {
    warnings_.emplace_back("the scene has no entities: only the background shows");
  } else if (scene.lights.empty() && environment_ == nullptr && !emits) {
    warn_of_no_light();
  }
  warn_of_camera();
  warn_of_meshes();

  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  prepare_seconds_ = elapsed.count();
}

PreparedData::~PreparedData() = default;

MemoryUse PreparedData::memory() const {
  MemoryUse use = accelerator_->memory();
  use.primitives += entities_.nodes.bytes() + bytes_of(compiled_->entity_ids);
  use.materials = bytes_of(entities_.materials->list) + bytes_of(entities_.materials->of_leaves) +
                  bytes_of(materials_) + textures_.bytes() + normals_.bytes() +
                  layer_tables_.bytes() +
                  (chosen_lights_ == nullptr ? 0 : chosen_lights_->bytes()) +
                  (opacity_.of_materials.capacity() + opacity_.of_objects.capacity()) / CHAR_BIT;
  return use;
}

RayHit PreparedData::intersect(const WorldRay& ray, RayWorkspace& work, PassingRays kind) const {
  return accelerator_->nearest(ray, work, kind);
}

bool PreparedData::occluded(const WorldRay& ray, RayWorkspace& work) const {
  return accelerator_->any(ray, work);
}

void PreparedData::intersect_each(const RayBatch& rays, RayMask some,
                                  std::span<RayHit, packet_size> hits, RayWorkspace& work,
                                  Packets packets, PassingRays kind) const {
  accelerator_->nearest_each(rays, some, hits, packets, work, kind);
}

void PreparedData::prefetch_points(std::span<const RayHit, packet_size> hits, RayMask some) const {
  accelerator_->prefetch_surface_points(hits, some);
}

RayMask PreparedData::occluded_each(const RayBatch& rays, RayMask some, RayWorkspace& work,
                                    Packets packets) const {
  return accelerator_->any_each(rays, noted_starts(rays, some), some, packets, work);
}

RayMask PreparedData::shadowed_each(const RayBatch& rays, const PacketStarts& starts, RayMask some,
                                    RayWorkspace& work, PassingRays kind) const {
  return accelerator_->any_each(rays, starts, some, Packets::where_they_pay, work, kind);
}

PacketStarts PreparedData::noted_starts(const RayBatch& rays, RayMask some) const {
  return accelerator_->noted_starts(rays, some);
}

LightPaths PreparedData::paths_to_light(const RayBatch& rays, const PacketStarts& starts,
                                        RayMask some, RayWorkspace& work, Packets packets,
                                        PassingRays kind) const {
  const LightPaths paths =
      accelerator_->paths_to_light(rays, starts, some, opacity_, packets, work, kind);
  for_each_ray(paths.filtered,
               [&](std::size_t i) { accelerator_->sort(rays.ray(i), work.on_paths[i], work); });
  return paths;
}

void PreparedData::crossings(const WorldRay& ray, std::vector<RayHit>& out,
                             RayWorkspace& work) const {
  out.clear();
  accelerator_->all(ray, out, work);
  accelerator_->sort(ray, out, work);
}

void PreparedData::containing_solids(const WorldRay& ray, std::vector<RayHit>& out,
                                     RayWorkspace& work) const {
  out.clear();
  accelerator_->containing_solids(ray, out, work);
  std::sort(out.begin(), out.end(), [](const RayHit& a, const RayHit& b) {
    return std::make_tuple(-a.t, a.object) < std::make_tuple(-b.t, b.object);
  });
}

ContainingSolid PreparedData::innermost(const Vec3& point, RayWorkspace& work) const {
  return accelerator_->innermost(point, work);
}

bool PreparedData::all_pass_by(const Bounds& box) const {
  return accelerator_->all_pass_by(box);
}

bool PreparedData::is_on_surface(const Vec3& point, RayWorkspace& work) const {
  constexpr double relative_width = 0x1p-26;
  const double width = relative_width * largest_component(point);
  std::vector<RayHit> hits;
  for (int axis = 0; axis < 3; ++axis) {
    WorldRay line = {.origin = point, .direction = Vec3(0)};
    line.direction[axis] = 1;
    line.t_min = -std::numeric_limits<double>::max();
    crossings(line, hits, work);
    for (const RayHit& hit : hits) {
      if (std::abs(hit.t) <= hit.error + width) return true;
    }
  }
  return false;
}

SolidExit PreparedData::find_exit(const WorldRay& ray, std::uint32_t object,
                                  RayWorkspace& work) const {
  return accelerator_->find_exit(ray, object, work);
}

void PreparedData::hit_point(const WorldRay& ray, const RayHit& hit, bool with_uv,
                             HitPoint& point) const {
  const LeafOfHit in_place = placed_leaf(hit);
  const Placement& placement = in_place.placement();
  const SurfacePoint surface = object_point(in_place, ray, hit, with_uv);
  point.t = hit.t;
  point.position = placement.point_to_world(surface.position);
  point.object_position = surface.position;
  point.object_normal = surface.normal;
  point.normal = placement.normal_to_world(point.object_normal);
  point.u = surface.u;
  point.v = surface.v;
  point.material = hit_material(hit);
  point.entity_id = entity_id(hit);
  point.object = hit.object;
  point.leaf = hit.leaf;
  point.face = hit.face;
  point.entering = hit.entering;
  point.solid = is_solid(hit);
}

SurfacePoint PreparedData::object_point(const WorldRay& ray, const RayHit& hit,
                                        bool with_uv) const {
  return object_point(placed_leaf(hit), ray, hit, with_uv);
}

SurfacePoint PreparedData::object_point(const LeafOfHit& in_place, const WorldRay& ray,
                                        const RayHit& hit, bool with_uv) {
  SurfacePoint point = in_place.surface_point(ray, hit, with_uv);
  // A cutter's surface bounds what is left of the solid from the other side.
  if (in_place.leaf().complemented) point.normal = -point.normal;
  return point;
}

RayMask PreparedData::on_shapes_like(const RayHit& first, std::span<const RayHit, lane_count> hits,
                                     RayMask some) const {
  const Leaf& like = leaf(first);
  if (like.family == nullptr) return 0;
  const std::vector<std::uint32_t>& materials = entities_.materials->of_leaves;
  RayMask result = 0;
  for_each_ray(some, [&](std::size_t lane) {
    const Leaf& leaf = this->leaf(hits[lane]);
    // None of instances has a family.
    const bool is_like = leaf.family == like.family &&
                         materials[hits[lane].leaf] == materials[first.leaf] &&
                         hits[lane].entering == first.entering;
    result |= static_cast<RayMask>(is_like) << lane;
  });
  return result;
}

void PreparedData::points_on_shapes(std::span<const RayHit, lane_count> hits, RayMask some,
                                    const RayLanes& lines, const Lanes& t, bool with_uv,
                                    SurfacePointLanes& points) const {
  const std::size_t first = first_ray(some);
  std::array<const Shape*, lane_count> shapes;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const RayHit& hit = hits[(some >> lane & 1u) != 0 ? lane : first];
    shapes[lane] = leaf(hit).shape;
  }
  shapes[0]->points_on_each(shapes, lines, t, with_uv, points);
}

StartPoint PreparedData::start_point(const WorldRay& ray, const RayHit& hit, Side side) const {
  StartPoint start = start_face(hit, side);
  double farthest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    farthest = std::max(farthest, std::abs(std::fma(hit.t, ray.direction[axis], ray.origin[axis])));
  }
  start.t_error = start_rounding * farthest;
  return start;
}

}  // namespace crt::core

namespace crt {

MemoryUse PreparedScene::memory() const {
  return data_->memory();
}

const std::vector<std::string>& PreparedScene::warnings() const {
  return data_->warnings();
}

PreparedScene prepare(const Scene& scene, const PrepareOptions& options) {
  const core::FloatEnvironment ieee;
  if (has_section(scene.camera)) {
    const Camera& camera = scene.camera;
    validate(camera);
    return prepare(
        sectioned(scene, camera.section_normal, camera.section_offset, camera.section_hatch),
        options);
  }
  core::StopCheck stop(options.go_on, "preparing the scene");
  const core::Workers workers(0, options.go_on ? &stop : nullptr);
  return PreparedScene(std::make_shared<const core::PreparedData>(scene, options, workers));
}

PreparedScene prepare(const Scene& scene) {
  return prepare(scene, PrepareOptions{});
}

PreparedScene prepare(const Scene& scene, const PreparedScene& earlier) {
  return prepare(scene, PrepareOptions{.earlier = &earlier});
}

}  // namespace crt
