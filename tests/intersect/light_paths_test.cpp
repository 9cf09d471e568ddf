// Rays in packets and alone find the same things on their paths to a light, and all that is there.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "core/prepare/prepared_data.hpp"
#include "support/crowd.hpp"
#include "support/numbers.hpp"
#include "support/same_answers.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

constexpr std::uint64_t seed = 20261123;

/// Gives the scene materials of which most let light through, and some objects only in part.
void make_clear(Scene& scene, Numbers& numbers) {
  const SharedMaterial glass = Material{.transparency = 0.9};
  const SharedMaterial wall = Material{};
  const SharedMaterial veil = Material{.color = Color{1, 1, 1, 0.5}};
  const std::vector<SharedMaterial> materials = {glass, glass, glass, veil, wall};
  for (Entity& entity : scene.entities) {
    const Entity part =
        Entity(Sphere{.center = numbers.point(4), .radius = 0.5}).with_material(wall);
    if (numbers.below(20) == 0) entity = entity + part;
    const int which = numbers.below(static_cast<int>(materials.size()));
    entity = entity.with_material(materials[static_cast<std::size_t>(which)]);
  }
}

/// Returns paths from surfaces or from anywhere, mostly side by side, to somewhere near.
std::vector<WorldRay> paths_near(const PreparedData& data, Numbers& numbers, RayWorkspace& work) {
  const Vec3 light = numbers.point(6);
  const Vec3 place = numbers.point(4);
  const double radius = numbers.size(1e-3, 3);
  std::vector<WorldRay> rays(
      static_cast<std::size_t>(1 + numbers.below(static_cast<int>(packet_size))));
  for (WorldRay& ray : rays) {
    ray.origin = place + radius * numbers.direction();
    ray.direction = glm::normalize(light - ray.origin);
  }
  const auto to_light = [&](const HitPoint& point, WorldRay& ray) {
    ray.direction = light - point.position;
  };
  if (numbers.below(2) == 0) go_on(data, numbers, work, rays, to_light);
  for (WorldRay& ray : rays) {
    if (numbers.below(8) == 0) continue;
    ray.t_max = numbers.within(0, 2) * glm::length(light - ray.origin) / glm::length(ray.direction);
    ray.end_error = 1e-14;
  }
  return rays;
}

struct Counts {
  int blocked = 0;
  int filtered = 0;
  int free = 0;
};

void check_path(const PreparedData& data, const std::vector<RayHit>& line, bool blocked,
                bool filtered, const std::vector<RayHit>& found, Counts& counts) {
  const bool is_blocked = std::any_of(line.begin(), line.end(), [&](const RayHit& crossing) {
    return data.materials()[data.hit_material(crossing)].opaque;
  });
  REQUIRE(blocked == is_blocked);
  REQUIRE(filtered == (!is_blocked && !line.empty()));
  if (filtered) {
    REQUIRE(found.size() == line.size());
    for (std::size_t i = 0; i < line.size(); ++i) REQUIRE(same(found[i], line[i]));
  }
  ++(blocked ? counts.blocked : filtered ? counts.filtered : counts.free);
}

void check_paths(Precision precision, int rounds, Packets packets) {
  Numbers numbers(seed);
  Counts counts;
  for (int round = 0; round < rounds; ++round) {
    Crowd crowd = test::crowd(numbers, precision);
    keep(crowd, 2 + static_cast<std::size_t>(numbers.below(70)), numbers);
    make_clear(crowd.scene, numbers);
    const PreparedData data(crowd.scene);
    RayWorkspace work;
    std::vector<RayHit> line;
    for (int i = 0; i < 200; ++i) {
      const std::vector<WorldRay> rays = paths_near(data, numbers, work);
      const RayMask some = RayPacket::all(rays.size()) & static_cast<RayMask>(~numbers.below(256));
      const RayBatch batch = batch_of(rays, some);
      const LightPaths paths =
          data.paths_to_light(batch, data.noted_starts(batch, some), some, work, packets);
      CHECK(((paths.blocked | paths.filtered) & ~some) == 0);
      for_each_ray(some, [&](std::size_t k) {
        data.crossings(rays[k], line, work);
        check_path(data, line, (paths.blocked >> k & 1u) != 0, (paths.filtered >> k & 1u) != 0,
                   work.on_paths[k], counts);
      });
    }
  }
  CHECK(counts.blocked > 30 * rounds);
  CHECK(counts.filtered > 30 * rounds);
  CHECK(counts.free > 30 * rounds);
}

}  // namespace

TEST_CASE("paths to a light report whether something opaque is on them, and else all that is") {
  check_paths(Precision::standard, 40, Packets::always);
}

TEST_CASE("so they do where packets do not always pay") {
  check_paths(Precision::standard, 40, Packets::where_they_pay);
}

TEST_CASE("so they do in the exact tier") {
  check_paths(Precision::exact, 4, Packets::always);
}
