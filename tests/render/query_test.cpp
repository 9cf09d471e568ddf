#include <doctest/doctest.h>
#include <crt/error.hpp>
#include <crt/query.hpp>
#include <crt/scene.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <vector>

using namespace crt;

namespace {

PreparedScene two_spheres() {
  Scene scene;
  scene.entities = {Sphere{.center = {0, 0, 5}, .radius = 1},
                    Entity(Sphere{.center = {0, 0, 10}}).with_id(77)};
  return prepare(scene);
}

/// Makes small things of several kinds side by side, some behind others.
PreparedScene many_kinds() {
  Scene scene;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> real(-1, 1);
  for (std::uint32_t i = 0; i < 120; ++i) {
    const Vec3 center = {1.5 * real(random), 1.5 * real(random), 5 + real(random)};
    const double size = 0.1 + 0.05 * real(random);
    const Entity sphere = Sphere{.center = center, .radius = size};
    const Entity box = Box{.corner_a = center - Vec3(size), .corner_b = center + Vec3(size)};
    const std::array<Entity, 4> kinds = {
        sphere, box, csg_difference(box, std::array{sphere.transformed(translate({0, 0, -size}))}),
        sphere.transformed(scale({1, 0.5, 1}))};
    scene.entities.push_back(kinds[i % 7 < 4 ? i % 7 : 0].with_id(i));
  }
  return prepare(scene);
}

bool same(const PlainHit& plain, const std::optional<Hit>& hit) {
  if (!hit) {
    return plain.t == std::numeric_limits<double>::infinity() && plain.normal == Vec3(0) &&
           plain.u == 0 && plain.v == 0 && plain.entity_id == 0 && plain.side == HitSide::none;
  }
  return plain.t == hit->t && plain.normal == hit->normal && plain.u == hit->u &&
         plain.v == hit->v && plain.entity_id == hit->entity_id &&
         plain.side == (hit->entering ? HitSide::entering : HitSide::leaving);
}

std::string rejected(const Ray& ray) {
  const PreparedScene scene = two_spheres();
  std::string argument;
  const auto ask = [&](const auto& question) {
    try {
      question();
      argument = "nothing";
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::invalid_argument);
      argument = error.argument();
    }
  };
  ask([&] { occluded(scene, ray); });
  ask([&] { crossings(scene, ray); });
  ask([&] { intersect(scene, ray); });
  return argument;
}

}  // namespace

TEST_CASE("the nearest hit has its place, normal and entity") {
  const PreparedScene scene = two_spheres();
  const auto hit = intersect(scene, {.origin = {0, 0, 0}, .direction = {0, 0, 1}});
  REQUIRE(hit.has_value());
  CHECK(hit->t == 4);
  CHECK(hit->position == Vec3(0, 0, 4));
  CHECK(hit->normal == Vec3(0, 0, -1));
  CHECK(hit->entering);
  CHECK(hit->entity_id == 0);
  CHECK_FALSE(intersect(scene, {.origin = {0, 3, 0}, .direction = {0, 0, 1}}).has_value());
}

TEST_CASE("crossings go in and out of every solid in order") {
  const auto hits = crossings(two_spheres(), {.origin = {0, 0, 0}, .direction = {0, 0, 2}});
  REQUIRE(hits.size() == 4);
  CHECK(hits[0].t == 2);
  CHECK(hits[1].t == 3);
  CHECK(hits[2].t == 4.5);
  CHECK(hits[3].t == 5.5);
  CHECK(hits[0].entering);
  CHECK_FALSE(hits[1].entering);
  CHECK(hits[1].normal == Vec3(0, 0, 1));
  CHECK(hits[2].entity_id == 77);
}

TEST_CASE("t is in units of the direction's length, whatever that is") {
  const PreparedScene scene = two_spheres();
  for (const double length : {1e-300, 1e-160, 1e-5, 0.3, 1.0, 7e20, 1e160, 1e307}) {
    const auto hit = intersect(scene, {.origin = {0, 0, 0}, .direction = {0, 0, length}});
    REQUIRE(hit.has_value());
    CHECK(hit->t * length == doctest::Approx(4).epsilon(1e-14));
    CHECK(hit->position == Vec3(0, 0, 4));
    CHECK(occluded(scene, {.direction = {0, 0, length}, .t_max = 4.001 / length}));
    CHECK_FALSE(occluded(scene, {.direction = {0, 0, length}, .t_max = 3.999 / length}));
  }
}

TEST_CASE("only crossings between t_min and t_max count") {
  const PreparedScene scene = two_spheres();
  const auto count = [&](double t_min, double t_max) {
    return crossings(scene,
                     {.origin = {0, 0, 0}, .direction = {0, 0, 1}, .t_min = t_min, .t_max = t_max})
        .size();
  };
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(count(0, 5) == 1);
  CHECK(count(4.5, 10) == 2);
  CHECK(count(-inf, inf) == 4);
  CHECK(count(20, 30) == 0);
  CHECK(intersect(scene, {.origin = {0, 0, 0}, .direction = {0, 0, 1}, .t_min = 4.5})->t == 6);
  CHECK(intersect(scene, {.origin = {0, 0, 20}, .direction = {0, 0, 1}, .t_min = -15})->t == -14);
}

TEST_CASE("a ray without a direction or with a number that is none is refused, and said why") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(rejected({.origin = {nan, 0, 0}}) == "origin");
  CHECK(rejected({.origin = {0, inf, 0}}) == "origin");
  CHECK(rejected({.direction = {0, 0, 0}}) == "direction");
  CHECK(rejected({.direction = {0, inf, 0}}) == "direction");
  CHECK(rejected({.t_min = nan}) == "t_min");
  CHECK(rejected({.t_max = nan}) == "t_max");
}

TEST_CASE("the first ray of many that is refused is named") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const double largest = std::numeric_limits<double>::max();
  const std::array<Ray, 7> wrong = {Ray{.origin = {0, nan, 0}},
                                    Ray{.origin = {0, 0, -inf}},
                                    Ray{.direction = {0, 0, 0}},
                                    Ray{.direction = {nan, 0, 1}},
                                    Ray{.direction = {0, inf, 1}},
                                    Ray{.t_min = nan},
                                    Ray{.t_max = nan}};
  // Rays as large, or as empty, as can be are not refused.
  const std::array<Ray, 3> extreme = {
      Ray{.origin = {largest, -largest, largest}, .direction = {largest, 0, 0}},
      Ray{.direction = {0, 0, 5e-324}}, Ray{.t_min = inf, .t_max = -inf}};
  for (std::size_t count = 0; count < 20; ++count) {
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) rays.push_back(i % 5 == 3 ? extreme[i % 3] : Ray{});
    CHECK(first_invalid(rays) == count);
    for (std::size_t at = 0; at < count; ++at) {
      std::vector<Ray> some = rays;
      some[at] = wrong[(at + count) % wrong.size()];
      CHECK(first_invalid(some) == at);
      if (at + 1 < count) some[at + 1] = wrong[at % wrong.size()];
      CHECK(first_invalid(some) == at);
    }
  }
}

TEST_CASE("many rays at once find what each finds, however long they are and whatever they meet") {
  std::optional<PreparedScene> scene;
  SUBCASE("two spheres") {
    scene = two_spheres();
  }
  SUBCASE("many kinds of things") {
    scene = many_kinds();
  }
  RayQueries queries(*scene);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> real(-1, 1);
  const std::array<double, 8> lengths = {1, 1, 1, 1e-308, 5e-324, 1e307, 1e-160, 7e20};
  const double inf = std::numeric_limits<double>::infinity();
  int met = 0;
  for (int round = 0; round < 500; ++round) {
    std::vector<Ray> rays(1 + random() % 40);
    for (Ray& ray : rays) {
      const double length = lengths[random() % lengths.size()];
      ray.direction = {0.3 * length * real(random), 0.3 * length * real(random), length};
      if (random() % 4 == 0) ray.t_max = 8 / length * real(random);
      if (random() % 8 == 0) ray.t_min = random() % 2 == 0 ? -inf : real(random) / length;
    }
    std::vector<std::optional<Hit>> hits(rays.size());
    std::array<bool, 40> hidden{};
    std::vector<PlainHit> plain(rays.size());
    queries.intersect(rays, hits);
    queries.intersect(rays, plain);
    std::vector<double> distances(rays.size());
    std::vector<double> only_distances(rays.size());
    std::vector<std::uint32_t> ids(rays.size());
    queries.distances(rays, distances, ids);
    queries.distances(rays, only_distances);
    REQUIRE(only_distances == distances);
    queries.occluded(rays, hidden);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const std::optional<Hit> alone = queries.intersect(rays[i]);
      REQUIRE(alone.has_value() == hits[i].has_value());
      REQUIRE(queries.occluded(rays[i]) == hidden[i]);
      REQUIRE(same(plain[i], alone));
      REQUIRE(distances[i] == plain[i].t);
      REQUIRE(ids[i] == plain[i].entity_id);
      if (!alone) continue;
      ++met;
      REQUIRE(alone->t == hits[i]->t);
      REQUIRE(alone->position == hits[i]->position);
      REQUIRE(alone->normal == hits[i]->normal);
      REQUIRE(alone->u == hits[i]->u);
      REQUIRE(alone->v == hits[i]->v);
      REQUIRE(alone->entity_id == hits[i]->entity_id);
      REQUIRE(alone->entering == hits[i]->entering);
    }
  }
  CHECK(met > 2000);
}

TEST_CASE("parts are those of the nearest hits, alone and among many rays") {
  const PreparedScene scene = many_kinds();
  RayQueries queries(scene);
  std::vector<Ray> rays;
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> real(-0.3, 0.3);
  for (int i = 0; i < 3000; ++i) rays.push_back({.direction = {real(random), real(random), 1}});
  std::vector<HitPart> parts(rays.size());
  queries.parts(rays, parts);
  std::size_t found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::optional<Hit> hit = queries.intersect(rays[i]);
    HitPart alone;
    queries.parts(std::span(&rays[i], 1), std::span(&alone, 1));
    for (const HitPart& part : {parts[i], alone}) {
      REQUIRE(part.entity_id == (hit ? hit->entity_id : no_entity_id));
      REQUIRE(part.part_id == part.entity_id);
      REQUIRE(part.u == (hit ? hit->u : 0));
      REQUIRE(part.v == (hit ? hit->v : 0));
    }
    REQUIRE(alone.face == parts[i].face);
    REQUIRE((alone.face == no_entity_id) == !hit.has_value());
    if (hit) ++found;
  }
  CHECK(found > 500);
  CHECK_THROWS_AS(queries.parts(rays, std::span(parts).first(9)), Error);
}

TEST_CASE("a part has the innermost id around it, and its faces have numbers") {
  const Entity body = Entity(Cylinder{.from = {0, 0, 0}, .to = {0, 2, 0}}).with_id(1);
  const Entity slot = Entity(Box{.corner_a = {-2, 1, -0.25}, .corner_b = {2, 3, 0.25}}).with_id(2);
  Scene scene;
  scene.entities = {Sphere{.center = {9, 0, 0}},
                    ((body - slot).with_id(3) + Sphere{.center = {0, -5, 0}}).with_id(4)};
  const auto part_of = [&](const Vec3& origin, const Vec3& direction) {
    const Ray ray{.origin = origin, .direction = direction};
    HitPart part;
    RayQueries(prepare(scene)).parts(std::span(&ray, 1), std::span(&part, 1));
    return part;
  };
  struct Expected {
    Vec3 origin, direction;
    std::uint32_t entity, part, face;
  };
  for (const Expected& expected : {
           Expected{{9, 9, 0}, {0, -1, 0}, 0, 0, 0},    // a sphere without an id
           Expected{{0, 9, 0}, {0, -1, 0}, 4, 2, 2},    // the floor of the slot
           Expected{{0, 1.5, 0}, {0, 0, 1}, 4, 2, 5},   // its walls
           Expected{{0, 1.5, 0}, {0, 0, -1}, 4, 2, 4},  //
           Expected{{0, 9, 0.5}, {0, -1, 0}, 4, 1, 2},  // the cylinder's upper cap
           Expected{{0, 0.5, 9}, {0, 0, -1}, 4, 1, 0},  // its side
           Expected{{0.5, -3, 0}, {0, 1, 0}, 4, 1, 1},  // its lower cap
           Expected{{0, -9, 0}, {0, 1, 0}, 4, 4, 0},    // a part that has no id of its own
           Expected{{20, 20, 20}, {0, 1, 0}, no_entity_id, no_entity_id, no_entity_id},
       }) {
    const HitPart part = part_of(expected.origin, expected.direction);
    CAPTURE(expected.part);
    CHECK(part.entity_id == expected.entity);
    CHECK(part.part_id == expected.part);
    CHECK(part.face == expected.face);
  }
}

TEST_CASE("camera rays lead to where the camera sees what it sees") {
  for (const Projection projection : {Projection::pinhole, Projection::orthographic,
                                      Projection::spherical, Projection::cylindrical}) {
    Scene scene;
    scene.settings.width = 40;
    scene.settings.height = 30;
    scene.camera = {.position = {1, 2, -7}, .pointing = {1, 2, 0}, .projection = projection};
    const PreparedScene prepared = prepare(scene);
    const Ray middle = camera_ray(prepared, 20, 15);
    CHECK(middle.origin == Vec3(1, 2, -7));
    CHECK(middle.direction == Vec3(0, 0, 1));
    CHECK(middle.t_min == 0);
    CHECK(middle.t_max == std::numeric_limits<double>::infinity());
    const Ray corner = camera_ray(prepared, 0.5, 0.5);
    const Vec3 seen = corner.origin + corner.direction;
    CHECK(seen.x < 1);
    CHECK(seen.y > 2);
    const std::vector<std::array<double, 2>> places = {{20, 15}, {0.5, 0.5}, {-3, 100}};
    std::vector<Ray> rays(3);
    camera_rays(prepared, places, rays);
    CHECK(rays[0].direction == middle.direction);
    CHECK(rays[1].direction == corner.direction);
    CHECK(rays[1].origin == corner.origin);
    CHECK_THROWS_AS(camera_rays(prepared, places, std::span(rays).first(2)), Error);
    for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      CHECK_THROWS_AS(camera_ray(prepared, wrong, 1), Error);
      CHECK_THROWS_AS(camera_ray(prepared, 1, -wrong), Error);
    }
  }
}
