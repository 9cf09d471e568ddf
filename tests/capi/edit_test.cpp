// These tests prepare a scene from what was prepared before it was edited.
#include <cstring>
#include <vector>

#include "support.hpp"

using namespace crt::test;

namespace {

EntityHandle box(double x) {
  const double low[3] = {x, 0, 0};
  const double high[3] = {x + 1, 1, 1};
  return made<EntityHandle>([&](crt_entity** out) { return crt_box_create(low, high, out); });
}

EntityHandle moved(crt_entity* entity, double y) {
  const double by[3] = {0, y, 0};
  double map[12];
  crt_affine_translation(by, map);
  return made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_transform(entity, map, out); });
}

/// Returns a scene of entities, which remembers nothing.
SceneHandle scene_of(const std::vector<EntityHandle>& entities) {
  SceneHandle scene = new_scene();
  for (const EntityHandle& entity : entities)
    REQUIRE(crt_scene_add_entity(scene.get(), entity.get()) == CRT_OK);
  return scene;
}

/// Returns a scene of so many boxes.
SceneHandle scene_of(int count) {
  std::vector<EntityHandle> entities;
  for (int i = 0; i < count; ++i) entities.push_back(box(2.0 * i));
  return scene_of(entities);
}

PreparedHandle prepare_from(crt_scene* scene, crt_prepared* previous) {
  return made<PreparedHandle>(
      [&](crt_prepared** out) { return crt_scene_prepare_from(scene, previous, out); });
}

/// Returns what rays along z hit, with where others would start there.
std::vector<crt_full_hit> hits_of(crt_prepared* prepared) {
  std::vector<crt_ray> rays;
  for (int x = 0; x < 40; ++x) {
    for (int y = 0; y < 8; ++y)
      rays.push_back({{0.26 * x, 0.31 * y - 0.5, -5}, {0, 0.01, 1}, 0, 100});
  }
  std::vector<crt_full_hit> hits(rays.size());
  std::memset(hits.data(), 0, hits.size() * sizeof(crt_full_hit));
  REQUIRE(crt_trace(prepared, rays.data(), 0, nullptr, 0, rays.size(), hits.data(), 0) == CRT_OK);
  return hits;
}

bool same_hits(crt_prepared* a, crt_prepared* b) {
  const std::vector<crt_full_hit> one = hits_of(a);
  const std::vector<crt_full_hit> other = hits_of(b);
  return std::memcmp(one.data(), other.data(), one.size() * sizeof(crt_full_hit)) == 0;
}

}  // namespace

TEST_CASE("a scene that is prepared from an earlier one has the same hits, with their starts") {
  std::vector<EntityHandle> entities;
  for (int i = 0; i < 100; ++i) entities.push_back(box(0.1 * i));
  const SceneHandle scene = scene_of(entities);
  PreparedHandle prepared = prepare_from(scene.get(), nullptr);
  CHECK(same_hits(prepared.get(), prepare(scene_of(entities).get()).get()));
  for (int turn = 1; turn < 30; ++turn) {
    CAPTURE(turn);
    const std::size_t place = static_cast<std::size_t>(turn) * 37 % entities.size();
    if (turn % 5 == 0) {
      entities.erase(entities.begin() + static_cast<std::ptrdiff_t>(place));
    } else if (turn % 5 == 1) {
      entities.push_back(box(0.2 * turn));
    } else {
      entities[place] = moved(entities[place].get(), 0.03 * turn);
    }
    prepared = prepare_from(scene_of(entities).get(), prepared.get());
    CHECK(same_hits(prepared.get(), prepare(scene_of(entities).get()).get()));
  }
}

TEST_CASE("preparing from an earlier scene is an option beside others") {
  const SceneHandle scene = scene_of(2);
  const PreparedHandle previous = prepare(scene.get());
  crt_prepare_options options;
  REQUIRE(crt_prepare_options_init(&options, sizeof options) == CRT_OK);
  CHECK(options.previous == nullptr);
  options.previous = previous.get();
  const SceneHandle larger = scene_of(3);
  crt_prepared* out = nullptr;
  options.max_primitives = 2;
  CHECK(crt_scene_prepare_with(larger.get(), &options, &out) == CRT_ERROR_LIMIT);
  CHECK(out == nullptr);
  options.max_primitives = 3;
  const PreparedHandle prepared = made<PreparedHandle>(
      [&](crt_prepared** made) { return crt_scene_prepare_with(larger.get(), &options, made); });
  CHECK(same_hits(prepared.get(), prepare(larger.get()).get()));
}
