// Objects are ordered along a curve: each is there once, and neighbours are near each other,
// whatever the sizes.
#include "core/accel/space_order.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>
#include <vector>

using namespace crt;
using namespace crt::core;

namespace {

struct Boxes {
  CompiledScene scene;
  Bounds total;
  std::vector<std::uint32_t> order;

  void add(const Vec3& lower, const Vec3& upper) {
    Bounds box;
    box.include(lower);
    box.include(upper);
    scene.objects.push_back({.bounds = box});
    total.include(box);
    order.push_back(static_cast<std::uint32_t>(order.size()));
  }

  void sort() { sort_along_curve(scene, total, order); }

  bool has_each_once() const {
    std::vector<std::uint32_t> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> all(order.size());
    std::iota(all.begin(), all.end(), 0u);
    return sorted == all;
  }

  double path_length() const {
    double length = 0;
    for (std::size_t i = 1; i < order.size(); ++i) {
      length += glm::distance(scene.objects[order[i - 1]].bounds.lower,
                              scene.objects[order[i]].bounds.lower);
    }
    return length;
  }
};

Boxes random_points(std::size_t count, const Vec3& size) {
  std::mt19937_64 engine(20261122);
  std::uniform_real_distribution<double> within(-1, 1);
  Boxes boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 point = size * Vec3(within(engine), within(engine), within(engine));
    boxes.add(point, point);
  }
  return boxes;
}

}  // namespace

TEST_CASE("in a cloud the path from object to object is that to near neighbours") {
  constexpr std::size_t count = 20000;
  Boxes boxes = random_points(count, Vec3(1));
  const double before = boxes.path_length();
  boxes.sort();
  CHECK(boxes.has_each_once());
  // In a cube with sides of 2 a neighbour is some 2 / 27 away, and any other object 1.3.
  CHECK(before > 1.2 * count);
  CHECK(boxes.path_length() < 0.12 * count);
}

TEST_CASE("clouds as large and as small as numbers go are ordered alike") {
  Boxes boxes = random_points(1000, Vec3(1));
  boxes.sort();
  for (const double size : {0x1p1023, 0x1p-1000}) {
    Boxes others = random_points(1000, Vec3(size));
    others.sort();
    CHECK(others.order == boxes.order);
  }
}

TEST_CASE("objects in one place keep their order") {
  Boxes boxes;
  for (int i = 0; i < 100; ++i) boxes.add(Vec3(-1, 2, 3), Vec3(1, 2, 3));
  const std::vector<std::uint32_t> before = boxes.order;
  boxes.sort();
  CHECK(boxes.order == before);
}

TEST_CASE("a row of objects is followed from end to end, also among objects on the rim") {
  Boxes boxes;
  constexpr int count = 4096;
  for (int i = 0; i < count; ++i)
    boxes.add(Vec3((i * 1031) % count, 0, 0), Vec3((i * 1031) % count, 0, 0));
  boxes.sort();
  CHECK(boxes.has_each_once());
  CHECK(boxes.path_length() == count - 1);
}
