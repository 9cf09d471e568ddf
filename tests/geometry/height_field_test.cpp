#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "core/geometry/exact_shape.hpp"
#include "core/geometry/height_field/height_field.hpp"
#include "core/geometry/shape.hpp"
#include "crt/error.hpp"
#include "crt/image.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "crt/transform.hpp"
#include "geometry/height_fields.hpp"
#include "geometry/line_checks.hpp"
#include "support/scene_of.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns a field in a box whose numbers are mostly whole.
HeightField random_field(Random& random, std::uint32_t most = 9) {
  HeightField field{.heights = random_grid(random, most)};
  if (random.one_in(2)) {
    field.corner_a = {0, 0, 0};
    field.corner_b = {field.heights->columns() - 1.0, 4, field.heights->rows() - 1.0};
  } else if (random.one_in(2)) {
    field.corner_a = random.in_cube();
    field.corner_b = field.corner_a + random.uniform(0.1, 2) * Vec3(1, 0.5, -1.5);
  }
  return field;
}

/// Returns a hard ray, or one from a corner or an edge to another corner.
Ray field_ray(Random& random, const TriangleList& mesh) {
  if (random.one_in(4)) {
    const TriangleIndices& triangle = mesh.triangles[random.bits() % mesh.triangles.size()];
    const Vec3 a = mesh.positions[triangle[0]];
    const Vec3 from = random.one_in(2) ? a : 0.5 * (a + mesh.positions[triangle[1]]);
    const Vec3 to = mesh.positions[random.bits() % mesh.positions.size()];
    const double endless = std::numeric_limits<double>::infinity();
    const Vec3 way = to - from;
    if (way != Vec3(0.0)) return {.origin = from - 8.0 * way, .direction = way, .t_min = -endless};
  }
  return hard_ray(random, mesh);
}

std::string argument_of(const std::vector<double>& heights, std::uint32_t columns,
                        std::uint32_t rows) {
  try {
    make_height_grid(heights, columns, rows);
    return "";
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    return error.argument();
  }
}

}  // namespace

TEST_CASE("a height field and the mesh of its facets meet every line alike") {
  Random random(1);
  std::size_t met = 0;
  for (int round = 0; round < 150; ++round) {
    const HeightField field = random_field(random);
    const TriangleList mesh = mesh_of(field);
    REQUIRE(mesh.entity().is_solid());
    for (const Precision tier : tiers) {
      const bool is_exact = tier == Precision::exact;
      const PreparedScene by_field = scene_of(Entity(field), tier);
      const PreparedScene by_mesh = scene_of(mesh.entity(), tier);
      for (int i = 0; i < 200; ++i) {
        Ray ray = field_ray(random, mesh);
        const std::vector<Hit> hits = crossings(by_field, ray);
        const std::vector<Hit> expected = crossings(by_mesh, ray);
        check_turns(hits, ray);
        INFO("round ", round, " ray ", i, " tier ", is_exact, " origin ", ray.origin.x, " ",
             ray.origin.y, " ", ray.origin.z, " direction ", ray.direction.x, " ", ray.direction.y,
             " ", ray.direction.z);
        if (is_exact) {
          REQUIRE(hits.size() == expected.size());
          for (std::size_t k = 0; k < hits.size(); ++k) {
            REQUIRE(hits[k].t == expected[k].t);
            REQUIRE(hits[k].entering == expected[k].entering);
          }
          met += hits.size();
        }
        const std::optional<Hit> first = intersect(by_field, ray);
        REQUIRE(first.has_value() == !hits.empty());
        if (first) REQUIRE(first->t == hits.front().t);
        REQUIRE(occluded(by_field, ray) == !hits.empty());
      }
    }
  }
  CHECK(met > 10000);
}

TEST_CASE("a height field of one height is a box, to the last bit, also where it is cut flush") {
  Random random(2);
  std::size_t met = 0;
  for (int round = 0; round < 60; ++round) {
    const std::uint32_t columns = 2 + static_cast<std::uint32_t>(random.bits() % 5);
    const std::uint32_t rows = 2 + static_cast<std::uint32_t>(random.bits() % 5);
    const HeightField field{
        .heights =
            make_height_grid(std::vector<double>(std::size_t{columns} * rows, 0.5), columns, rows),
        .corner_a = {0, 0, 0},
        .corner_b = {3, 2, 3}};
    const Box box{.corner_a = {0, 0, 0}, .corner_b = {3, 1, 3}};
    const auto whole = [&] { return static_cast<double>(random.bits() % 3); };
    const Box cutter{.corner_a = {whole(), whole(), whole()}, .corner_b = {3, 1.5, 3.5}};
    Entity by_field = field;
    Entity by_box = box;
    if (round % 3 == 1) {
      by_field = by_field - cutter;
      by_box = by_box - cutter;
    } else if (round % 3 == 2) {
      by_field = cutter + by_field;
      by_box = cutter + by_box;
    }
    for (const Precision tier : tiers) {
      const PreparedScene field_scene = scene_of(by_field, tier);
      const PreparedScene box_scene = scene_of(by_box, tier);
      for (int i = 0; i < 200; ++i) {
        Ray ray{.origin = 6.0 * random.in_cube(), .direction = random.direction()};
        if (random.one_in(4)) ray.origin = Vec3(whole(), whole(), whole()) + Vec3(0.5);
        const std::vector<Hit> hits = crossings(field_scene, ray);
        const std::vector<Hit> expected = crossings(box_scene, ray);
        REQUIRE(hits.size() == expected.size());
        met += hits.size();
        for (std::size_t k = 0; k < hits.size(); ++k) {
          REQUIRE(hits[k].t == expected[k].t);
          REQUIRE(hits[k].normal == expected[k].normal);
        }
      }
    }
  }
  CHECK(met > 4000);
}

TEST_CASE("a height field is below the surface through its heights, and nowhere else") {
  Random random(3);
  int inside = 0;
  int outside = 0;
  for (int round = 0; round < 40; ++round) {
    const HeightField field = random_field(random, 6);
    const HeightGrid& grid = *field.heights;
    const Vec3 lower = glm::min(field.corner_a, field.corner_b);
    const Vec3 size = glm::max(field.corner_a, field.corner_b) - lower;
    const PreparedScene scene = scene_of(Entity(field));
    for (int i = 0; i < 300; ++i) {
      const double x = random.uniform(0, grid.columns() - 1.0);
      const double z = random.uniform(0, grid.rows() - 1.0);
      const auto column = static_cast<std::uint32_t>(x);
      const auto row = static_cast<std::uint32_t>(z);
      const double u = x - column;
      const double v = z - row;
      const double a = grid.height(column, row);
      const double b = grid.height(column + 1, row + 1);
      const double beside = u > v ? grid.height(column + 1, row) : grid.height(column, row + 1);
      const double height = u > v ? a + (beside - a) * (u - v) + (b - a) * v
                                  : a + (beside - a) * (v - u) + (b - a) * u;
      const double share = random.uniform(-0.1, 1.1);
      if (std::abs(share - height) < 1e-9 || std::abs(share) < 1e-9) continue;
      const Vec3 point =
          lower + size * Vec3(x / (grid.columns() - 1), share, z / (grid.rows() - 1));
      const Ray ray{.origin = point, .direction = random.direction()};
      const bool is_inside = crossings(scene, ray).size() % 2 != 0;
      REQUIRE(is_inside == (share > 0 && share < height));
      (is_inside ? inside : outside) += 1;
    }
  }
  CHECK(inside > 1000);
  CHECK(outside > 1000);
}

TEST_CASE("a ray that starts on a facet is inside at once if it leaves into the field") {
  Random random(4);
  int starts = 0;
  for (int round = 0; round < 150; ++round) {
    const HeightField field = random_field(random);
    const TriangleList mesh = mesh_of(field);
    const Primitive primitive = field;
    const auto shape = core::make_shape(primitive);
    const auto exact = core::make_exact_shape(primitive);
    for (int i = 0; i < 200; ++i) {
      const Ray ray = field_ray(random, mesh);
      core::CrossingList list;
      const core::ObjectRay object_ray{.origin = ray.origin, .direction = ray.direction};
      shape->crossings(object_ray, list);
      if (list.empty()) continue;
      const core::Crossing& crossing = list[random.bits() % list.size()];
      const core::SurfacePoint point = shape->surface_point(object_ray, crossing);
      Vec3 direction = random.in_cube();
      const double along = glm::dot(direction, point.normal);
      if (std::abs(along) < 1e-3) continue;
      const bool inwards = along < 0;
      // On an edge it is as well on the facet beyond, or leaves past all of them.
      const double x = point.u * (field.heights->columns() - 1);
      const double z = point.v * (field.heights->rows() - 1);
      constexpr double near = 1e-6;
      const bool is_on_edge = crossing.face < core::HeightFacets::first_of_cells ||
                              std::abs(x - std::round(x)) < near ||
                              std::abs(z - std::round(z)) < near ||
                              std::abs((x - std::floor(x)) - (z - std::floor(z))) < near;
      const core::ObjectRay start{
          .origin = point.position,
          .direction = direction,
          .start = {.face = crossing.face,
                    .side = inwards ? core::Side::inside : core::Side::outside},
          .begin = 0};
      for (const bool is_exact : {false, true}) {
        core::CrossingList next;
        const core::ExactRay exact_start{
            .near = start, .world_origin = start.origin, .world_direction = start.direction};
        if (is_exact) {
          exact->crossings(exact_start, next);
        } else {
          shape->crossings(start, next);
        }
        for (std::size_t k = 1; k < next.size(); ++k) {
          REQUIRE(next[k - 1].t <= next[k].t);
          REQUIRE(next[k - 1].entering != next[k].entering);
        }
        const auto at_0 = std::count_if(next.begin(), next.end(),
                                        [](const core::Crossing& met) { return met.t == 0; });
        REQUIRE(at_0 <= 1);
        const auto ahead = std::count_if(next.begin(), next.end(),
                                         [](const core::Crossing& met) { return met.t > 0; });
        if (!is_on_edge) REQUIRE(at_0 == 1);
        if (!is_on_edge) REQUIRE((ahead % 2 != 0) == inwards);
        starts += static_cast<int>(at_0);
      }
    }
  }
  CHECK(starts > 10000);
}

TEST_CASE("what a height field leaves out after the first crossing changes nothing before it") {
  Random random(5);
  int ended = 0;
  for (int round = 0; round < 100; ++round) {
    const HeightField field = random_field(random, 20);
    const TriangleList mesh = mesh_of(field);
    const Primitive primitive = field;
    const auto shape = core::make_shape(primitive);
    const auto exact = core::make_exact_shape(primitive);
    for (int i = 0; i < 200; ++i) {
      const Ray ray = field_ray(random, mesh);
      core::ObjectRay line{.origin = ray.origin, .direction = ray.direction};
      for (const bool is_exact : {false, true}) {
        const auto crossings = [&](core::CrossingList& list) {
          const core::ExactRay exact_line{
              .near = line, .world_origin = line.origin, .world_direction = line.direction};
          return is_exact ? exact->crossings(exact_line, list) : shape->crossings(line, list);
        };
        core::CrossingList all;
        line.first_wanted_after = std::numeric_limits<double>::infinity();
        const bool inside = crossings(all);
        core::CrossingList some;
        line.first_wanted_after = random.one_in(3) ? -1e9 : random.uniform(-2, 12);
        REQUIRE(crossings(some) == inside);
        REQUIRE(some.size() <= all.size());
        for (std::size_t k = 0; k < some.size(); ++k) REQUIRE(are_alike(some[k], all[k]));
        if (some.size() == all.size()) continue;
        REQUIRE(line.is_first_wanted(some.back()));
        REQUIRE(some.back().has_rest);
        ++ended;
      }
    }
  }
  CHECK(ended > 5000);
}

TEST_CASE("a field less itself is nothing, and with itself it is itself") {
  Random random(6);
  std::size_t compared = 0;
  for (int round = 0; round < 30; ++round) {
    const HeightField field = random_field(random);
    HeightField copy = field;
    std::vector<double> heights;
    for (std::uint32_t row = 0; row < field.heights->rows(); ++row) {
      for (std::uint32_t column = 0; column < field.heights->columns(); ++column) {
        heights.push_back(field.heights->height(column, row));
      }
    }
    copy.heights = make_height_grid(heights, field.heights->columns(), field.heights->rows());
    const TriangleList mesh = mesh_of(field);
    for (const Precision tier : tiers) {
      const PreparedScene nothing = scene_of(Entity(field) - Entity(copy), tier);
      const PreparedScene same = scene_of(Entity(field) + Entity(copy), tier);
      const PreparedScene with_mesh = scene_of(Entity(field) - mesh.entity(), tier);
      const PreparedScene alone = scene_of(Entity(field), tier);
      for (int i = 0; i < 100; ++i) {
        const Ray ray = field_ray(random, mesh);
        REQUIRE(crossings(nothing, ray).empty());
        REQUIRE(crossings(with_mesh, ray).empty());
        const std::vector<Hit> hits = crossings(same, ray);
        const std::vector<Hit> expected = crossings(alone, ray);
        // The standard tier may take crossings that are next to each other for one place.
        if (tier == Precision::standard) continue;
        compared += hits.size();
        REQUIRE(hits.size() == expected.size());
        for (std::size_t k = 0; k < hits.size(); ++k) REQUIRE(hits[k].t == expected[k].t);
      }
    }
  }
  CHECK(compared > 2000);
}

TEST_CASE("u and v run along x and z across the box, and on the sides as those of a box") {
  const HeightField field{.heights = make_height_grid({1, 1, 1, 0.5, 0.5, 0.5}, 3, 2),
                          .corner_a = {0, 0, 0},
                          .corner_b = {4, 2, 8}};
  const PreparedScene scene = scene_of(Entity(field));
  const Hit top = *intersect(scene, {.origin = {1, 5, 6}, .direction = {0, -1, 0}});
  CHECK(top.u == doctest::Approx(0.25));
  CHECK(top.v == doctest::Approx(0.75));
  CHECK(top.position.y == doctest::Approx(1.25));
  const Hit below = *intersect(scene, {.origin = {1, -5, 6}, .direction = {0, 1, 0}});
  CHECK(below.u == doctest::Approx(0.25));
  CHECK(below.v == doctest::Approx(0.75));
  const Hit at_x = *intersect(scene, {.origin = {-5, 0.5, 6}, .direction = {1, 0, 0}});
  CHECK(at_x.u == doctest::Approx(0.75));
  CHECK(at_x.v == doctest::Approx(0.25));
  const Hit at_z = *intersect(scene, {.origin = {1, 0.5, -5}, .direction = {0, 0, 1}});
  CHECK(at_z.u == doctest::Approx(0.25));
  CHECK(at_z.v == doctest::Approx(0.25));
  CHECK(at_z.normal == Vec3(0, 0, -1));
}

TEST_CASE("of an image each pixel is a height, and the lowest row is at lower z") {
  Image image(2, 3);
  image.set(0, 2, {0.25, 0.25, 0.25});
  image.set(1, 2, {0, 0.75, 0.75});
  image.set(1, 0, {1, 1, 1});
  const auto grid = make_height_grid(image);
  CHECK(grid->columns() == 2);
  CHECK(grid->rows() == 3);
  CHECK(grid->height(0, 0) == 0.25);
  CHECK(grid->height(1, 0) == 0.5);
  CHECK(grid->height(0, 1) == 0);
  CHECK(grid->height(1, 2) == 1);
  CHECK_THROWS_AS(make_height_grid(Image(1, 1)), Error);
  image.set(0, 0, {2, 2, 2});
  CHECK_THROWS_AS(make_height_grid(image), Error);
}

TEST_CASE("of a file with 16 bits no step is lost") {
  // It is a PNG file of 2 x 2 grey pixels.
  constexpr std::array<std::uint8_t, 75> file = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
      0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x10, 0x00, 0x00, 0x00, 0x00, 0x07,
      0x4d, 0x8e, 0xbb, 0x00, 0x00, 0x00, 0x12, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0x60,
      0x60, 0x60, 0x64, 0x62, 0x60, 0x64, 0xfc, 0xff, 0x1f, 0x00, 0x03, 0x21, 0x02, 0x04, 0x24,
      0x29, 0x51, 0x2f, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  constexpr std::array<int, 4> steps = {0, 258, 257, 65535};
  const auto grid = make_height_grid(Image::decode(std::as_bytes(std::span(file)), "steps.png"));
  const std::array<double, 4> heights = {grid->height(0, 1), grid->height(1, 1), grid->height(0, 0),
                                         grid->height(1, 0)};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    CHECK(std::abs(65535 * heights[i] - steps[i]) < 0.01);
  }
}

TEST_CASE("grids of heights say what is wrong with them") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(argument_of({1, 1, 1, 1}, 2, 2) == "");
  CHECK(argument_of({1, 1}, 1, 2) == "columns");
  CHECK(argument_of({1, 1}, 2, 1) == "rows");
  CHECK(argument_of({}, 0, 0) == "columns");
  CHECK(argument_of({1, 1, 1}, 2, 2) == "heights");
  CHECK(argument_of({}, 0xffffffffu, 0xffffffffu) == "heights");
  CHECK(argument_of({1, nan, 1, 1}, 2, 2) == "heights");
  CHECK(argument_of({1, 1, 1.5, 1}, 2, 2) == "heights");
  CHECK(argument_of({1, 1, -1e-300, 1}, 2, 2) == "heights");
  CHECK(argument_of({0, 0, 0, 0}, 2, 2) == "heights");
}
