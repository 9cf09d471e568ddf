// Hits that are looked up side by side equal what each is by itself.
#include "core/render/surface_hit.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "core/shading/bump.hpp"
#include "support/numbers.hpp"

using namespace crt;
using namespace crt::core;
using crt::test::Numbers;

namespace {

std::vector<Material> materials() {
  const Color gap = {0.9, 0.5, 0.25, 0.75};
  const auto image = std::make_shared<Image>(4, 4);
  for (int i = 0; i < 16; ++i)
    image->set(i % 4, i / 4, {i / 16.0, 1 - i / 16.0, 0.5, i % 3 == 0 ? 0.5 : 1});
  const Pattern checker = Checker{.color_b = gap, .scale = 0.37, .offset = {0.1, 0.2, 0.3}};
  const Pattern picture = ImageMap{.image = image, .repeat_u = 3, .repeat_v = 2};
  return {{.color = gap, .transparency = 0.25},
          {.color = Color{1, 0.5, 0.25}, .reflectivity = 0.3, .diffuse = 0.8},
          {.color = checker, .reflectivity = 0.25, .transparency = 0.5},
          {.color = Pattern(Stripes{.direction = {1, 2, 3}, .scale = 0.3})},
          {.color = Pattern(Marble{.scale = 0.5})},
          {.color = picture, .transparency = 0.1},
          {.color = checker, .bump = Pattern(Noise{.scale = 0.5}), .bump_height = 0.3},
          {.color = grey(1), .bump = picture, .bump_height = 0.05}};
}

/// Makes solids of all these materials, as they are, moved, turned, and cut from one another.
Scene solids(Numbers& numbers) {
  Scene scene;
  for (const Material& material : materials()) {
    const auto add = [&](const Entity& entity) { scene.entities.push_back(entity); };
    const auto worn = [&](const Primitive& primitive) {
      return Entity(primitive).with_material(material);
    };
    const auto sphere = [&] {
      return worn(Sphere{.center = numbers.point(4), .radius = numbers.size(0.3, 1.5)});
    };
    const auto box = [&] {
      const Vec3 corner = numbers.point(4);
      return worn(Box{.corner_a = corner, .corner_b = corner + Vec3(0.5, 1, 1.5)});
    };
    add(sphere());
    add(box());
    add(sphere().transformed(translate(numbers.point(2))));
    add(box().transformed(rotate_degrees(numbers.point(180))));
    const Vec3 center = numbers.point(4);
    add(worn(Sphere{.center = center, .radius = 1}) -
        worn(Sphere{.center = center + 0.5 * numbers.direction(), .radius = 0.8}));
    const Entity torus = worn(Torus{.center = numbers.point(4), .radius = 1, .thickness = 0.3});
    add(torus);
    add(torus.transformed(rotate_degrees(numbers.point(180)))
            .transformed(scale(Vec3(0.7, 1.1, 1.3))));
    const Vec3 foot = numbers.point(4);
    add(worn(Cone{.from = foot, .to = foot + numbers.direction(), .radius = 0.5}));
    add(worn(Cylinder{.from = foot, .to = foot - 2.0 * numbers.direction(), .radius = 0.2})
            .transformed(rotate_degrees(numbers.point(180))));
    add(worn(Disc{.center = numbers.point(4), .normal = numbers.direction(), .radius = 0.8}));
    add(worn(Triangle{.a = numbers.point(4), .b = numbers.point(4), .c = numbers.point(4)})
            .transformed(scale(Vec3(1, 0.8, 1.2))));
  }
  scene.entities.push_back(Plane{.position = {0, -3, 0}, .material = materials()[2]});
  return scene;
}

void check_alone(const PreparedData& data, const WorldRay& ray, const RayHit& hit,
                 const SurfaceLane& found, Workspace& work) {
  const HitPoint point = data.hit_point(ray, hit);
  const PreparedMaterial& material = data.materials()[point.material];
  const SurfacePoint in_object = {point.object_position, point.object_normal, point.u, point.v};
  const Color color = material.pattern ? material.pattern->color(in_object) : material.color;
  const double transparency = material.transparency(color.a);
  const double to_viewer = hit.entering ? 1 : -1;
  const std::size_t lane = found.lane;

  const double found_transparency = found.group.transparency[lane];
  REQUIRE(found_transparency == transparency);
  REQUIRE((found.group.sending_on >> lane & 1u) == (material.ends_paths ? 0 : 1));
  const StartPoint start = data.start_point(ray, hit, hit.entering ? Side::outside : Side::inside);
  REQUIRE(found.start().face == start.face);
  REQUIRE(found.start().leaf == start.leaf);
  REQUIRE(found.start().surface == start.surface);
  REQUIRE(found.start().side == start.side);
  REQUIRE(found.start().t_error == start.t_error);
  REQUIRE(found.color() == rgb(color));
  const double diffuse = found.group.phong.diffuse[lane];
  const double reflectivity = found.group.reflectivity[lane];
  REQUIRE(diffuse == material.diffuse(transparency));
  REQUIRE(reflectivity == material.description->reflectivity);
  REQUIRE(found.position() == point.position);
  REQUIRE(found.group.face_normal.lane(found.lane) == to_viewer * point.normal);

  Vec3 normal = to_viewer * point.normal;
  if (material.bump) {
    const Leaf& leaf = data.leaf(hit);
    const LuminanceGradient luminance =
        luminance_gradient(*material.bump, in_object, *leaf.shape, hit.face, work.scratch);
    const Vec3 slope =
        material.description->bump_height * leaf.placement->covector_to_world(luminance.gradient);
    normal = visible_normal(to_viewer * tilted_normal(point.normal, slope), ray.direction);
  }
  REQUIRE(found.normal() == normal);
}

}  // namespace

TEST_CASE("hits looked up side by side are what each is by itself, to the last bit") {
  Numbers numbers(7);
  for (int round = 0; round < 20; ++round) {
    const PreparedData data(solids(numbers));
    Workspace work;
    SurfaceGroup group;
    for (int i = 0; i < 500; ++i) {
      // The rays are close to one another, so that some of them hit the same thing.
      std::array<WorldRay, lane_count> rays;
      std::array<RayHit, lane_count> hits;
      const Vec3 origin = numbers.point(8);
      const Vec3 target = numbers.point(4);
      RayMask seen = 0;
      RayLanes lines;
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const Vec3 aim = target + numbers.point(0.3);
        rays[lane] = {.origin = origin, .direction = glm::normalize(aim - origin)};
        lines.origin.set(lane, rays[lane].origin);
        lines.direction.set(lane, rays[lane].direction);
        hits[lane] = data.intersect(rays[lane], work.rays);
        seen |= static_cast<RayMask>(hits[lane].found()) << lane;
      }
      look_up(data, lines, hits, seen, group, work);
      for_each_ray(seen, [&](std::size_t lane) {
        check_alone(data, rays[lane], hits[lane], {group, lane}, work);
      });
    }
  }
}

namespace {

/// Looks up what four parallel rays along z meet.
SurfaceGroup seen_along_z(const PreparedData& data, const Vec3& origin, Workspace& work) {
  SurfaceGroup group;
  std::array<RayHit, lane_count> hits;
  RayLanes lines;
  RayMask seen = 0;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const WorldRay ray = {.origin = origin + Vec3(static_cast<double>(lane), 0, 0),
                          .direction = {0, 0, 1}};
    lines.origin.set(lane, ray.origin);
    lines.direction.set(lane, ray.direction);
    hits[lane] = data.intersect(ray, work.rays);
    seen |= static_cast<RayMask>(hits[lane].found()) << lane;
  }
  look_up(data, lines, hits, seen, group, work);
  return group;
}

Entity box_at(double x, const SharedMaterial& material) {
  return Box{.corner_a = {x - 0.4, -1, 0}, .corner_b = {x + 0.4, 1, 1}, .material = material};
}

}  // namespace

TEST_CASE("hits of principled materials have their numbers, patterns and tables") {
  const Pattern half = Checker{.color_a = grey(0.5), .color_b = grey(0.5)};
  const Pattern bright = Checker{.color_a = {3, 0, 0}, .color_b = {3, 0, 0}};
  const PrincipledMaterial glass = {.color = Color{1, 0.5, 0.25},
                                    .roughness = 0.25,
                                    .refractive_index = 1.6,
                                    .transmission = 0.75,
                                    .coat = 0.5,
                                    .coat_roughness = 0.125,
                                    .sheen = 0.375};
  Scene scene;
  scene.entities = {
      box_at(0, glass),
      box_at(1, PrincipledMaterial{.metallic = half, .roughness = half, .emission = bright}),
      box_at(2, Material{.color = grey(0.25), .emission = {0, 2, 0}}),
      box_at(3, PrincipledMaterial{.metallic = bright, .emission = Color{0, 0, 4}})};
  const PreparedData data(scene);
  CHECK(data.features().principled);
  CHECK(data.features().emission);
  Workspace work;
  const SurfaceGroup outside = seen_along_z(data, {0, 0, -5}, work);
  const PrincipledSurface<Lanes>& surface = outside.principled;
  CHECK(outside.principled_rays == 0b1011);
  CHECK(surface.color.lane(0) == Vec3(1, 0.5, 0.25));
  CHECK(double{surface.roughness[0]} == 0.25);
  CHECK(double{surface.relative_index[0]} == 1.6);
  CHECK(double{surface.transmission[0]} == 0.75);
  CHECK(double{surface.coat[0]} == 0.5);
  CHECK(double{surface.coat_roughness[0]} == 0.125);
  CHECK(double{surface.sheen[0]} == 0.375);
  CHECK(double{surface.metallic[1]} == doctest::Approx(0.5));
  CHECK(double{surface.roughness[1]} == doctest::Approx(0.5));
  CHECK(double{surface.metallic[3]} == doctest::Approx(3 * 0.2126));
  CHECK(surface.before[0] != surface.behind[0]);
  CHECK(surface.before[1] == surface.behind[1]);
  CHECK(surface.before[2] == nullptr);
  CHECK(outside.emission.lane(0) == Vec3(0));
  CHECK(outside.emission.lane(1) == Vec3(3, 0, 0));
  CHECK(outside.emission.lane(2) == Vec3(0, 2, 0));
  CHECK(outside.emission.lane(3) == Vec3(0, 0, 4));

  const SurfaceGroup inside = seen_along_z(data, {0, 0, 0.5}, work);
  CHECK(double{inside.principled.relative_index[0]} == 1 / 1.6);
  CHECK(double{inside.principled.coat[0]} == 0);
  CHECK(inside.principled.before[0] == surface.behind[0]);
  CHECK(inside.principled.behind[0] == surface.before[0]);
  // What lets no light through is alike from both sides.
  CHECK(double{inside.principled.relative_index[1]} == 1.5);
}

TEST_CASE("a normal map tilts the normal along u and v, and blue alone leaves it as it is") {
  const auto normal_under = [](const Color& color) {
    const PrincipledMaterial mapped = {.normal_map =
                                           Pattern(Checker{.color_a = color, .color_b = color})};
    Scene scene;
    scene.entities = {Plane{.normal = {0, 0, -1}, .position = {0, 0, 0}, .material = mapped}};
    const PreparedData data(scene);
    CHECK(data.features().bumps);
    Workspace work;
    return seen_along_z(data, {0.3, 0.2, -5}, work).phong.normal.lane(0);
  };
  CHECK(glm::length(normal_under({0.5, 0.5, 1}) - Vec3(0, 0, -1)) < 1e-9);
  const Vec3 along_u = normal_under({1, 0.5, 0.5 + 0.5 * std::sqrt(3.0)}) - Vec3(0, 0, -1);
  const Vec3 along_v = normal_under({0.5, 1, 0.5 + 0.5 * std::sqrt(3.0)}) - Vec3(0, 0, -1);
  // The normal is half as far out again: the tilt is one of 30 degrees.
  CHECK(normal_under({1, 0.5, 0.5 + 0.5 * std::sqrt(3.0)}).z ==
        doctest::Approx(-std::cos(std::numbers::pi / 6)));
  CHECK(std::abs(glm::dot(Vec3(along_u.x, along_u.y, 0), Vec3(along_v.x, along_v.y, 0))) < 1e-9);
  CHECK(glm::length(Vec3(along_u.x, along_u.y, 0)) == doctest::Approx(0.5));
}

TEST_CASE("scenes without principled materials look nothing of them up") {
  Scene scene;
  scene.entities = {box_at(0, Material{})};
  const PreparedData data(scene);
  CHECK_FALSE(data.features().principled);
  CHECK_FALSE(data.features().emission);
}

TEST_CASE("what a path through a medium leaves of light is right at all lengths") {
  const auto left = [](const Color& absorption, double length) {
    TexturePool textures(1);
    LayerTablePool tables;
    const PreparedMaterial medium(Material{.absorption = absorption}, {textures, textures, tables});
    return transmittance(medium, length);
  };
  const Rgb some = left({0.5, 3, 1e-3}, 0.75);
  CHECK(some.x == doctest::Approx(std::exp(-0.375)).epsilon(1e-15));
  CHECK(some.y == doctest::Approx(std::exp(-2.25)).epsilon(1e-15));
  CHECK(some.z == doctest::Approx(std::exp(-0.75e-3)).epsilon(1e-15));
  CHECK(left({1e100, 0, 1}, 0) == Rgb(1));
  CHECK(left({1e100, 0, 1}, infinity) == Rgb(0, 1, 0));
  CHECK(left({1e100, 1e-300, 0}, 1e308) == Rgb(0, 0, 1));
}
