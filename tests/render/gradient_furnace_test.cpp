// Principled surfaces under a sky that is brighter above: pictures against sums over directions.
#include <doctest/doctest.h>

#include <cmath>

#include "pictures.hpp"
#include "shading/principled_surfaces.hpp"

using namespace crt::test;
using crt::Vec3;

namespace {

constexpr double horizon = 0.2;
constexpr double zenith = 1.4;

double sky_at(double height) {
  return horizon + (zenith - horizon) * std::abs(height);
}

crt::Color seen_in_picture(const Surface& surface, double cosine) {
  crt::Scene scene = dark_scene();
  scene.settings.width = scene.settings.height = 1;
  scene.settings.min_samples = scene.settings.max_samples = 16384;
  scene.settings.target_error = 1e-9;
  scene.background =
      crt::GradientBackground{.horizon = crt::grey(horizon), .sky = crt::grey(zenith)};
  scene.lights = {crt::EnvironmentLight{}};
  const Vec3& tint = surface.color;
  const crt::PrincipledMaterial material{
      .color = crt::Color{static_cast<float>(tint.x), static_cast<float>(tint.y),
                          static_cast<float>(tint.z)},
      .metallic = surface.metallic,
      .roughness = surface.roughness,
      .coat = surface.layers.coat,
      .coat_roughness = surface.layers.coat_roughness,
      .sheen = surface.layers.sheen};
  scene.entities = {crt::Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = material}};
  const Vec3 to_viewer = direction(cosine);
  scene.camera = {.position = 4.0 * Vec3(to_viewer.x, to_viewer.z, 0), .fov = 1e-4};
  return render(prepare(scene), {.threads = 2}).at(0, 0);
}

}  // namespace

TEST_CASE("pictures of principled surfaces under a gradient are sums over all directions") {
  for (const double metallic : {0.0, 0.5, 1.0}) {
    for (const double roughness : {0.0, 0.3, 0.7, 1.0}) {
      for (const double coat : {0.0, 1.0}) {
        for (const double cosine : {0.3, 0.9}) {
          CAPTURE(metallic);
          CAPTURE(roughness);
          CAPTURE(coat);
          CAPTURE(cosine);
          const Surface surface =
              surface_of(metallic, roughness, 0,
                         {.coat = coat, .coat_roughness = 0.3, .sheen = 0.5}, Vec3(0.9, 0.5, 0.1));
          const Vec3 exact = sent_back(surface.seen(true), cosine, sky_at);
          const crt::Color seen = seen_in_picture(surface, cosine);
          CHECK(seen.r == doctest::Approx(exact.x).epsilon(4e-3));
          CHECK(seen.g == doctest::Approx(exact.y).epsilon(4e-3));
          CHECK(seen.b == doctest::Approx(exact.z).epsilon(4e-3));
        }
      }
    }
  }
}
