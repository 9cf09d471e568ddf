// Sections of random solids, against whether points of a grid are in the solid; and what is drawn.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "crt/error.hpp"
#include "crt/svg_path.hpp"
#include "geometry/random_instances.hpp"
#include "measure/section_checks.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;

TEST_CASE("sections of random solids of all primitives hold what points say") {
  for (std::size_t kind = 0; kind < std::variant_size_v<Primitive>; ++kind) {
    Random random(300 + kind);
    for (int instance = 0; instance < 4; ++instance) {
      CAPTURE(kind);
      CAPTURE(instance);
      const Primitive primitive = random_instance(kind, random);
      const Entity whole = primitive;
      if (!whole.is_solid()) continue;
      // Heights may be so small that only rounding tells the surface from the bottom. That takes
      // long to find out.
      const bool is_thin = std::holds_alternative<HeightField>(primitive);
      if (is_thin && instance % 2 == 1) continue;
      const BoundingBox box = bounding_box(whole);
      const Vec3 size = box.upper - box.lower;
      const double largest = std::max({size.x, size.y, size.z});
      if (!std::isfinite(largest)) continue;
      const Vec3 middle = 0.5 * (box.lower + box.upper);
      if (kind + 1 == std::variant_size_v<Primitive>) {
        // Of a custom solid nothing is known but its box.
        CHECK(section(whole, along_z, middle.z, 1e-2 * largest).deviation > 1e-2 * largest);
        continue;
      }
      const Entity cut = whole - Entity(Sphere{.center = middle + 0.3 * size * random.in_cube(),
                                               .radius = 0.3 * largest});
      for (const Entity& solid : {whole, cut}) {
        for (int plane = 0; plane < 3; ++plane) {
          CAPTURE(plane);
          const Vec3 normal = plane == 0 ? along_z : plane == 1 ? -along_y : random.direction();
          const Vec3 through = middle + 0.2 * size * random.in_cube();
          const double offset = glm::dot(normal, through) / glm::length(normal);
          const double deviation = largest * random.power_of_ten(-4, -2);
          const Section found = section(solid, normal, offset, deviation);
          if (!is_thin) CHECK(found.deviation <= deviation);
          if (found.deviation <= deviation) check_section(solid, found, box, 24);
        }
      }
    }
  }
}

TEST_CASE("sections of random CSG trees with coincident faces hold what points say") {
  int unknown = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    SolidMaker maker(seed);
    const Solid solid = maker.tree(3);
    const Entity entity = solid.entity();
    const BoundingBox box = bounding_box(entity);
    const Vec3 size = box.upper - box.lower;
    if (!std::isfinite(size.x + size.y + size.z) || !(size.x + size.y + size.z > 0)) continue;
    Random random(seed);
    for (const Vec3& normal : {along_x, -along_z, random.direction()}) {
      const double offset = glm::dot(normal, 0.5 * (box.lower + box.upper)) / glm::length(normal);
      const Section found = section(entity, normal, offset, 1e-2);
      // Planes of whole numbers touch some cylinders.
      if (found.deviation > 1e-2) ++unknown;
      if (found.deviation <= 1e-2) check_section(entity, found, box, 24);
    }
  }
  CHECK(unknown <= 3);
}

TEST_CASE("sections are the same for any number of threads") {
  const Entity solid = drilled_plate() - Entity(Sphere{.center = {18, 12, 0}, .radius = 10}) +
                       Entity(Torus{.center = {0, 20, 0}, .radius = 5, .thickness = 2});
  const Section one = section(solid, {1, 3, 2}, 3, 1e-3, {.threads = 1});
  CHECK(!one.empty());
  for (const int threads : {2, 5}) {
    const Section more = section(solid, {1, 3, 2}, 3, 1e-3, {.threads = threads});
    CHECK(more.contours == one.contours);
    CHECK(more.deviation == one.deviation);
    CHECK(more.area == one.area);
  }
}

TEST_CASE("a search that ends early says how well the section is known") {
  const Entity solid = drilled_plate();
  const Section found = section(solid, along_y, 6, 1e-3, {.seconds = 1e-9});
  CHECK(found.area.lower <= 6000 - 64 * std::numbers::pi);
  CHECK(found.area.upper >= 6000 - 64 * std::numbers::pi);
  CHECK(found.deviation > 1e-3);
  CHECK_THROWS_AS(section(solid, along_y, 6, 1e-3, {.go_on = [] { return false; }}), Error);
}

TEST_CASE("what is no question about a section is an error") {
  const double infinite = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto code = [&](const Entity& entity, const Vec3& normal, double offset, double deviation) {
    try {
      section(entity, normal, offset, deviation);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::internal;
  };
  const Entity ball = Sphere{};
  CHECK(code(ball, {0, 0, 0}, 0, 1e-3) == ErrorCode::invalid_argument);
  CHECK(code(ball, {0, nan, 0}, 0, 1e-3) == ErrorCode::invalid_argument);
  CHECK(code(ball, {0, infinite, 0}, 0, 1e-3) == ErrorCode::invalid_argument);
  for (const double bad : {infinite, nan})
    CHECK(code(ball, along_z, bad, 1e-3) == ErrorCode::invalid_argument);
  for (const double bad : {0.0, -1.0, infinite, nan})
    CHECK(code(ball, along_z, 0, bad) == ErrorCode::invalid_argument);
  CHECK(code(Plane{}, along_z, 0, 1e-3) == ErrorCode::invalid_argument);
  CHECK(code(Disc{}, along_z, 0, 1e-3) == ErrorCode::invalid_argument);
  CHECK_THROWS_AS(section(ball, along_z, 0, 1e-3, {.relative_width = 0}), Error);
  // Numbers of any size are no crash.
  for (const double size : {1e-300, 1e-100, 1e100, 1e300}) {
    try {
      section(Sphere{.radius = size}, {size, 2 * size, 0}, 0.1 * size, 1e-3 * size);
      section(ball, {size, 0, size}, size, 1e-3);
      section(ball, along_z, 0, size);
    } catch (const Error&) {
    }
  }
}

TEST_CASE("sections are drawn as SVG and DXF") {
  const Entity plate = drilled_plate();
  const Section found = section(plate, along_y, 6, 1e-2);
  const std::string svg = section_svg(found, {.unit = Unit::mm, .line_width = 0.5});
  CHECK(svg.find("width=\"101mm\" height=\"61mm\" viewBox=\"-50.5 -30.5 101 61\"") !=
        std::string::npos);
  // What a path of SVG encloses is what the section has.
  const std::size_t begin = svg.rfind(" d=\"") + 4;
  const std::string path = svg.substr(begin, svg.find('"', begin) - begin);
  double area = 0;
  for (const Contour& contour : svg_path_contours(path)) area += signed_area(polygon_of(contour));
  CHECK(std::abs(area) == doctest::Approx(6000 - 64 * std::numbers::pi).epsilon(1e-3));
  CHECK(svg.find("A4 4 0 0 ") != std::string::npos);
  CHECK(section_svg(found, {.unit = Unit::m}).find("width=\"100000.7mm\"") != std::string::npos);
  CHECK(section_svg(found, {.unit = Unit::in}).find("in\" height") != std::string::npos);

  const std::string dxf = section_dxf(found, {.unit = Unit::mm, .hatch = 2});
  CHECK(dxf.find("$INSUNITS\n70\n4\n") != std::string::npos);
  const auto count = [&](const std::string& word) {
    std::size_t number = 0;
    for (std::size_t at = dxf.find(word); at != std::string::npos; at = dxf.find(word, at + 1))
      ++number;
    return number;
  };
  CHECK(count("\nPOLYLINE\n") == 5);
  CHECK(count("\nVERTEX\n") == 12);
  CHECK(count("\n42\n-1\n") == 8);
  // Hatching covers what is solid, and nothing else: its length times its distance is the area.
  double length = 0;
  std::size_t at = dxf.find("\nLINE\n");
  CHECK(at != std::string::npos);
  for (; at != std::string::npos; at = dxf.find("\nLINE\n", at + 1)) {
    const auto number = [&](const std::string& group) {
      return std::stod(dxf.substr(dxf.find("\n" + group + "\n", at) + group.size() + 2));
    };
    const double dx = number("11") - number("10");
    const double dy = number("21") - number("20");
    CHECK(dx == doctest::Approx(dy));
    length += std::hypot(dx, dy);
    const Vec3 middle = found.frame.at(number("10") + 0.5 * dx, number("20") + 0.5 * dy);
    CHECK(contains(plate, middle) != PointSide::outside);
  }
  CHECK(2 * length == doctest::Approx(6000 - 64 * std::numbers::pi).epsilon(5e-3));

  CHECK_THROWS_AS(section_svg(found, {.hatch = -1}), Error);
  CHECK_THROWS_AS(section_dxf(found, {.hatch = 1e-9}), Error);
  CHECK_THROWS_AS(section_svg(found, {.line_width = std::nan("")}), Error);
  CHECK_THROWS_AS(write_section("section.pdf", found), Error);
  CHECK_THROWS_AS(write_section("/no/such/folder/section.svg", found), Error);
  CHECK(section_svg(Section{}).find("</svg>") != std::string::npos);
  CHECK(section_dxf(Section{}).find("EOF") != std::string::npos);
}
