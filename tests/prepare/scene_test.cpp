// These tests prepare scenes and find crossings: transforms, sizes, places, many objects.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <vector>

#include "core/prepare/prepared_data.hpp"
#include "crt/error.hpp"
#include "crt/prepared_scene.hpp"
#include "geometry/custom_shapes.hpp"
#include "support/solids.hpp"

using namespace crt;
using crt::core::HitPoint;
using crt::core::PreparedData;
using crt::core::RayHit;
using crt::core::RayWorkspace;
using crt::core::WorldRay;
using crt::test::SolidMaker;

namespace {

std::vector<RayHit> all_crossings(const PreparedData& scene, const WorldRay& ray) {
  RayWorkspace work;
  std::vector<RayHit> hits;
  scene.crossings(ray, hits, work);
  return hits;
}

WorldRay ray_from(const Vec3& origin, const Vec3& direction) {
  return {.origin = origin, .direction = direction, .start = {}};
}

Scene scene_of(std::vector<Entity> entities) {
  Scene scene;
  scene.entities = std::move(entities);
  return scene;
}

/// Returns one of each primitive around the origin, none larger than about 2.
std::vector<Entity> one_of_each(double scale) {
  const auto v = [scale](double x, double y, double z) {
    return Vec3(x * scale, y * scale, z * scale);
  };
  return {Sphere{.center = v(0.3, 0.1, 0.2), .radius = 0.7 * scale},
          Box{.corner_a = v(-0.9, -0.8, -0.7), .corner_b = v(0.3, 0.6, 0.5)},
          Cylinder{.from = v(-0.5, -0.5, 0.1), .to = v(0.4, 0.7, 0.3), .radius = 0.3 * scale},
          Cone{.from = v(0.5, -0.5, 0.1),
               .to = v(-0.4, 0.7, 0.3),
               .radius = 0.6 * scale,
               .radius2 = 0.1 * scale},
          Capsule{.from = v(-0.3, 0.5, 0.1), .to = v(0.4, -0.4, 0.3), .radius = 0.25 * scale},
          Extrusion{.profile = make_profile(
                        std::array{Contour{{-0.5 * scale, -0.4 * scale},
                                           {0.7 * scale, -0.3 * scale},
                                           {0.2 * scale, 0.8 * scale, 0.5}},
                                   Contour{{0.3 * scale, 0, 1}, {-0.1 * scale, 0, 1}}}),
                    .from = -0.3 * scale,
                    .to = 0.6 * scale},
          revolved(make_profile(std::array{Contour{{0.2 * scale, -0.4 * scale},
                                                   {0.7 * scale, -0.3 * scale},
                                                   {0.4 * scale, 0.8 * scale, 0.5}}}),
                   v(0.1, 0.1, -0.2), v(0.3, 0.9, 0.4), 4),
          HeightField{.heights = make_height_grid({0.2, 0.9, 0.4, 0, 1, 0.3}, 3, 2),
                      .corner_a = v(-0.7, -0.4, -0.5),
                      .corner_b = v(0.6, 0.5, 0.8)},
          Quadric{.squares = {1, 4, 2},
                  .products = {0.5, 0, 1},
                  .linear = v(0.2, -0.3, 0.1),
                  .constant = -0.6 * scale * scale},
          Torus{.center = v(0.1, 0.2, 0.1),
                .axis = {0.2, 1, 0.3},
                .radius = 0.8 * scale,
                .thickness = 0.25 * scale},
          Disc{.center = v(0, 0.9, 0), .normal = {0.1, 1, 0.1}, .radius = 0.8 * scale},
          Triangle{.a = v(-1, -1, 0.5), .b = v(1, -1, 0.7), .c = v(0, 1, 0.2)},
          Plane{.normal = {0.1, 1, 0.2}, .position = v(0, -1, 0)},
          HalfPlane{.normal = {1, 0.2, 0}, .position = v(-0.95, 0, 0), .direction = {0, 1, 0}},
          Implicit{.field = pow(Field::x() / scale, 2) + 2 * pow(Field::y() / scale, 2) +
                            pow(Field::z() / scale, 3) - 0.4,
                   .lower = v(-0.8, -0.7, -0.6),
                   .upper = v(0.7, 0.8, 0.9)},
          test::as_custom(
              Capsule{.from = v(-0.3, 0, 0.1), .to = v(0.4, 0.2, 0), .radius = 0.3 * scale})};
}

}  // namespace

TEST_CASE("many objects: what Embree's boxes let through is all that brute force finds") {
  SolidMaker make(3);
  std::vector<Entity> spheres;
  std::vector<Scene> alone;
  for (int i = 0; i < 300; ++i) {
    const Sphere sphere{.center = {make.real(-9, 9), make.real(-9, 9), make.real(-9, 9)},
                        .radius = make.real(0.01, 1.5)};
    spheres.emplace_back(sphere);
  }
  const PreparedData all(scene_of(spheres));
  std::vector<std::unique_ptr<PreparedData>> each;
  for (const Entity& sphere : spheres)
    each.push_back(std::make_unique<PreparedData>(scene_of({sphere})));
  RayWorkspace work;
  for (int i = 0; i < 300; ++i) {
    const WorldRay ray = ray_from({make.real(-12, 12), make.real(-12, 12), make.real(-12, 12)},
                                  {make.real(-1, 1), make.real(-1, 1), make.real(-1, 1)});
    std::vector<double> expected;
    for (const auto& one : each) {
      for (const RayHit& hit : all_crossings(*one, ray)) expected.push_back(hit.t);
    }
    std::sort(expected.begin(), expected.end());
    const auto found = all_crossings(all, ray);
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(found[k].t == expected[k]);
    const RayHit nearest = all.intersect(ray, work);
    CHECK(nearest.found() == !expected.empty());
    if (nearest.found()) CHECK(nearest.t == expected[0]);
    CHECK(all.occluded(ray, work) == !expected.empty());
    if (!expected.empty()) {
      WorldRay shorter = ray;
      shorter.t_max = expected[0];
      CHECK_FALSE(all.occluded(shorter, work));
      shorter.t_max = std::nextafter(expected[0], 1e300);
      CHECK(all.occluded(shorter, work));
    }
  }
}

TEST_CASE("multiplying all lengths by a power of two changes no bit") {
  const PreparedData unit(scene_of(one_of_each(1)));
  for (const int exponent : {-300, -77, -1, 1, 40, 300}) {
    CAPTURE(exponent);
    const double factor = std::ldexp(1.0, exponent);
    const PreparedData scaled(scene_of(one_of_each(factor)));
    SolidMaker make(11);
    for (int i = 0; i < 400; ++i) {
      const Vec3 o(make.real(-4, 4), make.real(-4, 4), make.real(-4, 4));
      const Vec3 d = Vec3(make.real(-1, 1), make.real(-1, 1), make.real(-1, 1)) - o;
      const auto one = all_crossings(unit, ray_from(o, d));
      const auto two = all_crossings(scaled, ray_from(o * factor, d * factor));
      REQUIRE(one.size() == two.size());
      for (std::size_t k = 0; k < one.size(); ++k) {
        CHECK(one[k].t == two[k].t);
        CHECK(one[k].object == two[k].object);
        const HitPoint first = unit.hit_point(ray_from(o, d), one[k]);
        const HitPoint second = scaled.hit_point(ray_from(o * factor, d * factor), two[k]);
        CHECK(first.position * factor == second.position);
        CHECK(first.normal == second.normal);
      }
    }
  }
}

TEST_CASE("a transformed ray meets a transformed entity where the plain ones meet") {
  SolidMaker make(17);
  const PreparedData plain(scene_of(one_of_each(1)));
  for (int round = 0; round < 20; ++round) {
    // The scale is non-uniform, and mirrored in every second round.
    const Transform steps[] = {
        scale(Vec3(make.real(0.3, 3), make.real(0.3, 3),
                   round % 2 == 0 ? make.real(0.3, 3) : -make.real(0.3, 3))),
        rotate_degrees({make.real(-180, 180), make.real(-180, 180), make.real(-180, 180)}),
        translate({make.real(-5, 5), make.real(-5, 5), make.real(-5, 5)})};
    std::vector<Entity> moved;
    for (Entity entity : one_of_each(1)) {
      for (const Transform& step : steps) entity = entity.transformed(step);
      moved.push_back(entity);
    }
    const PreparedData transformed(scene_of(moved));
    const auto apply = [&](Vec3 v, bool point) {
      for (const Transform& step : steps) {
        v = Vec3(glm::dot(step.row_x, v), glm::dot(step.row_y, v), glm::dot(step.row_z, v)) +
            (point ? step.translation : Vec3(0));
      }
      return v;
    };
    for (int i = 0; i < 100; ++i) {
      const Vec3 o(make.real(-4, 4), make.real(-4, 4), make.real(-4, 4));
      const Vec3 d = Vec3(make.real(-1, 1), make.real(-1, 1), make.real(-1, 1)) - o;
      const WorldRay before = ray_from(o, d);
      const WorldRay after = ray_from(apply(o, true), apply(d, false));
      const auto one = all_crossings(plain, before);
      const auto two = all_crossings(transformed, after);
      REQUIRE(one.size() == two.size());
      for (std::size_t k = 0; k < one.size(); ++k) {
        CHECK(one[k].t == doctest::Approx(two[k].t).epsilon(1e-9));
        const HitPoint first = plain.hit_point(before, one[k]);
        const HitPoint second = transformed.hit_point(after, two[k]);
        const double along = (one[k].error + two[k].error) * glm::length(after.direction);
        CHECK(glm::distance(apply(first.position, true), second.position) < 1e-9 + along);
        CHECK(glm::length(second.normal) == doctest::Approx(1));
        // The normal keeps its side: it is against the ray exactly where the plain one is.
        CHECK((glm::dot(first.normal, d) < 0) == (glm::dot(second.normal, after.direction) < 0));
        CHECK(first.u == doctest::Approx(second.u).epsilon(1e-6));
        CHECK(first.v == doctest::Approx(second.v).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("a union whose parts are disjoint is several objects, one whose parts touch is one") {
  std::vector<Entity> row;
  for (int i = 0; i < 50; ++i) row.emplace_back(Sphere{.center = {3.0 * i, 0, 0}, .radius = 1});
  const PreparedData disjoint(scene_of({csg_union(row)}));
  RayWorkspace work;
  CHECK(disjoint.intersect(ray_from({0, 0, -5}, {0, 0, 1}), work).found());
  CHECK(work.intersection_tests == 1);
  CHECK_FALSE(disjoint.features().csg);

  const PreparedData touching(scene_of({Entity(Sphere{}) + Sphere{.center = {2, 0, 0}}}));
  CHECK(touching.features().csg);
}

TEST_CASE("surrounding solids come outermost first") {
  const PreparedData data(scene_of({Sphere{.radius = 1}, Sphere{.radius = 3}, Sphere{.radius = 2},
                                    Plane{.normal = {0, 1, 0}, .position = {0, 10, 0}},
                                    Disc{.center = {0, 0.5, 0}}, Sphere{.center = {9, 0, 0}}}));
  RayWorkspace work;
  std::vector<RayHit> around;
  data.containing_solids(ray_from({0, 0, 0}, {1, 0, 0.1}), around, work);
  REQUIRE(around.size() == 4);
  CHECK(around[0].t ==
        std::numeric_limits<double>::infinity());  // a ray along the ground never leaves it
  CHECK(around[1].object == 1);
  CHECK(around[2].object == 2);
  CHECK(around[3].object == 0);
}

TEST_CASE("equal t goes to the object that comes first") {
  const Disc disc{.center = {0, 0, 0}, .normal = {0, 1, 0}, .radius = 2};
  const Plane plane{};
  RayWorkspace work;
  const WorldRay down = ray_from({0.1, 3, 0.7}, {0.2, -1, 0.3});
  CHECK(PreparedData(scene_of({disc, plane})).intersect(down, work).object == 0);
  CHECK(PreparedData(scene_of({plane, disc})).intersect(down, work).object == 0);
}

TEST_CASE("a distant ray finds a small scene as precisely as its numbers allow") {
  const PreparedData data(scene_of({Sphere{.radius = 1}}));
  RayWorkspace work;
  for (const double distance : {1e3, 1e6, 1e9, 1e12}) {
    const RayHit hit = data.intersect(ray_from({0, 0.5, -distance}, {0, 0, 1}), work);
    REQUIRE(hit.found());
    const double exact = distance - std::sqrt(0.75);
    CHECK(std::abs(hit.t - exact) <= std::nextafter(exact, 1e300) - exact);
  }
}

TEST_CASE("a scene holds sizes 1e20 apart") {
  const PreparedData data(scene_of({Sphere{.center = {0, 0, 1e12}, .radius = 1e11},
                                    Sphere{.center = {0, 0, 0}, .radius = 1e-9}}));
  RayWorkspace work;
  const RayHit small = data.intersect(ray_from({0, 0, -1e-6}, {0, 0, 1}), work);
  CHECK(small.object == 1);
  CHECK(small.t == doctest::Approx(1e-6 - 1e-9).epsilon(1e-13));
  const RayHit large = data.intersect(ray_from({0, 1e-8, -1e-6}, {0, 0, 1}), work);
  CHECK(large.object == 0);
  CHECK(large.t == doctest::Approx(9e11));
}

TEST_CASE("an empty scene and an empty solid are met by nothing") {
  RayWorkspace work;
  CHECK_FALSE(PreparedData(Scene{}).intersect(ray_from({0, 0, -5}, {0, 0, 1}), work).found());
  const PreparedData nothing(scene_of({Entity(Sphere{}) ^ Sphere{.center = {5, 0, 0}}}));
  CHECK_FALSE(nothing.intersect(ray_from({0, 0, -5}, {0, 0, 1}), work).found());
}

TEST_CASE("the empty entity is what the empty set is") {
  const Entity nothing = empty_entity();
  CHECK(nothing.is_empty());
  CHECK(nothing.is_solid());
  CHECK(nothing.primitive_count() == 0);
  const Entity ball = Sphere{};
  const Entity disc = Disc{};
  for (const Entity& same : {ball + nothing, nothing + ball, ball - nothing,
                             csg_difference(ball, std::array{nothing, nothing}),
                             csg_union(std::array{nothing, ball, nothing})}) {
    CHECK(same.shared_node() == ball.shared_node());
  }
  CHECK((disc + nothing).shared_node() == disc.shared_node());
  const Entity bitten = csg_difference(ball, std::array{nothing, Entity(Box{}), nothing});
  CHECK(bitten.primitive_count() == 2);
  for (const Entity& empty : {ball ^ nothing, nothing ^ ball, nothing - ball, nothing + nothing,
                              nothing - nothing, nothing.transformed(translate({1, 2, 3})),
                              nothing.with_id(7), nothing.with_material(Material{})}) {
    CHECK(empty.is_empty());
  }
  CHECK_FALSE(ball.is_empty());
  // The rules for operands hold for these, too.
  CHECK_THROWS_AS(disc ^ nothing, Error);
  CHECK_THROWS_AS(nothing - disc, Error);
  CHECK_THROWS_AS(nothing.transformed(scale(0)), Error);
}

TEST_CASE("no ray meets the empty entity, and those behind it keep their ids") {
  const PreparedData data(scene_of({empty_entity(), Sphere{.center = {0, 0, 5}}, empty_entity()}));
  RayWorkspace work;
  const RayHit hit = data.intersect(ray_from({0, 0, 0}, {0, 0, 1}), work);
  REQUIRE(hit.found());
  CHECK(data.entity_id(hit) == 1);
  CHECK_FALSE(PreparedData(scene_of({empty_entity()}))
                  .intersect(ray_from({0, 0, -5}, {0, 0, 1}), work)
                  .found());
}

TEST_CASE("transforms that flatten space are refused") {
  const Entity ball = Sphere{};
  CHECK_THROWS_AS(ball.transformed(Transform{.row_z = {0, 0, 0}}), Error);
  CHECK_THROWS_AS(ball.transformed(Transform{.row_y = {1, 0, 0}}), Error);
  CHECK_THROWS_AS(ball.transformed(Transform{.translation = {0, NAN, 0}}), Error);
  Entity shrunk = ball;
  CHECK_THROWS_AS(
      [&] {
        for (int i = 0; i < 10; ++i) shrunk = shrunk.transformed(scale(1e-20));
      }(),
      Error);
}

TEST_CASE("a wrong light is named by its place") {
  Scene scene;
  scene.lights = {PointLight{}, SpotLight{.angle = -1}};
  try {
    prepare(scene);
    FAIL("the light is accepted");
  } catch (const Error& error) {
    CHECK(error.argument() == "lights[1].angle");
    CHECK(std::string(error.what()).starts_with("lights[1]: angle must be greater than 0"));
  }
}

TEST_CASE("a wrong description is refused with the name of the field") {
  const auto argument_of = [](const Scene& scene) {
    try {
      const PreparedData data(scene);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::invalid_argument);
      return error.argument();
    }
    return std::string("(accepted)");
  };
  Scene scene;
  scene.camera.pointing = scene.camera.position;
  CHECK(argument_of(scene) == "pointing");
  scene = {};
  scene.camera.fov = 4;
  CHECK(argument_of(scene) == "fov");
  scene = {};
  scene.settings.width = 0;
  CHECK(argument_of(scene) == "width");
  scene.settings.width = scene.settings.height = 65536;
  CHECK(argument_of(scene) == "height");
  scene = {};
  scene.settings.gamma = NAN;
  CHECK(argument_of(scene) == "gamma");
  scene = {};
  scene.lights.emplace_back(SpotLight{.origin = {0, 0, 0}, .pointing = {0, 0, 0}});
  CHECK(argument_of(scene) == "lights[0].pointing");
  scene.lights = {PointLight{.color = {-1, 0, 0}}};
  CHECK(argument_of(scene) == "lights[0].color");
  scene = {};
  scene.settings.compat = 2014;
  CHECK(argument_of(scene) == "compat");
  scene = {};
  scene.camera.lens_radius = -1;
  CHECK(argument_of(scene) == "lens_radius");
  scene.camera = {.aperture = 1, .lens_radius = 0.001};
  CHECK(argument_of(scene) == "lens_radius");
  scene = {};
  scene.background = PanoramaBackground{};
  CHECK(argument_of(scene) == "image");
  CHECK_THROWS_AS(SharedMaterial(Material{.reflectivity = 1.5}), Error);
  CHECK_THROWS_AS(SharedMaterial(Material{.color = Color{-0.5, 0, 0}}), Error);
  CHECK_THROWS_AS(SharedMaterial(Material{.color = Pattern(ImageMap{})}), Error);
}

TEST_CASE("prepare warns of a scene without lights, and of a camera that is on a surface") {
  Scene scene;
  CHECK(prepare(scene).warnings() ==
        std::vector<std::string>{"the scene has no entities: only the background shows"});
  // The default camera is on the default sphere.
  scene.entities = {Sphere{}};
  CHECK(prepare(scene).warnings() ==
        std::vector<std::string>{
            "the scene has no lights: a head light shines from the camera",
            "the camera is on the surface of an object: rounding decides what it sees"});
  scene.camera.position = {0, 0, -5};
  scene.settings.head_light = false;
  CHECK(prepare(scene).warnings() ==
        std::vector<std::string>{
            "the scene has no lights: only mirrors, glass and the background show"});
  scene.lights = {PointLight{}};
  CHECK(prepare(scene).warnings().empty());
}

TEST_CASE("prepare warns of a lens that has no effect, but not in scenes of 2015") {
  Scene scene;
  scene.entities = {Sphere{}};
  scene.lights = {PointLight{}};
  scene.camera = {.position = {0, 0, -5}, .aperture = 10};
  CHECK(prepare(scene).warnings() ==
        std::vector<std::string>{
            "the camera's aperture has no effect, as dofsamples is 1: all is sharp"});
  scene.camera = {.position = {0, 0, -5}, .lens_radius = 0.01};
  CHECK(prepare(scene).warnings() ==
        std::vector<std::string>{
            "the camera's lensradius has no effect, as dofsamples is 1: all is sharp"});
  scene.settings.compat = 2015;
  CHECK(prepare(scene).warnings().empty());
  scene.settings.compat = 0;
  scene.settings.dof_samples = 4;
  CHECK(prepare(scene).warnings().empty());
}

TEST_CASE("prepare warns of a camera in a solid through which nothing is seen") {
  const std::vector<std::string> warning = {
      "the camera is inside an object that is not transparent: it sees that from within"};
  const SharedMaterial glass(Material{.transparency = 0.9});
  const Entity room = Box{.corner_a = {-9, -9, -9}, .corner_b = {9, 9, 9}};
  const Entity hollow = Box{.corner_a = {-8, -8, -8}, .corner_b = {8, 8, 8}};
  Scene scene;
  scene.entities = {room};
  scene.lights = {PointLight{}};
  scene.camera.position = {0, 0, -5};
  CHECK(prepare(scene).warnings() == warning);
  scene.entities = {Plane{.normal = {0, 1, 0}, .position = {0, 3, 0}}};
  CHECK(prepare(scene).warnings() == warning);
  scene.entities = {room - hollow};
  CHECK(prepare(scene).warnings().empty());
  scene.entities = {room.with_material(glass)};
  CHECK(prepare(scene).warnings().empty());
  scene.camera.projection = Projection::orthographic;
  scene.entities = {room};
  CHECK(prepare(scene).warnings().empty());
}
