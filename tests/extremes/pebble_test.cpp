// A pebble lies on a planet, lit by a distant sun and seen from a metre away. These tests compare
// with closed forms in quadruple precision what is seen, its shadow, and its image in the ground.
#include <doctest/doctest.h>

#include <array>

#include "extremes/support.hpp"
#include "support/quad.hpp"

using namespace crt;
using namespace crt::test;

namespace {

struct QuadVec {
  Quad x = 0;
  Quad y = 0;
  Quad z = 0;
};

QuadVec wide(const Vec3& v) {
  return {v.x, v.y, v.z};
}
QuadVec operator+(const QuadVec& a, const QuadVec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
QuadVec operator-(const QuadVec& a, const QuadVec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
QuadVec operator*(Quad f, const QuadVec& v) {
  return {f * v.x, f * v.y, f * v.z};
}
Quad dot(const QuadVec& a, const QuadVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Quad root(Quad value) {
  Quad x = std::sqrt(static_cast<double>(value));
  for (int i = 0; i < 3; ++i) x = x > 0 ? (x + value / x) / 2 : x;
  return x;
}
QuadVec unit(const QuadVec& v) {
  return (1 / root(dot(v, v))) * v;
}

/// Is thrown where a ray is too close to call for rounded positions. Then the oracle gives no
/// answer.
struct Close {};

struct Ball {
  Sphere sphere;
  /// Lines that pass an edge by less than this are too close to call.
  double margin;

  /// Returns where the ray enters the ball, or a negative number.
  Quad enter(const QuadVec& origin, const QuadVec& direction) const {
    const QuadVec from = origin - wide(sphere.center);
    const Quad along = dot(from, direction);
    const QuadVec closest = from - along * direction;
    const Quad distance = root(dot(closest, closest));
    const Quad r = sphere.radius;
    if (distance > r - margin && distance < r + margin && along < 0) throw Close{};
    if (distance >= r) return -1;
    return -along - root((r - distance) * (r + distance));
  }
  QuadVec normal(const QuadVec& at) const { return unit(at - wide(sphere.center)); }
};

/// A World is planet, pebble and sun somewhere in space.
struct World {
  Sphere planet;
  Sphere pebble;
  Sphere sun;
  Vec3 light;       ///< just before the sun
  Vec3 up;          ///< at the pebble
  double rounding;  ///< of coordinates there
};

constexpr double mirrored_share = 0.3;
constexpr double sky = 0.2;
constexpr double pebble_red = 0.9;
constexpr double ground_grey = 0.5;

class Oracle {
 public:
  explicit Oracle(const World& world)
      : world_(world), planet_{world.planet, 0}, pebble_{world.pebble, 8 * world.rounding} {}

  /// Returns the red light along a ray from the camera.
  double red(const Ray& ray) const {
    const QuadVec origin = wide(ray.origin);
    const QuadVec direction = unit(wide(ray.direction));
    return static_cast<double>(red(origin, direction, true));
  }

 private:
  Quad red(const QuadVec& origin, const QuadVec& direction, bool mirrors) const {
    const Quad to_pebble = pebble_.enter(origin, direction);
    const Quad to_ground = mirrors ? planet_.enter(origin, direction) : -1;
    if (to_pebble > 0 && (to_ground < 0 || to_pebble < to_ground)) {
      const QuadVec point = origin + to_pebble * direction;
      return pebble_red * lit(point, pebble_.normal(point), planet_);
    }
    if (to_ground < 0) return sky;
    const QuadVec point = origin + to_ground * direction;
    const QuadVec normal = planet_.normal(point);
    const QuadVec mirror = direction - (2 * dot(direction, normal)) * normal;
    return ground_grey * (1 - mirrored_share) * lit(point, normal, pebble_) +
           mirrored_share * red(point, mirror, false);
  }

  Quad lit(const QuadVec& point, const QuadVec& normal, const Ball& other) const {
    const QuadVec towards = unit(wide(world_.light) - point);
    const Quad cosine = dot(towards, normal);
    if (cosine <= 0) return 0;
    return other.enter(point, towards) > 0 ? Quad(0) : cosine;
  }

  World world_;
  Ball planet_;
  Ball pebble_;
};

constexpr double planet_radius = 6e6;
constexpr double pebble_radius = 1e-2;
constexpr double sun_distance = 1.5e11;
constexpr double sun_radius = 7e8;

/// Makes a world with the pebble's foot as near to `foot` as coordinates there allow.
World world_at(const Vec3& foot, const Vec3& up, double rounding) {
  World world;
  world.up = up;
  world.rounding = rounding;
  world.planet = {.center = foot - planet_radius * up, .radius = planet_radius};
  world.pebble = {.center = foot + pebble_radius * up, .radius = pebble_radius};
  const Vec3 sunwards = glm::normalize(0.5 * up + across(up));
  world.light = foot + sun_distance * sunwards;
  world.sun = {.center = foot + (sun_distance + 1.01 * sun_radius) * sunwards,
               .radius = sun_radius};
  return world;
}

Scene seen_from(World world, const Vec3& eye, const Vec3& target, double fov, Precision precision) {
  Scene scene;
  scene.settings.width = 60;
  scene.settings.height = 60;
  scene.settings.recursion_depth = 1;
  scene.settings.precision = precision;
  scene.background = SolidBackground{grey(sky)};
  scene.lights = {PointLight{.origin = world.light}};
  world.planet.material = Material{.color = grey(ground_grey), .reflectivity = mirrored_share};
  world.pebble.material = Material{.color = Color{pebble_red, 0.1, 0.1}};
  scene.entities = {world.planet, world.pebble, world.sun};
  scene.camera = {.position = eye, .pointing = target, .fov = fov};
  return scene;
}

struct Count {
  int wrong = 0;
  int too_close = 0;
  double darkest = 1;
  double brightest = 0;
};

Count compare(const World& world, const Scene& scene, double tolerance) {
  const Oracle oracle(world);
  const Image image = render(prepare(scene), {.threads = 1});
  Count count;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      try {
        const double expected = oracle.red(pixel_ray(scene, x, y));
        count.darkest = std::min(count.darkest, expected);
        count.brightest = std::max(count.brightest, expected);
        if (std::abs(image.at(x, y).r - expected) > tolerance) ++count.wrong;
      } catch (const Close&) {
        ++count.too_close;
      }
    }
  }
  return count;
}

void check_views(const World& world, double tolerance, double smallest_view) {
  const Vec3 foot = world.pebble.center - pebble_radius * world.up;
  const Vec3 side = across(world.up);
  const Vec3 front = glm::cross(world.up, side);
  const Vec3 eye = foot + 0.3 * world.up + 0.5 * side + 0.8 * front;
  const Vec3 low_eye = foot + 0.003 * world.up + 0.2 * side + 0.95 * front;
  struct View {
    Vec3 eye;
    Vec3 target;
    double size;  ///< of what is seen, in units
  };
  for (const View& view :
       {View{eye, foot, 0.08}, View{eye, foot - 0.02 * side, 0.03}, View{low_eye, foot, 0.05},
        View{low_eye, foot, 1e-4}, View{eye, foot - 0.004 * side, 3e-3}}) {
    if (view.size < smallest_view) continue;
    for (const Precision precision : {Precision::standard, Precision::exact}) {
      const double distance = glm::length(view.target - view.eye);
      const Scene scene = seen_from(world, view.eye, view.target, view.size / distance, precision);
      const Count count = compare(world, scene, tolerance);
      CAPTURE(view.size);
      CAPTURE(view.eye.y);
      CHECK(count.wrong == 0);
      CHECK(count.too_close <= 150);
      CHECK(count.brightest > count.darkest + 0.05);
    }
  }
}

}  // namespace

TEST_CASE("a pebble on a planet, its shadow and its image in the ground are where they belong") {
  SUBCASE("the pebble at the origin") {
    check_views(world_at({0, 0, 0}, {0, 1, 0}, 1e-15), 1e-6, 0);
  }
  SUBCASE("the planet at the origin") {
    check_views(world_at({0, 6e6, 0}, {0, 1, 0}, 1e-9), 1e-5, 0);
  }
  SUBCASE("the planet at the origin, on its slope") {
    const Vec3 up = glm::normalize(Vec3(0.5, 0.3, -0.7));
    check_views(world_at(planet_radius * up, up, 1e-9), 1e-5, 0);
  }
  SUBCASE("the sun at the origin") {
    check_views(world_at({sun_distance, 0, 0}, {0, 1, 0}, 3e-5), 5e-2, 2e-2);
  }
}
