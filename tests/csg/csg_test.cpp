// CSG is compared with brute force: membership by definition, in quadruple precision, between every
// two surfaces that a ray passes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/prepare/prepared_data.hpp"
#include "crt/error.hpp"
#include "crt/validate.hpp"
#include "support/solids.hpp"

using namespace crt;
using crt::core::HitPoint;
using crt::core::PreparedData;
using crt::core::RayHit;
using crt::core::RayWorkspace;
using crt::core::Side;
using crt::core::WorldRay;
using crt::test::Quad;
using crt::test::QuadPoint;
using crt::test::Solid;
using crt::test::SolidMaker;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<RayHit> all_crossings(const PreparedData& scene, const WorldRay& ray) {
  RayWorkspace work;
  std::vector<RayHit> hits;
  scene.crossings(ray, hits, work);
  return hits;
}

PreparedData prepared(const Entity& entity) {
  Scene scene;
  scene.entities.push_back(entity);
  return PreparedData(scene);
}

WorldRay whole_line(const Vec3& origin, const Vec3& direction) {
  return {
      .origin = origin, .direction = direction, .t_min = -infinity, .t_max = infinity, .start = {}};
}

/// Returns the crossings that must be there: where membership on both sides of a candidate differs.
std::vector<Quad> expected_crossings(const Solid& solid, const Vec3& o, const Vec3& d) {
  std::vector<Quad> ts;
  solid.candidate_ts(o, d, ts);
  std::sort(ts.begin(), ts.end());
  std::vector<Quad> distinct;
  for (const Quad t : ts) {
    if (distinct.empty() || t - distinct.back() > 1e-25) distinct.push_back(t);
  }
  const auto inside = [&](Quad t) {
    return solid.contains({o.x + t * d.x, o.y + t * d.y, o.z + t * d.z});
  };
  std::vector<Quad> result;
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    const Quad before = i == 0 ? distinct[i] - 1 : (distinct[i - 1] + distinct[i]) / 2;
    const Quad after =
        i + 1 == distinct.size() ? distinct[i] + 1 : (distinct[i] + distinct[i + 1]) / 2;
    if (inside(before) != inside(after)) result.push_back(distinct[i]);
  }
  return result;
}

/// Compares along one ray. Returns the number of crossings.
std::size_t compare(const Solid& solid, const PreparedData& scene, const Vec3& o, const Vec3& d) {
  const std::vector<Quad> expected = expected_crossings(solid, o, d);
  const std::vector<RayHit> found = all_crossings(scene, whole_line(o, d));
  std::vector<double> found_ts;
  std::vector<double> expected_ts;
  for (const RayHit& hit : found) found_ts.push_back(hit.t);
  for (const Quad t : expected) expected_ts.push_back(static_cast<double>(t));
  CAPTURE(found_ts);
  CAPTURE(expected_ts);
  CAPTURE(o);
  CAPTURE(d);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].t == doctest::Approx(expected_ts[i]).epsilon(1e-12));
    const Quad t = expected[i];
    const Quad step = 1e-9;
    const QuadPoint after{o.x + (t + step) * d.x, o.y + (t + step) * d.y, o.z + (t + step) * d.z};
    if (i + 1 == found.size() || expected[i + 1] - t > 2 * step)
      CHECK(found[i].entering == solid.contains(after));
  }
  return found.size();
}

}  // namespace

TEST_CASE("random trees with coincident faces agree with membership by definition") {
  std::size_t crossings = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    SolidMaker make(seed);
    const Solid solid = make.tree(3);
    const PreparedData scene = prepared(solid.entity());
    CAPTURE(seed);
    for (int i = 0; i < 60; ++i) {
      const Vec3 o(make.real(-9, 9), make.real(-9, 9), make.real(-9, 9));
      const Vec3 target(make.real(-3, 3), make.real(-3, 3), make.real(-3, 3));
      crossings += compare(solid, scene, o, target - o);
    }
  }
  CHECK(crossings > 10000);
}

TEST_CASE("rays along an axis through random trees agree with membership by definition") {
  for (std::uint32_t seed = 1000; seed < 1200; ++seed) {
    SolidMaker make(seed);
    const Solid solid = make.tree(3);
    const PreparedData scene = prepared(solid.entity());
    CAPTURE(seed);
    for (int i = 0; i < 30; ++i) {
      Vec3 o(make.real(-4, 4), make.real(-4, 4), make.real(-4, 4));
      Vec3 d(0);
      const int axis = make.integer(0, 2);
      o[axis] = -20;
      d[axis] = make.integer(1, 3);
      compare(solid, scene, o, d);
    }
  }
}

TEST_CASE("set identities hold along random rays") {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SolidMaker make(seed + 5000);
    const Entity a = make.tree(2).entity();
    const Entity b = make.tree(2).entity();
    const Entity everything = Sphere{.center = {0, 0, 0}, .radius = 50};
    const PreparedData empty = prepared(a - a);
    const PreparedData plain = prepared(everything ^ a);
    const PreparedData twice = prepared(everything ^ (a + a));
    const PreparedData rejoined = prepared(everything ^ ((a - b) + (a ^ b)));
    const PreparedData de_morgan_1 = prepared(everything - (a + b));
    const PreparedData de_morgan_2 = prepared((everything - a) ^ (everything - b));
    for (int i = 0; i < 40; ++i) {
      const Vec3 o(make.real(-9, 9), make.real(-9, 9), make.real(-9, 9));
      const Vec3 d(make.real(-1, 1), make.real(-1, 1), make.real(-1, 1));
      const WorldRay ray = whole_line(o, d);
      const auto same = [&](const PreparedData& first, const PreparedData& second) {
        const auto one = all_crossings(first, ray);
        const auto two = all_crossings(second, ray);
        REQUIRE(one.size() == two.size());
        for (std::size_t k = 0; k < one.size(); ++k) {
          CHECK(one[k].t == doctest::Approx(two[k].t).epsilon(1e-12));
          CHECK(one[k].entering == two[k].entering);
        }
      };
      CHECK(all_crossings(empty, ray).empty());
      same(plain, twice);
      same(plain, rejoined);
      same(de_morgan_1, de_morgan_2);
    }
  }
}

TEST_CASE("a cut face has the cutter's material and a normal out of what is left") {
  const SharedMaterial red = Material{.color = Color{1, 0, 0}};
  const SharedMaterial blue = Material{.color = Color{0, 0, 1}};
  const PreparedData scene =
      prepared(Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}, .material = red} -
               Sphere{.center = {0, 0, -1}, .radius = 0.5, .material = blue});
  RayWorkspace work;
  const WorldRay ray{.origin = {0, 0, -5}, .direction = {0, 0, 1}, .start = {}};
  const RayHit hit = scene.intersect(ray, work);
  REQUIRE(hit.found());
  CHECK(hit.t == doctest::Approx(4.5));
  CHECK(hit.entering);
  const HitPoint point = scene.hit_point(ray, hit);
  CHECK(std::get<Color>(scene.materials()[point.material].description->color) == Color{0, 0, 1});
  CHECK(point.normal.z == doctest::Approx(-1));
  CHECK(point.position.z == doctest::Approx(-0.5));
}

TEST_CASE("where surfaces of both sides coincide, the first part gives the material") {
  const SharedMaterial red = Material{.color = Color{1, 0, 0}};
  const SharedMaterial blue = Material{.color = Color{0, 0, 1}};
  const Box first{.corner_a = {0, 0, 0}, .corner_b = {2, 2, 2}, .material = red};
  const Box second{.corner_a = {1, 0, 0}, .corner_b = {3, 2, 2}, .material = blue};
  RayWorkspace work;
  const WorldRay ray{.origin = {1.5, 1, -5}, .direction = {0, 0, 1}, .start = {}};
  const auto material_of = [&](const Entity& entity) {
    const PreparedData scene = prepared(entity);
    const HitPoint point = scene.hit_point(ray, scene.intersect(ray, work));
    return std::get<Color>(scene.materials()[point.material].description->color);
  };
  CHECK(material_of(Entity(first) + second) == Color{1, 0, 0});
  CHECK(material_of(Entity(second) + first) == Color{0, 0, 1});
  CHECK(material_of(Entity(first) ^ second) == Color{1, 0, 0});
  CHECK(material_of(Entity(second) ^ first) == Color{0, 0, 1});
}

TEST_CASE("a part that ends where another begins does not lend its face to the hit") {
  // At z = 0 the first operand's own intersection changes nothing, though one of its leaves does.
  const SharedMaterial red = Material{.color = Color{1, 0, 0}};
  const SharedMaterial blue = Material{.color = Color{0, 0, 1}};
  const Entity before = Box{.corner_a = {-1, -1, -2}, .corner_b = {1, 1, 0}, .material = red};
  const Entity far_away = Sphere{.center = {0, 9, 0}, .radius = 1, .material = red};
  const Entity behind = Box{.corner_a = {-1, -1, 0}, .corner_b = {1, 1, 2}, .material = blue};
  const PreparedData scene = prepared((before ^ far_away) + behind);
  const WorldRay ray{.origin = {0.1, 0.2, -5}, .direction = {0, 0, 1}, .start = {}};
  RayWorkspace work;
  const RayHit hit = scene.intersect(ray, work);
  REQUIRE(hit.found());
  const HitPoint point = scene.hit_point(ray, hit);
  CHECK(std::get<Color>(scene.materials()[point.material].description->color) == Color{0, 0, 1});
  CHECK(point.normal == Vec3(0, 0, -1));
}

TEST_CASE("touching solids show no seam and a flush cutter opens the face") {
  const Entity left = Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}};
  const Entity right = Box{.corner_a = {1, 0, 0}, .corner_b = {2, 1, 1}};
  const WorldRay ray{.origin = {-5, 0.3, 0.4}, .direction = {1, 0, 0}, .start = {}};
  CHECK(all_crossings(prepared(left + right), ray).size() == 2);
  CHECK(all_crossings(prepared(left - right), ray).size() == 2);
  CHECK(all_crossings(prepared(left ^ right), ray).empty());
  const Entity hole = Cylinder{.from = {0.5, 0.5, 0}, .to = {0.5, 0.5, 1}, .radius = 0.25};
  const WorldRay through{.origin = {0.5, 0.6, -5}, .direction = {0, 0, 1}, .start = {}};
  CHECK(all_crossings(prepared(left - hole), through).empty());
}

TEST_CASE("a ray that starts on a surface never meets it again, whatever side it leaves to") {
  for (std::uint32_t seed = 0; seed < 150; ++seed) {
    SolidMaker make(seed + 9000);
    const Solid solid = make.tree(2);
    const PreparedData scene = prepared(solid.entity());
    RayWorkspace work;
    for (int i = 0; i < 40; ++i) {
      const Vec3 o(make.real(-9, 9), make.real(-9, 9), make.real(-9, 9));
      const Vec3 target(make.real(-3, 3), make.real(-3, 3), make.real(-3, 3));
      const WorldRay ray{.origin = o, .direction = target - o, .start = {}};
      const RayHit hit = scene.intersect(ray, work);
      if (!hit.found()) continue;
      const HitPoint point = scene.hit_point(ray, hit);
      Vec3 d = glm::normalize(Vec3(make.real(-1, 1), make.real(-1, 1), make.real(-1, 1)));
      for (const Side side : {Side::outside, Side::inside}) {
        if ((glm::dot(d, point.normal) > 0) != (side == Side::outside)) d = -d;
        if (std::abs(glm::dot(d, point.normal)) < 1e-6) continue;
        const WorldRay leaving{
            .origin = point.position, .direction = d, .start = scene.start_point(ray, hit, side)};
        const auto crossings = all_crossings(scene, leaving);
        if (!crossings.empty()) {
          CAPTURE(seed);
          CHECK(crossings.front().t > 1e-13);
          // Just after the start it is inside or outside as the side says, so the next crossing
          // leaves or enters. A start next to an edge may be past it already.
          const double ahead = 1e-7;
          const Vec3 p = point.position + ahead * d;
          if (crossings.front().t > 2 * ahead &&
              solid.contains({p.x, p.y, p.z}) == (side == Side::inside)) {
            CHECK(crossings.front().entering == (side == Side::outside));
          }
        }
      }
    }
  }
}

TEST_CASE("infinite solids combine to finite ones") {
  const Entity slab = Entity(Plane{.normal = {0, 1, 0}, .position = {0, 1, 0}}) ^ Plane {
    .normal = {0, -1, 0}, .position = { 0, -1, 0 }
  };
  const Entity cube =
      csg_intersection(std::vector<Entity>{slab, Plane{.normal = {1, 0, 0}, .position = {1, 0, 0}},
                                           Plane{.normal = {-1, 0, 0}, .position = {-1, 0, 0}},
                                           Plane{.normal = {0, 0, 1}, .position = {0, 0, 1}},
                                           Plane{.normal = {0, 0, -1}, .position = {0, 0, -1}}});
  const PreparedData planes = prepared(cube);
  const PreparedData box = prepared(Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}});
  SolidMaker make(7);
  for (int i = 0; i < 1000; ++i) {
    const WorldRay ray = whole_line({make.real(-3, 3), make.real(-3, 3), make.real(-3, 3)},
                                    {make.real(-1, 1), make.real(-1, 1), make.real(-1, 1)});
    const auto one = all_crossings(planes, ray);
    const auto two = all_crossings(box, ray);
    REQUIRE(one.size() == two.size());
    for (std::size_t k = 0; k < one.size(); ++k) CHECK(one[k].t == doctest::Approx(two[k].t));
  }
}

TEST_CASE("a pit in an infinite ground is seen from above and from below") {
  const PreparedData scene =
      prepared(Entity(Plane{.normal = {0, 1, 0}}) - Sphere{.center = {0, 0, 0}, .radius = 1});
  const auto down =
      all_crossings(scene, {.origin = {0, 5, 0}, .direction = {0, -1, 0}, .start = {}});
  REQUIRE(down.size() == 1);
  CHECK(down[0].t == doctest::Approx(6));
  CHECK(down[0].entering);
  const auto up = all_crossings(scene, {.origin = {0, -5, 0}, .direction = {0, 1, 0}, .start = {}});
  REQUIRE(up.size() == 1);
  CHECK_FALSE(up[0].entering);
}

TEST_CASE("surfaces cannot be cut, and cut nothing") {
  const Entity disc = Disc{};
  const Entity sphere = Sphere{};
  CHECK_THROWS_AS(disc - sphere, Error);
  CHECK_THROWS_AS(sphere - disc, Error);
  CHECK_THROWS_AS(sphere ^ disc, Error);
  CHECK_THROWS_AS(sphere - (sphere + disc), Error);
  CHECK_NOTHROW(sphere + disc);
  CHECK_FALSE((sphere + disc).is_solid());
}

TEST_CASE("a hundred thousand nested operations neither overflow the stack nor take long") {
  Entity chain = Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}};
  const Entity drill = Sphere{.center = {0, 0, 1}, .radius = 0.5};
  for (int i = 0; i < 100'000; ++i) chain = i % 100 == 99 ? chain + drill : chain - drill;
  CHECK(chain.primitive_count() == 100'001);
  const PreparedData scene = prepared(chain);
  const auto hits =
      all_crossings(scene, {.origin = {0, 0, -5}, .direction = {0, 0, 1}, .start = {}});
  REQUIRE(hits.size() == 2);
  CHECK(hits[1].t == doctest::Approx(6.5));  // the last operation was a union
}

TEST_CASE("a million nested transforms cost nothing later") {
  Entity moved = Sphere{};
  for (int i = 0; i < 1'000'000; ++i) moved = moved.transformed(translate({1e-6, 0, 0}));
  const PreparedData scene = prepared(moved);
  const auto hits =
      all_crossings(scene, {.origin = {-5, 0, 0}, .direction = {1, 0, 0}, .start = {}});
  REQUIRE(hits.size() == 2);
  CHECK(hits[0].t == doctest::Approx(5).epsilon(1e-13));
}

TEST_CASE("sharing that multiplies to more primitives than memory holds is an error, not a crash") {
  Entity doubled = Sphere{};
  for (int i = 0; i < 70; ++i) doubled = doubled + doubled;
  CHECK(doubled.primitive_count() == std::numeric_limits<std::uint64_t>::max());
  Scene scene;
  scene.entities.push_back(doubled);
  try {
    const PreparedData data(scene);
    FAIL("was prepared");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::limit);
  }
}

TEST_CASE("materials given to a group reach only parts without one, and inner ones win") {
  const SharedMaterial red = Material{.color = Color{1, 0, 0}};
  const SharedMaterial blue = Material{.color = Color{0, 0, 1}};
  const SharedMaterial green = Material{.color = Color{0, 1, 0}};
  const Entity left = Sphere{.center = {-2, 0, 0}, .material = red};
  const Entity middle = Entity(Sphere{}).with_material(green);
  const Entity right = Sphere{.center = {2, 0, 0}};
  Scene scene;
  scene.entities.push_back((left + middle + right).with_material(blue));
  const PreparedData data(scene);
  RayWorkspace work;
  const auto color_at = [&](double x) {
    const WorldRay ray{.origin = {x, 0, -5}, .direction = {0, 0, 1}, .start = {}};
    const HitPoint point = data.hit_point(ray, data.intersect(ray, work));
    return std::get<Color>(data.materials()[point.material].description->color);
  };
  CHECK(color_at(-2) == Color{1, 0, 0});
  CHECK(color_at(0) == Color{0, 1, 0});
  CHECK(color_at(2) == Color{0, 0, 1});
  CHECK(lacks_material(left + middle + right));
  CHECK(lacks_material(left - right));
  CHECK_FALSE(lacks_material((left + middle + right).with_material(blue)));
  CHECK_FALSE(lacks_material((left + middle).transformed(scale(2))));
  CHECK_FALSE(lacks_material(empty_entity()));
}

TEST_CASE("the outermost id holds; without one it is the place in the scene") {
  Scene scene;
  scene.entities.push_back(Sphere{.center = {-3, 0, 0}});
  scene.entities.push_back(Entity(Sphere{}).with_id(77));
  scene.entities.push_back(
      (Entity(Sphere{.center = {3, 0, 0}}).with_id(5) + Sphere{.center = {6, 0, 0}}).with_id(9));
  scene.entities.push_back(Entity(Sphere{.center = {9, 0, 0}}).with_id(5) +
                           Sphere{.center = {12, 0, 0}});
  const PreparedData data(scene);
  RayWorkspace work;
  const auto id_at = [&](double x) {
    const WorldRay ray{.origin = {x, 0, -5}, .direction = {0, 0, 1}, .start = {}};
    return data.hit_point(ray, data.intersect(ray, work)).entity_id;
  };
  CHECK(id_at(-3) == 0);
  CHECK(id_at(0) == 77);
  CHECK(id_at(3) == 9);
  CHECK(id_at(6) == 9);
  CHECK(id_at(9) == 5);
  CHECK(id_at(12) == 3);
}
