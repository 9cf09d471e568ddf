// How large the lens is: in units, in thousandths of them, and in scenes of 2015.
#include <doctest/doctest.h>

#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "core/camera/camera_rays.hpp"
#include "crt/settings.hpp"

using namespace crt::core;
using crt::Camera;
using crt::Projection;
using crt::Vec3;

namespace {

constexpr std::array<Projection, 4> projections = {
    Projection::pinhole, Projection::spherical, Projection::cylindrical, Projection::orthographic};

/// Returns a camera at the origin that looks along z.
Camera ahead(Projection projection) {
  return {.position = {0, 0, 0}, .pointing = {0, 0, 1}, .projection = projection};
}

}  // namespace

TEST_CASE("the radius of a lens in units is that of the aperture in thousandths, in 2015 as well") {
  for (const Projection projection : projections) {
    Camera in_units = ahead(projection);
    in_units.lens_radius = 0.125;
    Camera in_thousandths = ahead(projection);
    in_thousandths.aperture = 125;
    const CameraRays expected(in_thousandths, 30, 20);
    for (const int compat : {0, crt::compat_2015}) {
      const CameraRays rays(in_units, 30, 20, compat);
      CHECK(rays.has_lens());
      const CameraRay ray = rays.ray(9, 12, {0.3, -0.6});
      CHECK(ray.origin == expected.ray(9, 12, {0.3, -0.6}).origin);
      CHECK(ray.direction == expected.ray(9, 12, {0.3, -0.6}).direction);
    }
  }
}

TEST_CASE(
    "a lens of 2015 reaches aperture / width across and aperture / height up, whatever the "
    "projection") {
  for (const Projection projection : projections) {
    Camera camera = ahead(projection);
    camera.aperture = 6;
    for (const auto& [width, height] : {std::pair(20, 10), std::pair(40, 20), std::pair(30, 60)}) {
      const CameraRays rays(camera, width, height, crt::compat_2015);
      REQUIRE(rays.has_lens());
      const double x = 0.3 * width;
      const double y = 0.6 * height;
      const CameraRay middle = rays.ray(x, y);
      const Vec3 across = rays.ray(x, y, {1, 0}).origin - middle.origin;
      const Vec3 up = rays.ray(x, y, {0, -1}).origin - middle.origin;
      CHECK(glm::length(across - (6.0 / width) * rays.right()) < 1e-14);
      CHECK(glm::length(up + (6.0 / height) * rays.up()) < 1e-14);
    }
  }
}
