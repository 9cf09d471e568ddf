// Many things at one place look as one does, or as they do one by one.
#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "core/render/media_along_ray.hpp"
#include "crt/error.hpp"
#include "pictures.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

Material tinted_glass() {
  return {.color = Color{0.9, 0.8, 0.7},
          .transparency = 0.8,
          .refractive_index = 1.3,
          .specular = 0.3,
          .absorption = {0.1, 0.2, 0.3}};
}

Scene lit_scene(std::vector<Entity> entities) {
  Scene scene;
  scene.settings.width = 24;
  scene.settings.height = 18;
  scene.camera = {.position = {0.3, 1, -5}, .pointing = {0, 0, 0}};
  scene.lights = {PointLight{.origin = {-4, 6, -5}}};
  scene.entities = std::move(entities);
  scene.entities.emplace_back(Plane{.position = {0, -1, 0}});
  return scene;
}

Image picture(const Scene& scene) {
  return render(prepare(scene), {.threads = 1});
}

}  // namespace

TEST_CASE("a picture with things twice has the bytes of that with them once") {
  const SharedMaterial glass = tinted_glass();
  const Entity sphere = Sphere{.material = glass};
  const Entity bite = Sphere{.center = {0.6, 0.4, -0.6}, .radius = 0.7};
  const Entity disc =
      Disc{.center = {0, 0, -2}, .normal = {0, 0, 1}, .radius = 0.5, .material = glass};
  for (const Entity& entity :
       {sphere, Entity(Sphere{}), disc, sphere - bite, sphere + bite, bite ^ sphere}) {
    const Image once = picture(lit_scene({entity}));
    CHECK(same_pixels(picture(lit_scene({entity, entity, entity})), once));
    CHECK(same_pixels(picture(lit_scene({entity + entity, entity})), once));
    if (!entity.is_solid()) continue;
    CHECK(same_pixels(picture(lit_scene({entity ^ entity})), once));
    CHECK(same_pixels(picture(lit_scene({(entity + bite) ^ entity})), once));
  }
  const Image cut = picture(lit_scene({sphere - bite}));
  CHECK(same_pixels(picture(lit_scene({csg_difference(sphere, std::vector<Entity>(1000, bite))})),
                    cut));
  CHECK(
      same_pixels(picture(lit_scene({csg_union(std::vector<Entity>(1000, sphere - bite))})), cut));
}

TEST_CASE("a hundred thousand equal things cost a ray what one does") {
  const Entity sphere = Sphere{.material = tinted_glass()};
  const RenderStats one = picture(lit_scene({sphere})).stats();
  const RenderStats many = picture(lit_scene(std::vector<Entity>(100'000, sphere))).stats();
  CHECK(many.intersection_tests == one.intersection_tests);
  CHECK(many.camera_rays == one.camera_rays);
}

TEST_CASE("a picture whose rays take too many steps is an error, at any number of threads") {
  std::vector<Entity> spheres;
  for (int i = 0; i < 20'000; ++i) spheres.emplace_back(Sphere{.center = {0, 0, 1e-7 * i}});
  const PreparedScene prepared = prepare(lit_scene({csg_intersection(spheres)}));
  for (const int threads : {1, 3}) {
    const auto failure = [&](std::uint64_t most) {
      try {
        render(prepared,
               {.region = Region{11, 8, 2, 2}, .threads = threads, .max_ray_steps = most});
      } catch (const Error& error) {
        CHECK(std::string(error.what()).find("max_ray_steps") != std::string::npos);
        return error.code();
      }
      return ErrorCode::internal;
    };
    CHECK(failure(10'000) == ErrorCode::limit);
    CHECK(failure(30'000) == ErrorCode::internal);
    CHECK(failure(0) == ErrorCode::internal);
  }
}

TEST_CASE(
    "light through tens of thousands of absorbing solids that overlap costs no square of their "
    "number") {
  // Each sphere is left in the order in which they are entered.
  std::vector<Entity> spheres;
  const SharedMaterial clear =
      Material{.color = grey(1), .transparency = 1, .absorption = {1e-6, 1e-6, 1e-6}};
  for (int i = 0; i < 30'000; ++i)
    spheres.emplace_back(Sphere{.center = {1e-6 * i, 0, 0}, .material = clear});
  Scene scene = lit_scene(spheres);
  scene.settings.recursion_depth = 0;
  scene.lights = {PointLight{.origin = {0, 20, 0}}};
  scene.camera = {.position = {0, -0.9, -5}, .pointing = {0, -1, 0}};
  const Image image = render(prepare(scene), {.region = Region{12, 9, 1, 1}});
  CHECK(image.stats().shadow_rays > 0);
}

TEST_CASE("the media along a ray are those that lists of them give, however solids overlap") {
  std::mt19937 random(18);
  for (int trial = 0; trial < 3000; ++trial) {
    const auto count = std::uint32_t{1} + random() % (trial % 10 == 0 ? 60 : 8);
    std::vector<RayHit> crossings;
    std::vector<double> beyond(count, 0);  // where a solid is left that is not left before
    std::vector<std::uint32_t> around;
    const auto any_t = [&] { return static_cast<double>(random() % 40); };
    for (std::uint32_t object = 0; object < count; ++object) {
      const double a = any_t();
      const double b = any_t();
      const bool starts_inside = random() % 4 == 0;
      const bool ends_inside = random() % 4 == 0;
      if (starts_inside) around.push_back(object);
      const auto add = [&](double t, bool entering) {
        crossings.push_back({.t = t, .error = 1e-9, .object = object, .entering = entering});
      };
      if (!starts_inside) add(std::min(a, b), true);
      if (!ends_inside) add(std::max(a, b) + 0.5, false);
      beyond[object] = 100 + any_t();
    }
    std::shuffle(around.begin(), around.end(), random);
    std::stable_sort(crossings.begin(), crossings.end(),
                     [](const RayHit& a, const RayHit& b) { return a.t < b.t; });

    const auto exit_after = [&](std::size_t index, std::uint32_t object) {
      for (; index < crossings.size(); ++index) {
        if (crossings[index].object == object && !crossings[index].entering)
          return crossings[index];
      }
      return RayHit{.t = beyond[object], .error = 1e-9, .object = object};
    };
    MediaLists lists;
    MediaLists::List list = MediaLists::empty;
    for (auto object = around.rbegin(); object != around.rend(); ++object) {
      list = lists.entered(list, Medium{*object, 0});
    }
    class Line final : public MediaAlongRay::Line {
     public:
      explicit Line(const std::vector<double>& beyond) : beyond_(beyond) {}
      RayHit exit_beyond(std::uint32_t object) const override {
        return {.t = beyond_[object], .error = 1e-9, .object = object};
      }

     private:
      const std::vector<double>& beyond_;
    };
    const Line line(beyond);
    MediaAlongRay along;
    along.begin(crossings, line);
    for (const std::uint32_t object : around) along.surround({object, 0});
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      const Medium medium{crossings[i].object, static_cast<std::uint32_t>(i)};
      if (crossings[i].entering) {
        list = entered_in_order(lists, list, medium,
                                [&](std::uint32_t object) { return exit_after(i + 1, object); });
        along.enter(medium, i + 1);
      } else {
        list = lists.left(list, medium.object);
        along.leave(medium.object);
      }
      REQUIRE(along.empty() == (list == MediaLists::empty));
      if (along.empty()) continue;
      REQUIRE(along.innermost().object == lists.innermost(list).object);
      REQUIRE(along.innermost().material == lists.innermost(list).material);
    }
  }
}
