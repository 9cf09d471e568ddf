// These tests check ray queries: batches, strides, crossings, and that they see what pictures see.
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "support.hpp"

using namespace crt::test;

namespace {

std::vector<crt_ray> random_rays(std::size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-2, 2);
  std::vector<crt_ray> rays(count);
  for (crt_ray& ray : rays) {
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = place(random);
      ray.direction[axis] = place(random);
    }
    ray.t_min = 0;
    ray.t_max = infinity;
  }
  return rays;
}

bool same(const crt_hit& a, const crt_hit& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

TEST_CASE("a batch gives what single rays give, and occlusion and crossings agree with it") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const std::vector<crt_ray> rays = random_rays(20000);
  std::vector<crt_hit> hits(rays.size());
  std::vector<std::uint8_t> occluded(rays.size(), 7);
  REQUIRE(crt_intersect(prepared.get(), rays.data(), 0, rays.size(), hits.data(), 0) == CRT_OK);
  REQUIRE(crt_occluded(prepared.get(), rays.data(), 0, rays.size(), occluded.data()) == CRT_OK);
  std::vector<double> distances(rays.size(), 7);
  std::vector<std::uint32_t> ids(rays.size(), 7);
  REQUIRE(crt_distances(prepared.get(), rays.data(), 0, rays.size(), distances.data(),
                        ids.data()) == CRT_OK);
  std::size_t found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    crt_hit single;
    REQUIRE(crt_intersect(prepared.get(), &rays[i], 0, 1, &single, 0) == CRT_OK);
    REQUIRE(same(single, hits[i]));
    REQUIRE(occluded[i] == (hits[i].t < infinity ? 1 : 0));
    REQUIRE(distances[i] == hits[i].t);
    REQUIRE(ids[i] == hits[i].entity_id);
    double distance = 7;
    REQUIRE(crt_distances(prepared.get(), &rays[i], 0, 1, &distance, nullptr) == CRT_OK);
    REQUIRE(distance == hits[i].t);
    crt_hit crossings[16];
    std::size_t count = 99;
    REQUIRE(crt_crossings(prepared.get(), &rays[i], crossings, 16, &count) == CRT_OK);
    REQUIRE((count > 0) == (hits[i].t < infinity));
    if (count == 0) continue;
    ++found;
    REQUIRE(crossings[0].t == hits[i].t);
    for (std::size_t k = 1; k < count; ++k) REQUIRE(crossings[k - 1].t <= crossings[k].t);
  }
  CHECK(found > 1000);
  CHECK(found < rays.size() - 1000);
}

TEST_CASE(
    "rays and hits lie where the caller wants them, unaligned too, and nothing else is touched") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const std::vector<crt_ray> rays = random_rays(3000);
  std::vector<crt_hit> expected(rays.size());
  REQUIRE(crt_intersect(prepared.get(), rays.data(), 0, rays.size(), expected.data(), 0) == CRT_OK);

  constexpr std::size_t ray_stride = 77;
  constexpr std::size_t hit_stride = 61;
  std::vector<unsigned char> ray_bytes(3000 * ray_stride + 1);
  std::vector<unsigned char> hit_bytes(3000 * hit_stride + 1, 0x5a);
  for (std::size_t i = 0; i < rays.size(); ++i)
    std::memcpy(&ray_bytes[1 + i * ray_stride], &rays[i], 64);
  REQUIRE(crt_intersect(prepared.get(), reinterpret_cast<const crt_ray*>(&ray_bytes[1]), ray_stride,
                        3000, reinterpret_cast<crt_hit*>(&hit_bytes[1]), hit_stride) == CRT_OK);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    crt_hit hit;
    std::memcpy(&hit, &hit_bytes[1 + i * hit_stride], sizeof hit);
    REQUIRE(same(hit, expected[i]));
    for (std::size_t k = sizeof hit; k < hit_stride; ++k)
      REQUIRE(hit_bytes[1 + i * hit_stride + k] == 0x5a);
  }
}

TEST_CASE("hits may take the place of their rays") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  std::vector<crt_ray> rays = random_rays(3000);
  std::vector<crt_hit> expected(rays.size());
  REQUIRE(crt_intersect(prepared.get(), rays.data(), 0, rays.size(), expected.data(), 0) == CRT_OK);
  REQUIRE(crt_intersect(prepared.get(), rays.data(), 0, rays.size(),
                        reinterpret_cast<crt_hit*>(rays.data()), sizeof(crt_ray)) == CRT_OK);
  for (std::size_t i = 0; i < rays.size(); ++i)
    REQUIRE(std::memcmp(&rays[i], &expected[i], sizeof(crt_hit)) == 0);
}

TEST_CASE("a hit tells place, normal, entity and side; a miss nothing but infinity") {
  const SceneHandle scene = new_scene();
  const EntityHandle ball = sphere({0, 0, 0}, 2);
  const EntityHandle named = made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_id(ball.get(), 4000000000u, out); });
  REQUIRE(crt_scene_add_entity(scene.get(), named.get()) == CRT_OK);
  const PreparedHandle prepared = prepare(scene.get());
  const crt_ray rays[] = {{{-5, 0, 0}, {10, 0, 0}, 0, infinity},
                          {{0, 0, 0}, {0, 4, 0}, 0, infinity},
                          {{0, 5, 0}, {0, 1, 0}, 0, infinity},
                          {{-5, 0, 0}, {10, 0, 0}, 0, 0.29},
                          {{0, 5, 0}, {0, 1, 0}, -infinity, infinity}};
  crt_hit hits[5];
  REQUIRE(crt_intersect(prepared.get(), rays, 0, 5, hits, 0) == CRT_OK);
  CHECK(hits[0].t == doctest::Approx(0.3));  // in units of the direction's length
  CHECK(hits[0].normal[0] == doctest::Approx(-1));
  CHECK(hits[0].entity_id == 4000000000u);
  CHECK(hits[0].flags == CRT_HIT_ENTERING);
  CHECK(hits[1].t == doctest::Approx(0.5));
  CHECK(hits[1].normal[1] == doctest::Approx(1));
  CHECK(hits[1].flags == CRT_HIT_BACKFACE);
  for (const int miss : {2, 3}) {
    crt_hit expected = {};
    expected.t = infinity;
    CHECK(same(hits[miss], expected));
  }
  CHECK(hits[4].t == doctest::Approx(-7));
}

TEST_CASE("crossings are counted however small the array for them is") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  // The ray passes the block with the hole, in at the hole's bottom and out at the back, and the
  // plain part.
  const crt_ray ray = {{0.7, 0, 0}, {0, 0, 1}, 0, infinity};
  std::size_t count = 0;
  REQUIRE(crt_crossings(prepared.get(), &ray, nullptr, 0, &count) == CRT_OK);
  CHECK(count == 2);
  crt_hit hits[3] = {};
  REQUIRE(crt_crossings(prepared.get(), &ray, hits, 1, &count) == CRT_OK);
  CHECK(count == 2);
  CHECK(hits[0].t == doctest::Approx(1.9));
  CHECK(hits[0].flags == CRT_HIT_ENTERING);
  CHECK(hits[0].normal[2] == doctest::Approx(-1));
  CHECK(hits[1].t == 0);
  REQUIRE(crt_crossings(prepared.get(), &ray, hits, 3, &count) == CRT_OK);
  CHECK(hits[1].t == doctest::Approx(2.5));
  CHECK(hits[1].flags == CRT_HIT_BACKFACE);
  CHECK(hits[1].entity_id == 1);
}

TEST_CASE("rays see what the picture sees, pixel by pixel") {
  // Each entity has a channel of its own, so that a pixel shows which entity its ray met.
  constexpr int width = 96;
  constexpr int height = 72;
  const SceneHandle scene = new_scene();
  const auto add = [&](const EntityHandle& entity, double r, double g, double b) {
    crt_material material;
    REQUIRE(crt_material_init(&material, sizeof material) == CRT_OK);
    material.color[0] = r;
    material.color[1] = g;
    material.color[2] = b;
    const EntityHandle dressed = made<EntityHandle>(
        [&](crt_entity** out) { return crt_entity_with_material(entity.get(), &material, out); });
    REQUIRE(crt_scene_add_entity(scene.get(), dressed.get()) == CRT_OK);
  };
  const EntityHandle block = box({0.2, -0.5, 1.5}, {1.2, 0.5, 2.5});
  const EntityHandle hole = sphere({0.7, 0, 1.5}, 0.4);
  add(sphere({-0.4, 0, 2}, 0.5), 1, 0, 0);
  add(difference(block.get(), hole.get()), 0, 1, 0);
  add(sphere({0, -100.5, 2}, 100), 0, 0, 1);
  crt_light light;
  REQUIRE(crt_light_init(&light, sizeof light) == CRT_OK);
  light.origin[2] = -1;  // where the camera is, so that whatever is seen is lit
  REQUIRE(crt_scene_add_light(scene.get(), &light) == CRT_OK);
  crt_settings settings;
  REQUIRE(crt_settings_init(&settings, sizeof settings) == CRT_OK);
  settings.width = width;
  settings.height = height;
  REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
  const PreparedHandle prepared = prepare(scene.get());
  const ImageHandle image = render(prepared.get());
  const float* const pixels = crt_image_pixels(image.get(), nullptr);

  // The default camera is at z = -1 and looks along z, 60 degrees from bottom to top.
  const double half = std::tan(std::acos(-1) / 6);
  std::vector<crt_ray> rays;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double nx = 2 * (x + 0.5) / width - 1;
      const double ny = 1 - 2 * (y + 0.5) / height;
      rays.push_back({{0, 0, -1}, {nx * half * width / height, ny * half, 1}, 0, infinity});
    }
  }
  std::vector<crt_hit> hits(rays.size());
  REQUIRE(crt_intersect(prepared.get(), rays.data(), 0, rays.size(), hits.data(), 0) == CRT_OK);
  std::array<int, 4> seen = {0, 0, 0, 0};
  int differing = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const float* const pixel = pixels + 4 * i;
    const bool missed = hits[i].t == infinity;
    const std::size_t whom = missed ? 3 : hits[i].entity_id;
    ++seen[whom];
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const bool bright = pixel[channel] > 0;
      if (bright != (missed || channel == whom)) ++differing;
    }
  }
  for (const int count : seen) CHECK(count > 100);
  CHECK(differing == 0);
}

TEST_CASE("parts are those of the nearest hits, and lie where the caller wants them") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  std::vector<crt_ray> rays = random_rays(3000);
  std::vector<crt_hit> hits(rays.size());
  std::vector<crt_hit_part> parts(rays.size());
  REQUIRE(crt_intersect(prepared.get(), rays.data(), 0, rays.size(), hits.data(), 0) == CRT_OK);
  REQUIRE(crt_hit_parts(prepared.get(), rays.data(), 0, rays.size(), parts.data(), 0) == CRT_OK);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool is_miss = hits[i].t == infinity;
    REQUIRE(parts[i].entity_id == (is_miss ? UINT32_MAX : hits[i].entity_id));
    REQUIRE((parts[i].part_id == UINT32_MAX) == is_miss);
    REQUIRE((parts[i].face == UINT32_MAX) == is_miss);
    REQUIRE(parts[i].reserved == 0);
    REQUIRE(parts[i].u == hits[i].u);
    REQUIRE(parts[i].v == hits[i].v);
  }
  // They may take the places of their own rays.
  auto* in_place = reinterpret_cast<crt_hit_part*>(rays.data());
  REQUIRE(crt_hit_parts(prepared.get(), rays.data(), 0, rays.size(), in_place, sizeof(crt_ray)) ==
          CRT_OK);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    crt_hit_part part;
    std::memcpy(&part, &rays[i], sizeof part);
    REQUIRE(std::memcmp(&part, &parts[i], sizeof part) == 0);
  }
  std::vector<crt_ray> wrong = random_rays(3);
  wrong[2].direction[0] = std::nan("");
  parts[0].face = 99;
  CHECK(crt_hit_parts(prepared.get(), wrong.data(), 0, 3, parts.data(), 0) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(parts[0].face == 99);
  CHECK(std::strstr(crt_error_message(), "rays[2]") != nullptr);
}

TEST_CASE("full hits have what hits and parts have, and rays go on from them in place") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  std::vector<crt_ray> rays = random_rays(3000);
  const std::size_t count = rays.size();
  std::vector<crt_hit> hits(count);
  std::vector<crt_hit_part> parts(count);
  std::vector<crt_full_hit> full(count);
  REQUIRE(crt_intersect(prepared.get(), rays.data(), 0, count, hits.data(), 0) == CRT_OK);
  REQUIRE(crt_hit_parts(prepared.get(), rays.data(), 0, count, parts.data(), 0) == CRT_OK);
  REQUIRE(crt_trace(prepared.get(), rays.data(), 0, nullptr, 0, count, full.data(), 0) == CRT_OK);
  for (std::size_t i = 0; i < count; ++i) {
    REQUIRE(full[i].t == hits[i].t);
    REQUIRE(std::memcmp(full[i].normal, hits[i].normal, sizeof full[i].normal) == 0);
    REQUIRE(full[i].u == hits[i].u);
    REQUIRE(full[i].v == hits[i].v);
    REQUIRE(full[i].flags == hits[i].flags);
    REQUIRE(full[i].entity_id == parts[i].entity_id);
    REQUIRE(full[i].part_id == parts[i].part_id);
    REQUIRE(full[i].face == parts[i].face);
    REQUIRE(full[i].user == 0);
  }
  // All crossings, by hits of their own and at once.
  std::vector<std::size_t> first(count + 1, 7);
  REQUIRE(crt_trace_all(prepared.get(), rays.data(), 0, nullptr, 0, count, nullptr, 0,
                        first.data()) == CRT_ERROR_LIMIT);
  const std::size_t total = first[count];
  std::vector<crt_full_hit> all(total);
  REQUIRE(crt_trace_all(prepared.get(), rays.data(), 0, nullptr, 0, count, all.data(), total,
                        first.data()) == CRT_OK);
  REQUIRE(first[count] == total);
  for (std::size_t i = 0; i < count; ++i) {
    crt_hit crossings[16];
    std::size_t number = 0;
    REQUIRE(crt_crossings(prepared.get(), &rays[i], crossings, 16, &number) == CRT_OK);
    REQUIRE(first[i + 1] - first[i] == number);
    for (std::size_t k = 0; k < number; ++k) REQUIRE(all[first[i] + k].t == crossings[k].t);
  }
  // Walks whose starts lie in the hits that are written.
  std::vector<std::size_t> met(count);
  for (int step = 0; step < 20; ++step) {
    for (std::size_t i = 0; i < count; ++i) {
      if (full[i].t == infinity) continue;
      ++met[i];
      std::memcpy(rays[i].origin, full[i].position, sizeof rays[i].origin);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (full[i].t == infinity) rays[i].t_max = 0;  // it has ended
    }
    REQUIRE(crt_trace(prepared.get(), rays.data(), 0, &full[0].start, sizeof full[0], count,
                      full.data(), 0) == CRT_OK);
  }
  for (std::size_t i = 0; i < count; ++i) REQUIRE(met[i] == first[i + 1] - first[i]);
}

TEST_CASE("a start of nowhere in the scene is refused, with its index") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const std::vector<crt_ray> rays = random_rays(3);
  std::vector<crt_start> starts(3, crt_start{});
  starts[1].bits[0] = 12345;
  std::vector<crt_full_hit> full(3);
  full[0].t = 99;
  CHECK(crt_trace(prepared.get(), rays.data(), 0, starts.data(), 0, 3, full.data(), 0) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(std::strstr(crt_error_message(), "starts[1]") != nullptr);
  CHECK(full[0].t == 99);
  std::uint8_t blocked[3] = {7, 7, 7};
  CHECK(crt_blocked(prepared.get(), rays.data(), 0, nullptr, starts.data(), 0, 3, blocked) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(std::strstr(crt_error_message(), "ends[1]") != nullptr);
  CHECK(blocked[0] == 7);
  const double points[6] = {0, 0, 0, 0, std::nan(""), 0};
  std::uint32_t ids[2] = {7, 7};
  CHECK(crt_locate(prepared.get(), points, 0, 2, ids, nullptr, nullptr) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(std::strstr(crt_error_message(), "points[1]") != nullptr);
  CHECK(ids[0] == 7);
}

TEST_CASE("camera rays lead to what a picture shows") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  crt_settings settings;
  crt_settings_init(&settings, sizeof settings);
  REQUIRE(crt_scene_get_settings(scene.get(), &settings) == CRT_OK);
  std::vector<double> places;
  for (int y = 0; y < settings.height; ++y) {
    for (int x = 0; x < settings.width; ++x) places.insert(places.end(), {x + 0.5, y + 0.5});
  }
  const std::size_t count = places.size() / 2;
  std::vector<crt_ray> rays(count);
  REQUIRE(crt_camera_rays(prepared.get(), places.data(), count, rays.data(), 0) == CRT_OK);
  std::vector<double> distances(count);
  REQUIRE(crt_distances(prepared.get(), rays.data(), 0, count, distances.data(), nullptr) ==
          CRT_OK);
  crt_render_options options;
  crt_render_options_init(&options, sizeof options);
  options.aovs = CRT_AOV_DEPTH;
  const ImageHandle image = render(prepared.get(), &options);
  const float* depth = crt_image_channel(image.get(), "Z");
  REQUIRE(depth != nullptr);
  for (std::size_t i = 0; i < count; ++i) {
    if (distances[i] == infinity) {
      REQUIRE(depth[i] == std::numeric_limits<float>::infinity());
    } else {
      REQUIRE(depth[i] == doctest::Approx(distances[i]).epsilon(1e-6));
    }
  }
  const double wrong[] = {1, 1, std::nan(""), 1};
  const crt_ray untouched = rays[0];
  CHECK(crt_camera_rays(prepared.get(), wrong, 2, rays.data(), 0) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(std::memcmp(&untouched, &rays[0], sizeof untouched) == 0);
  CHECK(crt_camera_rays(prepared.get(), nullptr, 0, nullptr, 0) == CRT_OK);
}

TEST_CASE("an entity's bounds hold it") {
  const Numbers center = {1, 2, 3};
  const EntityHandle ball = sphere(center, 2);
  double lower[3];
  double upper[3];
  REQUIRE(crt_entity_bounds(ball.get(), lower, upper) == CRT_OK);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CHECK(lower[axis] <= center[axis] - 2);
    CHECK(lower[axis] == doctest::Approx(center[axis] - 2));
    CHECK(upper[axis] >= center[axis] + 2);
    CHECK(upper[axis] == doctest::Approx(center[axis] + 2));
  }
}

TEST_CASE("a ray that is none is refused with its index, and no answer is written") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const crt_ray good = {{-0.4, 0, -5}, {0, 0, 1}, 0, infinity};
  for (const std::size_t count : {std::size_t{10}, std::size_t{5000}}) {
    std::vector<crt_ray> rays(count, good);
    rays[count - 3].direction[2] = 0;
    rays[count - 2].origin[1] = not_a_number;
    std::vector<crt_hit> hits(count);
    for (crt_hit& hit : hits) hit.t = 42;
    CHECK(crt_intersect(prepared.get(), rays.data(), 0, count, hits.data(), 0) ==
          CRT_ERROR_INVALID_ARGUMENT);
    CHECK(says("rays[" + std::to_string(count - 3) + "]"));
    CHECK(says("direction"));
    for (const crt_hit& hit : hits) CHECK(hit.t == 42);
    std::vector<std::uint8_t> occluded(count, 42);
    CHECK(crt_occluded(prepared.get(), rays.data(), 0, count, occluded.data()) ==
          CRT_ERROR_INVALID_ARGUMENT);
    CHECK(says("rays[" + std::to_string(count - 3) + "]"));
    CHECK(says("direction"));
    for (const std::uint8_t answer : occluded) CHECK(answer == 42);
    std::vector<double> distances(count, 42);
    std::vector<std::uint32_t> ids(count, 42);
    CHECK(crt_distances(prepared.get(), rays.data(), 0, count, distances.data(), ids.data()) ==
          CRT_ERROR_INVALID_ARGUMENT);
    CHECK(says("rays[" + std::to_string(count - 3) + "]"));
    CHECK(says("direction"));
    for (const double distance : distances) CHECK(distance == 42);
    for (const std::uint32_t id : ids) CHECK(id == 42);
  }
}
