// A room with a light in its ceiling, against a path tracer that does nothing clever: textbook code
// of its own, which follows diffuse rays until they happen on the light.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr int bounces = 4;
constexpr double light_half = 0.35;
constexpr double radiance = 12;

/// A Slab is a box, seen from within or from outside.
struct Slab {
  Vec3 lower;
  Vec3 upper;
  std::array<Color, 6> colors;  ///< of its faces: lower x, upper x, lower y, ...
};

Slab room() {
  const Color white = grey(0.75);
  return {{-1, -1, -1},
          {1, 1, 1},
          {Color{0.7, 0.1, 0.1}, Color{0.1, 0.6, 0.1}, white, white, white, white}};
}

std::vector<Slab> blocks() {
  std::array<Color, 6> tan;
  tan.fill(Color{0.7, 0.6, 0.4});
  return {{{-0.6, -1, 0}, {-0.1, 0.2, 0.5}, tan}, {{0.1, -1, -0.6}, {0.6, -0.45, -0.1}, tan}};
}

struct Met {
  double t = std::numeric_limits<double>::infinity();
  Vec3 normal{0, 0, 0};  ///< to where the ray came from
  Color color;
};

/// Finds where a ray meets a face of a slab: the last one of those before it where it is within,
/// and else the first one that it enters by.
void meet(const Slab& slab, bool from_within, const Vec3& origin, const Vec3& direction, Met& met) {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  int enter_face = 0;
  int leave_face = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double to_lower = (slab.lower[axis] - origin[axis]) / direction[axis];
    const double to_upper = (slab.upper[axis] - origin[axis]) / direction[axis];
    const bool is_upwards = direction[axis] > 0;
    const double first = is_upwards ? to_lower : to_upper;
    const double second = is_upwards ? to_upper : to_lower;
    if (first > enter) {
      enter = first;
      enter_face = 2 * axis + (is_upwards ? 0 : 1);
    }
    if (second < leave) {
      leave = second;
      leave_face = 2 * axis + (is_upwards ? 1 : 0);
    }
  }
  const double t = from_within ? leave : enter;
  const int face = from_within ? leave_face : enter_face;
  if (enter >= leave || t < 1e-9 || t >= met.t) return;
  met.t = t;
  met.color = slab.colors[static_cast<std::size_t>(face)];
  met.normal = Vec3(0);
  met.normal[face / 2] = ((face % 2 == 1) == from_within) ? -1 : 1;
}

/// Follows diffuse rays from a point of a surface. Returns what the surface sends to anywhere.
Color followed(Vec3 point, Vec3 normal, Color color, std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(0, 1);
  for (int ray = 0; ray <= bounces; ++ray) {
    const double angle = 2 * std::numbers::pi * number(random);
    const double squared = number(random);
    const Vec3 across = std::abs(normal.x) > 0.5 ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    const Vec3 other = glm::cross(normal, across);
    const Vec3 direction =
        std::sqrt(squared) * (std::cos(angle) * across + std::sin(angle) * other) +
        std::sqrt(1 - squared) * normal;
    Met met;
    meet(room(), true, point, direction, met);
    for (const Slab& block : blocks()) meet(block, false, point, direction, met);
    point += met.t * direction;
    if (met.normal.y == -1 && point.y > 0.999 && std::abs(point.x) < light_half &&
        std::abs(point.z) < light_half)
      return {radiance * color.r, radiance * color.g, radiance * color.b};
    normal = met.normal;
    color = {color.r * met.color.r, color.g * met.color.g, color.b * met.color.b};
  }
  return {0, 0, 0};
}

Entity painted(const Slab& slab, int face, double thickness) {
  Vec3 lower = slab.lower;
  Vec3 upper = slab.upper;
  const int axis = face / 2;
  if (face % 2 == 0) {
    upper[axis] = lower[axis];
    lower[axis] -= thickness;
  } else {
    lower[axis] = upper[axis];
    upper[axis] += thickness;
  }
  return Box{
      .corner_a = lower,
      .corner_b = upper,
      .material = Material{.color = slab.colors[static_cast<std::size_t>(face)], .diffuse = 1}};
}

Scene cornell_box() {
  Scene scene = dark_scene();
  scene.settings.width = scene.settings.height = 1;
  scene.settings.min_samples = scene.settings.max_samples = 16384;
  scene.settings.target_error = 1e-9;
  scene.settings.indirect = bounces;
  for (int face = 0; face < 6; ++face) scene.entities.push_back(painted(room(), face, 0.1));
  for (const Slab& block : blocks()) {
    scene.entities.emplace_back(Box{.corner_a = block.lower,
                                    .corner_b = block.upper,
                                    .material = Material{.color = block.colors[0], .diffuse = 1}});
  }
  return scene;
}

}  // namespace

TEST_CASE("a room is as bright as a path tracer without any cleverness finds it") {
  struct Place {
    Vec3 point;
    Vec3 normal;
    Color color;
  };
  const std::vector<Place> places = {{{0.5, -1, 0.5}, {0, 1, 0}, grey(0.75)},
                                     {{-0.8, -1, -0.2}, {0, 1, 0}, grey(0.75)},
                                     {{1, 0.1, 0.2}, {-1, 0, 0}, {0.1, 0.6, 0.1}},
                                     {{0.6, 0.4, 1}, {0, 0, -1}, grey(0.75)},
                                     {{-0.9, 1, 0.8}, {0, -1, 0}, grey(0.75)},
                                     {{0.3, -0.45, -0.3}, {0, 1, 0}, {0.7, 0.6, 0.4}}};
  const RectangleLight light{.corner = {-light_half, 0.9999, -light_half},
                             .edge_a = {2 * light_half, 0, 0},
                             .edge_b = {0, 0, 2 * light_half},
                             .color = grey(radiance)};
  const Box panel{.corner_a = {-light_half, 0.9999, -light_half},
                  .corner_b = {light_half, 1.0, light_half},
                  .material = Material{.color = grey(0), .diffuse = 0, .emission = grey(radiance)}};
  std::mt19937_64 random(1);
  for (const Place& place : places) {
    constexpr int paths = 65536;
    double sum = 0;
    double squares = 0;
    for (int i = 0; i < paths; ++i) {
      const double seen = followed(place.point, place.normal, place.color, random).g;
      sum += seen / paths;
      squares += seen * seen / paths;
    }
    const double deviation = std::sqrt((squares - sum * sum) / paths);
    for (const bool is_surface : {false, true}) {
      CAPTURE(is_surface);
      Scene scene = cornell_box();
      if (is_surface) {
        scene.entities.emplace_back(panel);
      } else {
        scene.lights = {light};
      }
      scene.camera = {.position = place.point + 0.05 * place.normal + Vec3(0.01, 0.02, 0.015),
                      .pointing = place.point,
                      .fov = 1e-4};
      const double found = render(prepare(scene), {.threads = 2}).at(0, 0).g;
      CHECK(std::abs(found - sum) < 4 * deviation + 1e-3 * sum);
      CHECK(deviation < 0.01 * sum + 0.005);
    }
  }
}
