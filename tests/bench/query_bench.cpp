// Compares a batch of ray queries through the C interface with rendering the same rays: a picture
// without lights, with one ray a pixel, consists of its camera rays alone. Both take turns, so that
// their ratio means something on a machine with other work. `ratio` is the median of queries /
// render (the aim is at most 1.2).
#include <benchmark/benchmark.h>
#include <crt/crt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr int side = 1000;  // a million rays

void require(crt_status status) {
  if (status != CRT_OK) throw std::runtime_error(crt_error_message());
}

template <class Call>
double seconds(const Call& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Makes balls in a grid, or one plate with as many holes.
crt_prepared* grid(bool holes) {
  constexpr int count = 10;
  std::vector<crt_entity*> balls;
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < count; ++x) {
      const double center[3] = {(x - 4.5) * 0.1, (y - 4.5) * 0.1, 0};
      crt_entity* ball = nullptr;
      require(crt_sphere_create(center, 0.04, &ball));
      balls.push_back(ball);
    }
  }
  crt_scene* scene = nullptr;
  require(crt_scene_create(&scene));
  if (holes) {
    const double a[3] = {-0.55, -0.55, 0};
    const double b[3] = {0.55, 0.55, 0.1};
    crt_entity* plate = nullptr;
    crt_entity* part = nullptr;
    require(crt_box_create(a, b, &plate));
    require(crt_difference_create(plate, balls.data(), balls.size(), &part));
    require(crt_scene_add_entity(scene, part));
    crt_entity_release(part);
    crt_entity_release(plate);
  } else {
    for (crt_entity* ball : balls) require(crt_scene_add_entity(scene, ball));
  }
  for (crt_entity* ball : balls) crt_entity_release(ball);
  crt_settings settings;
  require(crt_settings_init(&settings, sizeof settings));
  settings.width = settings.height = side;
  settings.no_head_light = 1;
  require(crt_scene_set_settings(scene, &settings));
  crt_prepared* prepared = nullptr;
  require(crt_scene_prepare(scene, &prepared));
  crt_scene_release(scene);
  return prepared;
}

/// Returns the rays of the default camera through the pixels' centres.
std::vector<crt_ray> camera_rays() {
  const double half = std::tan(std::acos(-1) / 6);
  std::vector<crt_ray> rays;
  rays.reserve(std::size_t{side} * side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double nx = 2 * (x + 0.5) / side - 1;
      const double ny = 1 - 2 * (y + 0.5) / side;
      rays.push_back(
          {{0, 0, -1}, {nx * half, ny * half, 1}, 0, std::numeric_limits<double>::infinity()});
    }
  }
  return rays;
}

void queries_against_render(benchmark::State& state, bool holes) {
  crt_prepared* const prepared = grid(holes);
  const std::vector<crt_ray> rays = camera_rays();
  std::vector<crt_hit> hits(rays.size());
  std::vector<double> ratios;
  double ask_total = 0;
  double render_total = 0;
  for (auto _ : state) {
    crt_image* image = nullptr;
    const double render = seconds([&] { require(crt_render(prepared, nullptr, &image)); });
    crt_image_release(image);
    const double ask = seconds(
        [&] { require(crt_intersect(prepared, rays.data(), 0, rays.size(), hits.data(), 0)); });
    ratios.push_back(ask / render);
    ask_total += ask;
    render_total += render;
  }
  std::sort(ratios.begin(), ratios.end());
  const double count = static_cast<double>(ratios.size()) * static_cast<double>(rays.size());
  state.counters["ratio"] = ratios[ratios.size() / 2];
  state.counters["query_ns"] = ask_total / count * 1e9;
  state.counters["render_ns"] = render_total / count * 1e9;
  crt_prepared_release(prepared);
}

}  // namespace

BENCHMARK_CAPTURE(queries_against_render, hundred_spheres, false)
    ->Iterations(21)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(queries_against_render, plate_with_hundred_holes, true)
    ->Iterations(11)
    ->Unit(benchmark::kMillisecond);
