// Any number of small scenes may be ready for rays at a time.
#include <doctest/doctest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "crt/entity.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"

using namespace crt;

namespace {

/// Prepares a row of unit balls along x, the first of them at x = first.
PreparedScene row_of_balls(double first, int count) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    scene.entities.emplace_back(Sphere{.center = {first + 3 * i, 0, 0}, .radius = 1});
  }
  return prepare(scene);
}

/// Returns where a ray along x from the origin meets it.
double distance_to(const PreparedScene& scene) {
  return intersect(scene, {.origin = {0, 0, 0}, .direction = {1, 0, 0}})->t;
}

}  // namespace

TEST_CASE("thousands of small scenes are ready at a time, each with its own answers") {
  constexpr int count = 3000;  // a process has 1024 keys for what belongs to a thread
  std::vector<PreparedScene> scenes;
  scenes.reserve(count);
  for (int i = 0; i < count; ++i) scenes.push_back(row_of_balls(10 + i, i % 2 == 0 ? 1 : 70));
  int place = 9;
  for (const PreparedScene& scene : scenes) REQUIRE(distance_to(scene) == place++);
  const MemoryUse memory = scenes.front().memory();
  CHECK(memory.tree == scenes[2].memory().tree);
  CHECK(scenes[1].memory().tree > memory.tree);
  scenes.erase(scenes.begin(), scenes.begin() + count / 2);
  CHECK(distance_to(scenes.front()) == 9 + count / 2);
  scenes.clear();
  CHECK(distance_to(row_of_balls(10, 1)) == 9);
}

TEST_CASE("scenes that threads prepare at once report the same memory") {
  const std::uint64_t expected = row_of_balls(10, 100).memory().tree;
  std::vector<int> wrong(4);
  std::vector<std::thread> threads;
  threads.reserve(wrong.size());
  for (int& mine : wrong) {
    threads.emplace_back([&mine, expected] {
      for (int i = 0; i < 200; ++i) {
        const PreparedScene scene = row_of_balls(10 + i, 100);
        mine += distance_to(scene) != 9 + i || scene.memory().tree != expected ? 1 : 0;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const int mine : wrong) CHECK(mine == 0);
}
