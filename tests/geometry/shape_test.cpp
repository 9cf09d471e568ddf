// All primitives have in common that they are in the list, and that their parameters are checked.
#include "core/geometry/shape.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "crt/error.hpp"
#include "crt/schema_primitives.hpp"
#include "crt/validate.hpp"
#include "geometry/custom_shapes.hpp"
#include "geometry/meshes.hpp"
#include "geometry/profiles.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

/// Returns "argument: message", or "" if the primitive is accepted.
std::string fault(const Primitive& primitive) {
  try {
    validate(primitive);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    return error.argument() + ": " + error.what();
  }
  return "";
}

std::string argument(const Primitive& primitive) {
  return fault(primitive).substr(0, fault(primitive).find(':'));
}

}  // namespace

TEST_CASE(
    "every primitive that is made of numbers is valid by default and makes a shape that agrees on "
    "being a solid") {
  CHECK(argument(Mesh{}) == "triangles");
  CHECK(argument(Extrusion{}) == "profile");
  CHECK(argument(Revolution{}) == "profile");
  CHECK(argument(HeightField{}) == "heights");
  CHECK(argument(Custom{}) == "shape");
  Random random(1);
  const TriangleList list = ball_mesh(random, 1, 0);
  const Mesh mesh{.triangles = mesh_triangles(list.positions, list.triangles)};
  const Extrusion extrusion{.profile = profile_of({rectangle(0, 0, 1, 1)})};
  const Revolution revolution{.profile = extrusion.profile};
  const HeightField field{.heights = make_height_grid({0, 0.5, 1, 0}, 2, 2)};
  const Custom custom = as_custom(Sphere{});
  const Primitive all[] = {Sphere{},   Box{},  Plane{},    HalfPlane{},  Cylinder{}, Cone{},
                           Torus{},    Disc{}, Triangle{}, Capsule{},    mesh,       extrusion,
                           revolution, field,  Quadric{},  RoundedBox{}, Implicit{}, custom};
  CHECK(std::size(all) == std::variant_size_v<Primitive>);
  for (const Primitive& primitive : all) {
    CHECK(fault(primitive) == "");
    const auto shape = core::make_shape(primitive);
    CHECK(shape->is_solid() == core::is_solid(primitive));
    CHECK(shape->face_count() > 0);
    CHECK_FALSE(shape->bounds().empty());
  }
}

TEST_CASE("discs, triangles and half planes are surfaces; all else is solid") {
  CHECK_FALSE(core::is_solid(Disc{}));
  CHECK_FALSE(core::is_solid(Triangle{}));
  CHECK_FALSE(core::is_solid(HalfPlane{}));
  CHECK(core::is_solid(Sphere{}));
  CHECK(core::is_solid(Plane{}));
  CHECK(core::is_solid(Torus{}));
}

TEST_CASE("an error says what is wrong with which field") {
  CHECK(fault(Sphere{.radius = -1}) == "radius: radius must be greater than 0 (it is -1)");
  CHECK(fault(Cone{.radius2 = -1}) == "radius2: radius2 must not be negative (it is -1)");
  CHECK(fault(Sphere{.radius = 1e-101}) == "radius: radius must be at least 1e-100 (it is 1e-101)");
  CHECK(fault(Sphere{.radius = 1e101}) == "radius: radius must be at most 1e100 (it is 1e+101)");
  CHECK(fault(Sphere{.radius = not_a_number}) == "radius: radius must be finite (it is nan)");
  CHECK(fault(Sphere{.center = {0, inf, 0}}) ==
        "center: center must be finite (it is (0, inf, 0))");
  CHECK(fault(Sphere{.center = {0, 0, -1.5e100}}) ==
        "center: center must be at most 1e100 in magnitude (it is (0, 0, -1.5e+100))");
  CHECK(fault(Plane{.normal = {0, 0, 0}}) == "normal: normal must have a length (it is (0, 0, 0))");
}

namespace {

/// Says which field is wrong if one of an instance that is right has another value.
template <class Shape, class Row>
std::string argument_with(Shape shape, const Row& row, const typename Row::Value& value) {
  shape.*row.member = value;
  return argument(shape);
}

}  // namespace

TEST_CASE("every field that has a rule is checked by it") {
  const Vec3 bad(not_a_number, 0, 0);
  int checked = 0;
  schema::for_each_kind<Primitive>([&]<class Kind>(std::type_identity<Kind>) {
    Kind right;
    if constexpr (std::is_same_v<Kind, HeightField>)
      right.heights = make_height_grid({1, 1, 1, 1}, 2, 2);
    schema::for_each_field<Kind>([&]<class Row>(const Row& row) {
      using enum schema::Rule::Kind;
      const auto kind = row.rule.kind;
      CAPTURE(row.name);
      if (kind == any) return;
      ++checked;
      if constexpr (std::is_same_v<typename Row::Value, double>) {
        for (const double wrong : {not_a_number, inf, -0.5, 1e-101, 1e101})
          CHECK(argument_with(right, row, wrong) == row.name);
        CHECK(argument_with(right, row, 0) == (kind == length ? row.name : ""));
      } else if constexpr (std::is_same_v<typename Row::Value, Vec3>) {
        CHECK(argument_with(right, row, bad) == row.name);
        CHECK(argument_with(right, row, {0, 0, -1.5e100}) == row.name);
        if (kind == direction) CHECK(argument_with(right, row, Vec3(0)) == row.name);
        if (kind != apart && kind != corner) return;
        const auto other = schema::value_of<Vec3>(right, row.rule.other);
        CHECK(argument_with(right, row, other) == row.name);
        CHECK(argument_with(right, row, other + Vec3(1, 0, 1)) == (kind == corner ? row.name : ""));
      }
    });
  });
  CHECK(checked > 30);
}

TEST_CASE("what primitives have no rules for is checked, too") {
  const Vec3 bad(not_a_number, 0, 0);
  CHECK(argument(HalfPlane{.normal = {1, 2, 3}, .direction = {-3, -6, -9}}) == "direction");
  CHECK_THROWS_AS(mesh_triangles(std::array{bad}, {}), Error);
  const auto square = profile_of({rectangle(0, 0, 1, 1)});
  CHECK(argument(Extrusion{.profile = square, .from = inf}) == "from");
  CHECK(argument(Extrusion{.profile = square, .to = 1e101}) == "to");
  CHECK(argument(Extrusion{.profile = square, .from = 1, .to = 1}) == "to");
  CHECK(argument(Revolution{.profile = square, .angle = 0}) == "angle");
  CHECK(argument(Revolution{.profile = square, .angle = 6.3}) == "angle");
  CHECK(argument(Revolution{.profile = square, .angle = not_a_number}) == "angle");
  const auto grid = make_height_grid({1, 1, 1, 1, 1, 1}, 3, 2);
  const Vec3 next(std::nextafter(1.0, 2.0), 1, 1);
  CHECK(argument(HeightField{.heights = grid, .corner_a = {1, 0, 0}, .corner_b = next}) ==
        "corner_b");
  CHECK(argument(Quadric{.squares = bad}) == "squares");
  CHECK(argument(Quadric{.products = {0, inf, 0}}) == "products");
  CHECK(argument(Quadric{.linear = bad}) == "linear");
  CHECK(argument(Quadric{.constant = -inf}) == "constant");
  CHECK(argument(Implicit{.upper = {1, -1, 1}}) == "upper");
  CHECK(argument(Triangle{.a = {1, 1, 1}, .b = {2, 2, 2}, .c = {4, 4, 4}}) == "c");
  CHECK(argument(Triangle{.a = {0.1, 0.1, 0.1}, .b = {0.3, 0.3, 0.3}, .c = {0.7, 0.7, 0.7}}) ==
        "c");
}

TEST_CASE("profiles of revolutions are checked, and errors name the corner") {
  const auto fault_of = [](const std::vector<Contour>& contours) {
    return fault(Revolution{.profile = profile_of(contours)});
  };
  CHECK(fault_of({rectangle(0, 0, 1, 1), rectangle(2, 0, -1, 1)}) ==
        "profile: profile: corner 1 of contour 1 must be at x >= 0, as x is the distance from the "
        "axis (it is at x = -1)");
  CHECK(fault_of({rectangle(1e-101, 0, 1, 1)}) ==
        "profile: profile: corner 0 of contour 0 must be on the axis or at least 1e-100 from it "
        "(it is at x = 1e-101)");
  CHECK(fault_of({{{1, 0}, {2, 0}, {2, 1}, {1.5, 1e-101}}}) ==
        "profile: profile: corner 0 of contour 0 must be as high as the corner before, or at least "
        "1e-100 off");
  CHECK(fault_of({{{0.5, 0}, {1, 0}, {1, 2}, {0.5, 2}, {0.5, 0, 1}}}) ==
        "profile: profile: corner 0 of contour 0 must not be reached by an arc beyond the axis (it "
        "goes to x = -0.5)");
  CHECK(fault_of({circle(0.3, 0.1, 0.3)}) == "");
  CHECK(fault_of({{{0, -1}, {0, 1, 1}}}) == "");
  CHECK(fault_of({rectangle(0, 0, 1e100, 1e-100)}) == "");
}

TEST_CASE("a quadric has a surface, a size, and no coefficients that are lost beside the others") {
  const std::string size = "and linear must give the quadric a size from 1e-100 to 1e100";
  CHECK(fault(Quadric{.squares = {0, 0, 0}}) ==
        "squares: squares must not be 0 together with products and linear");
  CHECK(fault(Quadric{.constant = -0x1p700}) == "constant: constant " + size);
  CHECK(fault(Quadric{.linear = {1e-101, 0, 0}, .constant = 0}) == "constant: constant " + size);
  CHECK(fault(Quadric{.squares = {0, 0, 0}, .linear = {1e308, 0, 0}, .constant = 1e-308}) ==
        "constant: constant " + size);
  CHECK(fault(Quadric{.squares = {1e300, 1e300, 1e300}, .constant = -1e300}) == "");
  CHECK(fault(Quadric{.squares = {5e-324, 0, 0}, .linear = {0, 1e-308, 0}, .constant = 0}) == "");
  CHECK(argument(Quadric{.squares = {1, 1, 1e-201}}) == "squares");
  CHECK(argument(Quadric{.squares = {1e300, 1e-300, 1}, .constant = 0}) == "squares");
  CHECK(argument(Quadric{.products = {1e-201, 0, 0}}) == "products");
  CHECK(argument(Quadric{.linear = {0, 1e-201, 0}}) == "linear");
  CHECK(fault(Quadric{.squares = {1, 1, 1e-199}}) == "");

  const std::string empty =
      "constant: constant must leave points where the sum is below 0, as the quadric is empty";
  CHECK(fault(Quadric{.constant = 1}) == empty);
  CHECK(fault(Quadric{.constant = 0}) == empty);                        // a point
  CHECK(fault(Quadric{.squares = {1, 1, 0}, .constant = 0}) == empty);  // a line
  CHECK(fault(Quadric{
            .squares = {1, 4, 9}, .products = {4, 6, 12}, .linear = {2, 4, 6}, .constant = 1}) ==
        empty);  // a plane, twice
  CHECK(fault(Quadric{.squares = {1, 4, 9},
                      .products = {4, 6, 12},
                      .linear = {2, 4, 6},
                      .constant = 1 - 0x1p-53}) == "");
  CHECK(fault(Quadric{.squares = {-1, -1, 0}, .constant = 0}) ==
        "constant: constant must leave points where the sum is above 0, as the quadric has no "
        "surface");
  CHECK(fault(Quadric{.squares = {0, 0, 0}, .products = {1, 0, 0}, .constant = 0}) == "");
}

TEST_CASE("values at the limits, slivers and spindles are accepted") {
  CHECK(fault(Sphere{.center = {1e100, -1e100, 0}, .radius = 1e-100}) == "");
  CHECK(fault(Cylinder{.from = {0, 0, 0}, .to = {0, 1e-100, 0}, .radius = 1e100}) == "");
  CHECK(fault(Capsule{.from = {0, 0, 0}, .to = {0, 1e-100, 0}, .radius = 1e100}) == "");
  CHECK(fault(Cone{.radius = 1, .radius2 = 1}) == "");
  CHECK(fault(Torus{.radius = 1, .thickness = 3}) == "");
  CHECK(fault(Plane{.normal = {0, 1e-300, 0}}) == "");
  CHECK(fault(Triangle{.a = {0, 0, 0}, .b = {1, 0, 0}, .c = {0.5, 1e-20, 0}}) == "");
  CHECK(fault(HalfPlane{.normal = {1, 2, 3}, .direction = {-3, -6, -9.000000000000002}}) == "");
}
