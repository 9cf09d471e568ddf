#include "core/geometry/bvh.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

using namespace crt;
using namespace crt::core;

namespace {

constexpr LineSpan whole_line = {-infinity, infinity};

/// Returns where a line enters all leaves that it comes near within a part of it, and NaN for
/// others.
std::vector<double> entries(const Bvh& tree, std::size_t count, const RaySlabs& slabs,
                            const LineSpan& part = whole_line) {
  std::vector<double> result(count, std::numeric_limits<double>::quiet_NaN());
  if (!tree.has_root()) return result;
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    tree.visit(node, slabs, part, [&](Bvh::Child child, double enter) {
      if (child.is_leaf()) {
        CHECK(std::isnan(result[child.index()]));  // never twice
        result[child.index()] = enter;
      } else {
        open.push_back(child.index());
      }
    });
  }
  return result;
}

}  // namespace

TEST_CASE("a line finds in the tree the boxes that it meets one by one, where it enters each") {
  std::mt19937 random(1);
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (const std::size_t count :
       std::initializer_list<std::size_t>{0, 1, 2, 3, 4, 5, 17, 100, 1000}) {
    std::vector<Bounds> boxes;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 corner{real(-9, 9), real(-9, 9), real(-9, 9)};
      boxes.push_back({corner, corner + Vec3(real(0, 2), real(0, 2), i % 7 == 0 ? 0 : real(0, 2))});
    }
    if (count > 3) boxes[3] = {};  // empty: left out
    const Bvh tree(boxes);
    for (int i = 0; i < 200; ++i) {
      Vec3 direction{real(-1, 1), real(-1, 1), real(-1, 1)};
      if (i % 3 == 0) direction[i % 9 / 3] = 0;
      if (i % 20 == 0) direction = {0, 0x1p-1060, 0};
      const RaySlabs slabs({real(-9, 9), real(-9, 9), real(-9, 9)}, direction);
      const double middle = real(-9, 9);
      for (const LineSpan& part :
           {whole_line, {-infinity, middle}, {middle, infinity}, {middle, middle + 2}}) {
        const std::vector<double> found = entries(tree, count, slabs, part);
        for (std::size_t k = 0; k < count; ++k) {
          const LineSpan alone =
              boxes[k].empty() ? LineSpan{infinity, -infinity} : slabs.span(boxes[k]);
          const bool is_near =
              !alone.empty() && alone.leave >= part.enter && alone.enter <= part.leave;
          REQUIRE(std::isnan(found[k]) == !is_near);
          if (is_near) REQUIRE(found[k] == alone.enter);
        }
      }
    }
  }
}

TEST_CASE("boxes without end are kept apart") {
  const Bounds half{{-infinity, 0, 0}, {1, 1, 1}};
  const Bounds unit{{0, 0, 0}, {1, 1, 1}};
  const Bvh tree(std::vector<Bounds>{unit, half, Bounds::everything()});
  REQUIRE(tree.unbounded().size() == 2);
  CHECK(tree.unbounded()[0] == 1);
  CHECK(tree.unbounded()[1] == 2);
}

TEST_CASE("a thousand boxes in one place are a tree, too") {
  const std::vector<Bounds> boxes(1000, Bounds{{0, 0, 0}, {1, 1, 1}});
  const RaySlabs slabs({0.5, 0.5, -3}, {0, 0, 1});
  for (const double enter : entries(Bvh(boxes), boxes.size(), slabs))
    CHECK_FALSE(std::isnan(enter));
}

TEST_CASE("a tree is the same on any number of threads") {
  std::mt19937 random(2);
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<Bounds> boxes;
  for (int i = 0; i < 30'000; ++i) {
    const Vec3 corner{real(-9, 9), real(-9, 9) * real(0, 1), i % 2 == 0 ? 0 : real(0, 1)};
    boxes.push_back({corner, corner + Vec3(real(0, 0.2))});
  }
  const Bvh tree(boxes, 1);
  for (const int threads : {0, 2, 5}) CHECK(Bvh(boxes, threads) == tree);
  CHECK_FALSE(Bvh(std::span(boxes).first(29'999)) == tree);

  for (int i = 0; i < 20; ++i) {
    const RaySlabs slabs({real(-9, 9), real(-9, 9), -5}, {real(-0.1, 0.1), real(-0.1, 0.1), 1});
    const std::vector<double> found = entries(tree, boxes.size(), slabs);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const LineSpan alone = slabs.span(boxes[k]);
      REQUIRE(std::isnan(found[k]) == alone.empty());
      if (!alone.empty()) REQUIRE(found[k] == alone.enter);
    }
  }
}

TEST_CASE("a line's span in a box is the same by axes side by side, and by lines side by side") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> real(-3, 3);
  std::uniform_int_distribution<int> grid(-2, 2);
  // Lines are steep, along a side of the box, or next to one that is meant to be on it.
  const std::array<double, 4> steps = {0, 0x1p-1022, 0x1p-52, -0x1p-50};
  const auto step = [&] {
    return steps[static_cast<std::size_t>(grid(random) + 2) % steps.size()];
  };
  int empty = 0;
  for (int i = 0; i < 20'000; ++i) {
    Bounds box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = grid(random);
      box.upper[axis] = box.lower[axis] + 3;
    }
    FilterLine<Lanes> lines;
    std::array<LineSpan, lane_count> alone;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const Vec3 origin(real(random), grid(random) + step(), real(random));
      const Vec3 direction(real(random), grid(random) * (grid(random) == 0 ? step() : 1),
                           real(random));
      alone[lane] = RaySlabs(origin, direction).span(box);
      empty += alone[lane].empty() ? 1 : 0;
      const LineSpan by_axes = RaySlabs::span(origin, direction, box);
      CHECK(by_axes.empty() == alone[lane].empty());
      if (!by_axes.empty())
        CHECK((by_axes.enter == alone[lane].enter && by_axes.leave == alone[lane].leave));
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        lines.origin[a][lane] = origin[axis];
        lines.direction[a][lane] = direction[axis];
        lines.inverse[a][lane] = 1 / direction[axis];
      }
    }
    const LineSpanLanes side_by_side = RaySlabs::spans(lines, box, ~0u);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const double enter = side_by_side.enter[lane];
      const double leave = side_by_side.leave[lane];
      CHECK((enter <= leave) == !alone[lane].empty());
      if (!alone[lane].empty()) CHECK((enter == alone[lane].enter && leave == alone[lane].leave));
    }
  }
  CHECK(empty > 10'000);
  CHECK(empty < 70'000);
}
