#include "core/geometry/compact_bvh.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

#include "core/math/vector.hpp"
#include "geometry/oracle.hpp"

using namespace crt;
using namespace crt::core;
using crt::test::Random;

namespace {

std::vector<Bounds> random_boxes(Random& random, std::size_t count, double scale) {
  std::vector<Bounds> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 corner = 3.0 * random.in_cube();
    const auto size = [&] {
      if (i % 7 == 0) return 0.0;
      return i % 3 == 0 ? random.power_of_ten(-9, 0) : random.uniform(0, 3);
    };
    const Vec3 sizes{size(), size(), size()};
    boxes.push_back({scale * corner, scale * (corner + sizes)});
  }
  return boxes;
}

/// Calls use(leaf) for the boxes of a leaf.
template <class Use>
void for_each_in(const CompactBvh& tree, BvhChild leaf, const Use& use) {
  for (const std::uint32_t box : tree.order().subspan(leaf.index(), leaf.count())) use(box);
}

}  // namespace

TEST_CASE("a line finds in a compact tree all boxes that it meets, and few others") {
  Random random(1);
  std::size_t met = 0;
  std::size_t found_too = 0;
  for (const double scale : {1.0, 0x1p-300, 0x1p300}) {
    for (const std::size_t count : std::initializer_list<std::size_t>{1, 5, 9, 100, 2000}) {
      const std::vector<Bounds> boxes = random_boxes(random, count, scale);
      const CompactBvh tree(boxes, 4, 1);
      for (int i = 0; i < 100; ++i) {
        Vec3 origin = scale * 5.0 * random.in_cube();
        Vec3 direction = random.power_of_ten(-30, 30) * random.in_cube();
        if (i % 3 == 0) direction[i % 9 / 3] = 0;
        if (i % 20 == 0) direction = {0, 0x1p-1060, 0};
        std::size_t aim = count;
        if (i % 5 == 0) {
          // It goes through a corner, or along an edge.
          aim = random.bits() % count;
          origin = boxes[aim].lower;
          if (i % 2 == 0) origin[i % 3] = boxes[aim].upper[i % 3];
        }
        if (largest_component(direction) == 0) direction.z = 1;
        const RaySlabs slabs(origin, direction);
        const GridSlabs grid_slabs(origin, direction, 0);
        std::vector<double> enters(count, infinity);
        std::vector<std::uint32_t> open{0};
        while (!open.empty()) {
          const std::uint32_t node = open.back();
          open.pop_back();
          tree.visit(node, grid_slabs, {-infinity, infinity}, [&](BvhChild child, double enter) {
            if (!child.is_leaf()) {
              open.push_back(child.index());
              return;
            }
            for_each_in(tree, child, [&](std::uint32_t box) { enters[box] = enter; });
          });
        }
        for (std::size_t k = 0; k < count; ++k) {
          // The span is rounded outwards, too. What a line meets surely is met by a smaller one.
          const LineSpan span = slabs.span(boxes[k]);
          constexpr double rounding = 0x1p-48;
          const double slack = rounding * (std::abs(span.enter) + std::abs(span.leave));
          if (k == aim) REQUIRE(enters[k] <= 0);
          if (span.enter + slack <= span.leave - slack) {
            ++met;
            REQUIRE(enters[k] <= grid_slabs.to_s(span.enter + slack));
          } else {
            found_too += enters[k] < infinity ? 1 : 0;
          }
        }
      }
    }
  }
  CHECK(met > 10000);
  CHECK(found_too < 5 * met);  // most of them in one leaf with one that is met
}

TEST_CASE("a box finds in a compact tree all boxes that it touches") {
  Random random(2);
  for (const double scale : {1.0, 0x1p-300}) {
    const std::vector<Bounds> boxes = random_boxes(random, 500, scale);
    const CompactBvh tree(boxes, 4, 1);
    for (const Bounds& box : boxes) {
      std::vector<bool> found(boxes.size());
      std::vector<std::uint32_t> open{0};
      while (!open.empty()) {
        const std::uint32_t node = open.back();
        open.pop_back();
        tree.for_each_touching(node, box, [&](BvhChild child) {
          if (!child.is_leaf()) {
            open.push_back(child.index());
            return;
          }
          for_each_in(tree, child, [&](std::uint32_t other) { found[other] = true; });
        });
      }
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (box.touches(boxes[i])) REQUIRE(found[i]);
      }
    }
  }
}
