// Measures rays that only exact arithmetic answers: those through corners of revolutions, on grids
// and turned, at revolutions in trees, and at turned extrusions from afar. `mean_us` and `worst_us`
// are microseconds a ray. The aims are 10 in the mean of all rays that are asked for, and 1000.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <crt/prepared_scene.hpp>
#include <crt/query.hpp>
#include <crt/scene.hpp>
#include <crt/transform.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <vector>

#include "compared_scenes.hpp"

namespace {

using namespace crt;

constexpr int ray_count = 500;

Entity turned_profile(const Contour& contour) {
  return Revolution{.profile = make_profile(std::vector<Contour>{contour})};
}

/// Makes a post with a ball's half about its middle.
Entity post() {
  return turned_profile({{0, 0}, {2, 0}, {2, 1, 1}, {2, 3}, {0, 3}});
}

Entity tree() {
  const Entity ring = Torus{.center = {0, 2, 0}, .axis = {0, 1, 0}, .radius = 2, .thickness = 1};
  return (post() + ring) - post().transformed(translate({1, 1, 0}));
}

Entity gear() {
  Contour contour;
  constexpr int teeth = 60;
  for (int i = 0; i < teeth; ++i) {
    const double angle = 2 * std::numbers::pi * i / teeth;
    const double radius = i % 2 == 0 ? 2 : 2.5;
    contour.push_back({radius * std::cos(angle), radius * std::sin(angle), i % 3 == 0 ? 0 : 0.3});
  }
  return Extrusion{.profile = make_profile(std::vector<Contour>{contour}), .from = -1, .to = 1};
}

Vec3 moved(const Transform& by, const Vec3& v) {
  return {glm::dot(by.row_x, v), glm::dot(by.row_y, v), glm::dot(by.row_z, v)};
}

/// Makes rays through points of small whole numbers, and placed like the solid.
std::vector<Ray> rays_through_grid(const Transform& place, double distance) {
  bench::RandomShare share;
  const auto whole = [&] { return std::floor(7 * share()) - 3; };
  std::vector<Ray> rays;
  while (rays.size() < ray_count) {
    const Vec3 direction(whole(), whole(), whole());
    if (direction == Vec3(0, 0, 0)) continue;
    const Vec3 origin = Vec3(whole(), whole(), whole()) - distance * direction;
    rays.push_back({.origin = moved(place, origin), .direction = moved(place, direction)});
  }
  return rays;
}

double microseconds(RayQueries& queries, const Ray& ray, std::vector<Hit>& hits) {
  const auto begin = std::chrono::steady_clock::now();
  queries.crossings(ray, hits);
  const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - begin;
  return spent.count();
}

/// Returns the longest time of a ray, of which the least of some tries counts.
double worst(RayQueries& queries, const std::vector<Ray>& rays, std::vector<Hit>& hits) {
  constexpr int tries = 5;
  double longest = 0;
  for (const Ray& ray : rays) {
    double least = microseconds(queries, ray, hits);
    for (int i = 1; i < tries && least > longest; ++i) {
      least = std::min(least, microseconds(queries, ray, hits));
    }
    longest = std::max(longest, least);
  }
  return longest;
}

void ask(benchmark::State& state, const Entity& solid, double distance) {
  const bool is_turned = state.range(0) != 0;
  const Transform place = is_turned ? rotate_degrees({30, 40, 50}) : Transform{};
  Scene scene;
  scene.entities = {solid.transformed(place)};
  scene.settings.precision = state.range(1) != 0 ? Precision::exact : Precision::standard;
  const PreparedScene prepared = prepare(scene);
  RayQueries queries(prepared);
  const std::vector<Ray> rays = rays_through_grid(place, distance);
  std::vector<Hit> hits;
  for (auto _ : state) {
    for (const Ray& ray : rays) queries.crossings(ray, hits);
  }
  state.counters["mean_us"] =
      benchmark::Counter(ray_count * 1e-6, benchmark::Counter::kIsIterationInvariantRate |
                                               benchmark::Counter::kInvert);
  state.counters["worst_us"] = worst(queries, rays, hits);
}

void all_kinds(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"turned", "exact"})->ArgsProduct({{0, 1}, {0, 1}});
}

BENCHMARK_CAPTURE(ask, revolution, post(), 4)->Apply(all_kinds);
BENCHMARK_CAPTURE(ask, tree, tree(), 4)->Apply(all_kinds);
BENCHMARK_CAPTURE(ask, extrusion_from_afar, gear(), 1e12)->Apply(all_kinds);

}  // namespace

BENCHMARK_MAIN();
