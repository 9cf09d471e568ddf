#include "core/shading/principled.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/math/random.hpp"
#include "core/shading/fresnel.hpp"

using namespace crt::core;
using crt::Vec3;

namespace {

/// A Surface is a principled surface with the tables of its layers, in the frame of an up normal.
struct Surface {
  Layers layers;
  double metallic = 0;
  double transmission = 0;
  Vec3 color{1, 1, 1};
  double roughness = 0.5;
  LayerTables tables{layers};

  Surface(const Layers& with, double metal, double through, const Vec3& tint, double rough)
      : layers(with), metallic(metal), transmission(through), color(tint), roughness(rough) {}

  /// Returns it as a viewer sees it from one side.
  PrincipledSurface<double> seen(bool from_outside) const {
    PrincipledSurface<double> surface;
    surface.color = color;
    surface.metallic = metallic;
    surface.roughness = roughness;
    surface.relative_index = from_outside ? layers.index_behind : 1 / layers.index_behind;
    surface.transmission = transmission;
    surface.before = {from_outside ? &tables.outside() : &tables.inside()};
    surface.behind = {from_outside ? &tables.inside() : &tables.outside()};
    if (!from_outside) return surface;
    surface.coat = layers.coat;
    surface.coat_roughness = layers.coat_roughness;
    surface.sheen = layers.sheen;
    return surface;
  }
};

Surface surface_of(double metallic, double roughness, double transmission, Layers layers = {},
                   const Vec3& color = Vec3(1)) {
  layers.roughness = roughness;
  return {layers, metallic, transmission, color, roughness};
}

const Vec3 up(0, 0, 1);

Vec3 direction(double cosine, double turn = 0) {
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  const double angle = 2 * std::numbers::pi * turn;
  return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

/// Three numbers of a sequence without gaps: an additive one by powers of the root of x^4 = x + 1.
std::array<double, 3> numbers_at(int index) {
  constexpr double root = 1.2207440846057596;
  std::array<double, 3> numbers{};
  double step = 1;
  for (double& number : numbers) {
    step /= root;
    const double place = 0.5 + step * index;
    number = place - std::floor(place);
  }
  return numbers;
}

/// Sums value(directions, solid angles) over all directions side by side. It looks closely at
/// grazing ones and at those near to the normal.
template <class Value>
void for_all_directions(const Value& value) {
  constexpr int heights = 400;
  constexpr int turns = 128;  // of half a circle: the viewer is in the plane of x and z
  for (int k = 0; k < 2 * heights; ++k) {
    const double root = (k / 2 + 0.5) / heights;
    const double height = root * root * (3 - 2 * root) * (k % 2 == 0 ? 1 : -1);
    const double solid_angle = 2 * std::numbers::pi * 6 * root * (1 - root) / heights / turns;
    for (int turn = 0; turn < turns; turn += 4) {
      VectorLanes i;
      for (std::size_t lane = 0; lane < lane_count; ++lane)
        i.set(lane, direction(height, 0.5 * (turn + static_cast<int>(lane) + 0.5) / turns));
      value(i, solid_angle);
    }
  }
}

PrincipledSurface<Lanes> lanes_of(const PrincipledSurface<double>& one) {
  PrincipledSurface<Lanes> surface = {.color = crt::core::lanes_of(one.color),
                                      .metallic = one.metallic,
                                      .roughness = one.roughness,
                                      .relative_index = one.relative_index,
                                      .transmission = one.transmission,
                                      .coat = one.coat,
                                      .coat_roughness = one.coat_roughness,
                                      .sheen = one.sheen};
  surface.before.fill(one.before[0]);
  surface.behind.fill(one.behind[0]);
  return surface;
}

double sum_of(const Lanes& x) {
  return x[0] + x[1] + (x[2] + x[3]);
}

/// Returns the share of even light that a surface sends to the viewer: by a sum over directions,
/// and by what perfect mirrors and clear glass add, whose weights do not depend on chance.
Vec3 albedo(const PrincipledSurface<double>& surface, double cosine) {
  const Vec3 o = direction(cosine);
  const PrincipledSurface<Lanes> lanes = lanes_of(surface);
  Vec3 sum(0);
  for_all_directions([&](const VectorLanes& i, double solid_angle) {
    const VectorLanes value =
        evaluate<Lanes>(lanes, crt::core::lanes_of(o), crt::core::lanes_of(up), i).value;
    sum += solid_angle * Vec3(sum_of(value.x), sum_of(value.y), sum_of(value.z));
  });
  constexpr int choices = 4096;
  for (int k = 0; k < choices; ++k) {
    const auto ray = sample<double>(surface, o, up, {(k + 0.5) / choices, 0.3, 0.6});
    if (ray.is_delta) sum += ray.weight / double{choices};
  }
  return sum;
}

const std::vector<double> shares = {0, 0.5, 1};
const std::vector<double> cosines = {0.1, 0.3, 0.75, 1};

/// All combinations of layers.
std::vector<Layers> all_layers() {
  std::vector<Layers> all;
  for (const double sheen : {0.0, 1.0}) {
    all.push_back({.sheen = sheen});
    for (const double coat_roughness : {0.0, 0.6})
      all.push_back({.coat = 1, .coat_roughness = coat_roughness, .sheen = sheen});
    all.push_back({.coat = 0.5, .coat_roughness = 0.5, .sheen = 0.5 * sheen});
  }
  return all;
}

/// Some surfaces with different lobes, none of them smooth.
std::vector<Surface> rough_surfaces() {
  const Vec3 orange(0.9, 0.5, 0.1);
  return {surface_of(0, 0.5, 0, {}, orange),
          surface_of(1, 0.3, 0, {}, orange),
          surface_of(0, 0.4, 1, {}, orange),
          surface_of(0, 0.6, 1, {.index_behind = 2}, orange),
          surface_of(0.5, 0.7, 0.5, {.coat = 0.7, .coat_roughness = 0.4, .sheen = 0.6}, orange),
          surface_of(0, 1, 1, {.index_behind = 0.8, .coat = 1, .coat_roughness = 1}, orange)};
}

}  // namespace

TEST_CASE("white surfaces send back all light, whatever they are a mixture of") {
  // Sums in tables and over directions, and tables between their entries, err by so much.
  constexpr double lost = 1e-2;
  constexpr double made = 1e-3;
  for (const Layers& layers : all_layers()) {
    for (const double metallic : shares) {
      for (const double transmission : shares) {
        if (metallic == 1 && transmission > 0) continue;
        if ((metallic == 0.5) != (transmission == 0.5)) continue;
        for (const double roughness : {0.0, 0.5, 1.0}) {
          const Surface surface = surface_of(metallic, roughness, transmission, layers);
          for (const bool from_outside : {true, false}) {
            if (!from_outside && transmission == 0) continue;
            for (const double cosine : cosines) {
              CAPTURE(layers.coat);
              CAPTURE(layers.coat_roughness);
              CAPTURE(layers.sheen);
              CAPTURE(metallic);
              CAPTURE(transmission);
              CAPTURE(roughness);
              CAPTURE(from_outside);
              CAPTURE(cosine);
              const Vec3 white = albedo(surface.seen(from_outside), cosine);
              CHECK(white.x > 1 - lost);
              CHECK(white.x < 1 + made);
            }
          }
        }
      }
    }
  }
}

TEST_CASE("light takes the same path back") {
  for (const Surface& surface : rough_surfaces()) {
    const double index = surface.layers.index_behind;
    for (int k = 0; k < 2000; ++k) {
      const auto [a, b, turn] = numbers_at(k);
      const Vec3 o = direction(0.01 + 0.99 * a);
      const Vec3 i = direction((b < 0.5 ? 1 : -1) * (0.01 + 0.98 * std::abs(2 * b - 1)), turn);
      // The value has the cosine at the light, and is of radiance by the index's square.
      const Vec3 there = evaluate<double>(surface.seen(true), o, up, i).value / std::abs(i.z);
      const bool is_through = i.z < 0;
      const Vec3 back =
          is_through ? evaluate<double>(surface.seen(false), -i, up, -o).value / o.z / index / index
                     : evaluate<double>(surface.seen(true), i, up, o).value / o.z;
      const Vec3 ahead = is_through ? there / index / index : there;
      const double scale = is_through ? index * index : 1;
      for (int channel = 0; channel < 3; ++channel) {
        CAPTURE(k);
        CHECK(ahead[channel] == doctest::Approx(back[channel] * scale).epsilon(1e-12));
      }
    }
  }
}

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
          scattered += solid_angle *
                       Vec3(sum_of(found.value.x), sum_of(found.value.y), sum_of(found.value.z));
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
      CHECK(found.value.x == doctest::Approx(ray.weight.x * ray.density).epsilon(1e-9));
    }
  }
}

TEST_CASE("a smooth metal is a mirror that has its colour straight on, and is white at the rim") {
  const Vec3 gold(1, 0.77, 0.34);
  const PrincipledSurface<double> seen = surface_of(1, 0, 0, {}, gold).seen(true);
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
  CHECK(seen.metallic == 1);
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

TEST_CASE("a rough dielectric without a metal's share is tinted by its colour in its body alone") {
  const Surface black = surface_of(0, 0.3, 0, {}, Vec3(0));
  const double mirrored = albedo(black.seen(true), 0.75).x;
  CHECK(mirrored == doctest::Approx(fresnel_reflectance(0.75, 1.0, 1.5)).epsilon(0.1));
}

TEST_CASE("tables for patterns of roughness are those of single ones, nearly") {
  Layers layers{.coat = 0.5, .sheen = 0.2};
  layers.roughness = -1;
  const LayerTables all(layers);
  for (const double roughness : {0.0, 0.21, 0.5, 0.73, 1.0}) {
    layers.roughness = roughness;
    const LayerTables one(layers);
    for (int k = 0; k <= 100; ++k) {
      const auto a = all.outside().at(k / 100.0, roughness);
      const auto b = one.outside().at(k / 100.0, roughness);
      CHECK(std::abs(a.metal - b.metal) < 5e-3);
      CHECK(std::abs(a.dielectric - b.dielectric) < 5e-3);
      CHECK(std::abs(a.transparent - b.transparent) < 5e-3);
    }
  }
}

TEST_CASE("tables of equal layers are computed once, also for a scene that was edited") {
  LayerTablePool before;
  const auto tables = before.get({.coat = 0.5});
  CHECK(before.get({.coat = 0.5}) == tables);
  CHECK(before.get({.coat = 0.25}) != tables);
  CHECK(before.bytes() >= 2 * tables->bytes());
  LayerTablePool after(&before);
  CHECK(after.get({.coat = 0.5}) == tables);
  after.settle();
  CHECK(after.get({.coat = 0.25}) != before.get({.coat = 0.25}));
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
