#include "core/camera/camera_rays.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <random>
#include <span>

#include "crt/settings.hpp"

using namespace crt::core;
using crt::Camera;
using crt::Projection;
using crt::Vec3;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::array<Projection, 4> all_projections = {
    Projection::pinhole, Projection::spherical, Projection::cylindrical, Projection::orthographic};

bool near(const Vec3& a, const Vec3& b, double tolerance = 1e-14) {
  return glm::length(a - b) <= tolerance * std::max(1.0, glm::length(b));
}

bool is_finite_unit(const Vec3& v) {
  return std::abs(glm::length(v) - 1) < 1e-15;
}

/// Returns a camera at the origin that looks along z.
Camera plain_camera(Projection projection) {
  return {.position = {0, 0, 0}, .pointing = {0, 0, 1}, .projection = projection};
}

Camera random_camera(std::mt19937_64& random, Projection projection) {
  std::uniform_real_distribution<double> place(-10, 10);
  std::uniform_real_distribution<double> angle(0.1, 2.5);
  return {.position = {place(random), place(random), place(random)},
          .pointing = {place(random), place(random), place(random)},
          .fov = angle(random),
          .roll = place(random),
          .projection = projection,
          .aperture = 100,
          .focal_distance = 1 + std::abs(place(random))};
}

/// Returns the pixel position at which a camera sees `point`. It inverts image.md's formulas in the
/// camera's own coordinates.
glm::dvec2 pixel_of(const Camera& camera, const CameraRays& rays, const Vec3& point, double width,
                    double height) {
  const Vec3 offset = point - camera.position;
  const double x = glm::dot(offset, rays.right());
  const double y = glm::dot(offset, rays.up());
  const double z = glm::dot(offset, rays.forward());
  const double aspect = width / height;
  const double tangent = std::tan(camera.fov / 2);
  double nx = 0;
  double ny = 0;
  switch (camera.projection) {
    case Projection::pinhole:
      nx = x / z / tangent / aspect;
      ny = y / z / tangent;
      break;
    case Projection::spherical:
      nx = std::atan2(x, z) / (camera.fov / 2 * aspect);
      ny = std::atan2(y, std::hypot(x, z)) / (camera.fov / 2);
      break;
    case Projection::cylindrical:
      nx = std::atan2(x, z) / (camera.fov / 2 * aspect);
      ny = y / std::hypot(x, z) / tangent;
      break;
    case Projection::orthographic:
      nx = x / (camera.focal_distance * tangent * aspect);
      ny = y / (camera.focal_distance * tangent);
      break;
  }
  return {(nx + 1) / 2 * width, (1 - ny) / 2 * height};
}

}  // namespace

TEST_CASE("looking along z, x is to the right and y is up") {
  for (const Projection projection : all_projections) {
    const CameraRays rays(plain_camera(projection), 4, 2);
    CHECK(rays.right() == Vec3(1, 0, 0));
    CHECK(rays.up() == Vec3(0, 1, 0));
    CHECK(rays.forward() == Vec3(0, 0, 1));
    CHECK(rays.ray(2, 1).direction == Vec3(0, 0, 1));
    CHECK(rays.ray(2, 1).origin == Vec3(0));
    // Row 0 is the top row, column 0 the leftmost.
    const CameraRay top_left = rays.ray(0.5, 0.5);
    const Vec3 seen = top_left.origin + top_left.direction;
    CHECK(seen.x < 0);
    CHECK(seen.y > 0);
  }
}

TEST_CASE("the camera's directions are orthonormal and left-handed for any direction and roll") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Camera camera = random_camera(random, Projection::pinhole);
    const CameraRays rays(camera, 3, 2);
    REQUIRE(is_finite_unit(rays.right()));
    REQUIRE(is_finite_unit(rays.up()));
    REQUIRE(is_finite_unit(rays.forward()));
    // Space is left-handed, as x, y, z are: the formula of the cross product gives right x up =
    // forward.
    REQUIRE(near(glm::cross(rays.right(), rays.up()), rays.forward()));
    REQUIRE(near(rays.forward(), glm::normalize(camera.pointing - camera.position)));
  }
}

TEST_CASE("without roll the horizon is level and the top is up") {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    Camera camera = random_camera(random, Projection::pinhole);
    camera.roll = 0;
    const CameraRays rays(camera, 3, 2);
    REQUIRE(std::abs(rays.right().y) < 1e-15);
    REQUIRE(rays.up().y >= 0);
  }
}

TEST_CASE("roll tips the picture's top to the right") {
  Camera camera = plain_camera(Projection::pinhole);
  camera.roll = 0.3;
  const CameraRays rays(camera, 2, 2);
  CHECK(near(rays.up(), {std::sin(0.3), std::cos(0.3), 0}));
  CHECK(near(rays.right(), {std::cos(0.3), -std::sin(0.3), 0}));
  CHECK(near(rays.forward(), {0, 0, 1}));
}

TEST_CASE("straight up and down the picture's top is towards z") {
  for (const double sign : {1.0, -1.0}) {
    for (const double rounding : {0.0, 1e-13}) {
      const CameraRays rays(
          {.position = {5, 0, 3}, .pointing = {5 + rounding, sign * 7, 3 - rounding}}, 2, 2);
      CHECK(near(rays.forward(), {0, sign, 0}, 1e-12));
      CHECK(near(rays.up(), {0, 0, 1}, 1e-12));
      CHECK(near(rays.right(), {-sign, 0, 0}, 1e-12));
    }
  }
  // A direction that is nearly vertical by intention still takes its top from y.
  const CameraRays rays({.position = {0, 0, 0}, .pointing = {1e-6, 1, 0}}, 2, 2);
  CHECK(near(rays.up(), {-1, 1e-6, 0}, 1e-9));
}

TEST_CASE("a point seen along a pixel's ray is found at that pixel, in every projection") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int width = 160;
  constexpr int height = 90;
  for (const Projection projection : all_projections) {
    for (int i = 0; i < 2000; ++i) {
      Camera camera = random_camera(random, projection);
      // The picture is less than a full turn across, so that the inverse is unique.
      if (projection == Projection::spherical || projection == Projection::cylindrical)
        camera.fov *= 0.9;
      const CameraRays rays(camera, width, height);
      const double x = unit(random) * width;
      const double y = unit(random) * height;
      const CameraRay ray = rays.ray(x, y);
      REQUIRE(is_finite_unit(ray.direction));
      const glm::dvec2 pixel = pixel_of(
          camera, rays, ray.origin + (0.1 + 10 * unit(random)) * ray.direction, width, height);
      REQUIRE(std::abs(pixel.x - x) < 1e-9);
      REQUIRE(std::abs(pixel.y - y) < 1e-9);
    }
  }
}

TEST_CASE("the field of view spans the picture's height") {
  const double fov = 1.2;
  for (const Projection projection : all_projections) {
    Camera camera = plain_camera(projection);
    camera.fov = fov;
    camera.focal_distance = 5;
    const CameraRays rays(camera, 300, 100);
    const CameraRay top = rays.ray(150, 0);
    const CameraRay bottom = rays.ray(150, 100);
    if (projection == Projection::orthographic) {
      CHECK(glm::length(top.origin - bottom.origin) == doctest::Approx(2 * 5 * std::tan(fov / 2)));
      CHECK(top.direction == bottom.direction);
    } else {
      CHECK(std::acos(glm::dot(top.direction, bottom.direction)) == doctest::Approx(fov));
    }
  }
}

TEST_CASE("a spherical camera of half a turn and twice as wide as high sees everything once") {
  Camera camera = plain_camera(Projection::spherical);
  camera.fov = pi;
  const CameraRays rays(camera, 200, 100);
  CHECK(near(rays.ray(0, 50).direction, {0, 0, -1}));
  CHECK(near(rays.ray(50, 50).direction, {-1, 0, 0}));
  CHECK(near(rays.ray(150, 50).direction, {1, 0, 0}));
  CHECK(near(rays.ray(200, 50).direction, {0, 0, -1}));
  for (const double x : {0.0, 70.0, 100.0}) {
    CHECK(near(rays.ray(x, 0).direction, {0, 1, 0}));
    CHECK(near(rays.ray(x, 100).direction, {0, -1, 0}));
  }
}

TEST_CASE("mirrored pixels have mirrored rays") {
  for (const Projection projection : all_projections) {
    Camera camera = plain_camera(projection);
    camera.fov = 0.8;
    const CameraRays rays(camera, 64, 32);
    for (double y = 0.5; y < 32; y += 1)
      for (double x = 0.5; x < 64; x += 1) {
        const CameraRay here = rays.ray(x, y);
        const CameraRay across = rays.ray(64 - x, y);
        const CameraRay below = rays.ray(x, 32 - y);
        REQUIRE(across.direction == here.direction * Vec3(-1, 1, 1));
        REQUIRE(below.direction == here.direction * Vec3(1, -1, 1));
        REQUIRE(across.origin == here.origin * Vec3(-1, 1, 1));
        REQUIRE(below.origin == here.origin * Vec3(1, -1, 1));
      }
  }
}

TEST_CASE("rays through all of the lens meet on the focal surface") {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const Projection projection : all_projections) {
    for (int i = 0; i < 200; ++i) {
      const Camera camera = random_camera(random, projection);
      const CameraRays rays(camera, 16, 9);
      const double x = 16 * unit(random);
      const double y = 9 * unit(random);
      const CameraRay central = rays.ray(x, y);
      const bool has_plane =
          projection == Projection::pinhole || projection == Projection::orthographic;
      const double distance =
          has_plane ? camera.focal_distance / glm::dot(central.direction, rays.forward())
                    : camera.focal_distance;
      const Vec3 focus = central.origin + distance * central.direction;
      for (int j = 0; j < 10; ++j) {
        const LensPoint lens = rays.lens_point(unit(random), unit(random));
        const CameraRay ray = rays.ray(x, y, lens);
        REQUIRE(is_finite_unit(ray.direction));
        // The lens lies in the plane of right and up, with its radius in thousandths.
        const Vec3 offset = ray.origin - central.origin;
        REQUIRE(near(offset, 0.1 * (lens.x * rays.right() + lens.y * rays.up()), 1e-13));
        REQUIRE(glm::length(glm::cross(focus - ray.origin, ray.direction)) <
                1e-12 * glm::length(focus - ray.origin) + 1e-13);
        REQUIRE(glm::dot(focus - ray.origin, ray.direction) > 0);
      }
    }
  }
}

TEST_CASE("the blur of a point out of focus has the thin lens's radius") {
  // Seen from the point at distance z, the edge of a lens of radius a casts a circle of radius a |f
  // - z| / z on the focal plane at distance f.
  const double a = 0.2;
  const double f = 5;
  const CameraRays rays(
      {.position = {0, 0, 0}, .pointing = {0, 0, 1}, .aperture = 1000 * a, .focal_distance = f},
      100, 100);
  for (const double z : {1.0, 4.0, 5.0, 8.0, 1000.0}) {
    const double blur = a * std::abs(f - z) / z;
    for (int i = 0; i < 16; ++i) {
      const double angle = 2 * pi * i / 16;
      const LensPoint rim{std::cos(angle), std::sin(angle)};
      // In the direction of this pixel the ray from the lens's edge through the point (0, 0, z) is
      // in focus.
      const double side = (1 - f / z) * a;
      const double pixels_per_unit = 50 / (f * std::tan(pi / 6));
      const CameraRay ray =
          rays.ray(50 + side * rim.x * pixels_per_unit, 50 - side * rim.y * pixels_per_unit, rim);
      const Vec3 at_z = ray.origin + (z / ray.direction.z) * ray.direction;
      const Vec3 at_focus = ray.origin + (f / ray.direction.z) * ray.direction;
      CHECK(std::hypot(at_z.x, at_z.y) < 1e-12 * z);
      CHECK(std::hypot(at_focus.x, at_focus.y) == doctest::Approx(blur).epsilon(1e-9));
    }
  }
}

TEST_CASE("a lens of no size changes nothing") {
  std::mt19937_64 random(5);
  for (const Projection projection : all_projections) {
    Camera camera = random_camera(random, projection);
    camera.aperture = 0;
    const CameraRays rays(camera, 8, 8);
    CHECK_FALSE(rays.has_lens());
    CHECK(near(rays.ray(2.5, 3.5, {0.7, -0.2}).direction, rays.ray(2.5, 3.5).direction, 1e-15));
    CHECK(rays.ray(2.5, 3.5, {0.7, -0.2}).origin == rays.ray(2.5, 3.5).origin);
  }
}

TEST_CASE("extreme fields of view, sizes and lenses give finite unit directions") {
  for (const Projection projection : all_projections) {
    for (const double fov : {1e-300, 1e-6, pi - 1e-6, std::nextafter(pi, 0.0), pi}) {
      for (const double focal_distance : {1e-100, 1.0, 1e100}) {
        for (const double aperture : {0.0, 1e-100, 1e100}) {
          Camera camera = plain_camera(projection);
          camera.fov = fov;
          camera.focal_distance = focal_distance;
          camera.aperture = aperture;
          const CameraRays rays(camera, 65536, 1);
          for (const double x : {0.0, 0.5, 32768.0, 65535.5, 65536.0})
            for (const LensPoint& lens : {LensPoint{0, 0}, LensPoint{1, 0}, LensPoint{-1, 0}}) {
              const CameraRay ray = rays.ray(x, 0.25, lens);
              REQUIRE(is_finite_unit(ray.direction));
              REQUIRE(std::isfinite(glm::dot(ray.origin, Vec3(1e-10))));
            }
        }
      }
    }
  }
}

TEST_CASE(
    "the point in focus on a spherical camera's own lens is looked at from there all the same") {
  // The camera looks to the side along the lens, with the focal distance equal to the lens's
  // radius.
  Camera camera = plain_camera(Projection::spherical);
  camera.fov = pi / 2;
  camera.aperture = 1000;
  camera.focal_distance = 1;
  const CameraRays rays(camera, 2, 1);
  const CameraRay central = rays.ray(2, 0.5);
  const Vec3& d = central.direction;
  const CameraRay ray = rays.ray(2, 0.5, {glm::dot(d, rays.right()), glm::dot(d, rays.up())});
  CHECK(is_finite_unit(ray.direction));
}

TEST_CASE("scaling the scene by a power of two changes no bit of any direction") {
  std::mt19937_64 random(6);
  for (const Projection projection : all_projections) {
    const Camera camera = random_camera(random, projection);
    const CameraRays rays(camera, 16, 9);
    for (const int exponent : {-300, -1, 1, 300}) {
      const double factor = std::scalbn(1.0, exponent);
      Camera scaled = camera;
      scaled.position *= factor;
      scaled.pointing *= factor;
      scaled.aperture *= factor;
      scaled.focal_distance *= factor;
      const CameraRays scaled_rays(scaled, 16, 9);
      for (double x = 0.5; x < 16; x += 1) {
        const CameraRay a = rays.ray(x, 2.5, {0.3, -0.4});
        const CameraRay b = scaled_rays.ray(x, 2.5, {0.3, -0.4});
        REQUIRE(a.direction == b.direction);
        REQUIRE(a.origin * factor == b.origin);
      }
    }
  }
}

TEST_CASE("a point appears where the ray to it starts from, in every projection") {
  Camera camera{.position = {1, 2, -3},
                .pointing = {0.5, 1, 1},
                .fov = 1.2,
                .roll = 0.3,
                .focal_distance = 2};
  for (const Projection projection : {Projection::pinhole, Projection::spherical,
                                      Projection::cylindrical, Projection::orthographic}) {
    camera.projection = projection;
    const CameraRays rays(camera, 64, 48);
    for (const auto& [x, y] : {std::pair{32.0, 24.0}, {0.5, 47.25}, {63.0, 3.0}}) {
      const CameraRay ray = rays.ray(x, y);
      const Vec3 point = ray.origin + 5.0 * ray.direction;
      const auto place = rays.place_of(point);
      REQUIRE(place);
      CHECK(place->x == doctest::Approx(x));
      CHECK(place->y == doctest::Approx(y));
      // A step of length 1 to the side moves it by that many pixels or more.
      const auto aside = rays.place_of(point + rays.up());
      REQUIRE(aside);
      const double pixels = std::hypot(aside->x - x, aside->y - y);
      CHECK(pixels >= 0.6 * rays.least_pixels_per_unit(point));
      CHECK(pixels <= 4 * rays.least_pixels_per_unit(point));
    }
  }
  camera.projection = Projection::pinhole;
  CHECK_FALSE(CameraRays(camera, 64, 48).place_of({2, 3, -5}));
}

TEST_CASE("several rays at once are the same to the last bit") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-20, 100);
  std::uniform_real_distribution<double> on_lens(-1, 1);
  constexpr std::size_t most = 11;
  constexpr std::size_t groups = 3;
  for (const Projection projection : all_projections) {
    // At the scales at the ends lengths are too large or too small to be squared.
    for (const double scale : {1.0, 1e-160, 1e160}) {
      Camera camera = random_camera(random, projection);
      camera.aperture = 300 * scale;
      camera.focal_distance = 3 * scale;
      const CameraRays rays(camera, 80, 60);
      std::array<PicturePlaceLanes, groups> places;
      std::array<LensPointLanes, groups> lens_points;
      for (std::size_t i = 0; i < most; ++i) {
        const std::size_t lane = i % lane_count;
        set_lane(places[i / lane_count], lane, {place(random), place(random)});
        set_lane(lens_points[i / lane_count], lane, {on_lens(random), on_lens(random)});
      }
      for (std::size_t count = 0; count <= most; ++count) {
        std::array<RayLanes, groups> found;
        rays.rays(count, places, {}, found);
        std::array<RayLanes, groups> with_lens;
        rays.rays(count, places, lens_points, with_lens);
        for (std::size_t i = 0; i < count; ++i) {
          const auto [x, y] = lane_of(places[i / lane_count], i % lane_count);
          const CameraRay one = rays.ray(x, y);
          const auto is_lane = [&](const std::array<RayLanes, groups>& all, const CameraRay& ray) {
            const RayLanes& group = all[i / lane_count];
            CHECK(group.origin.lane(i % lane_count) == ray.origin);
            CHECK(group.direction.lane(i % lane_count) == ray.direction);
          };
          is_lane(found, one);
          const CameraRay through_lens =
              rays.ray(x, y, lane_of(lens_points[i / lane_count], i % lane_count));
          is_lane(with_lens, through_lens);
        }
      }
    }
  }
}
