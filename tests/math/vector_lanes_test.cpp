#include "core/math/vector_lanes.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <random>

#include "core/math/vector.hpp"

using namespace crt::core;
using crt::Vec3;

namespace {

/// Makes vectors of all sizes, with components of very different sizes.
class Vectors {
 public:
  Vec3 next() {
    const double size = std::ldexp(1, static_cast<int>(exponents_(engine_)));
    Vec3 v;
    for (int axis = 0; axis < 3; ++axis) {
      v[axis] = size * components_(engine_) *
                (axis == 2 ? std::ldexp(1, -static_cast<int>(engine_() % 60)) : 1);
    }
    return v;
  }
  std::array<Vec3, lane_count> four() { return {next(), next(), next(), next()}; }

 private:
  std::mt19937_64 engine_{1};
  std::uniform_real_distribution<double> components_{-1, 1};
  std::uniform_int_distribution<int> exponents_{-1000, 1000};
};

VectorLanes side_by_side(const std::array<Vec3, lane_count>& vectors) {
  VectorLanes result;
  for (std::size_t lane = 0; lane < lane_count; ++lane) result.set(lane, vectors[lane]);
  return result;
}

}  // namespace

TEST_CASE("vectors side by side are computed with as each by itself, to the last bit") {
  Vectors vectors;
  for (int i = 0; i < 100000; ++i) {
    const auto a = vectors.four();
    const auto b = vectors.four();
    const VectorLanes lanes_a = side_by_side(a);
    const VectorLanes lanes_b = side_by_side(b);
    const Lanes dots = dot(lanes_a, lanes_b);
    const DoubleDoubleLanes accurate = accurate_dot(lanes_a, lanes_b);
    const Lanes largest = largest_component(lanes_a);
    VectorLanes directions;
    Lanes lengths;
    directions_and_lengths(lanes_a, directions, lengths);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const std::size_t k = lane;
      REQUIRE((lanes_a + lanes_b).lane(lane) == a[lane] + b[lane]);
      REQUIRE((lanes_a / lanes_b).lane(lane) == a[lane] / b[lane]);
      REQUIRE(floor(lanes_a).lane(lane) == glm::floor(a[lane]));
      REQUIRE((lanes_a - lanes_b).lane(lane) == a[lane] - b[lane]);
      REQUIRE((lanes_a * lanes_b).lane(lane) == a[lane] * b[lane]);
      const double expected_dot = glm::dot(a[lane], b[lane]);
      const DoubleDouble expected_accurate = accurate_dot(a[lane], b[lane]);
      REQUIRE((dots[k] == expected_dot || std::isnan(expected_dot)));
      REQUIRE((accurate.hi[k] == expected_accurate.hi || std::isnan(expected_accurate.hi)));
      REQUIRE((accurate.lo[k] == expected_accurate.lo || std::isnan(expected_accurate.lo)));
      REQUIRE(largest[k] == largest_component(a[lane]));
      REQUIRE(unit_vector(lanes_a).lane(lane) == unit_vector(a[lane]));
      const DirectionAndLength expected = direction_and_length(a[lane]);
      REQUIRE(directions.lane(lane) == expected.direction);
      const double length = lengths[k];
      REQUIRE(length == expected.length);
    }
  }
}

TEST_CASE("vectors by lane have their components in a row") {
  const std::array<Vec3, lane_count> vectors = {Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 8, 9),
                                                Vec3(-1, -2, -3)};
  const auto rows = by_lane(side_by_side(vectors));
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const Lanes row = rows[lane];
    CHECK(Vec3(row[0], row[1], row[2]) == vectors[lane]);
    CHECK(row[3] == 0);
  }
}

TEST_CASE("lanes are chosen by mask") {
  const VectorLanes a = lanes_of(Vec3(1, 2, 3));
  const VectorLanes b = lanes_of(Vec3(4, 5, 6));
  for (std::uint32_t mask = 0; mask < 1u << lane_count; ++mask) {
    const VectorLanes c = select(lanes_with(mask), a, b);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      CHECK(c.lane(lane) == ((mask >> lane & 1u) != 0 ? Vec3(1, 2, 3) : Vec3(4, 5, 6)));
    }
    CHECK(mask_of(lanes_with(mask)) == mask);
  }
}

TEST_CASE("cross products side by side are those of each pair, to the last bit") {
  Vectors vectors;
  for (int i = 0; i < 100000; ++i) {
    auto a = vectors.four();
    auto b = vectors.four();
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      a[lane] = scaled_to_one(a[lane]);
      b[lane] = scaled_to_one(b[lane]);
    }
    const VectorLanes crosses = accurate_cross(side_by_side(a), side_by_side(b));
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      REQUIRE(crosses.lane(lane) == accurate_cross(a[lane], b[lane]));
    }
  }
}
