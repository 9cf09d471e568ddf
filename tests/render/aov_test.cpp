// These tests compare what a picture reports beside its colours (RenderOptions::aovs) with closed
// forms.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "crt/error.hpp"
#include "crt/query.hpp"
#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr Aovs all_aovs = {.depth = true,
                           .normal = true,
                           .id = true,
                           .part = true,
                           .albedo = true,
                           .samples = true,
                           .error = true};
constexpr float infinity = std::numeric_limits<float>::infinity();
/// This is a float's rounding and a bit more.
constexpr double float_rounding = 1e-6;

/// Makes a camera at (0, 0, -4) that looks along z.
Scene scene_before_eye(int width, int height) {
  Scene scene = dark_scene();
  scene.settings.width = width;
  scene.settings.height = height;
  scene.camera = {.position = {0, 0, -4}, .pointing = {0, 0, 0}};
  return scene;
}

Image with_aovs(const Scene& scene, RenderOptions options = {}) {
  options.aovs = all_aovs;
  return render(prepare(scene), options);
}

std::size_t index_of(const Image& image, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width()) +
         static_cast<std::size_t>(x);
}

double depth_at(const Image& image, int x, int y) {
  return double{image.channel("Z")[index_of(image, x, y)]};
}

std::uint32_t id_at(const Image& image, int x, int y) {
  return image.integer_channel("id")[index_of(image, x, y)];
}

Vec3 normal_at(const Image& image, int x, int y) {
  const std::size_t i = index_of(image, x, y);
  return {image.channel("N.X")[i], image.channel("N.Y")[i], image.channel("N.Z")[i]};
}

Vec3 albedo_at(const Image& image, int x, int y) {
  const std::size_t i = index_of(image, x, y);
  return {image.channel("albedo.R")[i], image.channel("albedo.G")[i], image.channel("albedo.B")[i]};
}

bool is_near(const Vec3& a, const Vec3& b, double tolerance = float_rounding) {
  return glm::distance(a, b) <= tolerance;
}

/// Returns the direction, of unit length, through a place of a picture of scene_before_eye.
Vec3 direction_through(const Image& image, double x, double y) {
  const double tangent = std::tan(std::numbers::pi / 6);
  const double nx = 2 * x / image.width() - 1;
  const double ny = 1 - 2 * y / image.height();
  return glm::normalize(Vec3(nx * tangent * image.width() / image.height(), ny * tangent, 1));
}

bool same_channels(const Image& a, const Image& b) {
  return std::equal(a.channels().begin(), a.channels().end(), b.channels().begin(),
                    b.channels().end(), [](const ImageChannel& one, const ImageChannel& other) {
                      return one.name == other.name && one.values == other.values;
                    });
}

/// Makes a scene of all kinds of things, behind a lens.
Scene busy_scene() {
  Scene scene = scene_before_eye(45, 34);
  scene.settings.supersampling = 2;
  scene.settings.dof_samples = 3;
  scene.camera.aperture = 80;
  scene.camera.focal_distance = 3;
  scene.lights = {PointLight{.origin = {3, 5, -4}}};
  Material crystal = glass(1.5);
  crystal.absorption = {0.1, 0.4, 0.2};
  scene.entities = {
      Plane{.position = {0, -1, 0}, .material = Material{.color = Pattern(Checker{})}},
      Sphere{.center = {-1, 0, 0}, .radius = 0.9, .material = crystal},
      Entity(Box{.corner_a = {0, -1, 0}, .corner_b = {1.5, 1, 1}}) -
          Entity(Sphere{.center = {0.8, 0.2, 0}, .radius = 0.5})};
  return scene;
}

}  // namespace

TEST_CASE("nobody who does not ask gets channels, and the colours are the same for those who do") {
  const PreparedScene scene = prepare(busy_scene());
  const Image plain = render(scene);
  CHECK(plain.channels().empty());
  CHECK(plain.channel("Z").empty());
  const Image extended = render(scene, {.aovs = all_aovs});
  CHECK(same_pixels(plain, extended));
  CHECK(extended.stats().camera_rays == plain.stats().camera_rays);
  CHECK(extended.channels().size() == 11);
}

TEST_CASE("parts of an entity have their ids in pictures, as in queries") {
  Scene scene = scene_before_eye(61, 61);
  const Entity block = Entity(Box{.corner_a = {-1, -1, -0.5}}).with_id(10);
  const Entity drill = Entity(Sphere{.center = {0, 0, -0.5}, .radius = 0.5}).with_id(11);
  scene.entities = {(block - drill).with_id(5)};
  const PreparedScene prepared = prepare(scene);
  const Image image = with_aovs(scene);
  const auto ids = image.integer_channel("part");
  RayQueries queries(prepared);
  std::array<std::size_t, 3> counts{};
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 61; ++x) {
      const Ray ray = camera_ray(prepared, x + 0.5, y + 0.5);
      HitPart part;
      queries.parts(std::span(&ray, 1), std::span(&part, 1));
      REQUIRE(ids[index_of(image, x, y)] == part.part_id);
      REQUIRE(id_at(image, x, y) == part.entity_id);
      const std::size_t kind = part.part_id == no_entity_id ? 0 : part.part_id - 9;
      REQUIRE(kind < 3);
      ++counts[kind];
    }
  }
  for (const std::size_t count : counts) CHECK(count > 100);
}

TEST_CASE("each AOV is the same by itself as with all others") {
  const PreparedScene scene = prepare(busy_scene());
  const Image all = render(scene, {.aovs = all_aovs});
  std::size_t count = 0;
  for (const Aovs& aovs :
       {Aovs{.depth = true}, Aovs{.normal = true}, Aovs{.id = true}, Aovs{.part = true},
        Aovs{.albedo = true}, Aovs{.samples = true}, Aovs{.error = true}}) {
    const Image one = render(scene, {.aovs = aovs});
    for (const ImageChannel& channel : one.channels()) {
      CAPTURE(channel.name);
      const auto same =
          std::find_if(all.channels().begin(), all.channels().end(),
                       [&](const ImageChannel& other) { return other.name == channel.name; });
      REQUIRE(same != all.channels().end());
      CHECK(same->values == channel.values);
      ++count;
    }
  }
  CHECK(count == all.channels().size());
}

TEST_CASE("a sphere's depth, normal, id and albedo are those of the closed form") {
  Scene scene = scene_before_eye(33, 25);
  const Vec3 center(0.3, -0.2, 1);
  const double radius = 1.7;
  const Material red{.color = Color{0.7, 0.2, 0.1}};
  scene.entities = {
      Plane{.position = {0, -100, 0}},
      Entity(Sphere{.center = center, .radius = radius, .material = red}).with_id(70000007)};
  const Image image = with_aovs(scene);
  int hits = 0;
  for (int y = 0; y < 25; ++y) {
    for (int x = 0; x < 33; ++x) {
      const Vec3 direction = direction_through(image, x + 0.5, y + 0.5);
      const Vec3 to_center = center - scene.camera.position;
      const double middle = glm::dot(to_center, direction);
      const double discriminant =
          middle * middle - glm::dot(to_center, to_center) + radius * radius;
      if (discriminant < 0) continue;
      ++hits;
      const double distance = middle - std::sqrt(discriminant);
      REQUIRE(depth_at(image, x, y) == doctest::Approx(distance).epsilon(float_rounding));
      const Vec3 normal = (scene.camera.position + distance * direction - center) / radius;
      REQUIRE(is_near(normal_at(image, x, y), normal));
      REQUIRE(id_at(image, x, y) == 70000007);
      REQUIRE(is_near(albedo_at(image, x, y), {0.7, 0.2, 0.1}));
    }
  }
  CHECK(hits > 100);
}

TEST_CASE(
    "a plane is seen from outside and from within: its normal is turned to the viewer, its id is "
    "its place") {
  Scene scene = scene_before_eye(9, 9);
  for (const double facing : {-1.0, 1.0}) {
    scene.entities = {Sphere{.center = {0, 0, -50}},
                      Plane{.normal = {0, 0, facing}, .position = {0, 0, 2}}};
    const Image image = with_aovs(scene);
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 9; ++x) {
        const double expected = 6 / direction_through(image, x + 0.5, y + 0.5).z;
        REQUIRE(depth_at(image, x, y) == doctest::Approx(expected).epsilon(float_rounding));
        REQUIRE(is_near(normal_at(image, x, y), {0, 0, -1}));
        REQUIRE(id_at(image, x, y) == 1);
      }
    }
  }
}

TEST_CASE("where nothing is, depth is infinite, the id is none, and the rest is 0") {
  const Image image = with_aovs(scene_before_eye(3, 2));
  for (const float depth : image.channel("Z")) CHECK(depth == infinity);
  for (const std::uint32_t id : image.integer_channel("id")) CHECK(id == no_entity_id);
  CHECK(normal_at(image, 1, 1) == Vec3(0));
  CHECK(albedo_at(image, 1, 1) == Vec3(0));
}

TEST_CASE("an ellipsoid's normal is that of its surface, not its sphere's") {
  Scene scene = scene_before_eye(21, 21);
  const Vec3 half_axes(1.5, 0.7, 0.4);
  scene.entities = {Entity(Sphere{}).transformed(crt::scale(half_axes))};
  const Image image = with_aovs(scene);
  int hits = 0;
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 21; ++x) {
      if (depth_at(image, x, y) == double{infinity}) continue;
      ++hits;
      const Vec3 point = scene.camera.position +
                         depth_at(image, x, y) * direction_through(image, x + 0.5, y + 0.5);
      // This is the gradient of (x/a)^2 + (y/b)^2 + (z/c)^2 = 1. Near the silhouette it turns fast.
      const Vec3 scaled = point / half_axes;
      CHECK(glm::dot(scaled, scaled) == doctest::Approx(1).epsilon(1e-5));
      CHECK(is_near(normal_at(image, x, y), glm::normalize(point / (half_axes * half_axes)), 1e-4));
    }
  }
  CHECK(hits > 20);
}

TEST_CASE("a cut face has its cutter's material and the whole's id") {
  Scene scene = scene_before_eye(1, 1);
  const Material outside{.color = Color{1, 0, 0}};
  const Material inside{.color = Color{0, 0.5, 1}};
  const Entity whole = Box{.corner_a = {-2, -2, -1}, .corner_b = {2, 2, 1}, .material = outside};
  const Entity cutter = Sphere{.center = {0, 0, -1}, .radius = 0.75, .material = inside};
  scene.entities = {Sphere{.center = {0, 0, -90}}, (whole - cutter).with_id(12)};
  const Image image = with_aovs(scene);
  CHECK(depth_at(image, 0, 0) == 3.75);
  CHECK(is_near(albedo_at(image, 0, 0), {0, 0.5, 1}));
  CHECK(is_near(normal_at(image, 0, 0), {0, 0, -1}));
  CHECK(id_at(image, 0, 0) == 12);
}

TEST_CASE("normal and albedo are means over a pixel's samples, depth and id those of its middle") {
  Scene scene = scene_before_eye(1, 1);
  scene.settings.supersampling = 4;
  // Columns of samples are at -3/4, -1/4, 1/4 and 3/4 of the distance to the picture's edge.
  const double edge = 4 * std::tan(std::numbers::pi / 6);
  const Material red{.color = Color{1, 0, 0}};
  const Material blue{.color = Color{0, 0, 1}};
  const auto slab = [&](double from, double to, double z, const Material& material) {
    return Entity(Box{.corner_a = {from * edge, -9, z},
                      .corner_b = {to * edge, 9, z + 0.5},
                      .material = material});
  };
  scene.entities = {slab(-9, 9, 1, red), slab(-0.5, 9, 0, blue)};
  const Image two = with_aovs(scene);
  CHECK(is_near(albedo_at(two, 0, 0), {0.25, 0, 0.75}));
  CHECK(is_near(normal_at(two, 0, 0), {0, 0, -1}));
  CHECK(depth_at(two, 0, 0) == 4);
  CHECK(id_at(two, 0, 0) == 1);
  scene.entities = {slab(0.5, 9, 0, blue)};
  const Image quarter = with_aovs(scene);
  CHECK(is_near(albedo_at(quarter, 0, 0), {0, 0, 0.25}));
  CHECK(is_near(normal_at(quarter, 0, 0), {0, 0, -0.25}));
  CHECK(depth_at(quarter, 0, 0) == double{infinity});
  CHECK(id_at(quarter, 0, 0) == no_entity_id);
}

TEST_CASE("a lens blurs albedo as it blurs colours, and leaves depth and id sharp") {
  Scene scene = scene_before_eye(24, 24);
  scene.settings.dof_samples = 64;
  scene.camera.aperture = 300;
  scene.camera.focal_distance = 2;
  scene.lights = {glow(1)};
  scene.entities = {Sphere{.radius = 1, .material = inert()}};
  const Image image = with_aovs(scene);
  scene.camera.aperture = 0;
  const Image sharp = with_aovs(scene);
  CHECK(
      std::equal(image.channel("Z").begin(), image.channel("Z").end(), sharp.channel("Z").begin()));
  CHECK(image.integer_channel("id")[0] == no_entity_id);
  int partly = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      // The sphere is white and evenly lit, so that its light equals its albedo.
      REQUIRE(albedo_at(image, x, y).x ==
              doctest::Approx(image.at(x, y).r).epsilon(float_rounding));
      partly += image.at(x, y).r > 0.1 && image.at(x, y).r < 0.9 ? 1 : 0;
    }
  }
  CHECK(partly > 50);
}

TEST_CASE("the first surface counts, be it a mirror or glass") {
  Scene scene = scene_before_eye(1, 1);
  Material clear = glass(1.5);
  clear.color = Color{0.9, 0.8, 0.7};
  for (const Material& material :
       {clear, Material{.color = Color{0.9, 0.8, 0.7}, .reflectivity = 1}}) {
    scene.entities = {Sphere{.center = {0, 0, 9}}, Sphere{.radius = 1, .material = material}};
    const Image image = with_aovs(scene);
    CHECK(depth_at(image, 0, 0) == 3);
    CHECK(id_at(image, 0, 0) == 1);
    CHECK(is_near(albedo_at(image, 0, 0), {0.9, 0.8, 0.7}));
    CHECK(is_near(normal_at(image, 0, 0), {0, 0, -1}));
  }
}

TEST_CASE("seen through a medium that swallows all light a surface is still reported") {
  Scene scene = scene_before_eye(1, 1);
  Material ink = glass(1);
  ink.absorption = {1e6, 1e6, 1e6};
  const Material red{.color = Color{1, 0, 0}};
  scene.entities = {Sphere{.radius = 50, .material = ink}, Sphere{.radius = 1, .material = red}};
  const Image image = with_aovs(scene);
  CHECK(image.at(0, 0).r == 0);
  CHECK(depth_at(image, 0, 0) == 3);
  CHECK(is_near(albedo_at(image, 0, 0), {1, 0, 0}));
}

TEST_CASE("of surfaces at one place the one that is seen is reported") {
  Scene scene = scene_before_eye(1, 1);
  const Material red{.color = Color{1, 0, 0}};
  const Entity clear = Box{.corner_a = {-1, -1, 0}, .corner_b = {1, 1, 1}, .material = glass(1.5)};
  const Entity opaque = Box{.corner_a = {-1, -1, 0}, .corner_b = {1, 1, 2}, .material = red};
  scene.entities = {clear, opaque};
  const Image image = with_aovs(scene);
  CHECK(id_at(image, 0, 0) == 1);
  CHECK(is_near(albedo_at(image, 0, 0), {1, 0, 0}));
}

TEST_CASE("an orthographic camera measures from its image plane") {
  Scene scene = scene_before_eye(8, 8);
  scene.camera.projection = Projection::orthographic;
  scene.entities = {Plane{.normal = {0, 0, -1}, .position = {0, 0, 3}}};
  const Image image = with_aovs(scene);
  for (const float depth : image.channel("Z")) CHECK(depth == 7);
}

TEST_CASE("channels have the same bytes for any number of threads and in any region") {
  for (const double target_error : {0.0, 0.02}) {
    CAPTURE(target_error);
    Scene busy = busy_scene();
    busy.settings.target_error = target_error;
    busy.settings.max_samples = 256;
    const PreparedScene scene = prepare(busy);
    const Image reference = render(scene, {.threads = 1, .aovs = all_aovs});
    CHECK(same_channels(render(scene, {.threads = 7, .aovs = all_aovs}), reference));
    const Region region{7, 5, 29, 23};
    const Image part = render(scene, {.region = region, .aovs = all_aovs});
    for (int y = 0; y < region.height; ++y) {
      for (int x = 0; x < region.width; ++x) {
        const int whole_x = region.x + x;
        const int whole_y = region.y + y;
        REQUIRE(depth_at(part, x, y) == depth_at(reference, whole_x, whole_y));
        REQUIRE(id_at(part, x, y) == id_at(reference, whole_x, whole_y));
        REQUIRE(normal_at(part, x, y) == normal_at(reference, whole_x, whole_y));
        REQUIRE(albedo_at(part, x, y) == albedo_at(reference, whole_x, whole_y));
        REQUIRE(part.integer_channel("samples")[index_of(part, x, y)] ==
                reference.integer_channel("samples")[index_of(reference, whole_x, whole_y)]);
        REQUIRE(part.channel("error")[index_of(part, x, y)] ==
                reference.channel("error")[index_of(reference, whole_x, whole_y)]);
      }
    }
  }
}

TEST_CASE("of a plain grid all pixels have the same samples and nobody knows the error") {
  Scene scene = busy_scene();
  for (const double aperture : {80.0, 0.0}) {
    scene.camera.aperture = aperture;
    const Image image = with_aovs(scene);
    for (const std::uint32_t samples : image.integer_channel("samples")) {
      REQUIRE(samples == (aperture > 0 ? 12 : 4));
    }
    for (const float error : image.channel("error")) REQUIRE(error == 1);
  }
}

TEST_CASE("of an adaptive picture samples and errors are those that the statistics sum up") {
  Scene scene = busy_scene();
  scene.settings.target_error = 4.0 / 255;
  scene.settings.max_samples = 128;
  const Image image = with_aovs(scene);
  const RenderStats& stats = image.stats();
  const auto samples = image.integer_channel("samples");
  const auto errors = image.channel("error");
  CHECK(*std::min_element(samples.begin(), samples.end()) == stats.samples_min);
  CHECK(*std::max_element(samples.begin(), samples.end()) == stats.samples_max);
  CHECK(stats.samples_min < stats.samples_max);
  CHECK(double{*std::max_element(errors.begin(), errors.end())} == stats.half_width_max);
  std::uint64_t unresolved = 0;
  for (const float error : errors)
    unresolved += double{error} > scene.settings.target_error ? 1 : 0;
  CHECK(unresolved == stats.pixels_unresolved);
}

TEST_CASE(
    "in an adaptive picture normal and albedo are means over the samples that each pixel has") {
  Scene scene = scene_before_eye(16, 16);
  scene.settings.target_error = 2.0 / 255;
  scene.lights = {glow(1)};
  scene.entities = {Sphere{.radius = 1, .material = inert()}};
  const Image image = with_aovs(scene);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      // It is white and evenly lit, so that its light equals its albedo.
      REQUIRE(albedo_at(image, x, y).x == doctest::Approx(image.at(x, y).r).epsilon(1e-5));
    }
  }
  CHECK(image.stats().samples_min < image.stats().samples_max);
  CHECK(same_pixels(image, render(prepare(scene))));
}

TEST_CASE("depth and id are those that a ray query through the pixel's middle finds") {
  const Scene scene = busy_scene();
  const PreparedScene prepared = prepare(scene);
  const Image image = render(prepared, {.aovs = all_aovs});
  for (int y = 0; y < image.height(); y += 3) {
    for (int x = 0; x < image.width(); x += 2) {
      const auto hit =
          intersect(prepared, {.origin = scene.camera.position,
                               .direction = direction_through(image, x + 0.5, y + 0.5)});
      REQUIRE(id_at(image, x, y) == (hit ? hit->entity_id : no_entity_id));
      if (hit) REQUIRE(depth_at(image, x, y) == doctest::Approx(hit->t).epsilon(float_rounding));
    }
  }
}
