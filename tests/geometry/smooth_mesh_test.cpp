// These tests render meshes with normals and materials of their own. A ball of triangles whose
// corners lie on a sphere has, at each point of its facets, a normal along the point itself.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "crt/mesh.hpp"
#include "crt/transform.hpp"
#include "geometry/meshes.hpp"
#include "render/pictures.hpp"
#include "support/scene_of.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns a ball of 8 n^2 triangles, whose normals are those of the sphere.
Entity smooth_ball(int n, MeshAttributes attributes = {}) {
  Random random(1);
  const TriangleList list = ball_mesh(random, n, 0);
  attributes.normals = list.positions;
  return triangle_mesh(list.positions, list.triangles, attributes);
}

Entity flat_ball(int n) {
  Random random(1);
  return ball_mesh(random, n, 0).entity();
}

/// A Pixel is what a picture reports of one.
struct Pixel {
  Vec3 normal;
  Vec3 albedo;
  double depth = 0;
};

Pixel pixel_of(Scene scene, const Vec3& eye, const Vec3& target) {
  scene.settings.width = scene.settings.height = 1;
  scene.camera.position = eye;
  scene.camera.pointing = target;
  const Image image = render(
      prepare(scene), {.threads = 1, .aovs = {.depth = true, .normal = true, .albedo = true}});
  const auto at = [&](const char* name) { return double{image.channel(name)[0]}; };
  return {.normal = {at("N.X"), at("N.Y"), at("N.Z")},
          .albedo = {at("albedo.R"), at("albedo.G"), at("albedo.B")},
          .depth = at("Z")};
}

Scene scene_with(const Entity& entity, Precision precision = Precision::standard) {
  Scene scene = dark_scene();
  scene.entities = {entity};
  scene.settings.precision = precision;
  return scene;
}

/// Returns the normal nearest to `normal` of a surface that a viewer sees who looks along `view`.
Vec3 seen_normal(const Vec3& normal, const Vec3& view) {
  const double away = glm::dot(normal, view);
  return away <= 0 ? normal : glm::normalize(normal - away * view);
}

/// Checks normals of an entity all around. `normal_at` gives what is expected at a point.
template <class NormalAt>
void check_normals(const Entity& entity, double distance, const NormalAt& normal_at) {
  for (const Precision precision : tiers) {
    const Scene scene = scene_with(entity, precision);
    Random random(5);
    int met = 0;
    for (int i = 0; i < 60; ++i) {
      const Vec3 eye = distance * glm::normalize(random.in_cube());
      const Vec3 target = 0.3 * random.in_cube();
      const Vec3 view = glm::normalize(target - eye);
      const Pixel pixel = pixel_of(scene, eye, target);
      if (!std::isfinite(pixel.depth)) continue;
      ++met;
      const Vec3 place = eye + pixel.depth * view;
      const Vec3 expected = seen_normal(normal_at(place, view), view);
      REQUIRE(glm::distance(pixel.normal, expected) < 1e-4);
    }
    CHECK(met > 30);
  }
}

/// Returns a square across z, whose two triangles have a material each.
Entity two_halves(const Material& low, const Material& high, double z = 0) {
  return triangle_mesh(std::array{Vec3(-1, -1, z), Vec3(1, -1, z), Vec3(1, 1, z), Vec3(-1, 1, z)},
                       std::array{TriangleIndices{0, 1, 2}, TriangleIndices{0, 2, 3}},
                       {.materials = {low, high}, .material_of_triangle = {0, 1}});
}

const Material red{.color = Color{1, 0, 0}};
const Material green{.color = Color{0, 1, 0}};
const Material blue{.color = Color{0, 0, 1}};

/// Returns the cube [-1, 1]^3, whose faces across an axis have the material of that axis.
Entity colored_cube(const std::vector<SharedMaterial>& materials) {
  Random random(1);
  TriangleList list = Voxels(random, 1).mesh();
  MeshAttributes attributes;
  attributes.materials = materials;
  for (Vec3& place : list.positions) place = 2.0 * place - Vec3(1);
  for (const auto& [a, b, c] : list.triangles) {
    for (int axis = 0; axis < 3; ++axis) {
      const double place = list.positions[a][axis];
      if (list.positions[b][axis] == place && list.positions[c][axis] == place)
        attributes.material_of_triangle.push_back(static_cast<std::uint32_t>(axis));
    }
  }
  return triangle_mesh(list.positions, list.triangles, attributes);
}

}  // namespace

TEST_CASE("a smooth ball has the sphere's normals, however few triangles it has") {
  for (const int n : {1, 2, 7}) {
    check_normals(smooth_ball(n), 4,
                  [](const Vec3& place, const Vec3&) { return glm::normalize(place); });
  }
}

TEST_CASE("normals go by the inverse transpose of where the mesh is put") {
  const Vec3 size(1, 2, 0.5);
  const Entity entity = smooth_ball(4).transformed(scale(size));
  check_normals(entity, 6, [&](const Vec3& place, const Vec3&) {
    return glm::normalize(place / size / size);
  });
}

TEST_CASE("cut surfaces have the normals of what cut them, turned round") {
  const Entity cut = Entity(Box{.corner_a = Vec3(-5), .corner_b = Vec3(5)}) - smooth_ball(3);
  // The eye is within the hole.
  check_normals(cut, 0.4, [](const Vec3& place, const Vec3&) { return -glm::normalize(place); });
  const Entity rest = smooth_ball(3) ^ Entity(Box{.corner_a = Vec3(-5), .corner_b = {5, 5, 0}});
  check_normals(rest, 4, [](const Vec3& place, const Vec3& view) {
    const bool on_cut = std::abs(place.z) < 1e-5;
    return on_cut && view.z < 0 ? Vec3(0, 0, 1) : glm::normalize(place);
  });
}

TEST_CASE("a mesh that is smoothed by 0, or has no normals, has those of its facets") {
  const Scene plain = scene_with(flat_ball(3));
  MeshAttributes flat;
  flat.smooth = 0;
  const Scene other = scene_with(smooth_ball(3, flat));
  CHECK(same_pixels(look(plain, {3, 4, 5}, {0, 0, 0}), look(other, {3, 4, 5}, {0, 0, 0})));
  const Vec3 normal = pixel_of(plain, {4, 4, 4}, {0, 0, 0}).normal;
  CHECK(pixel_of(other, {4, 4, 4}, {0, 0, 0}).normal == normal);
}

TEST_CASE("a mirror of triangles reflects as its normals say, and never into itself") {
  Scene scene = scene_with(smooth_ball(2, {.materials = {Material{.reflectivity = 1}}}));
  scene.background = two_halves({1, 0, 0}, {0, 0, 1});
  scene.settings.recursion_depth = 1;
  Random random(9);
  for (int i = 0; i < 100; ++i) {
    const Vec3 eye = 4.0 * glm::normalize(random.in_cube());
    const Vec3 target = 0.5 * random.in_cube();
    const Vec3 view = glm::normalize(target - eye);
    const Pixel pixel = pixel_of(scene, eye, target);
    const Vec3 mirrored = view - 2 * glm::dot(view, pixel.normal) * pixel.normal;
    const Vec3 facet = pixel_of(scene_with(flat_ball(2)), eye, target).normal;
    if (std::abs(mirrored.y) < 0.1 || glm::dot(mirrored, facet) < 1e-3) continue;
    const Color color = seen(scene, eye, target);
    REQUIRE((mirrored.y > 0 ? color.r : color.b) == 1);
  }
}

TEST_CASE("light does not come through to facets that are turned away from it") {
  Scene scene = scene_with(smooth_ball(2, {.materials = {Material{.color = grey(1)}}}));
  scene.lights = {ParallelLight{.from = {0, 5, 0}, .pointing = {0, 0, 0}}};
  Scene flat = scene;
  flat.entities = {flat_ball(2)};
  Random random(10);
  int dark = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 eye = 4.0 * glm::normalize(random.in_cube());
    const Vec3 target = 0.6 * random.in_cube();
    const double facet_up = pixel_of(flat, eye, target).normal.y;
    const double light = seen(scene, eye, target).g;
    const double up = pixel_of(scene, eye, target).normal.y;
    if (facet_up <= 0 || up <= 0) {
      REQUIRE(light == 0);
      ++dark;
    } else {
      // It is no more than the normal says, and no facet that is well turned to it is black.
      REQUIRE(light <= up + 1e-6);
      if (facet_up > 0.7) REQUIRE(light > 0);
    }
  }
  CHECK(dark > 20);
}

TEST_CASE("the light on a smooth ball has no jumps where facets turn away from it") {
  Scene scene = scene_with(smooth_ball(6, {.materials = {Material{.color = grey(1)}}}));
  scene.lights = {ParallelLight{.from = {0, 5, 0}, .pointing = {0, 0, 0}}};
  scene.camera.position = {0, 0, -4};
  scene.camera.pointing = {0, 0, 0};
  scene.settings.width = 1;
  scene.settings.height = 400;
  const auto largest_jump = [&] {
    const Image image = render(prepare(scene));
    double largest = 0;
    for (int y = 141; y < 260; ++y) {  // within the silhouette
      const double change = double{image.at(0, y).g} - double{image.at(0, y - 1).g};
      largest = std::max(largest, std::abs(change));
    }
    return largest;
  };
  CHECK(largest_jump() < 0.02);
  scene.entities = {flat_ball(6)};
  CHECK(largest_jump() > 0.1);
}

TEST_CASE("triangles of one plane have a material each") {
  for (const Precision precision : tiers) {
    const Scene scene = scene_with(two_halves(red, green), precision);
    CHECK(pixel_of(scene, {0.5, -0.5, -3}, {0.5, -0.5, 0}).albedo == Vec3(1, 0, 0));
    CHECK(pixel_of(scene, {-0.5, 0.5, -3}, {-0.5, 0.5, 0}).albedo == Vec3(0, 1, 0));
  }
}

TEST_CASE("facets keep their materials through CSG, as cutters and in any place") {
  const Entity cube = colored_cube({red, green, blue});
  const Entity hole =
      Box{.corner_a = {-5, -5, -0.5}, .corner_b = {5, 0.5, 0.5}, .material = Material{}};
  const auto check = [](const Scene& scene, double size) {
    CHECK(pixel_of(scene, {-5, 0.8, 0.7}, {0, size * 0.8, size * 0.7}).albedo == Vec3(1, 0, 0));
    CHECK(pixel_of(scene, {0.1, 9, 0.2}, {0.1, 0, 0.2}).albedo == Vec3(0, 1, 0));
    CHECK(pixel_of(scene, {0.1, 0.2, 9}, {0.1, 0.2, 0}).albedo == Vec3(0, 0, 1));
  };
  for (const Precision precision : tiers) {
    check(scene_with(cube, precision), 1);
    check(scene_with(cube - hole, precision), 1);
    check(scene_with((cube - hole).transformed(scale({1, 2, 2})), precision), 2);
    const Entity room = Entity(Box{.corner_a = Vec3(-4), .corner_b = Vec3(4)}) - cube;
    const Scene inside = scene_with(room, precision);
    CHECK(pixel_of(inside, {0, 0, 0}, {1, 0.1, 0.2}).albedo == Vec3(1, 0, 0));
    CHECK(pixel_of(inside, {0, 0, 0}, {0.1, -1, 0.2}).albedo == Vec3(0, 1, 0));
  }
}

TEST_CASE(
    "the material of the entity takes the place of those of facets, and none is the default") {
  const Entity cube = colored_cube({red, green, blue});
  const auto color = [](const Entity& entity) {
    return pixel_of(scene_with(entity), {5, 0.1, 0.2}, {0, 0.1, 0.2}).albedo;
  };
  CHECK(color(cube.with_material(green)) == Vec3(0, 1, 0));
  CHECK(color((cube + Entity(Sphere{.center = {9, 9, 9}})).with_material(blue)) == Vec3(0, 0, 1));
  CHECK(color(cube) == Vec3(1, 0, 0));
  const Entity none = triangle_mesh(std::array{Vec3(1, -1, -1), Vec3(1, 1, 0), Vec3(1, -1, 1)},
                                    std::vector<TriangleIndices>{{0, 1, 2}},
                                    {.materials = {red}, .material_of_triangle = {no_index}});
  CHECK(color(none) == Vec3(0.5));
}

TEST_CASE("light goes through facets that let it, and through no other facet of the mesh") {
  const Material clear{.color = grey(1), .transparency = 1, .diffuse = 0};
  for (const Precision precision : tiers) {
    Scene scene =
        scene_with(Plane{.normal = {0, 0, -1}, .material = Material{.color = grey(1)}}, precision);
    scene.entities.push_back(two_halves(clear, Material{}, -1));
    scene.lights = {ParallelLight{.from = {0, 0, -5}, .pointing = {0, 0, 0}}};
    CHECK(seen(scene, {0.5, -0.5, -0.5}, {0.5, -0.5, 0}).g == 1);
    CHECK(seen(scene, {-0.5, 0.5, -0.5}, {-0.5, 0.5, 0}).g == 0);
    CHECK(seen(scene, {0.5, -0.5, -3}, {0.5, -0.5, 0}).g == 1);
    CHECK(seen(scene, {-0.5, 0.5, -3}, {-0.5, 0.5, 0}).g == 0.5);
  }
}

TEST_CASE("equal meshes at one place count once, unless one lets light through") {
  const Material clear{.color = grey(1), .transparency = 1, .diffuse = 0};
  const Entity cube = colored_cube({red, green, clear});
  Scene scene = scene_with(cube);
  scene.entities.push_back(cube.with_material(blue));
  scene.entities.push_back(cube);
  // What is opaque is seen, where the two are at one place.
  CHECK(pixel_of(scene, {0.1, 0.2, 9}, {0.1, 0.2, 0}).albedo == Vec3(0, 0, 1));
}
