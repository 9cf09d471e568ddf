// These checks must hold of every primitive. They go over the list of all, so a new one is tested
// by being listed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/geometry/description.hpp"
#include "core/geometry/placed_solid.hpp"
#include "core/geometry/shape.hpp"
#include "core/math/vector.hpp"
#include "core/ray/line_of_ray.hpp"
#include "crt/error.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "crt/transform.hpp"
#include "crt/validate.hpp"
#include "geometry/exact_tools.hpp"
#include "geometry/oracle.hpp"
#include "geometry/random_instances.hpp"
#include "support/scene_of.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Checks that crossings with a shape are where an enclosure has them, with the bounds on their
/// errors or without.
void check_enclosed(const core::Shape& shape, const Crossings& crossings, bool with_errors,
                    const core::Enclosure<double>& part) {
  for (const core::Crossing& crossing : crossings.list) {
    const double error = with_errors ? crossing.error : 0;
    const double from = crossing.t - error;
    const double to = crossing.t + error;
    REQUIRE_FALSE((crossing.entering ? from < part.enter_from : to > part.leave_to));
    REQUIRE_FALSE((from > part.enter_to && to < part.leave_from));
    if (shape.is_convex())
      REQUIRE_FALSE((crossing.entering ? to > part.enter_to : from < part.leave_from));
  }
  if (crossings.list.empty() && !crossings.starts_inside) REQUIRE_FALSE(part.is_met());
}

Transform scaling(double factor) {
  return {{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}, {0, 0, 0}};
}

/// Returns how far apart two lengths of this instance may be that are equal but for rounding.
double tolerance(const core::ObjectRay& ray, double t) {
  return 1e-12 * (1 + core::largest_component(ray.origin) +
                  std::abs(t) * core::largest_component(ray.direction));
}

}  // namespace

TEST_CASE("what encloses a primitive along a line holds its crossings") {
  for_instances(400, [](const Primitive&, const core::Shape& shape, Random& random) {
    if (!shape.is_solid()) return;
    const Transform moved =
        random.one_in(2) ? Transform{} : rotate_degrees(180.0 * random.in_cube());
    const core::Placement placement{core::PreciseTransform(moved)};
    const auto box = core::place_box(shape, placement);
    const auto by_formula = shape.placed(placement);
    const auto by_crossings =
        shape.is_convex() ? core::place_by_crossings(shape, placement) : nullptr;
    for (int i = 0; i < 20; ++i) {
      const core::ObjectRay in_object = random_ray(random);
      const core::WorldRay ray{.origin = placement.point_to_world(in_object.origin),
                               .direction = placement.direction_to_world(in_object.direction)};
      const auto line = core::line_of(ray);
      const Crossings crossings =
          crossings_of(shape, placement.to_object(ray.origin, ray.direction));
      for (const auto* solid : {box.get(), by_formula.get(), by_crossings.get()}) {
        if (solid == nullptr) continue;
        core::Enclosure<double> part;
        if (solid->enclose(line, true, nullptr, part)) {
          check_enclosed(shape, crossings, solid != box.get(), part);
        } else {
          REQUIRE(crossings.list.empty());
          REQUIRE_FALSE(crossings.starts_inside);
        }
      }
    }
  });
}

TEST_CASE("all primitives: crossings come in order and by turns, and solids that end are left") {
  for_instances(300, [](const Primitive&, const core::Shape& shape, Random& random) {
    for (int i = 0; i < 30; ++i) {
      const auto [list, starts_inside] = crossings_of(shape, random_ray(random));
      const bool ends = shape.bounds().finite();
      REQUIRE((!starts_inside || (shape.is_solid() && !ends)));
      bool inside = starts_inside;
      for (std::size_t k = 0; k < list.size(); ++k) {
        REQUIRE(list[k].face < shape.face_count());
        REQUIRE(list[k].error >= 0);
        if (k > 0) REQUIRE(list[k - 1].t <= list[k].t);
        if (shape.is_solid()) REQUIRE(list[k].entering != inside);
        inside = list[k].entering;
      }
      if (shape.is_solid() && ends) REQUIRE(list.size() % 2 == 0);
      if (shape.is_solid() && shape.is_convex()) REQUIRE(list.size() <= 2);
    }
  });
}

TEST_CASE(
    "all primitives: points are where the ray is, in the bounds, with a normal that faces right") {
  for_instances(300, [](const Primitive&, const core::Shape& shape, Random& random) {
    for (int i = 0; i < 30; ++i) {
      const core::ObjectRay ray = random_ray(random);
      for (const core::Crossing& crossing : crossings_of(shape, ray).list) {
        const core::SurfacePoint point = shape.surface_point(ray, crossing);
        const double room = tolerance(ray, crossing.t);
        const Vec3 place = ray.origin + crossing.t * ray.direction;
        const double grazing = crossing.error * core::largest_component(ray.direction);
        REQUIRE(core::largest_component(point.position - place) <= room + grazing);
        REQUIRE(shape.bounds().grown(room).touches({point.position, point.position}));
        REQUIRE(std::abs(glm::length(point.normal) - 1) < 1e-14);
        const double along = glm::dot(point.normal, ray.direction) / glm::length(ray.direction);
        // That of an implicit solid is against the ray where the field has a corner or is flat.
        const bool has_normal = point.normal != core::unit_vector(-ray.direction);
        if (has_normal && std::abs(along) > 1e-6) REQUIRE((along < 0) == crossing.entering);
        REQUIRE(std::isfinite(point.u));
        REQUIRE(std::isfinite(point.v));
      }
    }
  });
}

TEST_CASE(
    "all primitives: both tiers tell the same crossings, as near to each other as is promised") {
  int rays = 0;
  int others = 0;
  for_instances(100, [&](const Primitive& primitive, const core::Shape& shape, Random& random) {
    for (int i = 0; i < 20; ++i) {
      const core::ObjectRay ray = random_ray(random);
      const core::CrossingList list = crossings_of(shape, ray).list;
      const core::CrossingList exact =
          exact_crossings(primitive, Transform{}, ray.origin, ray.direction);
      ++rays;
      // Where a ray grazes or passes along a face, one tier may see what the other does not.
      if (exact.size() != list.size()) {
        ++others;
        continue;
      }
      for (std::size_t k = 0; k < list.size(); ++k) {
        REQUIRE(exact[k].entering == list[k].entering);
        const double difference = exact[k].t - list[k].t + exact[k].t_low;
        REQUIRE(std::abs(difference) <= list[k].error + exact[k].error);
      }
    }
  });
  CHECK(others * 1000 < rays);
}

TEST_CASE(
    "all primitives: every query of a scene tells what the shape does, at any scale to the bit") {
  for_instances(40, [](const Primitive& primitive, const core::Shape& shape, Random& random) {
    std::vector<Ray> rays;
    for (int i = 0; i < 32; ++i) {
      const core::ObjectRay ray = random_ray(random);
      rays.push_back({.origin = ray.origin, .direction = ray.direction});
    }
    for (const double scale : {1.0, 0x1p-120, 0x1p90}) {
      std::vector<Ray> scaled_rays = rays;
      for (Ray& ray : scaled_rays) {
        ray.origin *= scale;
        ray.direction *= scale;
      }
      const PreparedScene scene = scene_of(Entity(primitive).transformed(scaling(scale)));
      std::vector<double> distances(rays.size());
      RayQueries queries(scene);
      queries.distances(scaled_rays, distances);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const core::CrossingList list =
            crossings_of(shape, {rays[i].origin, {}, rays[i].direction}).list;
        std::vector<double> ahead;
        for (const core::Crossing& crossing : list) {
          if (crossing.t - crossing.error > 0) ahead.push_back(crossing.t);
        }
        const std::vector<Hit> hits = crossings(scene, scaled_rays[i]);
        REQUIRE(hits.size() == ahead.size());
        for (std::size_t k = 0; k < hits.size(); ++k) REQUIRE(hits[k].t == ahead[k]);
        REQUIRE(distances[i] == (ahead.empty() ? HUGE_VAL : ahead.front()));
        const std::optional<Hit> hit = intersect(scene, scaled_rays[i]);
        REQUIRE((hit ? hit->t : HUGE_VAL) == distances[i]);
        REQUIRE(occluded(scene, scaled_rays[i]) == hit.has_value());
      }
    }
  });
}

TEST_CASE(
    "all primitives: a solid is one with itself in CSG, and nothing is left of it without itself") {
  for_instances(30, [](const Primitive& primitive, const core::Shape& shape, Random& random) {
    if (!shape.is_solid()) return;
    const Entity solid(primitive);
    for (const Precision precision : {Precision::standard, Precision::exact}) {
      const PreparedScene alone = scene_of(solid, precision);
      const PreparedScene with_itself = scene_of(solid ^ solid.with_id(1), precision);
      const PreparedScene without_itself = scene_of(solid - solid.with_id(1), precision);
      for (int i = 0; i < 20; ++i) {
        const core::ObjectRay made = random_ray(random);
        const Ray ray{.origin = made.origin, .direction = made.direction};
        REQUIRE(crossings(without_itself, ray).empty());
        const std::vector<Hit> expected = crossings(alone, ray);
        const std::vector<Hit> hits = crossings(with_itself, ray);
        REQUIRE(hits.size() == expected.size());
        for (std::size_t k = 0; k < hits.size(); ++k) REQUIRE(hits[k].t == expected[k].t);
      }
    }
  });
}
