#include "images/hashes.hpp"

#include <algorithm>
#include <cmath>
#include <crt/query.hpp>
#include <crt/render.hpp>
#include <random>

#include "images/example_pictures.hpp"
#include "images/measured_solids.hpp"
#include "images/number_bytes.hpp"

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

/// Asks for all crossings of each ray, for nearest hits of all together, and for blocked rays.
std::string hash_of_queries(const PreparedScene& scene, const std::vector<Ray>& rays) {
  RayQueries queries(scene);
  NumberBytes bytes;
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

NamedHashes hashes_of(const ExamplePicture& picture) {
  NamedHashes result;
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

}  // namespace

std::vector<HashSubject> hash_subjects() {
  std::vector<HashSubject> subjects;
  for (const ExamplePicture& picture : example_pictures())
    subjects.push_back([picture] { return hashes_of(picture); });
  for (const std::filesystem::path& script : measured_scripts())
    subjects.push_back([script] { return hashes_of_measures(script); });
  return subjects;
}

}  // namespace crt::tests
