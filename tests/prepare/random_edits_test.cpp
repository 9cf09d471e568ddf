// A scene that is prepared from the one before an edit has the lists, answers and pictures of one
// that is prepared anew.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <numeric>
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
    const auto place =
        static_cast<std::size_t>(entities.empty() ? 0 : below(static_cast<int>(entities.size())));
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

/// Returns whether what rays find is the same, and what those find that go on from there.
bool same_rays(EditedScene& edited, const PreparedData& one, const PreparedData& other) {
  core::RayWorkspace work;
  core::RayWorkspace other_work;
  std::vector<WorldRay> rays(core::packet_size);
  for (WorldRay& ray : rays) ray = edited.some_ray();
  bool are_same = true;
  for (int bounce = 0; bounce < 2; ++bounce) {
    std::array<core::RayHit, core::packet_size> hits;
    std::array<core::RayHit, core::packet_size> other_hits;
    intersect_as_packet(one, rays, hits, work);
    intersect_as_packet(other, rays, other_hits, other_work);
    are_same = are_same && std::ranges::equal(hits, other_hits, same) &&
               occluded_as_packet(one, rays, work) == occluded_as_packet(other, rays, other_work);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      std::vector<core::RayHit> line;
      std::vector<core::RayHit> other_line;
      one.crossings(rays[i], line, work);
      other.crossings(rays[i], other_line, other_work);
      const core::RayHit& hit = hits.at(i);
      are_same = are_same && std::ranges::equal(line, other_line, same) &&
                 same(one.intersect(rays[i], work), other.intersect(rays[i], other_work)) &&
                 one.innermost(rays[i].origin, work).leaf ==
                     other.innermost(rays[i].origin, other_work).leaf;
      if (!hit.found() || !are_same) continue;
      are_same = one.entity_id(hit) == other.entity_id(hit) &&
                 one.ids(hit).part == other.ids(hit).part &&
                 one.ids(hit).user == other.ids(hit).user &&
                 one.hit_material(hit) == other.hit_material(hit);
      rays[i] = {.origin = one.hit_point(rays[i], hit).position,
                 .direction = edited.some_ray().direction,
                 .start = one.start_point(rays[i], hit, core::Side::outside)};
    }
  }
  return are_same;
}

bool same_pictures(const PreparedScene& one, const PreparedScene& other) {
  return std::ranges::equal(render(one).pixels(), render(other).pixels());
}

/// Returns whether a scene has something from an earlier one.
bool has_kept(const PreparedData& data, const PreparedData& earlier) {
  const auto& stores = earlier.compiled().stores;
  return std::ranges::any_of(data.compiled().stores, [&](const auto& store) {
    return std::find(stores.begin(), stores.end(), store) != stores.end();
  });
}

/// Edits a scene so many times, and compares what is prepared from the one before with what is
/// prepared anew. Returns how often anything was kept.
int check_edits(EditedScene& edited, int count, int edits_a_picture) {
  PreparedScene prepared = prepare(edited.scene);
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    edited.edit();
    const PreparedScene next = prepare(edited.scene, prepared);
    const PreparedScene anew = prepare(edited.scene);
    REQUIRE(same_scene(next.data().compiled(), anew.data().compiled()));
    REQUIRE(same_materials(next.data().material_table(), anew.data().material_table()));
    REQUIRE(next.warnings() == anew.warnings());
    REQUIRE(same_rays(edited, next.data(), anew.data()));
    if (i % edits_a_picture == 0) REQUIRE(same_pictures(next, anew));
    kept += has_kept(next.data(), prepared.data()) ? 1 : 0;
    prepared = next;
  }
  return kept;
}

}  // namespace

TEST_CASE(
    "a scene after random edits is the same whether or not it is prepared from an earlier one") {
  int kept = 0;
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    EditedScene edited(seed, seed % 4 == 0 ? 90 : 12);
    kept += check_edits(edited, 100, 25);
  }
  CHECK(kept > 3000);
}

TEST_CASE("instances that come, go and move are the same as if they were prepared anew") {
  // So many copies are worth sharing or not, by turns.
  Random random(5);
  const Entity ball = ball_mesh(random, 17, 0).entity();
  REQUIRE(ball.primitive_count() > 2048);
  EditedScene edited(5, 0);
  edited.scene.settings.precision = Precision::standard;
  std::vector<Entity>& entities = edited.scene.entities;
  const SharedMaterial glass = Material{.transparency = 0.5};
  int made = 0;
  const auto add_copy = [&] {
    const double x = 0.9 * (made++ % 7) - 3;
    Entity copy = ball.transformed(translate({x, 0.1 * made, 0}));
    if (made % 3 == 0) copy = copy.with_material(glass);
    if (made % 5 == 0) copy = copy.with_id(4);
    entities.push_back(copy);
  };
  for (int i = 0; i < 14; ++i) add_copy();
  entities.emplace_back(Box{.corner_a = {-9, -9, -9}, .corner_b = {9, -3, 9}});
  PreparedScene prepared = prepare(edited.scene);
  int with_instances = 0;
  int kept = 0;
  for (int i = 0; i < 48; ++i) {
    CAPTURE(i);
    const auto place = static_cast<std::size_t>(edited.below(static_cast<int>(entities.size())));
    if (i % 8 >= 5) {
      entities.erase(entities.begin() + 1);
    } else if (i % 8 == 0) {
      for (int k = 0; k < 3; ++k) add_copy();
    } else {
      entities[place] = entities[place].transformed(translate({0, 0.01 * i, 0.1}));
    }
    const PreparedScene next = prepare(edited.scene, prepared);
    const PreparedScene anew = prepare(edited.scene);
    REQUIRE(same_scene(next.data().compiled(), anew.data().compiled()));
    REQUIRE(same_materials(next.data().material_table(), anew.data().material_table()));
    REQUIRE(same_rays(edited, next.data(), anew.data()));
    with_instances += next.data().has_instances() ? 1 : 0;
    kept += has_kept(next.data(), prepared.data()) ? 1 : 0;
    prepared = next;
  }
  CHECK(with_instances > 10);
  CHECK(with_instances < 48);
  CHECK(kept > 20);
}

TEST_CASE("a scene of thousands is prepared from an earlier one while its parts wander") {
  Scene scene;
  scene.settings = {.width = 16, .height = 12};
  scene.camera = {.position = {40, 60, -60}, .pointing = {40, 0, 40}};
  scene.lights = {PointLight{.origin = {0, 100, 0}}};
  const auto part = [](int i, double height) {
    const Vec3 at(2.0 * (i % 40), height, 2.0 * (i / 40));
    if (i % 3 == 0) return Entity(Sphere{.center = at});
    return Box{.corner_a = at, .corner_b = at + Vec3(2, 1, 2)} - Entity(Sphere{.center = at});
  };
  std::vector<int> numbers(1600);
  std::iota(numbers.begin(), numbers.end(), 0);
  for (const int number : numbers) scene.entities.push_back(part(number, 0));
  EditedScene rays(1, 0);
  PreparedScene prepared = prepare(scene);
  int kept = 0;
  for (int turn = 1; turn <= 20; ++turn) {
    CAPTURE(turn);
    const auto step = static_cast<std::size_t>(turn);
    for (std::size_t i = step % 7; i < numbers.size(); i += 23 + step)
      scene.entities[i] = part(numbers[i], turn % 4 == 0 ? 0 : 0.1 * turn);
    if (turn % 6 == 5) {
      scene.entities.erase(scene.entities.begin() + turn);
      numbers.erase(numbers.begin() + turn);
    }
    if (turn == 10) {
      scene.entities.emplace_back(Sphere{.center = {1e5, 0, 0}});
      numbers.push_back(1602);
    }
    const PreparedScene next = prepare(scene, prepared);
    const PreparedScene anew = prepare(scene);
    REQUIRE(same_scene(next.data().compiled(), anew.data().compiled()));
    REQUIRE(same_rays(rays, next.data(), anew.data()));
    REQUIRE(same_pictures(next, anew));
    kept += has_kept(next.data(), prepared.data()) ? 1 : 0;
    prepared = next;
  }
  CHECK(kept == 20);
}
