// Compares plates with holes that share what they are compiled to with plates that do not, by the
// same rays in turns on one thread, and measures what it takes to prepare very many. `ratio` is the
// median of the copies' time / the instances'.
#include <benchmark/benchmark.h>

#include <cmath>
#include <crt/prepared_scene.hpp>
#include <crt/query.hpp>
#include <crt/scene.hpp>
#include <cstdint>
#include <vector>

#include "compared_scenes.hpp"

namespace {

using namespace crt;

constexpr double spacing = 3;

/// Returns a plate of so many primitives, but for a few, that are holes in it.
Entity plate(int primitives) {
  const int side = static_cast<int>(std::sqrt(primitives - 1));
  std::vector<Entity> holes;
  for (int i = 0; i < side * side; ++i) {
    const double x = 2 * (i % side + 0.5) / side - 1;
    const double y = 2 * (i / side + 0.5) / side - 1;
    holes.emplace_back(Cylinder{.from = {x, y, -1}, .to = {x, y, 1}, .radius = 0.7 / side});
  }
  return csg_difference(Box{.corner_a = {-1, -1, -0.1}, .corner_b = {1, 1, 0.1}}, holes);
}

/// Returns a scene of side x side plates that make() makes, each turned in its own way.
template <class Make>
Scene plates(int side, const Make& make) {
  Scene scene;
  scene.entities.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int i = 0; i < side * side; ++i) {
    const double c = std::cos(0.37 * i);
    const double s = std::sin(0.37 * i);
    scene.entities.push_back(
        make().transformed({.row_x = {c, -s, 0},
                            .row_y = {s, c, 0},
                            .row_z = {0, 0, 1},
                            .translation = {spacing * (i % side), spacing * (i / side), 0}}));
  }
  return scene;
}

/// Returns rays down at the plates, all from one point or each from its own.
std::vector<Ray> rays_at(int side, bool is_coherent) {
  constexpr int rays_a_side = 400;
  std::vector<Ray> rays;
  crt::bench::RandomShare random;
  const double middle = 0.5 * spacing * side;
  for (int i = 0; i < rays_a_side * rays_a_side; ++i) {
    if (is_coherent) {
      const double x = static_cast<double>(i % rays_a_side) / rays_a_side - 0.5;
      const double y = static_cast<double>(i / rays_a_side) / rays_a_side - 0.5;
      rays.push_back({.origin = {middle, middle - 20, 15}, .direction = {x, 0.8 * y + 0.6, -1}});
    } else {
      const Vec3 from(2 * middle * random(), 2 * middle * random(), 5);
      rays.push_back({.origin = from, .direction = {random() - 0.5, random() - 0.5, -1}});
    }
  }
  return rays;
}

void compare(benchmark::State& state, bool is_coherent) {
  const auto side = static_cast<int>(state.range(0));
  constexpr int primitives = 50;
  const Entity one = plate(primitives);
  const PreparedScene shared_scene = prepare(plates(side, [&] { return one; }));
  const PreparedScene scene_of_copies = prepare(plates(side, [] { return plate(primitives); }));
  const auto [of_shared, of_copies] = crt::bench::compare_in_turns(
      state, shared_scene, scene_of_copies, rays_at(side, is_coherent));
  if (of_shared != of_copies) state.SkipWithError("instances and copies differ");
}

void prepare_many(benchmark::State& state) {
  const Entity one = plate(1000);
  const Scene scene = plates(static_cast<int>(state.range(0)), [&] { return one; });
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    const MemoryUse use = prepare(scene).memory();
    bytes = use.primitives + use.csg + use.tree;
  }
  state.counters["bytes_an_instance"] =
      static_cast<double>(bytes) / static_cast<double>(scene.entities.size());
}

BENCHMARK_CAPTURE(compare, coherent, true)->Arg(40)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compare, scattered, false)->Arg(40)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(prepare_many)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
