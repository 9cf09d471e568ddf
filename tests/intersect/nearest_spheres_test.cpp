// The nearest-sphere filter finds in floats which sphere a ray crosses first. What it reports is
// true, and no answer depends on it.
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/accel/embree_tree.hpp"
#include "core/prepare/prepared_data.hpp"
#include "support/numbers.hpp"
#include "support/same_answers.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

constexpr std::uint64_t seed = 20261124;

/// A Room is where a crowd is, and how large: up to that far from its middle.
struct Room {
  Vec3 middle{0, 0, 0};
  double extent = 1;

  Vec3 point(Numbers& numbers, double factor = 1) const {
    return middle + numbers.point(factor * extent);
  }
};

/// Returns spheres of very different sizes. Many are related to one before: they are equal, are in
/// it with the same center, touch it, or are next to being equal.
std::vector<BoundedSphere> crowd_of_spheres(std::size_t count, const Room& room, double smallest,
                                            Numbers& numbers) {
  std::vector<BoundedSphere> spheres;
  while (spheres.size() < count) {
    BoundedSphere sphere{room.point(numbers), room.extent * numbers.size(smallest, 0.3)};
    const int kind = spheres.empty() ? 4 : numbers.below(10);
    if (kind < 4) {
      const BoundedSphere other =
          spheres[static_cast<std::size_t>(numbers.below(static_cast<int>(spheres.size())))];
      sphere = other;
      if (kind == 1) sphere.radius *= numbers.within(0.3, 1);
      if (kind == 2) sphere.center[numbers.below(3)] += 2 * sphere.radius;
      if (kind == 3) sphere.center += numbers.point(numbers.size(1e-9, 1e-4) * room.extent);
    }
    spheres.push_back(sphere);
  }
  return spheres;
}

/// Returns rays in nearly the same direction to a sphere, many of them along its silhouette. They
/// come from near or far, or from within.
std::vector<WorldRay> rays_at(const BoundedSphere& sphere, const Room& room, Numbers& numbers) {
  constexpr std::array<double, 6> distances = {1, 1.2, 1.9, 2.2, 30, 1e4};
  const Vec3 eye = numbers.below(6) == 0
                       ? sphere.center + numbers.point(0.5 * sphere.radius)
                       : room.point(numbers, distances[static_cast<std::size_t>(numbers.below(
                                                 static_cast<int>(distances.size())))]);
  const double excess = numbers.size(1e-9, 0.1);
  const int kind = numbers.below(6);
  std::vector<WorldRay> rays(
      static_cast<std::size_t>(1 + numbers.below(static_cast<int>(packet_size))));
  for (WorldRay& ray : rays) {
    const Vec3 offset = sphere.center - eye;
    const Vec3 across = glm::normalize(glm::cross(offset, numbers.direction()));
    const double rim = numbers.below(2) == 0 ? 1 + numbers.size(1e-9, 1e-2) * numbers.within(-1, 1)
                                             : numbers.within(0, 1 + excess);
    ray.origin = eye;
    ray.direction = glm::normalize(offset + rim * sphere.radius * across);
    if (kind == 0) ray.t_max = numbers.within(0, 2) * glm::length(offset);
    if (kind == 1) ray.t_min = numbers.within(0, 1.2) * glm::length(offset);
    if (kind == 2) ray.t_min = -numbers.within(0, 2) * glm::length(offset);
    if (numbers.below(2) == 0) ray.direction *= 1 / largest_component(ray.direction);
    // Some are a camera's.
    if (numbers.below(2) == 0) ray.start.t_error = start_rounding * largest_component(eye);
  }
  return rays;
}

Scene scene_of(const std::vector<BoundedSphere>& spheres) {
  Scene scene;
  for (const BoundedSphere& sphere : spheres) {
    scene.entities.emplace_back(Sphere{.center = sphere.center, .radius = sphere.radius});
  }
  return scene;
}

Room some_room(Numbers& numbers, int round) {
  Room room;
  if (round % 3 == 0) room.extent = numbers.size(1e-9, 1e9);
  if (round % 4 == 0) room.middle = numbers.point(room.extent * numbers.size(1, 1e10));
  return room;
}

const BoundedSphere& any_of(const std::vector<BoundedSphere>& spheres, Numbers& numbers) {
  return spheres[static_cast<std::size_t>(numbers.below(static_cast<int>(spheres.size())))];
}

/// A Chord is where a line enters and leaves a sphere, to many more digits than floats have. It is
/// not found if the line misses.
struct Chord {
  bool found = false;
  double enter = infinity;
  double leave = infinity;
};

Chord exact_chord(const WorldRay& ray, const BoundedSphere& sphere) {
  using Long = long double;
  std::array<Long, 3> offset;
  Long squared_length = 0;
  Long along = 0;
  for (int axis = 0; axis < 3; ++axis) {
    offset[static_cast<std::size_t>(axis)] =
        static_cast<Long>(sphere.center[axis]) - ray.origin[axis];
    squared_length += static_cast<Long>(ray.direction[axis]) * ray.direction[axis];
    along += offset[static_cast<std::size_t>(axis)] * ray.direction[axis];
  }
  const Long closest = along / squared_length;
  Long squared_distance = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Long across = offset[static_cast<std::size_t>(axis)] - closest * ray.direction[axis];
    squared_distance += across * across;
  }
  const Long margin = static_cast<Long>(sphere.radius) * sphere.radius - squared_distance;
  if (margin < 0) return {};
  const Long half = std::sqrt(margin / squared_length);
  return {true, static_cast<double>(closest - half), static_cast<double>(closest + half)};
}

double first_after(const Chord& chord, double t) {
  if (!chord.found || chord.leave <= t) return infinity;
  return chord.enter > t ? chord.enter : chord.leave;
}

}  // namespace

TEST_CASE("what floats say of rays among spheres is true") {
  Numbers numbers(seed);
  int asked = 0;
  int known = 0;
  int met = 0;
  int missed = 0;
  for (int round = 0; round < 40; ++round) {
    const Room room = some_room(numbers, round);
    const std::vector<BoundedSphere> spheres = crowd_of_spheres(100, room, 1e-3, numbers);
    std::vector<Bounds> boxes;
    Bounds total;
    for (const BoundedSphere& sphere : spheres) {
      Bounds box;
      box.include_around(sphere.center, Vec3(sphere.radius));
      boxes.push_back(box);
      total.include(box);
    }
    const EmbreeTree tree(boxes, total, spheres);
    REQUIRE(tree.filters_spheres());
    for (int i = 0; i < 300; ++i) {
      const std::vector<WorldRay> rays = rays_at(any_of(spheres, numbers), room, numbers);
      const RayMask all = RayPacket::all(rays.size());
      const RayBatch batch = batch_of(rays, all);
      const NearestSpheres first = tree.nearest_spheres(batch, batch.t_max, all);
      REQUIRE((first.meeting & first.missing) == 0);
      REQUIRE(((first.meeting | first.missing) & ~all) == 0);
      asked += static_cast<int>(rays.size());
      known += std::popcount(first.meeting | first.missing);
      for (std::size_t k = 0; k < rays.size(); ++k) {
        const WorldRay& ray = rays[k];
        const bool meets = (first.meeting >> k & 1u) != 0;
        if (!meets && (first.missing >> k & 1u) == 0) continue;
        const double to = meets ? first.to[k / lane_count][k % lane_count] : ray.t_max;
        for (std::size_t sphere = 0; sphere < spheres.size(); ++sphere) {
          const double t = first_after(exact_chord(ray, spheres[sphere]), ray.t_min);
          const bool is_first = meets && first.boxes[k] == sphere;
          // Beyond the ray's end any answer will do.
          INFO(round, ' ', i, ' ', k, ' ', sphere, " t ", t, " to ", to, " meets ", meets,
               " first ", first.boxes[k], " tmin ", ray.t_min, " tmax ", ray.t_max, " enter ",
               exact_chord(ray, spheres[sphere]).enter, " leave ",
               exact_chord(ray, spheres[sphere]).leave, " extent ", room.extent, " d ",
               ray.direction.x, ' ', ray.direction.y, ' ', ray.direction.z, " r ",
               spheres[sphere].radius);
          REQUIRE((is_first ? t < to : t == infinity || t > std::min(to, ray.t_max)));
        }
        ++(meets ? met : missed);
      }
    }
  }
  // Half of the rays pass their sphere's silhouette within a hundredth, and a third of the spheres
  // come in pairs.
  CHECK(known > asked / 2);
  CHECK(met > asked / 4);
  CHECK(missed > asked / 50);
}

TEST_CASE("a ray among spheres finds the same alone, in a packet, and without cheap tests") {
  Numbers numbers(seed);
  RayWorkspace work;
  int met = 0;
  for (int round = 0; round < 60; ++round) {
    const Room room = some_room(numbers, round);
    const std::vector<BoundedSphere> spheres =
        crowd_of_spheres(static_cast<std::size_t>(65 + numbers.below(300)), room, 1e-4, numbers);
    Scene scene = scene_of(spheres);
    if (round % 5 == 0) {
      scene.entities.emplace_back(
          Plane{.normal = numbers.direction(), .position = room.point(numbers)});
    }
    if (round % 7 == 0) {
      scene.entities.emplace_back(Plane{.normal = {0, 1, 0}, .position = room.middle});
    }
    const PreparedData data(scene);
    check_bounces(
        data, numbers, 60, [&] { return rays_at(any_of(spheres, numbers), room, numbers).front(); },
        met);
    for (int i = 0; i < 60; ++i) {
      check_first_crossings(data, rays_at(any_of(spheres, numbers), room, numbers), work, met);
    }
  }
  CHECK(met > 20000);
}

TEST_CASE("of a packet among spheres only those rays are answered that are asked") {
  Numbers numbers(seed);
  RayWorkspace work;
  const Room room;
  const std::vector<BoundedSphere> spheres = crowd_of_spheres(200, room, 1e-2, numbers);
  const PreparedData data(scene_of(spheres));
  for (int i = 0; i < 500; ++i) {
    std::vector<WorldRay> rays = rays_at(any_of(spheres, numbers), room, numbers);
    rays.resize(packet_size, rays.front());
    const auto some = static_cast<RayMask>(numbers.below(1 << packet_size));
    const RayHit untouched{.t = -1};
    std::array<RayHit, packet_size> hits;
    hits.fill(untouched);
    data.intersect_each(batch_of(rays, some), some, hits, work, Packets::always);
    for (std::size_t k = 0; k < packet_size; ++k) {
      const bool is_asked = (some >> k & 1u) != 0;
      REQUIRE(same(hits[k], is_asked ? data.intersect(rays[k], work) : untouched));
    }
  }
}

TEST_CASE("what is tiny beside its scene is found from anywhere") {
  Numbers numbers(seed);
  RayWorkspace work;
  std::array<RayHit, packet_size> hits;
  for (const double size : {1e-6, 1e-8, 1e-10}) {
    for (const bool as_boxes : {false, true}) {
      Scene scene;
      std::vector<Vec3> places;
      for (int i = 0; i < 500; ++i) {
        const Vec3 place = numbers.point(1);
        places.push_back(place);
        if (as_boxes) {
          scene.entities.emplace_back(
              Box{.corner_a = place - Vec3(size), .corner_b = place + Vec3(size)});
        } else {
          scene.entities.emplace_back(Sphere{.center = place, .radius = size});
        }
      }
      const PreparedData data(scene);
      for (const Vec3& place : places) {
        const Vec3 eye = numbers.point(numbers.below(3) == 0 ? 100 : 1.5);
        std::vector<WorldRay> rays(packet_size);
        for (WorldRay& ray : rays) {
          ray.origin = eye;
          ray.direction = glm::normalize(place + numbers.point(0.5 * size) - eye);
        }
        intersect_as_packet(data, rays, hits, work);
        const double farthest = glm::length(place - eye) + 4 * size;
        for (std::size_t k = 0; k < rays.size(); ++k) {
          REQUIRE(hits[k].t < farthest);
          REQUIRE(same(data.intersect(rays[k], work), hits[k]));
          REQUIRE(data.occluded(rays[k], work));
        }
      }
    }
  }
}
