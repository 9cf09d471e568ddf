// Tests of what is at one place share this: solids, and where rays cross them.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "crt/transform.hpp"

namespace crt::test::places_of {

inline constexpr double u = 0x1p-53;

/// A Random gives numbers that are the same everywhere.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vec3 in_cube() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }

 private:
  std::mt19937_64 engine_;
};

inline PreparedScene scene_of(const std::vector<Entity>& entities,
                              Precision precision = Precision::standard) {
  Scene scene;
  scene.entities = entities;
  scene.settings.precision = precision;
  return prepare(scene);
}

inline std::vector<double> places(const PreparedScene& scene, const Ray& ray) {
  std::vector<double> result;
  for (const Hit& hit : crossings(scene, ray)) result.push_back(hit.t);
  return result;
}

inline std::shared_ptr<const Profile> profile_of(const std::vector<Contour>& contours) {
  return make_profile(contours);
}

inline std::shared_ptr<const Profile> disc_of(double radius) {
  return profile_of({{{radius, 0, 1}, {-radius, 0, 1}}});
}

/// Returns the profile of a letter: straight walls, an arc and a hole.
inline std::shared_ptr<const Profile> letter() {
  return profile_of({{{-1, -1}, {1, -1}, {1, 0.5, 0.6}, {-0.3, 1}, {-1, 1}},
                     {{-0.5, -0.5}, {0.2, -0.5}, {0.2, 0.1}, {-0.5, 0.1}}});
}

/// Returns two vectors across a direction.
inline std::array<Vec3, 2> across(const Vec3& direction) {
  const Vec3 one = glm::normalize(glm::cross(direction, Vec3(0.3, -1, 0.7)));
  return {one, glm::normalize(glm::cross(direction, one))};
}

/// Checks that both tiers cross a scene alike, by rays side by side along a direction. Returns the
/// number of crossings.
inline std::size_t check_tiers(const Entity& entity, const Vec3& from, const Vec3& direction,
                               double half_width, int rays) {
  const PreparedScene standard = scene_of({entity});
  const PreparedScene exact = scene_of({entity}, Precision::exact);
  const auto [x, y] = across(direction);
  Random random(1);
  std::size_t count = 0;
  for (int i = 0; i < rays; ++i) {
    const Vec3 beside = half_width * (random.between(-1, 1) * x + random.between(-1, 1) * y);
    const Ray ray{.origin = from + beside, .direction = direction};
    const std::vector<double> found = places(standard, ray);
    const std::vector<double> truth = places(exact, ray);
    CAPTURE(i);
    CAPTURE(found);
    CAPTURE(truth);
    REQUIRE(found.size() == truth.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      CHECK(found[k] == doctest::Approx(truth[k]).epsilon(1e-10));
    count += found.size();
    CHECK(intersect(standard, ray).has_value() == !truth.empty());
  }
  return count;
}

inline Transform turned(const Vec3& degrees, const Vec3& offset = {0, 0, 0}) {
  Transform map = rotate_degrees(degrees);
  map.translation = offset;
  return map;
}

inline Entity box(const Vec3& a, const Vec3& b) {
  return Box{.corner_a = a, .corner_b = b};
}

/// Returns boxes from i * 0.1 to i * 0.1 + 0.1, of which some touch and others are a rounding
/// apart.
inline std::vector<Entity> row_of_boxes(int count) {
  std::vector<Entity> boxes;
  for (int i = 0; i < count; ++i) boxes.push_back(box({i * 0.1, 0, 0}, {i * 0.1 + 0.1, 0.1, 0.1}));
  return boxes;
}

inline Entity united(const std::vector<Entity>& entities) {
  Entity all = entities[0];
  for (std::size_t i = 1; i < entities.size(); ++i) all = all + entities[i];
  return all;
}

inline Vec3 moved(const Transform& map, const Vec3& p) {
  return Vec3(glm::dot(map.row_x, p), glm::dot(map.row_y, p), glm::dot(map.row_z, p)) +
         map.translation;
}

/// Checks that rays through the row meet one block.
inline void check_is_block(const PreparedScene& scene, const Transform& map, int count, int rays) {
  Random random(7);
  const double end = count * 0.1;
  for (int i = 0; i < rays; ++i) {
    const Vec3 from(random.between(0.01, end - 0.01), random.between(0.01, 0.09),
                    random.between(0.01, 0.09));
    const Vec3 to(random.between(0.01, end - 0.01), random.between(0.01, 0.09),
                  random.between(0.01, 0.09));
    const Vec3 direction = moved(map, to) - moved(map, from);
    const Ray ray{.origin = moved(map, from) - 30.0 / glm::length(direction) * direction,
                  .direction = direction};
    const std::vector<double> found = places(scene, ray);
    CAPTURE(i);
    CAPTURE(found);
    REQUIRE(found.size() == 2);
    const Ray inside{.origin = moved(map, from), .direction = direction};
    const std::vector<double> ahead = places(scene, inside);
    CAPTURE(ahead);
    REQUIRE(ahead.size() == 1);
    const std::optional<Hit> hit = intersect(scene, inside);
    REQUIRE(hit);
    CHECK(hit->t == ahead[0]);
  }
}

}  // namespace crt::test::places_of
