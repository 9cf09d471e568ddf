// Compares a height field with a closed mesh of the same triangles, by the same rays in turns on
// one thread, and measures what it takes to prepare a large one. `ratio` is the median of the
// mesh's time / the field's.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <crt/prepared_scene.hpp>
#include <crt/query.hpp>
#include <crt/scene.hpp>
#include <cstdint>
#include <vector>

#include "compared_scenes.hpp"

namespace {

using namespace crt;

/// Returns mountains: waves of ever shorter lengths, each in another direction.
std::vector<double> mountains(std::uint32_t side) {
  std::vector<double> heights;
  heights.reserve(std::size_t{side} * side);
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const double x = column / (side - 1.0);
      const double z = row / (side - 1.0);
      double sum = 0;
      double size = 0.25;
      for (int octave = 0; octave < 9; ++octave) {
        const double angle = 2.4 * octave;
        const double wave = 5 * std::pow(2.0, octave) * (x * std::cos(angle) + z * std::sin(angle));
        sum += size * (1 - std::abs(std::sin(wave + octave)));
        size /= 2;
      }
      heights.push_back(std::clamp(sum, 0.0, 1.0));
    }
  }
  return heights;
}

const Vec3 corner_a(-1, 0, -1);
const Vec3 corner_b(1, 0.3, 1);

/// Returns a mesh of the triangles that a field has, with as many on its bottom as on top: long
/// ones make meshes slow.
Entity mesh_of(const std::vector<double>& heights, std::uint32_t side) {
  std::vector<Vec3> positions;
  std::vector<TriangleIndices> triangles;
  const Vec3 size = corner_b - corner_a;
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      positions.emplace_back(corner_a.x + column * size.x / (side - 1),
                             corner_a.y + heights[std::size_t{row} * side + column] * size.y,
                             corner_a.z + row * size.z / (side - 1));
    }
  }
  std::vector<std::uint32_t> around;
  for (std::uint32_t i = 0; i + 1 < side; ++i) around.push_back(i);
  for (std::uint32_t i = 0; i + 1 < side; ++i) around.push_back(i * side + side - 1);
  for (std::uint32_t i = side; i-- > 1;) around.push_back((side - 1) * side + i);
  for (std::uint32_t i = side; i-- > 1;) around.push_back(i * side);
  const auto first = static_cast<std::uint32_t>(positions.size());
  const auto count = static_cast<std::uint32_t>(around.size());
  for (std::uint32_t corner = 0; corner < first; ++corner) {
    positions.emplace_back(positions[corner].x, corner_a.y, positions[corner].z);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t one = around[i];
    const std::uint32_t next = around[(i + 1) % count];
    triangles.push_back({one, first + next, first + one});
    triangles.push_back({one, next, first + next});
  }
  for (std::uint32_t row = 0; row + 1 < side; ++row) {
    for (std::uint32_t column = 0; column + 1 < side; ++column) {
      const std::uint32_t a = row * side + column;
      triangles.push_back({a, a + side, a + side + 1});
      triangles.push_back({a, a + side + 1, a + 1});
      triangles.push_back({first + a, first + a + side + 1, first + a + side});
      triangles.push_back({first + a, first + a + 1, first + a + side + 1});
    }
  }
  return triangle_mesh(positions, triangles);
}

/// Returns rays of a camera that looks across the mountains.
std::vector<Ray> camera_rays(int side) {
  std::vector<Ray> rays;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double across = 2.0 * x / side - 1;
      const double up = 1 - 2.0 * y / side;
      rays.push_back(
          {.origin = {0.1, 0.6, -1.8}, .direction = {0.6 * across, 0.45 * up - 0.35, 1}});
    }
  }
  return rays;
}

/// Returns rays from one point of a box about the mountains to another.
std::vector<Ray> scattered_rays(int count) {
  std::vector<Ray> rays;
  crt::bench::RandomShare share;
  const auto random = [&] { return 2 * share() - 1; };
  for (int i = 0; i < count; ++i) {
    const Vec3 from(2 * random(), 0.8 + 0.6 * random(), 2 * random());
    const Vec3 to(random(), 0.1, random());
    rays.push_back({.origin = from, .direction = to - from});
  }
  return rays;
}

PreparedScene prepared(const Entity& entity, Precision tier) {
  Scene scene;
  scene.entities = {entity};
  scene.settings.precision = tier;
  return prepare(scene);
}

Entity field_of(std::vector<double> heights, std::uint32_t side) {
  return HeightField{.heights = make_height_grid(std::move(heights), side, side),
                     .corner_a = corner_a,
                     .corner_b = corner_b};
}

void compare(benchmark::State& state, bool is_coherent, Precision tier) {
  const auto side = static_cast<std::uint32_t>(state.range(0));
  const std::vector<double> heights = mountains(side);
  const PreparedScene field_scene = prepared(field_of(heights, side), tier);
  const PreparedScene mesh_scene = prepared(mesh_of(heights, side), tier);
  constexpr int rays_a_side = 500;
  const std::vector<Ray> rays =
      is_coherent ? camera_rays(rays_a_side) : scattered_rays(rays_a_side * rays_a_side);
  const auto [of_field, of_mesh] =
      crt::bench::compare_in_turns(state, field_scene, mesh_scene, rays);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    differ += std::isfinite(of_field[i]) != std::isfinite(of_mesh[i]) ? 1 : 0;
  }
  if (differ > 0) state.SkipWithError("the field and the mesh are met by other rays");
}

void prepare_large(benchmark::State& state) {
  const auto side = static_cast<std::uint32_t>(state.range(0));
  const std::vector<double> heights = mountains(side);
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    const PreparedScene scene = prepared(field_of(heights, side), Precision::standard);
    bytes = scene.memory().primitives;
  }
  state.counters["bytes_a_height"] =
      static_cast<double>(bytes) / (static_cast<double>(side) * side);
}

BENCHMARK_CAPTURE(compare, camera, true, Precision::standard)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compare, scattered, false, Precision::standard)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compare, camera_exact, true, Precision::exact)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(prepare_large)->Arg(4096)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
