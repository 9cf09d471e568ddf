#include "core/shading/fresnel.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/quad.hpp"

using namespace crt::core;
using crt::Vec3;
using crt::test::Quad;

namespace {

const std::vector<double> indices = {0.01, 0.5, 1.0, 1.0003, 1.33, 1.5, 2.42, 100.0};

/// Returns a direction that comes down at the given angle from straight down, in the x-y plane.
Vec3 incoming(double angle) {
  return {std::sin(angle), -std::cos(angle), 0};
}

const Vec3 up(0, 1, 0);

/// Returns the reflectance by the textbook equations as they are usually written, in quadruple
/// precision.
double textbook_reflectance(double cosine, double index_1, double index_2) {
  const Quad n1 = index_1;
  const Quad n2 = index_2;
  const Quad c1 = cosine;
  const Quad squared = 1 - n1 * n1 / (n2 * n2) * (1 - c1 * c1);
  if (squared <= 0) return 1;
  Quad c2 = std::sqrt(static_cast<long double>(squared));
  c2 = (c2 + squared / c2) / 2;  // one step of Newton's method: from long double to quadruple
  const Quad across = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2);
  const Quad within = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
  return static_cast<double>((across * across + within * within) / 2);
}

}  // namespace

TEST_CASE(
    "straight on, ((n1 - n2) / (n1 + n2))^2 is reflected and the rest goes straight through") {
  for (const double n1 : indices) {
    for (const double n2 : indices) {
      const double amplitude = (n1 - n2) / (n1 + n2);
      const Refraction<double> refraction = refract(-up, up, n1, n2);
      CHECK(refraction.reflectance == doctest::Approx(amplitude * amplitude).epsilon(1e-14));
      CHECK(refraction.direction == -up);
    }
  }
}

TEST_CASE(
    "at Brewster's angle only the part polarised across the plane of incidence is reflected") {
  for (const double n1 : indices) {
    for (const double n2 : indices) {
      if (n1 == n2) continue;
      const double brewster = std::atan2(n2, n1);
      const double across = (n1 * n1 - n2 * n2) / (n1 * n1 + n2 * n2);
      CHECK(refract(incoming(brewster), up, n1, n2).reflectance ==
            doctest::Approx(0.5 * across * across).epsilon(1e-7));
    }
  }
}

TEST_CASE("the reflected share is that of the textbook's equations at all angles") {
  for (const double n1 : indices) {
    for (const double n2 : indices) {
      for (int step = 0; step <= 1000; ++step) {
        const double cosine = step / 1000.0;
        const double expected = n1 == n2 ? 0 : textbook_reflectance(cosine, n1, n2);
        const double sine_behind = n1 / n2 * std::sqrt(1 - cosine * cosine);
        if (std::abs(sine_behind - 1) < 1e-9)
          continue;  // at the critical angle any error is magnified
        REQUIRE(fresnel_reflectance(cosine, n1, n2) == doctest::Approx(expected).epsilon(1e-10));
      }
    }
  }
}

TEST_CASE("almost equal indices keep all digits of the little that they reflect") {
  const double n1 = 1.5;
  const double n2 = std::nextafter(n1, 2.0);
  const double reflectance = fresnel_reflectance(0.7, n1, n2);
  CHECK(reflectance > 0);
  CHECK(reflectance == doctest::Approx(textbook_reflectance(0.7, n1, n2)).epsilon(1e-10));
}

TEST_CASE("grazing light is all reflected, and near to grazing the share has all its digits") {
  CHECK(fresnel_reflectance(0.0, 1.0, 1.5) == doctest::Approx(1).epsilon(1e-15));
  CHECK(fresnel_reflectance(0.0, 1.5, 1.0) == 1);
  for (const double cosine : {1e-3, 1e-6, 1e-9, 1e-12}) {
    // The light let through is, to first order in the cosine, 2 c (n + 1/n) / sqrt(n^2 - 1).
    const double n = 1.5;
    const double passed = 2 * cosine * (n + 1 / n) / std::sqrt(n * n - 1);
    CHECK(1 - fresnel_reflectance(cosine, 1.0, n) ==
          doctest::Approx(passed).epsilon(5 * cosine + 3e-16 / cosine));
  }
}

TEST_CASE("equal indices let everything through exactly straight, at any angle") {
  for (const double n : indices) {
    for (int step = 0; step <= 90; ++step) {
      const Vec3 direction = incoming(step * std::numbers::pi / 180);
      const Refraction<double> refraction = refract(direction, up, n, n);
      CHECK(refraction.reflectance == 0);
      CHECK(refraction.direction == direction);
      CHECK(fresnel_reflectance(std::cos(step * 0.01), n, n) == 0);
    }
  }
}

TEST_CASE("the refracted direction obeys Snell's law, stays in the plane and has unit length") {
  for (const double n1 : indices) {
    for (const double n2 : indices) {
      for (int step = 0; step < 90; ++step) {
        const Vec3 direction = incoming(step * std::numbers::pi / 180);
        const Refraction<double> refraction = refract(direction, up, n1, n2);
        if (refraction.reflectance == 1) continue;
        CHECK(glm::length(refraction.direction) == doctest::Approx(1).epsilon(1e-15));
        CHECK(refraction.direction.y < 0);
        CHECK(refraction.direction.z == 0);
        CHECK(n2 * refraction.direction.x == doctest::Approx(n1 * direction.x).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("total internal reflection begins at the critical angle") {
  const double n1 = 1.5;
  const double critical = std::asin(1 / n1);
  CHECK(refract(incoming(critical - 1e-7), up, n1, 1.0).reflectance < 1);
  const Refraction<double> total = refract(incoming(critical + 1e-7), up, n1, 1.0);
  CHECK(total.reflectance == 1);
  CHECK(total.direction == Vec3(0));
}

TEST_CASE("light takes the same path back, and the same share of it is reflected") {
  for (const double n1 : indices) {
    for (const double n2 : indices) {
      for (int step = 1; step < 90; ++step) {
        const Vec3 direction = incoming(step * std::numbers::pi / 180);
        const Refraction<double> there = refract(direction, up, n1, n2);
        if (there.reflectance > 0.999) continue;  // the reverse path is then ill-conditioned
        const Refraction<double> back = refract(-there.direction, -up, n2, n1);
        CHECK(back.reflectance == doctest::Approx(there.reflectance).epsilon(1e-9));
        CHECK(glm::length(back.direction + direction) < 1e-9);
      }
    }
  }
}

TEST_CASE("a share is between 0 and 1 whatever the angle") {
  for (const double n1 : indices) {
    for (const double n2 : indices) {
      for (double cosine = 1; cosine > 1e-300; cosine /= 3) {
        const double share = fresnel_reflectance(cosine, n1, n2);
        CHECK(share >= 0);
        CHECK(share <= 1);
      }
    }
  }
}

TEST_CASE("a mirror turns the part along the normal round and nothing else") {
  CHECK(mirrored({0.6, -0.8, 0}, up) == Vec3(0.6, 0.8, 0));
  CHECK(mirrored({0, -1, 0}, up) == Vec3(0, 1, 0));
  const Vec3 direction = glm::normalize(Vec3(1, 2, 3));
  const Vec3 normal = glm::normalize(Vec3(-2, 1, -1));
  CHECK(glm::length(mirrored(mirrored(direction, normal), normal) - direction) < 1e-15);
}

TEST_CASE("four rays side by side are refracted as each alone, to the last bit") {
  std::vector<Vec3> directions = {-up, {1, 0, 0}, {1, 1e-9, 0}};
  for (int step = 0; step < 90; ++step)
    directions.push_back(incoming(step * std::numbers::pi / 180));
  for (const Vec3& direction : directions) {
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const double n1 = indices[i];
      VectorLanes lanes;
      Lanes n2{};
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        lanes.set(lane, lane % 2 == 0 ? direction : incoming(0.3));
        n2[lane] = indices[(i + lane) % indices.size()];
      }
      const auto together = refract(lanes, lanes_of(up), lanes_of(n1), n2);
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const auto alone = refract(lanes.lane(lane), up, n1, double{n2[lane]});
        REQUIRE(together.reflectance[lane] == alone.reflectance);
        REQUIRE(together.direction.lane(lane) == alone.direction);
      }
    }
  }
}
