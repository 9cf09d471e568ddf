#include "images/hashes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <crt/query.hpp>
#include <crt/render.hpp>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>

#include "core/base/sha256.hpp"

namespace crt::tests {

namespace {

/// With this many an example has, all examples in both tiers have about a million.
constexpr std::size_t rays_of_example = 6400;

/// Returns rays from around the scene to near what the camera looks at. They are made by sums and
/// products alone.
std::vector<Ray> random_rays(const Camera& camera) {
  std::mt19937_64 engine(1);
  const auto share = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  const auto in_cube = [&] {
    const double x = share();
    const double y = share();
    const double z = share();
    return Vec3(x, y, z);
  };
  const Vec3 view = camera.pointing - camera.position;
  const double size = std::max({std::abs(view.x), std::abs(view.y), std::abs(view.z)});
  std::vector<Ray> rays(rays_of_example);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    constexpr double near = 0.4;
    const Vec3 target = camera.pointing + near * size * in_cube();
    const Vec3 from = camera.pointing + size * in_cube();
    rays[i] = {.origin = i % 4 == 0 ? camera.position : from, .direction = target - from};
    if (i % 4 == 0) rays[i].direction = target - camera.position;
  }
  return rays;
}

class Bytes {
 public:
  void add(double x) { add_word(std::bit_cast<std::uint64_t>(x)); }
  void add(const Vec3& v) {
    for (const double x : {v.x, v.y, v.z}) add(x);
  }
  void add(const Hit& hit) {
    add(hit.t);
    add(hit.position);
    add(hit.normal);
    add(hit.u);
    add(hit.v);
    add_word(2 * std::uint64_t{hit.entity_id} + (hit.entering ? 1 : 0));
  }
  void add_word(std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8)
      bytes_.push_back(static_cast<std::byte>(word >> shift & 0xffu));
  }
  std::string hash() const { return core::sha256(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Asks for all crossings of each ray, for nearest hits of all together, and for blocked rays.
std::string hash_of_queries(const PreparedScene& scene, const std::vector<Ray>& rays) {
  RayQueries queries(scene);
  Bytes bytes;
  std::vector<std::optional<Hit>> nearest(rays.size());
  queries.intersect(rays, nearest);
  std::vector<Hit> crossings;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    bytes.add_word(nearest[i] ? 1 : 0);
    if (nearest[i]) bytes.add(*nearest[i]);
    bytes.add_word(queries.occluded(rays[i]) ? 1 : 0);
    queries.crossings(rays[i], crossings);
    bytes.add_word(crossings.size());
    for (const Hit& hit : crossings) bytes.add(hit);
  }
  return bytes.hash();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> hashes_of(const ExamplePicture& picture) {
  std::vector<std::pair<std::string, std::string>> result;
  Scene scene = small_scene(picture);
  const std::vector<Ray> rays = random_rays(scene.camera);
  for (const auto& [precision, tier] :
       {std::pair{Precision::standard, ""}, std::pair{Precision::exact, ":exact"}}) {
    scene.settings.precision = precision;
    const PreparedScene prepared = prepare(scene);
    result.emplace_back(picture.name + tier, pixel_hash(render(prepared)));
    result.emplace_back(picture.name + ":queries" + tier, hash_of_queries(prepared, rays));
  }
  return result;
}

}  // namespace crt::tests
