// Measures how long it takes to prepare a scene from an earlier one after an edit, beside preparing
// it anew.
#include <benchmark/benchmark.h>

#include <cmath>
#include <crt/prepared_scene.hpp>
#include <crt/query.hpp>
#include <crt/scene.hpp>
#include <optional>
#include <vector>

#include "compared_scenes.hpp"

namespace {

using namespace crt;

/// Parts are a plate with two holes or six, or a sphere.
enum class Part { plate, large_plate, sphere };

SharedMaterial some_material(int i) {
  static const std::vector<SharedMaterial> materials = [] {
    std::vector<SharedMaterial> some;
    for (int k = 0; k < 10; ++k) some.emplace_back(Material{.color = Color{0.1 * k, 0.5, 0.5}});
    return some;
  }();
  return materials[static_cast<std::size_t>(i) % materials.size()];
}

Entity plate(int count) {
  Entity result = Box{.corner_a = {-1, -0.1, -1}, .corner_b = {1, 0.1, 1}};
  std::vector<Entity> holes;
  for (int i = 0; i < count; ++i) {
    const double x = 0.6 * std::cos(i);
    const double z = 0.6 * std::sin(i);
    holes.emplace_back(Cylinder{.from = {x, -1, z}, .to = {x, 1, z}, .radius = 0.2});
  }
  return csg_difference(result, holes);
}

/// Returns a part at a place of a grid, of its own or like all others.
Entity part_at(Part part, int i, int side, double height) {
  const double x = 3.0 * (i % side);
  const double z = 3.0 * (i / side);
  if (part == Part::sphere)
    return Entity(Sphere{.center = {x, height, z}}).with_material(some_material(i));
  return plate(part == Part::plate ? 2 : 6)
      .transformed(translate({x, height, z}))
      .with_material(some_material(i));
}

Scene scene_of(Part part, int count) {
  Scene scene;
  scene.camera = {.position = {0, 20, -30}, .pointing = {0, 0, 0}};
  scene.lights = {PointLight{.origin = {0, 100, 0}}};
  const int side = static_cast<int>(std::sqrt(count)) + 1;
  for (int i = 0; i < count; ++i) scene.entities.push_back(part_at(part, i, side, 0));
  return scene;
}

/// Prepares a scene again and again after edit(scene, turn), from the one before or anew.
template <class Edit>
void prepare_edited(benchmark::State& state, Scene scene, bool from_earlier, const Edit& edit) {
  std::optional<PreparedScene> prepared = prepare(scene);
  int turn = 0;
  for (auto _ : state) {
    state.PauseTiming();
    edit(scene, ++turn);
    state.ResumeTiming();
    PreparedScene next = from_earlier ? prepare(scene, *prepared) : prepare(scene);
    state.PauseTiming();
    prepared = std::move(next);
    state.ResumeTiming();
  }
}

/// Moves 250 parts of 5000.
void move_some(benchmark::State& state, Part part, bool from_earlier) {
  Scene scene = scene_of(part, 5000);
  const std::vector<Entity> at_rest = scene.entities;
  prepare_edited(state, std::move(scene), from_earlier, [&](Scene& edited, int turn) {
    for (std::size_t i = 0; i < 5000; i += 20)
      edited.entities[i] = at_rest[i].transformed(translate({0, 0.01 * (turn % 100), 0}));
  });
}

/// Gives one sphere of very many another material.
void recolour_one(benchmark::State& state, bool from_earlier) {
  Scene scene = scene_of(Part::sphere, 100000);
  const int side = static_cast<int>(std::sqrt(100000)) + 1;
  prepare_edited(state, std::move(scene), from_earlier, [&](Scene& edited, int turn) {
    const int i = turn * 7919 % 100000;
    const Sphere sphere{.center = {3.0 * (i % side), 0, 3.0 * (i / side)}};
    edited.entities[static_cast<std::size_t>(i)] =
        Entity(sphere).with_material(some_material(i + turn));
  });
}

/// Puts another sphere in the place of one of very many.
void replace_one(benchmark::State& state, bool from_earlier) {
  Scene scene = scene_of(Part::sphere, 100000);
  const int side = static_cast<int>(std::sqrt(100000)) + 1;
  prepare_edited(state, std::move(scene), from_earlier, [&](Scene& edited, int turn) {
    const int i = turn * 7919 % 100000;
    edited.entities[static_cast<std::size_t>(i)] =
        part_at(Part::sphere, i, side, 0.01 * (turn % 100));
  });
}

BENCHMARK_CAPTURE(move_some, plates_anew, Part::plate, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(move_some, plates, Part::plate, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(move_some, large_plates_anew, Part::large_plate, false)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(move_some, large_plates, Part::large_plate, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(move_some, spheres_anew, Part::sphere, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(move_some, spheres, Part::sphere, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(recolour_one, anew, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(recolour_one, from_earlier, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replace_one, anew, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replace_one, from_earlier, true)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
