// Samples of principled surfaces are those of the formulas, and of mirrors and glass in the limit.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/shading/fresnel.hpp"
#include "principled_surfaces.hpp"

using namespace crt::test;
using crt::Vec3;

TEST_CASE("samples have the density of evaluate(), and weights that add up to what is scattered") {
  for (const Surface& surface : rough_surfaces()) {
    for (const bool from_outside : {true, false}) {
      const PrincipledSurface<double> seen = surface.seen(from_outside);
      for (const double cosine : {0.2, 0.9}) {
        const Vec3 o = direction(cosine);
        // These functions of directions have the same mean over both.
        const auto functions_of = [](const Vec3& i) {
          return std::array{1.0, i.z, i.z * i.z, i.x, i.x * i.z, i.y * i.y, i.x * i.x * i.z};
        };
        decltype(functions_of(o)) expected{};
        Vec3 scattered(0);
        const PrincipledSurface<Lanes> lanes = lanes_of(seen);
        for_all_directions([&](const VectorLanes& i, double solid_angle) {
          const auto found =
              evaluate<Lanes>(lanes, crt::core::lanes_of(o), crt::core::lanes_of(up), i);
          for (std::size_t lane = 0; lane < lane_count; ++lane) {
            const auto functions = functions_of(i.lane(lane));
            for (std::size_t k = 0; k < functions.size(); ++k)
              expected[k] += solid_angle * found.density[lane] * functions[k];
          }
          const VectorLanes value = found.value - found.body;
          scattered += solid_angle * Vec3(sum_of(value.x), sum_of(value.y), sum_of(value.z));
        });
        decltype(expected) counted{};
        Vec3 mean(0);
        constexpr int count = 100000;
        for (int k = 0; k < count; ++k) {
          const auto ray = sample<double>(seen, o, up, numbers_at(k));
          if (ray.weight == Vec3(0)) continue;
          const auto functions = functions_of(ray.direction);
          for (std::size_t i = 0; i < functions.size(); ++i) counted[i] += functions[i] / count;
          mean += ray.weight / double{count};
        }
        CAPTURE(from_outside);
        CAPTURE(cosine);
        for (std::size_t i = 0; i < expected.size(); ++i) {
          CAPTURE(i);
          CHECK(std::abs(counted[i] - expected[i]) < 4e-3);
        }
        for (int channel = 0; channel < 3; ++channel)
          CHECK(std::abs(mean[channel] - scattered[channel]) < 4e-3);
      }
    }
  }
}

TEST_CASE("a sample has the weight and the density that evaluate() has for its direction") {
  for (const Surface& surface : rough_surfaces()) {
    const PrincipledSurface<double> seen = surface.seen(true);
    const Vec3 normal = glm::normalize(Vec3(1, -2, 0.5));
    const Vec3 o = glm::normalize(normal + Vec3(0.2, 0.5, -0.4));
    for (int k = 0; k < 500; ++k) {
      const auto ray = sample<double>(seen, o, normal, numbers_at(k));
      if (ray.weight == Vec3(0)) continue;
      const auto found = evaluate<double>(seen, o, normal, ray.direction);
      CHECK(!ray.is_delta);
      CHECK(ray.is_transmitted == (dot(ray.direction, normal) < 0));
      CHECK(glm::length(ray.direction) == doctest::Approx(1).epsilon(1e-12));
      CHECK(found.density == doctest::Approx(ray.density).epsilon(1e-9));
      CHECK(found.value.x - found.body.x ==
            doctest::Approx(ray.weight.x * ray.density).epsilon(1e-9));
    }
  }
}

TEST_CASE("a smooth metal is a mirror that has its colour straight on, and is white at the rim") {
  const Vec3 gold(1, 0.77, 0.34);
  const Surface metal = surface_of(1, 0, 0, {}, gold);
  const auto at = [&](double cosine) {
    return sample<double>(metal.seen(true), direction(cosine), up, {0.4, 0.2, 0.9});
  };
  CHECK(at(1).is_delta);
  CHECK(!at(1).is_transmitted);
  for (int channel = 0; channel < 3; ++channel) {
    CHECK(at(1).weight[channel] == doctest::Approx(gold[channel]).epsilon(1e-12));
    CHECK(at(1e-6).weight[channel] == doctest::Approx(1).epsilon(1e-4));
  }
  CHECK(glm::length(at(0.5).direction - Vec3(-direction(0.5).x, 0, 0.5)) < 1e-15);
  CHECK(evaluate<double>(metal.seen(true), direction(0.5), up, at(0.5).direction).value.x < 1e-12);
}

TEST_CASE("clear glass mirrors and refracts by Fresnel's and Snell's laws, on both sides") {
  const Vec3 green(0.3, 0.9, 0.4);
  const Surface glass = surface_of(0, 0, 1, {}, green);
  for (const bool from_outside : {true, false}) {
    const double n2 = from_outside ? 1.5 : 1 / 1.5;
    for (const double cosine : {0.1, 0.5, 0.9, 1.0}) {
      const Vec3 o = direction(cosine);
      const auto refraction = refract<double>(-o, up, 1.0, n2);
      // The weights of all samples are what goes each way.
      double back = 0;
      Vec3 through(0);
      constexpr int count = 10000;
      for (int k = 0; k < count; ++k) {
        const auto ray =
            sample<double>(glass.seen(from_outside), o, up, {(k + 0.5) / count, 0.7, 0.1});
        REQUIRE(ray.is_delta);
        if (ray.is_transmitted) {
          through += ray.weight / double{count};
          CHECK(glm::length(ray.direction - refraction.direction) < 1e-15);
        } else {
          back += ray.weight.x / double{count};
        }
      }
      CHECK(back == doctest::Approx(refraction.reflectance).epsilon(1e-3));
      for (int channel = 0; channel < 3; ++channel) {
        CHECK(through[channel] ==
              doctest::Approx((1 - refraction.reflectance) * green[channel]).epsilon(1e-3));
      }
    }
  }
}

TEST_CASE("a boundary between equal indices lets all light straight through, however rough") {
  for (const double roughness : {0.0, 0.5, 1.0}) {
    const Surface none = surface_of(0, roughness, 1, {.index_behind = 1});
    for (int k = 0; k < 100; ++k) {
      const auto ray = sample<double>(none.seen(true), direction(0.3), up, numbers_at(k));
      CHECK(ray.is_delta);
      CHECK(glm::length(ray.direction + direction(0.3)) < 1e-15);
      CHECK(ray.weight.y == doctest::Approx(1).epsilon(1e-12));
    }
  }
}

TEST_CASE("surfaces side by side scatter as each alone, to the last bit") {
  const std::vector<Surface> surfaces = rough_surfaces();
  PrincipledSurface<Lanes> lanes;
  std::array<PrincipledSurface<double>, lane_count> single;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const PrincipledSurface<double>& one = single[lane] = surfaces[lane + 1].seen(lane != 2);
    lanes.color.set(lane, one.color);
    lanes.metallic[lane] = one.metallic;
    lanes.roughness[lane] = one.roughness;
    lanes.relative_index[lane] = one.relative_index;
    lanes.transmission[lane] = one.transmission;
    lanes.coat[lane] = one.coat;
    lanes.coat_roughness[lane] = one.coat_roughness;
    lanes.sheen[lane] = one.sheen;
    lanes.before[lane] = one.before[0];
    lanes.behind[lane] = one.behind[0];
  }
  for (int k = 0; k < 1000; ++k) {
    VectorLanes o, i;
    std::array<Lanes, 3> numbers;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const auto [a, b, c] = numbers_at(4 * k + static_cast<int>(lane));
      o.set(lane, direction(a, b));
      i.set(lane, direction(2 * c - 1, a));
      numbers[0][lane] = b;
      numbers[1][lane] = c;
      numbers[2][lane] = a;
    }
    const VectorLanes normals = crt::core::lanes_of(up);
    const auto together = evaluate<Lanes>(lanes, o, normals, i);
    const auto rays = sample<Lanes>(lanes, o, normals, numbers);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const auto alone = evaluate<double>(single[lane], o.lane(lane), up, i.lane(lane));
      REQUIRE(together.value.lane(lane) == alone.value);
      REQUIRE(together.density[lane] == alone.density);
      const auto ray = sample<double>(single[lane], o.lane(lane), up,
                                      {numbers[0][lane], numbers[1][lane], numbers[2][lane]});
      REQUIRE(rays.direction.lane(lane) == ray.direction);
      REQUIRE(rays.weight.lane(lane) == ray.weight);
      REQUIRE(rays.density[lane] == ray.density);
      REQUIRE(rays.is_transmitted[lane] == ray.is_transmitted);
    }
  }
}

TEST_CASE("whatever the numbers, what is scattered is finite and not negative") {
  for (const double roughness : {0.0, 0.002, 0.05, 1.0}) {
    for (const double index : {0.01, 0.999, 1.0 + 1e-5, 1.5, 100.0}) {
      for (const double metallic : {0.0, 0.5, 1.0}) {
        for (const Vec3& color : {Vec3(0), Vec3(1, 0, 0.5)}) {
          const Surface surface = surface_of(
              metallic, roughness, 0.5, {.index_behind = index, .coat = 0.5, .sheen = 0.5}, color);
          for (int k = 0; k < 200; ++k) {
            const auto [a, b, c] = numbers_at(k);
            for (const Vec3& o : {direction(a * a * a, b), up, direction(1e-12)}) {
              const auto ray = sample<double>(surface.seen(k % 2 == 0), o, up, {a, b, c});
              for (int channel = 0; channel < 3; ++channel) {
                REQUIRE(std::isfinite(ray.weight[channel]));
                REQUIRE(ray.weight[channel] >= 0);
                const auto found =
                    evaluate<double>(surface.seen(k % 2 == 0), o, up, direction(2 * c - 1, a));
                REQUIRE(std::isfinite(found.value[channel]));
                REQUIRE(found.value[channel] >= 0);
                REQUIRE(std::isfinite(found.density));
              }
            }
          }
        }
      }
    }
  }
}
