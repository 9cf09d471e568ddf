// Tasks cost about the same by the map that they are made from, and cover each pixel once.
#include <doctest/doctest.h>

#include <algorithm>

#include "farm/split.hpp"

using namespace crt;
using namespace crt::farm;

namespace {

/// Makes a map whose cost lies mostly in one corner.
CostMap corner_map(double factor) {
  CostMap map{.width = 640, .height = 480, .columns = 32, .rows = 24};
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column)
      map.seconds.push_back(factor * (column < 8 && row < 6 ? 50 : 1));
  }
  return map;
}

void check_covered(const std::vector<Task>& tasks, int frames) {
  std::vector<std::vector<int>> counts(static_cast<std::size_t>(frames),
                                       std::vector<int>(640 * 480));
  for (const Task& task : tasks) {
    for (const auto& [frame, region] : task.pieces) {
      for (int y = region.y; y < region.y + region.height; ++y) {
        for (int x = region.x; x < region.x + region.width; ++x)
          ++counts[static_cast<std::size_t>(frame)][static_cast<std::size_t>(640 * y + x)];
      }
    }
  }
  for (const std::vector<int>& frame : counts)
    CHECK(std::all_of(frame.begin(), frame.end(), [](int count) { return count == 1; }));
}

double longest_by_mean(const std::vector<Task>& tasks) {
  double sum = 0;
  double longest = 0;
  for (const Task& task : tasks) {
    sum += task.seconds;
    longest = std::max(longest, task.seconds);
  }
  return longest * static_cast<double>(tasks.size()) / sum;
}

}  // namespace

TEST_CASE("a picture is cut into tasks of equal cost") {
  const CostMap map = corner_map(1);
  const std::vector<const CostMap*> frames = {&map};
  for (const int count : {1, 2, 7, 64, 300}) {
    const std::vector<Task> tasks = split(frames, 0, {.tasks = count});
    check_covered(tasks, 1);
    CHECK(longest_by_mean(tasks) < (count < 100 ? 1.2 : 1.3));  // pixels are whole
  }
}

TEST_CASE("frames of different cost are cut into tasks of equal cost") {
  std::vector<CostMap> maps;
  for (int i = 0; i < 10; ++i) maps.push_back(corner_map(1 + i));
  std::vector<const CostMap*> frames;
  for (const CostMap& map : maps) frames.push_back(&map);
  for (const int count : {1, 3, 8, 10, 64}) {
    const std::vector<Task> tasks = split(frames, 0, {.tasks = count});
    check_covered(tasks, 10);
    CHECK(longest_by_mean(tasks) < 1.2);
  }
}

TEST_CASE("tiles of a size are shared out") {
  const CostMap map = corner_map(1);
  const std::vector<const CostMap*> one = {&map};
  std::vector<Task> tasks = split(one, 0, {.tasks = 6, .tile_width = 50, .tile_height = 33});
  check_covered(tasks, 1);
  CHECK(longest_by_mean(tasks) < 1.15);
  const std::vector<const CostMap*> three = {&map, &map, &map};
  tasks = split(three, 0, {.tasks = 6, .tile_width = 50, .tile_height = 33});
  check_covered(tasks, 3);
  CHECK(longest_by_mean(tasks) < 1.2);
}
