// These tests check what queries report of a surface at the start of a ray. crt/query.hpp has the
// promise.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/query.hpp>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <vector>

using namespace crt;

namespace {

constexpr double u = std::numeric_limits<double>::epsilon() / 2;
constexpr double infinity = std::numeric_limits<double>::infinity();

class Chance {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(source_);
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v(between(-1, 1), between(-1, 1), between(-1, 1));
      const double length = glm::length(v);
      if (length > 0.1 && length < 1) return v / length;
    }
  }

 private:
  std::mt19937_64 source_{7};
};

/// OnSurface is a primitive and a computed point of its surface.
struct OnSurface {
  Entity entity;
  Vec3 point;
};

/// Makes surfaces of about the given size, in a random place and position.
std::array<OnSurface, 6> surfaces(Chance& chance, double r) {
  const Vec3 c = std::pow(10, chance.between(-2, 4)) * chance.direction();
  const Vec3 n = chance.direction();
  const Vec3 a = glm::normalize(glm::cross(n, chance.direction()));
  const Vec3 b = glm::cross(n, a);
  const double turn = chance.between(0, 6);
  const double along = chance.between(0.1, 0.9);
  const Vec3 around = std::cos(turn) * a + std::sin(turn) * b;
  const Vec3 half = r * Vec3(1, along, 0.5);
  return {
      {{Sphere{.center = c, .radius = r}, c + r * n},
       {Box{c - half, c + half}, c + Vec3(half.x, 0.3 * half.y, -0.2 * half.z)},
       {Plane{.normal = n, .position = c}, c + r * along * around},
       {Cylinder{.from = c, .to = c + 2 * r * n, .radius = r}, c + 2 * r * along * n + r * around},
       {Cone{.from = c, .to = c + 2 * r * n, .radius = r, .radius2 = 0},
        c + 2 * r * along * n + r * (1 - along) * around},
       {Disc{.center = c, .normal = n, .radius = r}, c + r * along * around}}};
}

/// Returns the size of an object as the promise has it, or 0 for one without a limit.
double half_of_longest_side(const Entity& entity) {
  const auto& [lower, upper] = bounding_box(entity);
  const Vec3 half = 0.5 * (upper - lower);
  const double longest = std::max({half.x, half.y, half.z});
  return std::isfinite(longest) ? longest : 0;
}

/// Returns how far the nearest hit is, which four queries agree on.
double nearest(const PreparedScene& scene, const Ray& ray) {
  const std::optional<Hit> hit = intersect(scene, ray);
  const double t = hit ? hit->t : infinity;
  CHECK(occluded(scene, ray) == hit.has_value());
  const std::vector<Hit> all = crossings(scene, ray);
  CHECK((all.empty() ? infinity : all.front().t) == t);
  RayQueries queries(scene);
  double distance = 0;
  queries.distances(std::span(&ray, 1), std::span(&distance, 1));
  CHECK(distance == t);
  return t;
}

/// Returns the crossing that is nearest to the origin, before or behind it, if no other is near.
std::optional<Hit> crossing_at_start(const PreparedScene& exact, const Ray& ray, double near) {
  const std::vector<Hit> all =
      crossings(exact, {.origin = ray.origin, .direction = ray.direction, .t_min = -infinity});
  std::optional<Hit> found;
  for (const Hit& hit : all) {
    if (std::abs(hit.t) > near) continue;
    if (found) return std::nullopt;
    found = hit;
  }
  return found;
}

}  // namespace

TEST_CASE(
    "a surface at the start of a ray is behind it within rounding, and as the doubles say in the "
    "exact "
    "tier") {
  Chance chance;
  int passed = 0;
  int met = 0;
  for (int i = 0; i < 400; ++i) {
    const double size = std::pow(10, chance.between(-2, 2));
    for (const OnSurface& on : surfaces(chance, size)) {
      Scene scene;
      scene.entities = {on.entity};
      const PreparedScene standard = prepare(scene);
      scene.settings.precision = Precision::exact;
      const PreparedScene exact = prepare(scene);
      const Vec3 d = chance.direction();
      const double extent =
          half_of_longest_side(on.entity) +
          std::max({std::abs(on.point.x), std::abs(on.point.y), std::abs(on.point.z)});
      const double step = std::pow(2, chance.between(0, 9)) * u * extent * (i % 2 == 0 ? 1 : -1);
      const Ray ray{.origin = on.point - step * d, .direction = d};
      const double near = 1e6 * u * extent;
      const std::optional<Hit> at_start = crossing_at_start(exact, ray, near);
      if (!at_start) continue;
      const double across = at_start->t * std::abs(glm::dot(at_start->normal, d));
      const bool meets = nearest(standard, ray) < near;
      CHECK((nearest(exact, ray) < near) == (at_start->t > 0));
      if (across <= 0) CHECK_FALSE(meets);
      // Twice the error bound of a lone primitive's t is less.
      if (across > 64 * u * extent) CHECK(meets);
      if (across > 0) ++(meets ? met : passed);
    }
  }
  CHECK(passed > 100);
  CHECK(met > 100);
}
