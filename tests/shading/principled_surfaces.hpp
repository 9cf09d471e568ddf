// Principled surfaces that tests look at, and sums over all directions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/shading/principled.hpp"

namespace crt::test {

using namespace crt::core;

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

inline Surface surface_of(double metallic, double roughness, double transmission,
                          Layers layers = {}, const Vec3& color = Vec3(1)) {
  layers.roughness = roughness;
  return {layers, metallic, transmission, color, roughness};
}

inline const Vec3 up(0, 0, 1);

inline Vec3 direction(double cosine, double turn = 0) {
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  const double angle = 2 * std::numbers::pi * turn;
  return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

/// Three numbers of a sequence without gaps: an additive one by powers of the root of x^4 = x + 1.
inline std::array<double, 3> numbers_at(int index) {
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
inline void for_all_directions(const Value& value) {
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

inline PrincipledSurface<Lanes> lanes_of(const PrincipledSurface<double>& one) {
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

inline double sum_of(const Lanes& x) {
  return x[0] + x[1] + (x[2] + x[3]);
}

/// Returns what a surface sends to the viewer of light whose radiance depends on its direction's
/// height: by a sum over directions, and by what perfect mirrors and clear glass add, whose weights
/// do not depend on chance.
template <class Radiance>
inline Vec3 sent_back(const PrincipledSurface<double>& surface, double cosine,
                      const Radiance& radiance) {
  const Vec3 o = direction(cosine);
  const PrincipledSurface<Lanes> lanes = lanes_of(surface);
  Vec3 sum(0);
  for_all_directions([&](const VectorLanes& i, double solid_angle) {
    const VectorLanes value =
        evaluate<Lanes>(lanes, crt::core::lanes_of(o), crt::core::lanes_of(up), i).value;
    const Lanes light([&](auto lane) { return radiance(double{i.z[lane]}); });
    sum += solid_angle *
           Vec3(sum_of(light * value.x), sum_of(light * value.y), sum_of(light * value.z));
  });
  constexpr int choices = 4096;
  for (int k = 0; k < choices; ++k) {
    const auto ray = sample<double>(surface, o, up, {(k + 0.5) / choices, 0.3, 0.6});
    if (ray.is_delta) sum += radiance(ray.direction.z) * ray.weight / double{choices};
  }
  return sum;
}

/// Returns the share of even light that a surface sends to the viewer.
inline Vec3 albedo(const PrincipledSurface<double>& surface, double cosine) {
  return sent_back(surface, cosine, [](double) { return 1.0; });
}

inline const std::vector<double> shares = {0, 0.5, 1};
inline const std::vector<double> cosines = {0.1, 0.3, 0.75, 1};

/// All combinations of layers.
inline std::vector<Layers> all_layers() {
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
inline std::vector<Surface> rough_surfaces() {
  const Vec3 orange(0.9, 0.5, 0.1);
  return {surface_of(0, 0.5, 0, {}, orange),
          surface_of(1, 0.3, 0, {}, orange),
          surface_of(0, 0.4, 1, {}, orange),
          surface_of(0, 0.6, 1, {.index_behind = 2}, orange),
          surface_of(0.5, 0.7, 0.5, {.coat = 0.7, .coat_roughness = 0.4, .sheen = 0.6}, orange),
          surface_of(0, 1, 1, {.index_behind = 0.8, .coat = 1, .coat_roughness = 1}, orange)};
}

}  // namespace crt::test
