// One ray may meet very many things. These tests are about what it costs, and who may stop it.
#include <doctest/doctest.h>
#include <unistd.h>

#include <array>
#include <vector>

#include "core/prepare/prepared_data.hpp"
#include "crt/error.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"

using namespace crt;
using namespace crt::core;

namespace {

struct Stopped {};

/// Returns spheres that all overlap, each a little farther than the one before.
std::vector<Entity> crowd(int count) {
  std::vector<Entity> spheres;
  for (int i = 0; i < count; ++i) spheres.emplace_back(Sphere{.center = {0, 0, 1e-7 * i}});
  return spheres;
}

Scene scene_of(std::vector<Entity> entities) {
  Scene scene;
  scene.entities = std::move(entities);
  return scene;
}

/// These scenes have the spheres as objects of their own, or as one object. A ray meets them all.
Scene lone(int count) {
  return scene_of(crowd(count));
}
Scene united(int count) {
  return scene_of({csg_union(crowd(count))});
}
Scene common(int count) {
  return scene_of({csg_intersection(crowd(count))});
}

const WorldRay through{.origin = {0.1, 0.2, -5}, .direction = {0, 0, 1}};

/// Returns what a ray for all crossings counts: objects, and crossings with parts of them.
std::uint64_t work_of(const Scene& scene) {
  const PreparedData prepared(scene);
  RayWorkspace work;
  std::vector<RayHit> hits;
  prepared.crossings(through, hits, work);
  REQUIRE(hits.size() >= 2);
  return work.intersection_tests + work.interval_events();
}

RayBatch packet_through() {
  RayBatch rays;
  for (std::size_t i = 0; i < packet_size; ++i) rays.set(i, through.origin, through.direction, {});
  return rays;
}

ErrorCode code_of(const auto& ask) {
  try {
    ask();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::internal;
}

}  // namespace

TEST_CASE("what a ray meets of a crowd costs in proportion to its number") {
  for (const auto make : {lone, united, common}) {
    const std::uint64_t of_thousand = work_of(make(1000));
    CHECK(work_of(make(10'000)) <= 10 * of_thousand + 100);
    CHECK(work_of(make(100'000)) <= 100 * of_thousand + 100);
  }
}

TEST_CASE("a ray of too many steps ends with an error, alone and among others") {
  constexpr int count = 20'000;
  const StepRules rules{.most = 5000, .poll = {}};
  const StepRules wide{.most = 3 * count, .poll = {}};
  for (const auto make : {lone, united, common}) {
    const PreparedData prepared(make(count));
    RayWorkspace work;
    std::vector<RayHit> hits;
    const auto ask_for_all = [&] { prepared.crossings(through, hits, work); };
    const auto ask_for_first = [&] { prepared.intersect(through, work); };
    const auto ask_for_any = [&] {
      WorldRay inside = through;  // where nothing is
      inside.t_min = 5;
      inside.t_max = 5.0001;
      prepared.occluded(inside, work);
    };
    const auto ask_for_packet = [&] {
      std::array<RayHit, packet_size> found;
      prepared.intersect_each(packet_through(), RayPacket::all(packet_size), found, work,
                              Packets::always);
    };
    work.csg.steps.rules = &rules;
    CHECK(code_of(ask_for_all) == ErrorCode::limit);
    work.csg.steps.rules = &wide;
    CHECK_NOTHROW(ask_for_all());
    CHECK_NOTHROW(ask_for_first());
    CHECK_NOTHROW(ask_for_any());
    CHECK_NOTHROW(ask_for_packet());
  }
  // The nearest hit is behind all others here.
  const PreparedData prepared(common(count));
  RayWorkspace work;
  work.csg.steps.rules = &rules;
  CHECK(code_of([&] { prepared.intersect(through, work); }) == ErrorCode::limit);
  CHECK(code_of([&] { prepared.occluded(through, work); }) == ErrorCode::limit);
  CHECK(code_of([&] {
          std::array<RayHit, packet_size> found;
          prepared.intersect_each(packet_through(), RayPacket::all(packet_size), found, work,
                                  Packets::always);
        }) == ErrorCode::limit);
}

TEST_CASE("a ray through a crowd is stopped in its midst") {
  constexpr int count = 100'000;
  int polls = 0;
  const StepRules rules{.most = usual_most_steps, .poll = [&] {
                          if (++polls > 3) throw Stopped();
                        }};
  for (const auto make : {lone, united, common}) {
    const PreparedData prepared(make(count));
    RayWorkspace work;
    work.csg.steps.rules = &rules;
    std::vector<RayHit> hits;
    polls = 0;
    CHECK_THROWS_AS(prepared.crossings(through, hits, work), Stopped);
    CHECK(work.intersection_tests + work.interval_events() < count / 5);
    // The workspace is still usable.
    work.csg.steps.rules = nullptr;
    prepared.crossings(through, hits, work);
    CHECK(hits.size() == (make == lone ? 2 * count : 2));
  }
}

TEST_CASE("many things about a ray's place that it never comes to cost it nothing") {
  const PreparedData prepared(lone(100'000));
  RayWorkspace work;
  prepared.intersect({.origin = {3, 3, -5}, .direction = {0, 0, 1}}, work);
  CHECK(work.intersection_tests == 0);
}

TEST_CASE("preparing asks whether to go on, and ends with an error if not") {
  std::vector<Entity> entities = crowd(50'000);
  entities.push_back(csg_union(crowd(50'000)));
  const Scene scene = scene_of(entities);
  int asked = 0;
  CHECK_NOTHROW(prepare(scene, {.go_on = [&] { return ++asked > 0; }}));
  CHECK(asked > 0);
  CHECK(code_of([&] { prepare(scene, {.go_on = [] { return false; }}); }) == ErrorCode::cancelled);
  // With what was prepared earlier at hand there is little left to ask about.
  const PreparedScene earlier = prepare(scene);
  CHECK_NOTHROW(prepare(scene, {.earlier = &earlier}));
}

TEST_CASE("a scene of more primitives than are allowed, or than can be numbered, is an error") {
  const Scene scene = scene_of({csg_union(crowd(40)), Sphere{}, Sphere{}});
  CHECK_NOTHROW(prepare(scene, {.max_primitives = 42}));
  CHECK(code_of([&] { prepare(scene, {.max_primitives = 41}); }) == ErrorCode::limit);
  Entity many = Sphere{};
  for (int doubling = 0; doubling < 60; ++doubling) many = many + many;
  CHECK(code_of([&] { prepare(scene_of({many})); }) == ErrorCode::limit);
  // Two to the 25 can be numbered, but take some 90 GB.
  Entity much = Box{};
  for (int doubling = 0; doubling < 25; ++doubling) much = much + much;
  Scene exact = scene_of({much});
  exact.settings.precision = Precision::exact;
  if (::sysconf(_SC_PHYS_PAGES) < (std::int64_t{1} << 36) / ::sysconf(_SC_PAGESIZE)) {
    CHECK(code_of([&] { prepare(exact); }) == ErrorCode::limit);
  }
}
