// These tests render on a thread of their own, and ask batches of ray queries.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <crt/error.hpp>
#include <crt/job.hpp>
#include <crt/query.hpp>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Scene lit_sphere(int width, int height) {
  Scene scene;
  scene.settings.width = width;
  scene.settings.height = height;
  scene.lights = {PointLight{.origin = {2, 4, -3}}};
  scene.entities = {Sphere{.center = {0, 0, 2}, .radius = 0.8}};
  return scene;
}

ErrorCode end_of(const RenderJob& job) {
  try {
    static_cast<void>(job.wait());
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::internal;
}

}  // namespace

TEST_CASE("a job's picture is the one that render() gives, however often it is asked for") {
  const PreparedScene scene = prepare(lit_sphere(60, 40));
  const Image expected = render(scene);
  for (const int threads : {0, 1, 2}) {
    const RenderJob job(scene, {.threads = threads});
    CHECK(same_pixels(job.wait(), expected));
    CHECK(same_pixels(job.wait(), expected));
    CHECK(same_pixels(job.snapshot(), expected));
    CHECK(job.finished());
    CHECK(job.progress() == 1);
  }
}

TEST_CASE("a job outlives the scene that it renders") {
  std::optional<PreparedScene> scene = prepare(lit_sphere(60, 40));
  const Image expected = render(*scene);
  const RenderJob job(*scene);
  scene.reset();
  CHECK(same_pixels(job.wait(), expected));
}

TEST_CASE("a job may be moved, and one that takes another's place stops what was there") {
  const PreparedScene scene = prepare(lit_sphere(60, 40));
  RenderJob first(scene);
  RenderJob second(prepare(lit_sphere(400, 400)));
  second = std::move(first);
  CHECK(second.wait().width() == 60);
}

TEST_CASE("a cancelled job says so, before its first tile and after") {
  const PreparedScene scene = prepare(lit_sphere(200, 200));
  for (const double limit : {0.0, 0.4}) {
    RenderJob* running = nullptr;
    std::atomic<bool> ready = false;
    RenderJob job(scene, {.progress = [&](double share) {
                    while (!ready) std::this_thread::yield();
                    if (share >= limit) running->cancel();
                    return true;
                  }});
    running = &job;
    ready = true;
    CHECK(end_of(job) == ErrorCode::cancelled);
    CHECK(job.snapshot().at(199, 199).a == 0);
  }
}

TEST_CASE("what a callback of a job throws comes out of wait()") {
  const PreparedScene scene = prepare(lit_sphere(60, 40));
  const RenderJob job(
      scene, {.progress = [](double) -> bool { throw std::out_of_range("the host's own"); }});
  CHECK_THROWS_AS(static_cast<void>(job.wait()), std::out_of_range);
}

TEST_CASE("a job that cannot start says so at once") {
  const PreparedScene scene = prepare(lit_sphere(60, 40));
  CHECK_THROWS_AS(RenderJob(scene, {.threads = -2}), Error);
  CHECK_THROWS_AS(RenderJob(scene, {.region = Region{50, 0, 20, 20}}), Error);
}

TEST_CASE("a batch of rays is asked once each, on one thread or several") {
  const PreparedScene scene = prepare(lit_sphere(60, 40));
  for (const int threads : {1, 0, 3}) {
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{511}, std::size_t{100'001}}) {
      std::vector<std::uint8_t> asked(count, 0);
      std::atomic<int> wrong = 0;
      query_in_parallel(
          scene, count,
          [&](RayQueries& queries, std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
              ++asked[i];
              const double x = (static_cast<double>(i) / static_cast<double>(count) - 0.5) * 4;
              const Ray ray{.origin = {x, 0, -1}};
              if (queries.intersect(ray).has_value() != (std::abs(x) < 0.8)) ++wrong;
              if (queries.occluded(ray) != (std::abs(x) < 0.8)) ++wrong;
            }
          },
          threads);
      CHECK(std::ranges::all_of(asked, [](std::uint8_t times) { return times == 1; }));
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("what the work on a batch throws comes out") {
  const PreparedScene scene = prepare(lit_sphere(60, 40));
  CHECK_THROWS_AS(query_in_parallel(scene, 10, {}), Error);
  CHECK_THROWS_AS(query_in_parallel(scene, 100'000,
                                    [](RayQueries&, std::size_t first, std::size_t) {
                                      if (first > 0) throw std::out_of_range("the host's own");
                                    }),
                  std::out_of_range);
}

TEST_CASE("a direction of any length gives the same place, and t in its units") {
  const PreparedScene scene = prepare(lit_sphere(60, 40));
  RayQueries queries(scene);
  const Hit unit = queries.intersect({.origin = {0.1, 0.2, -1}}).value();
  for (const double length : {1e-300, 0x1p-1022, 0.3, 7.0, 1e300, 0x1p1023}) {
    const Hit hit =
        queries.intersect({.origin = {0.1, 0.2, -1}, .direction = {0, 0, length}}).value();
    CHECK(hit.t == doctest::Approx(unit.t / length));
    CHECK(hit.position.z == doctest::Approx(unit.position.z));
  }
}

TEST_CASE("where t would pass the largest number there is no hit for any question") {
  const PreparedScene scene = prepare(lit_sphere(60, 40));
  const Ray ray{.origin = {0.1, 0.2, -1}, .direction = {0, 0, 0x1p-1074}};
  CHECK_FALSE(intersect(scene, ray).has_value());
  CHECK_FALSE(occluded(scene, ray));
  CHECK(crossings(scene, ray).empty());
}

TEST_CASE("the triangles of a mesh share their corners without a gap") {
  // This is a square of two triangles, and a fan about its middle in front of it.
  const std::vector<Vec3> positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, -1}};
  const std::vector<TriangleIndices> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}, {1, 2, 4},
                                                  {2, 3, 4}, {3, 0, 4}, {0, 0, 1}};
  Scene scene;
  scene.entities = {triangle_mesh(positions, triangles)};
  CHECK(scene.entities[0].is_solid());
  CHECK(scene.entities[0].primitive_count() == 6);
  const PreparedScene prepared = prepare(scene);
  RayQueries queries(prepared);
  std::vector<Hit> hits;
  for (double y = -0.75; y <= 0.75; y += 0.125) {
    for (double x = -0.75; x <= 0.75; x += 0.125) {
      queries.crossings({.origin = {x, y, -5}}, hits);
      REQUIRE(hits.size() == 2);
      CHECK(hits.front().t == doctest::Approx(4 + std::max(std::abs(x), std::abs(y))));
      CHECK(hits.back().t == doctest::Approx(5));
    }
  }
  const std::vector<TriangleIndices> beyond = {{0, 1, 5}};
  const std::vector<TriangleIndices> flat = {{1, 1, 2}};
  CHECK_THROWS_AS(triangle_mesh(positions, beyond), Error);
  CHECK_THROWS_AS(triangle_mesh(positions, flat), Error);
  CHECK_THROWS_AS(triangle_mesh({}, {}), Error);
}
