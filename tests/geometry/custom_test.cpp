// Custom shapes that say what known primitives say are those primitives. Others say what cannot be.
#include "core/geometry/custom/custom.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "core/math/vector.hpp"
#include "crt/entity.hpp"
#include "crt/error.hpp"
#include "crt/job.hpp"
#include "crt/query.hpp"
#include "crt/render.hpp"
#include "geometry/custom_shapes.hpp"
#include "geometry/oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// A Shell is what is between two spheres about the origin.
class Shell final : public CustomShape {
 public:
  BoundingBox bounds() const override { return {.lower = Vec3(-1), .upper = Vec3(1)}; }
  void crossings(const Ray& ray, std::vector<CustomCrossing>& out) const override {
    add(ray, outer, 0, out);
    add(ray, inner, 1, out);
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  }
  CustomPoint point(const Vec3& position, std::uint32_t face) const override {
    return {.normal = face == 0 ? position : -position};
  }
  std::uint32_t face_count() const override { return 2; }

  static constexpr double outer = 1;
  static constexpr double inner = 0.75;

 private:
  static void add(const Ray& ray, double radius, std::uint32_t face,
                  std::vector<CustomCrossing>& out) {
    const double middle = -glm::dot(ray.origin, ray.direction);
    const Vec3 nearest = ray.origin + middle * ray.direction;
    const double square = radius * radius - glm::dot(nearest, nearest);
    if (!(square > 0)) return;
    const double half = std::sqrt(square);
    const double error = 1e-15 * (1 + 1 / half);
    out.push_back({.t = middle - half, .error = error, .face = face});
    out.push_back({.t = middle + half, .error = error, .face = face});
  }
};

/// A Scripted shape answers what a test says.
class Scripted final : public CustomShape {
 public:
  std::function<void(std::vector<CustomCrossing>&)> answer = [](auto& out) {
    out = {{.t = -0.5}, {.t = 0.5}};
  };
  CustomPoint answered_point;
  BoundingBox box{.lower = Vec3(-1), .upper = Vec3(1)};
  std::uint32_t faces = 1;

  BoundingBox bounds() const override { return box; }
  void crossings(const Ray&, std::vector<CustomCrossing>& out) const override { answer(out); }
  CustomPoint point(const Vec3&, std::uint32_t) const override { return answered_point; }
  std::uint32_t face_count() const override { return faces; }
  std::string name() const override { return "the odd egg"; }
};

Scene scene_of(const Entity& entity) {
  Scene scene;
  scene.entities = {entity};
  scene.settings.width = 24;
  scene.settings.height = 24;
  return scene;
}

/// Returns the message of what asking a shape throws.
std::string refusal(const std::shared_ptr<const CustomShape>& shape,
                    const std::function<void(const PreparedScene&)>& ask) {
  try {
    ask(prepare(scene_of(Custom{.shape = shape})));
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(error.argument() == "shape");
    return error.what();
  }
  return "";
}

Primitive random_solid(Random& random) {
  const double size = random.power_of_ten(-3, 3);
  const Vec3 at = random.in_cube() * size;
  const Vec3 end = at + random.direction() * size;
  switch (random.bits() % 4) {
    case 0:
      return Sphere{.center = at, .radius = size};
    case 1:
      return Box{.corner_a = at, .corner_b = at + size * Vec3(0.5, 1.5, -0.7)};
    case 2:
      return Capsule{.from = at, .to = end, .radius = 0.4 * size};
    default:
      return Torus{.center = at, .axis = end - at, .radius = size, .thickness = 0.3 * size};
  }
}

const Ray along_z{.origin = {0.1, 0.2, -5}, .direction = {0, 0, 1}};

}  // namespace

TEST_CASE(
    "a custom shape that says what a primitive says is met where that is, from any distance") {
  Random random(1);
  int met = 0;
  int others = 0;
  for (int i = 0; i < 20000; ++i) {
    const Primitive primitive = random_solid(random);
    const auto shape = core::make_shape(primitive);
    const auto custom = core::make_shape(as_custom(primitive));
    const core::Bounds bounds = shape->bounds();
    const double size = core::largest_component(bounds.upper - bounds.lower);
    const Vec3 aim = core::middle_of(bounds) + 0.5 * size * random.in_cube();
    const Vec3 direction = random.direction() * random.power_of_ten(-9, 9);
    const double away = random.power_of_ten(-2, 9) * size / glm::length(direction);
    const core::ObjectRay ray{.origin = aim - away * direction, .direction = direction};
    core::CrossingList expected;
    core::CrossingList found;
    shape->crossings(ray, expected);
    custom->crossings(ray, found);
    if (found.size() != expected.size()) {
      ++others;
      continue;
    }
    for (std::size_t k = 0; k < found.size(); ++k) {
      ++met;
      REQUIRE(found[k].entering == expected[k].entering);
      const core::SurfacePoint point = shape->surface_point(ray, expected[k]);
      const double cosine = std::abs(glm::dot(point.normal, core::unit_vector(direction)));
      const double most = (found[k].error + expected[k].error) / std::min(1.0, 10 * cosine);
      REQUIRE(std::abs(found[k].t - expected[k].t) <= most);
      if (found[k].face != expected[k].face) continue;  // at an edge
      const core::SurfacePoint same = custom->surface_point(ray, found[k]);
      REQUIRE(glm::length(same.normal - point.normal) < 1e-5 / std::max(cosine, 1e-5));
    }
  }
  CHECK(met > 10000);
  CHECK(others < 5);
}

TEST_CASE("a ray that starts on a custom shape goes on from there, to the side that it says") {
  const auto shape = core::make_shape(Custom{.shape = std::make_shared<const Shell>()});
  Random random(2);
  for (int i = 0; i < 50000; ++i) {
    // The start is off the surface by rounding, and the ray goes any way, grazing ones included.
    const std::uint32_t face = random.one_in(2) ? 0 : 1;
    const double radius = face == 0 ? Shell::outer : Shell::inner;
    const Vec3 place = radius * core::unit_vector(random.in_cube() + Vec3(1e-3));
    const Vec3 outwards = face == 0 ? place / radius : -place / radius;
    Vec3 direction = core::unit_vector(random.in_cube() + Vec3(1e-3));
    if (random.one_in(2)) {
      direction -= glm::dot(direction, outwards) * outwards;
      direction += random.power_of_ten(-18, 0) * (random.one_in(2) ? 1.0 : -1.0) * outwards;
      direction = core::unit_vector(direction);
    }
    const double rise = glm::dot(direction, outwards);
    if (rise == 0) continue;
    const core::ObjectRay ray{.origin = place * (1 + random.uniform(-1, 1) * 1e-15),
                              .direction = direction,
                              .start = {.face = face,
                                        .side = rise > 0 ? core::Side::outside : core::Side::inside,
                                        .t_error = 4e-15}};
    core::CrossingList list;
    shape->crossings(ray, list);
    bool inside = false;
    for (std::size_t k = 0; k < list.size(); ++k) {
      REQUIRE(list[k].entering != inside);
      if (k > 0) REQUIRE(list[k - 1].t < list[k].t);
      inside = list[k].entering;
    }
    std::vector<core::Crossing> ahead;
    for (const core::Crossing& crossing : list) {
      if (crossing.t > 0) ahead.push_back(crossing);
    }
    // The sphere's other end is ahead where the ray goes into that sphere.
    std::vector<double> expected;
    const bool into_outer = face == 0 && rise < 0;
    const double b = glm::dot(place, direction);
    const double of_inner = b * b - radius * radius + Shell::inner * Shell::inner;
    const double of_outer = b * b - radius * radius + Shell::outer * Shell::outer;
    if (face == 1) {
      if (rise > 0) expected.push_back(-2 * b);
      expected.push_back(-b + std::sqrt(of_outer));
    } else if (into_outer) {
      if (of_inner > 1e-12) {
        expected.push_back(-b - std::sqrt(of_inner));
        expected.push_back(-b + std::sqrt(of_inner));
      } else if (of_inner > -1e-12) {
        continue;  // grazes the inner sphere
      }
      expected.push_back(-2 * b);
    }
    INFO(face, " ", rise, " ", ahead.size(), " ", expected.size());
    REQUIRE(ahead.size() == expected.size());
    for (std::size_t k = 0; k < ahead.size(); ++k) {
      REQUIRE(std::abs(ahead[k].t - expected[k]) < 1e-6);
    }
  }
}

TEST_CASE("a custom shape is one with itself, is combined, placed, and met by all queries alike") {
  const Entity shell = Custom{.shape = std::make_shared<const Shell>()};
  const Entity ball = Sphere{.radius = 0.9};
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    const auto prepared = [&](const Entity& entity) {
      Scene scene = scene_of(entity);
      scene.settings.precision = precision;
      return prepare(scene);
    };
    const PreparedScene nothing = prepared(shell - shell.with_id(3));
    const PreparedScene cut = prepared(shell - ball);
    const PreparedScene expected =
        prepared(Entity(Sphere{.radius = 1}) - Entity(Sphere{.radius = 0.9}));
    const Transform placing{
        .row_x = {0, -2, 0}, .row_y = {2, 0, 0}, .row_z = {0, 0, 2}, .translation = {1, 5, -3}};
    const PreparedScene alone = prepared(shell);
    const PreparedScene placed = prepared(shell.transformed(placing));
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
      const Ray ray{.origin = 3.0 * random.direction(), .direction = random.direction()};
      CHECK(crossings(nothing, ray).empty());
      const std::vector<Hit> hits = crossings(cut, ray);
      const std::vector<Hit> other = crossings(expected, ray);
      REQUIRE(hits.size() == other.size());
      for (std::size_t k = 0; k < hits.size(); ++k) {
        REQUIRE(std::abs(hits[k].t - other[k].t) < 1e-12);
        REQUIRE(glm::length(hits[k].normal - other[k].normal) < 1e-9);
      }
      const std::optional<Hit> first = intersect(cut, ray);
      REQUIRE(first.has_value() == !hits.empty());
      if (first) REQUIRE(first->t == hits.front().t);
      const Ray moved{
          .origin = {1 - 2 * ray.origin.y, 5 + 2 * ray.origin.x, 2 * ray.origin.z - 3},
          .direction = {-2 * ray.direction.y, 2 * ray.direction.x, 2 * ray.direction.z}};
      const std::vector<Hit> here = crossings(alone, ray);
      const std::vector<Hit> there = crossings(placed, moved);
      REQUIRE(here.size() == there.size());
      for (std::size_t k = 0; k < here.size(); ++k) {
        REQUIRE(std::abs(here[k].t - there[k].t) < 1e-12);
      }
    }
  }
}

TEST_CASE("an answer that cannot be is an error that names the shape, whoever asked") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  const auto asked = [](const PreparedScene& scene) { crossings(scene, along_z); };
  const auto wrong = [&](std::vector<CustomCrossing> answer) {
    const auto shape = std::make_shared<Scripted>();
    shape->answer = [answer](std::vector<CustomCrossing>& out) { out = answer; };
    return refusal(shape, asked);
  };
  CHECK(wrong({{.t = -0.5}, {.t = 0.5}}) == "");
  CHECK(wrong({{.t = 0}}).starts_with("the odd egg: there are 1 crossings, an odd number, along "));
  CHECK(wrong({{.t = nan}, {.t = 1}}).starts_with("the odd egg: a crossing has t = nan, along "));
  CHECK(wrong({{.t = 0}, {.t = inf}}).starts_with("the odd egg: a crossing has t = inf, along "));
  CHECK(wrong({{.t = 0.5}, {.t = -0.5}})
            .starts_with("the odd egg: crossings are not in order: -0.5 comes after 0.5, along "));
  CHECK(wrong({{.t = 0}, {.t = 7}})
            .starts_with("the odd egg: the crossing at t = 7 is not within the bounds, along "));
  CHECK(wrong({{.t = 0, .error = -1}, {.t = 0.5}}).starts_with("the odd egg: an error is -1, "));
  CHECK(wrong({{.t = 0, .error = nan}, {.t = 0.5}}).starts_with("the odd egg: an error is nan, "));
  CHECK(wrong({{.t = 0, .face = 1}, {.t = 0.5}})
            .starts_with("the odd egg: a crossing has face 1 of 1, along "));
  CHECK(
      wrong(std::vector<CustomCrossing>(65538))
          .starts_with("the odd egg: there are 65538 crossings, and at most 65536 may be, along "));

  const auto shape = std::make_shared<Scripted>();
  shape->answered_point.normal = {0, 0, 0};
  const auto hit = [](const PreparedScene& scene) { intersect(scene, along_z); };
  CHECK(refusal(shape, hit).starts_with("the odd egg: the normal of face 0 at (0.1"));
  shape->answered_point = {.normal = {0, 0, 1}, .u = nan};
  CHECK(refusal(shape, hit).starts_with("the odd egg: (u, v) of face 0 at (0.1"));

  shape->answer = [](std::vector<CustomCrossing>& out) { out = {{.t = 0}}; };
  for (const std::function<void(const PreparedScene&)>& ask :
       std::vector<std::function<void(const PreparedScene&)>>{
           [](const PreparedScene& scene) { render(scene); },
           [](const PreparedScene& scene) { RenderJob(scene).wait(); },
           [](const PreparedScene& scene) { intersect(scene, along_z); },
           [](const PreparedScene& scene) { occluded(scene, along_z); },
           [](const PreparedScene& scene) {
             const std::vector<Ray> rays(100, along_z);
             std::vector<double> distances(rays.size());
             RayQueries(scene).distances(rays, distances);
           }}) {
    CHECK(refusal(shape, ask).starts_with("the odd egg: there are 1 crossings, an odd number, "));
  }
}

TEST_CASE("bounds and faces that cannot be are refused before any ray is traced") {
  const auto fault = [](const auto& change) -> std::string {
    const auto shape = std::make_shared<Scripted>();
    change(*shape);
    try {
      const Entity entity = Custom{.shape = shape};
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  CHECK(fault([](Scripted&) {}) == "");
  CHECK(fault([](Scripted& s) {
          s.box.upper.x = HUGE_VAL;
        }).starts_with("the odd egg: bounds must be finite"));
  CHECK(fault([](Scripted& s) {
          s.box.lower.y = NAN;
        }).starts_with("the odd egg: bounds must be finite"));
  CHECK(fault([](Scripted& s) {
          s.box.lower.z = -2e100;
        }).starts_with("the odd egg: bounds must be finite and at most 1e100"));
  CHECK(fault([](Scripted& s) {
          s.box.lower.z = 1;
        }).starts_with("the odd egg: upper bounds must be above lower ones"));
  CHECK(fault([](Scripted& s) { s.faces = 0; }) ==
        "the odd egg: there must be 1 to 65536 faces, but are 0");
  CHECK(fault([](Scripted& s) { s.faces = 65537; }) ==
        "the odd egg: there must be 1 to 65536 faces, but are 65537");
}

TEST_CASE("what a custom shape throws comes out of the render or the query as it was thrown") {
  struct Ours {
    int number;
  };
  const auto shape = std::make_shared<Scripted>();
  const PreparedScene scene = prepare(scene_of(Custom{.shape = shape}));
  shape->answer = [](std::vector<CustomCrossing>&) { throw Ours{5}; };
  const auto number = [&](const auto& ask) {
    try {
      ask();
    } catch (const Ours& ours) {
      return ours.number;
    }
    return 0;
  };
  CHECK(number([&] { prepare(scene_of(Custom{.shape = shape})); }) == 5);
  CHECK(number([&] { render(scene); }) == 5);
  CHECK(number([&] { RenderJob(scene).wait(); }) == 5);
  CHECK(number([&] { intersect(scene, along_z); }) == 5);
  CHECK(number([&] { occluded(scene, along_z); }) == 5);
  CHECK(number([&] { crossings(scene, along_z); }) == 5);
}
