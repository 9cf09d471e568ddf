// A scene that is prepared from the one before an edit has the lists, answers and pictures of one
// that is prepared anew.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/prepare/prepared_data.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/render.hpp"
#include "geometry/meshes.hpp"
#include "support/same_answers.hpp"
#include "support/same_scene.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;
using core::PreparedData;
using core::WorldRay;

namespace {

/// An EditedScene is a scene that is edited at random. Most of its faces lie in a few planes.
class EditedScene {
 public:
  Scene scene;

  EditedScene(std::uint32_t seed, int count) : make_(seed), some_mesh_(mesh_of(seed)) {
    for (int i = 0; i < count; ++i) scene.entities.push_back(some_entity());
    scene.lights = {PointLight{.origin = {3, 15, -6}}};
    scene.camera = {.position = {0.3, 2, -14}, .pointing = {0, 0, 0}};
    scene.settings = {.width = 16, .height = 12};
    if (make_.integer(0, 3) == 0) scene.settings.precision = Precision::exact;
  }

  /// Edits one entity, or a few.
  void edit() {
    const int count = make_.integer(0, 3) == 0 ? make_.integer(2, 6) : 1;
    for (int i = 0; i < count; ++i) edit_one();
  }
  WorldRay some_ray() {
    WorldRay ray{.origin = {make_.real(-9, 9), make_.real(-9, 9), make_.real(-9, 9)},
                 .direction = {make_.real(-1, 1), make_.real(-1, 1), make_.real(-1, 1)}};
    if (make_.integer(0, 3) == 0) {  // along faces and edges
      ray.origin = make_.grid_point();
      ray.direction = {0, 0, 0};
      ray.direction[make_.integer(0, 2)] = make_.integer(0, 1) == 0 ? 1 : -1;
    }
    return ray;
  }
  int below(int count) { return make_.integer(0, count - 1); }

 private:
  static Entity mesh_of(std::uint32_t seed) {
    Random random(seed);
    return ball_mesh(random, 3, 0).entity();
  }

  Entity some_shape() {
    switch (make_.integer(0, 9)) {
      case 0:
        return some_mesh_.transformed(translate(make_.grid_point()));
      case 1:
        return Disc{.center = make_.grid_point(), .normal = {0, 1, 0}, .radius = 1};
      case 2:
        return make_.tree(3).entity();
      case 3:
        return make_.tree(1).entity();
      case 4:
        return empty_entity();
      case 5:
        return RoundedBox{.corner_a = {0, 0, 0}, .corner_b = {1, 2, 1}, .radius = 0.25};
      default:
        return make_.leaf().entity();
    }
  }

  Entity some_entity() {
    Entity entity = some_shape();
    if (make_.integer(0, 1) == 0) entity = entity.transformed(translate(make_.grid_point()));
    if (make_.integer(0, 4) == 0) entity = entity.transformed(rotate_degrees(make_.grid_point()));
    if (make_.integer(0, 1) == 0) entity = entity.with_material(some_material());
    if (make_.integer(0, 5) == 0) entity = entity.with_id(static_cast<std::uint32_t>(below(9)));
    if (make_.integer(0, 5) == 0) entity = entity.with_user(7);
    if (make_.integer(0, 9) == 0) entity = entity.with_shadow(false);
    if (make_.integer(0, 9) == 0) entity = entity.with_visible(false);
    return entity;
  }

  SharedMaterial some_material() {
    static const std::array<SharedMaterial, 5> materials = {
        Material{.color = Color{1, 0, 0}}, Material{.color = Color{0, 1, 0}},
        Material{.color = Color{0, 0, 1}, .reflectivity = 0.25},
        Material{.transparency = 0.75, .refractive_index = 1.5},
        Material{.color = Color{1, 1, 0}, .transparency = 0.5}};
    return materials.at(static_cast<std::size_t>(below(materials.size())));
  }

  void edit_one() {
    std::vector<Entity>& entities = scene.entities;
    const int what = entities.empty() ? 4 : make_.integer(0, 7);
    const auto place = static_cast<std::size_t>(
        entities.empty() ? 0 : below(static_cast<int>(entities.size())));
    const auto at = entities.begin() + static_cast<std::ptrdiff_t>(place);
    switch (what) {
      case 0:
        *at = at->transformed(translate(make_.grid_point()));
        break;
      case 1:
        *at = at->transformed(translate({make_.real(-1, 1), 0, 0}));
        break;
      case 2:
        *at = recoloured(*at);
        break;
      case 3:
        *at = some_entity();
        break;
      case 4:
        entities.push_back(some_entity());
        break;
      case 5:
        entities.insert(at, some_entity());
        break;
      case 6:
        entities.erase(at);
        break;
      default:
        entities.push_back(*at);  // it is there twice
        if (make_.integer(0, 2) > 0) entities.pop_back();
    }
  }

  /// Returns an entity of the same shape and in the same place, of another material.
  Entity recoloured(const Entity& entity) {
    const auto* const wrapper = std::get_if<EntityWrapper>(&entity.node().content);
    const EntityNode& inner = wrapper == nullptr ? entity.node() : *wrapper->child;
    const auto* const primitive = std::get_if<Primitive>(&inner.content);
    if (primitive == nullptr) return entity.with_material(some_material());
    Primitive copy = *primitive;
    std::visit([&](auto& shape) { shape.material = some_material(); }, copy);
    if (wrapper == nullptr) return {copy};
    EntityWrapper other = *wrapper;
    other.child = Entity(copy).shared_node();
    return Entity(std::make_shared<const EntityNode>(std::move(other)));
  }

  SolidMaker make_;
  Entity some_mesh_;
};

/// Compares what rays find, and those that go on from there.
void check_rays(EditedScene& edited, const PreparedData& one, const PreparedData& other) {
  core::RayWorkspace work;
  core::RayWorkspace other_work;
  std::vector<WorldRay> rays(core::packet_size);
  for (WorldRay& ray : rays) ray = edited.some_ray();
  for (int bounce = 0; bounce < 2; ++bounce) {
    std::array<core::RayHit, core::packet_size> hits;
    std::array<core::RayHit, core::packet_size> other_hits;
    intersect_as_packet(one, rays, hits, work);
    intersect_as_packet(other, rays, other_hits, other_work);
    CHECK(occluded_as_packet(one, rays, work) == occluded_as_packet(other, rays, other_work));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      REQUIRE(same(hits.at(i), other_hits.at(i)));
      REQUIRE(same(one.intersect(rays[i], work), other.intersect(rays[i], other_work)));
      std::vector<core::RayHit> line;
      std::vector<core::RayHit> other_line;
      one.crossings(rays[i], line, work);
      other.crossings(rays[i], other_line, other_work);
      REQUIRE(std::ranges::equal(line, other_line, same));
      const core::RayHit& hit = hits.at(i);
      if (!hit.found()) continue;
      REQUIRE(one.entity_id(hit) == other.entity_id(hit));
      REQUIRE(one.ids(hit).part == other.ids(hit).part);
      REQUIRE(one.hit_material(hit) == other.hit_material(hit));
      rays[i] = {.origin = one.hit_point(rays[i], hit).position,
                 .direction = edited.some_ray().direction,
                 .start = one.start_point(rays[i], hit, core::Side::outside)};
    }
  }
}

void check_pictures(const PreparedScene& one, const PreparedScene& other) {
  CHECK(std::ranges::equal(render(one).pixels(), render(other).pixels()));
}

/// Edits a scene so many times, and compares what is prepared from the one before.
void check_edits(EditedScene& edited, int count, int edits_a_picture) {
  PreparedScene prepared = prepare(edited.scene);
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    edited.edit();
    const PreparedScene next = prepare(edited.scene, prepared);
    const PreparedScene anew = prepare(edited.scene);
    REQUIRE(same_scene(next.data().compiled(), anew.data().compiled()));
    REQUIRE(same_materials(next.data().material_table(), anew.data().material_table()));
    REQUIRE(next.warnings() == anew.warnings());
    check_rays(edited, next.data(), anew.data());
    if (i % edits_a_picture == 0) check_pictures(next, anew);
    prepared = next;
  }
}

}  // namespace

TEST_CASE("a scene after random edits is the same whether or not it is prepared from the one before") {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    EditedScene edited(seed, seed % 4 == 0 ? 90 : 12);
    check_edits(edited, 100, 25);
  }
}
