// Measures how the time of a ray grows with the scene, on one thread. Writes JSON: for each curve
// and N the seconds that preparing took, and in each round those of following the rays.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <crt/prepared_scene.hpp>
#include <crt/query.hpp>
#include <crt/render.hpp>
#include <functional>
#include <iostream>

#include "measuring.hpp"
#include "query_rays.hpp"

namespace crt::bench {

namespace {

struct Curve {
  const char* name;
  const char* about;
  std::function<Scene(int n)> scene;
  int largest;  ///< N
  int side;     ///< of the picture, in pixels
};

constexpr int quick_largest = 10'000;

Entity ball(const Vec3& center, double radius) {
  return Sphere{.center = center, .radius = radius};
}

Scene seen_from(const Vec3& position, Entity what) {
  Scene scene;
  scene.entities = {std::move(what)};
  scene.camera = {.position = position, .pointing = {0, 0, 0}, .fov = camera_fov};
  return scene;
}

Scene sparse_union(int n) {
  std::vector<Entity> balls;
  for (const Ball& one : balls_in_a_box(n)) {
    balls.push_back(ball({one.center[0], one.center[1], one.center[2]}, one.radius));
  }
  return seen_from({3, 6, -11}, csg_union(balls));
}

/// Places are the centres of n places in rows on the front of a plate of 8 x 8, with the width of a
/// place.
struct Places {
  std::vector<Vec3> centers;
  double width;
};

Places places(int n) {
  const int rows = static_cast<int>(std::ceil(std::sqrt(n)));
  const double width = 8.0 / rows;
  Places result{{}, width};
  for (int i = 0; i < n; ++i) {
    result.centers.emplace_back(width * (i % rows + 0.5) - 4, width * (i / rows + 0.5) - 4, 0);
  }
  return result;
}

const Box plate{.corner_a = {-4, -4, 0}, .corner_b = {4, 4, 1}};

Scene plate_of_holes(int n) {
  const Places holes = places(n);
  std::vector<Entity> cutters;
  for (const Vec3& center : holes.centers) cutters.push_back(ball(center, 0.4 * holes.width));
  return seen_from({1, 2, -11}, csg_difference(plate, cutters));
}

/// Puts the camera into the middle of n balls, all cut out of a box. A ray leaves all of them
/// before it meets the box.
Scene nested_shells(int n) {
  std::vector<Entity> cutters;
  for (int i = 0; i < n; ++i) cutters.push_back(ball({0, 0, 0}, 1 + 2.0 * (i + 1) / n));
  return seen_from({0, 0, -0.5},
                   csg_difference(Box{.corner_a = Vec3(-4), .corner_b = Vec3(4)}, cutters));
}

/// Makes holes that overlap. Each ray passes all of them before it is outside.
Scene holes_in_a_row(int n) {
  constexpr double step = 1.44;
  std::vector<Entity> cutters;
  for (int i = 0; i < n; ++i) cutters.push_back(ball({0, 0, step * i}, 1.2));
  const Box block{.corner_a = {-2, -2, 0}, .corner_b = {2, 2, step * (n - 1) + 3}};
  Scene scene = seen_from({0, 0, -5}, csg_difference(block, cutters));
  scene.camera.projection = Projection::orthographic;
  scene.camera.fov = 1.2;
  return scene;
}

/// Adds balls and cuts them out by turns, with a level of nesting each.
Scene alternating_depth(int n) {
  const Places balls = places(n);
  Entity body = plate;
  for (std::size_t i = 0; i < balls.centers.size(); ++i) {
    const Entity next = ball(balls.centers[i], 0.45 * balls.width);
    body = i % 2 == 0 ? body + next : body - next;
  }
  return seen_from({1, 2, -11}, body);
}

const Curve curves[] = {
    {"sparse union", "one union of N spheres in a box", sparse_union, 1'000'000, 500},
    {"plate of holes", "a box minus N spheres side by side", plate_of_holes, 1'000'000, 500},
    {"nested shells", "a box minus N spheres around one another, seen from their middle",
     nested_shells, 1'000, 100},
    {"holes in a row", "a box minus N spheres that overlap, along the ray", holes_in_a_row, 1'000,
     100},
    {"alternating depth", "unions and differences nested N deep, side by side", alternating_depth,
     10'000, 100},
};

struct Point {
  double prepare_seconds = 0;
  std::vector<double> nanoseconds;  ///< a camera ray, in each round
  double tests = 0;                 ///< of primitives and CSG objects, a ray
  double events = 0;                ///< crossings inside CSG objects, a ray
};

Point measured(Scene scene, int side, int rounds) {
  scene.settings.width = scene.settings.height = side;
  Point point;
  PreparedScene prepared = prepare({});
  point.prepare_seconds = processor_seconds_of([&] { prepared = prepare(scene); });
  for (int round = -1; round < rounds; ++round) {
    RenderStats stats;
    const double taken =
        processor_seconds_of([&] { stats = render(prepared, {.threads = 1}).stats(); });
    const auto rays = static_cast<double>(stats.camera_rays);
    point.tests = static_cast<double>(stats.intersection_tests) / rays;
    point.events = static_cast<double>(stats.interval_events) / rays;
    if (round >= 0) point.nanoseconds.push_back(taken / rays * 1e9);
  }
  return point;
}

std::vector<std::string> run(bool quick) {
  const int rounds = quick ? 1 : 5;
  std::vector<std::string> rows;
  for (const Curve& curve : curves) {
    for (int n = 1; n <= (quick ? std::min(curve.largest, quick_largest) : curve.largest);
         n *= 10) {
      const Point point = measured(curve.scene(n), quick ? curve.side / 2 : curve.side, rounds);
      std::cerr << fmt::format(
          "{:18} N = {:8}: {:10.1f} ns a ray, {:8.1f} crossings; prepared in {:.3f} s\n",
          curve.name, n, median(point.nanoseconds), point.events, point.prepare_seconds);
      rows.push_back(fmt::format(
          R"({{"curve": "{}", "about": "{}", "n": {}, "prepare_seconds": {}, "tests": {}, )"
          R"("events": {}, "nanoseconds": [{}]}})",
          curve.name, curve.about, n, point.prepare_seconds, point.tests, point.events,
          fmt::join(point.nanoseconds, ", ")));
    }
  }
  return rows;
}

}  // namespace

}  // namespace crt::bench

int main(int argc, char** argv) {
  return crt::bench::measured_main(argc, argv, crt::bench::run);
}
