// Measures of solids through the C interface: intervals that hold the truth, boxes, and points.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "measured_parts.hpp"
#include "support.hpp"

using namespace crt::test;

namespace {

constexpr double pi = std::numbers::pi;

crt_mass mass_of(crt_entity* entity, double relative_width) {
  crt_mass mass;
  REQUIRE(crt_mass_init(&mass, sizeof mass) == CRT_OK);
  REQUIRE(crt_entity_mass(entity, relative_width, 0, &mass) == CRT_OK);
  return mass;
}

}  // namespace

TEST_CASE("mass properties are narrow intervals that hold those of a sphere") {
  const EntityHandle ball = sphere({1, 2, 3}, 2);
  const crt_mass mass = mass_of(ball.get(), 1e-6);
  const double volume = 4.0 / 3 * pi * 8;
  CHECK(holds(mass.volume, volume));
  CHECK(mass.volume.upper - mass.volume.lower <= 1e-6 * volume);
  CHECK(holds(mass.area, 16 * pi));
  CHECK(mass.area.upper - mass.area.lower <= 1e-6 * 16 * pi);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(holds(mass.centroid[axis], axis + 1));
    CHECK(mass.centroid[axis].upper - mass.centroid[axis].lower < 1e-5);
    CHECK(holds(mass.inertia[axis], 0.4 * volume * 4));
    CHECK(holds(mass.inertia[axis + 3], 0));
  }
}

TEST_CASE("the volume and the area alone are those of the mass properties") {
  const EntityHandle part = half_torus();
  crt_interval volume;
  crt_interval area;
  REQUIRE(crt_entity_volume(part.get(), 1e-6, 0, &volume) == CRT_OK);
  REQUIRE(crt_entity_area(part.get(), 1e-6, infinity, &area) == CRT_OK);
  // By Pappus, half of the ring, and the two discs where it is cut.
  const double ring = pi * pi * 2 * 0.25;
  const double surface = 2 * pi * pi * 2 * 0.5 + 2 * pi * 0.25;
  CHECK(holds(volume, ring));
  CHECK(volume.upper - volume.lower <= 1e-6 * ring);
  CHECK(holds(area, surface));
  CHECK(area.upper - area.lower <= 1e-6 * surface);
}

TEST_CASE("a width that is asked for is given, and no more work is done for it") {
  const EntityHandle part = half_torus();
  for (const double width : {0.5, 1e-2, 1e-4}) {
    crt_interval volume;
    REQUIRE(crt_entity_volume(part.get(), width, 0, &volume) == CRT_OK);
    CHECK(holds(volume, pi * pi * 0.5));
    CHECK(volume.upper - volume.lower <= width * volume.upper);
  }
  // Time that is over at once leaves the box as a bound.
  crt_interval rough;
  REQUIRE(crt_entity_volume(part.get(), 1e-12, 1e-9, &rough) == CRT_OK);
  CHECK(holds(rough, pi * pi * 0.5));
  CHECK(rough.upper - rough.lower > 1e-12 * rough.upper);
}

TEST_CASE("the box of what is cut is that of what is left") {
  const EntityHandle part = half_torus();
  double lower[3];
  double upper[3];
  REQUIRE(crt_entity_bounds(part.get(), lower, upper) == CRT_OK);
  const double truth_lower[3] = {0, -0.5, -2.5};
  const double truth_upper[3] = {2.5, 0.5, 2.5};
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(lower[axis] <= truth_lower[axis]);
    CHECK(lower[axis] >= truth_lower[axis] - 2.51e-6);
    CHECK(upper[axis] >= truth_upper[axis]);
    CHECK(upper[axis] <= truth_upper[axis] + 2.51e-6);
  }
}

TEST_CASE("boxes of surfaces, of what is infinite and of nothing are given, too") {
  double lower[3];
  double upper[3];
  const EntityHandle disc = made<EntityHandle>([](crt_entity** out) {
    return crt_disc_create(Numbers{1, 0, 0}.data(), Numbers{1, 0, 0}.data(), 2, out);
  });
  REQUIRE(crt_entity_bounds(disc.get(), lower, upper) == CRT_OK);
  CHECK(lower[1] <= -2);
  CHECK(upper[1] >= 2);
  const EntityHandle half = made<EntityHandle>([](crt_entity** out) {
    return crt_plane_create(Numbers{0, 1, 0}.data(), Numbers{0, 3, 0}.data(), out);
  });
  REQUIRE(crt_entity_bounds(half.get(), lower, upper) == CRT_OK);
  CHECK(lower[1] == -infinity);
  CHECK(upper[0] == infinity);
  const EntityHandle ball = sphere({0, 0, 0}, 1);
  const EntityHandle around = sphere({0, 0, 0}, 2);
  const EntityHandle nothing = difference(ball.get(), around.get());
  REQUIRE(crt_entity_bounds(nothing.get(), lower, upper) == CRT_OK);
  CHECK(lower[0] > upper[0]);
}

TEST_CASE("points are inside, on the surface or outside, wherever they lie in memory") {
  const EntityHandle part = half_torus();
  struct Point {
    float before;
    double place[3];
    int8_t expected;
  };
  std::vector<Point> points = {{0, {2, 0, 0}, 1},       {0, {2.5, 0, 0}, 0}, {0, {0, 0, 2}, 0},
                               {0, {-2, 0, 0}, -1},     {0, {0, 0, 0}, -1},  {0, {1.5, 0, 0}, 0},
                               {0, {1.75, 0.25, 0}, 1}, {0, {2, 0.5, 0}, 0}};
  std::vector<std::int8_t> sides(points.size(), 7);
  REQUIRE(crt_entity_contains(part.get(), points[0].place, sizeof(Point), points.size(),
                              sides.data()) == CRT_OK);
  for (std::size_t i = 0; i < points.size(); ++i) {
    INFO(i);
    CHECK(sides[i] == points[i].expected);
  }
  CHECK(crt_entity_contains(part.get(), nullptr, 0, 0, nullptr) == CRT_OK);
  sides.assign(points.size(), 7);
  points[5].place[1] = not_a_number;
  CHECK(crt_entity_contains(part.get(), points[0].place, sizeof(Point), points.size(),
                            sides.data()) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("points[5]"));
  for (const std::int8_t side : sides) CHECK(side == 7);
}

TEST_CASE("what is no solid, or has no end, is not measured, and the message says why") {
  const EntityHandle disc = made<EntityHandle>([](crt_entity** out) {
    return crt_disc_create(Numbers{0, 0, 0}.data(), Numbers{1, 0, 0}.data(), 2, out);
  });
  const EntityHandle half = made<EntityHandle>([](crt_entity** out) {
    return crt_plane_create(Numbers{0, 1, 0}.data(), Numbers{0, 3, 0}.data(), out);
  });
  crt_interval out = {1, 2};
  std::int8_t side = 7;
  const double place[3] = {0, 0, 0};
  CHECK(crt_entity_volume(disc.get(), 1e-6, 0, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("solid"));
  CHECK(crt_entity_contains(disc.get(), place, 0, 1, &side) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("solid"));
  CHECK(crt_entity_volume(half.get(), 1e-6, 0, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("infinite"));
  CHECK(out.lower == 1);
  CHECK(out.upper == 2);
  CHECK(side == 7);
  // What has no end has an inside.
  CHECK(crt_entity_contains(half.get(), place, 0, 1, &side) == CRT_OK);
  CHECK(side == 1);
}

TEST_CASE("mass properties are written as far as the caller's struct goes") {
  const EntityHandle ball = sphere({0, 0, 0}, 1);
  crt_mass mass;
  std::memset(&mass, 0x5a, sizeof mass);
  const double untouched = mass.area.lower;
  mass.struct_size = offsetof(crt_mass, area);
  REQUIRE(crt_entity_mass(ball.get(), 1e-3, 0, &mass) == CRT_OK);
  CHECK(mass.struct_size == offsetof(crt_mass, area));
  CHECK(holds(mass.volume, 4.0 / 3 * pi));
  CHECK(std::memcmp(&mass.area.lower, &untouched, sizeof untouched) == 0);
  mass.struct_size = 0;
  CHECK(crt_entity_mass(ball.get(), 1e-3, 0, &mass) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("struct_size"));
}

TEST_CASE("a section has contours of points, a profile, an area and a place") {
  const EntityHandle part = half_torus();
  const double up[3] = {0, 3, 0};
  crt_section* section = nullptr;
  REQUIRE(crt_section_create(part.get(), up, 0, 1e-3, &section) == CRT_OK);
  crt_interval area;
  REQUIRE(crt_section_area(section, &area) == CRT_OK);
  CHECK(holds(area, 2 * pi));
  double deviation = -1;
  REQUIRE(crt_section_deviation(section, &deviation) == CRT_OK);
  CHECK(deviation >= 0);
  CHECK(deviation <= 1e-3);
  double origin[3];
  double x_axis[3];
  double y_axis[3];
  double offset = 1;
  REQUIRE(crt_section_frame(section, origin, x_axis, y_axis, &offset) == CRT_OK);
  CHECK(offset == 0);
  CHECK(x_axis[0] == 1);
  CHECK(y_axis[2] == 1);

  std::size_t contours = 0;
  const std::size_t* first = nullptr;
  const double* points = nullptr;
  REQUIRE(crt_section_contours(section, &contours, &first, &points) == CRT_OK);
  REQUIRE(contours == 1);
  CHECK(first[0] == 0);
  REQUIRE(first[1] > 8);
  double twice = 0;
  for (std::size_t i = 0; i < first[1]; ++i) {
    const double* const p = points + 3 * i;
    const double* const q = points + 3 * ((i + 1) % first[1]);
    const double radius = std::hypot(p[0], p[2]);
    CHECK(p[1] == 0);
    CHECK(radius >= 1.5 - 2e-3);
    CHECK(radius <= 2.5 + 2e-3);
    twice += p[0] * q[2] - p[2] * q[0];
  }
  CHECK(0.5 * twice == doctest::Approx(2 * pi).epsilon(1e-2));

  crt_profile* profile = nullptr;
  REQUIRE(crt_section_profile(section, &profile) == CRT_OK);
  std::size_t corners = 0;
  REQUIRE(crt_profile_contour(profile, 0, nullptr, 0, &corners) == CRT_OK);
  CHECK(corners >= 4);
  CHECK(corners <= 6);
  crt_profile_release(profile);

  CHECK(crt_section_retain(section) == section);
  crt_section_release(section);
  CHECK(crt_section_write(section, "/no/such/folder/part.svg") == CRT_ERROR_IO);
  CHECK(crt_section_write(section, "part.pdf") == CRT_ERROR_UNSUPPORTED);
  CHECK(crt_section_write_with(section, "part.svg", 4, 0) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_section_write_with(section, "part.svg", CRT_UNIT_MM, -1) == CRT_ERROR_INVALID_ARGUMENT);
  crt_section_release(section);
  CHECK(crt_section_retain(nullptr) == nullptr);
  crt_section_release(nullptr);
}

TEST_CASE("a section of nothing has no contours") {
  const EntityHandle ball = sphere({0, 0, 0}, 1);
  const double up[3] = {0, 1, 0};
  crt_section* section = nullptr;
  REQUIRE(crt_section_create(ball.get(), up, 2, 1e-3, &section) == CRT_OK);
  std::size_t contours = 1;
  const std::size_t* first = nullptr;
  const double* points = nullptr;
  REQUIRE(crt_section_contours(section, &contours, &first, &points) == CRT_OK);
  CHECK(contours == 0);
  CHECK(first[0] == 0);
  crt_section_release(section);
}

TEST_CASE("what is wrong with a question about a section is named") {
  const EntityHandle ball = sphere({0, 0, 0}, 1);
  const double up[3] = {0, 1, 0};
  const double none[3] = {0, 0, 0};
  crt_section* section = nullptr;
  const auto names = [](crt_status status, const char* argument) {
    CHECK(status == CRT_ERROR_INVALID_ARGUMENT);
    CHECK(std::string(crt_error_message()).find(argument) != std::string::npos);
  };
  names(crt_section_create(nullptr, up, 0, 1, &section), "entity");
  names(crt_section_create(ball.get(), nullptr, 0, 1, &section), "normal");
  names(crt_section_create(ball.get(), none, 0, 1, &section), "normal");
  names(crt_section_create(ball.get(), up, INFINITY, 1, &section), "offset");
  names(crt_section_create(ball.get(), up, 0, 0, &section), "deviation");
  names(crt_section_create(ball.get(), up, 0, 1, nullptr), "out");
  CHECK(section == nullptr);
  crt_interval area;
  double number;
  std::size_t count;
  const std::size_t* first;
  const double* points;
  crt_profile* profile;
  double place[3];
  names(crt_section_area(nullptr, &area), "section");
  names(crt_section_deviation(nullptr, &number), "section");
  names(crt_section_frame(nullptr, place, place, place, &number), "section");
  names(crt_section_contours(nullptr, &count, &first, &points), "section");
  names(crt_section_profile(nullptr, &profile), "section");
  names(crt_section_write(nullptr, "part.svg"), "section");
  REQUIRE(crt_section_create(ball.get(), up, 0, 1e-2, &section) == CRT_OK);
  names(crt_section_area(section, nullptr), "out");
  names(crt_section_deviation(section, nullptr), "out");
  names(crt_section_frame(section, nullptr, place, place, &number), "origin");
  names(crt_section_contours(section, nullptr, &first, &points), "contour_count");
  names(crt_section_contours(section, &count, nullptr, &points), "first");
  names(crt_section_contours(section, &count, &first, nullptr), "points");
  names(crt_section_profile(section, nullptr), "out");
  names(crt_section_write(section, nullptr), "path");
  names(crt_section_write(section, ""), "path");
  crt_section_release(section);
}

TEST_CASE("points are as far from a ball as formulas say, with the nearest points beside") {
  const EntityHandle ball = sphere({1, 2, 3}, 2);
  struct Point {
    double place[3];
    float after;
  };
  const std::vector<Point> points = {{{6, 2, 3}, 0}, {{1, 3.5, 3}, 0}, {{1, 2, 5}, 0}};
  const double truth[3] = {3, -0.5, 0};
  const double nearest[3][3] = {{3, 2, 3}, {1, 4, 3}, {1, 2, 5}};
  struct Answer {
    double place[3];
    std::int64_t beside;
  };
  std::vector<Answer> found(points.size(), Answer{{0, 0, 0}, 7});
  std::vector<double> distances(points.size());
  REQUIRE(crt_entity_distance(ball.get(), points[0].place, sizeof(Point), points.size(),
                              distances.data(), found[0].place, sizeof(Answer)) == CRT_OK);
  for (std::size_t i = 0; i < points.size(); ++i) {
    INFO(i);
    CHECK(std::abs(distances[i] - truth[i]) <= 1e-6);
    CHECK(std::abs(distances[i]) >= std::abs(truth[i]) - 1e-12);
    for (int axis = 0; axis < 3; ++axis)
      CHECK(found[i].place[axis] == doctest::Approx(nearest[i][axis]).epsilon(1e-2));
    CHECK(found[i].beside == 7);
  }
  double alone = 0;
  CHECK(crt_entity_distance(ball.get(), points[0].place, 0, 1, &alone, nullptr, 0) == CRT_OK);
  CHECK(alone == distances[0]);
  CHECK(crt_entity_distance(ball.get(), nullptr, 0, 0, nullptr, nullptr, 0) == CRT_OK);
  const double nowhere[3] = {0, not_a_number, 0};
  CHECK(crt_entity_distance(ball.get(), nowhere, 0, 1, &alone, nullptr, 0) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("points[0]"));
  CHECK(alone == distances[0]);
}

TEST_CASE("solids are apart, touch or overlap") {
  const EntityHandle ball = sphere({0, 0, 0}, 1);
  const EntityHandle beside = box({3, -1, -1}, {4, 1, 1});
  const EntityHandle touching = box({1, -1, -1}, {2, 1, 1});
  const EntityHandle within = box({0.5, -1, -1}, {2, 1, 1});
  crt_interval distance = {7, 7};
  double on_a[3];
  double on_b[3];
  REQUIRE(crt_entity_clearance(ball.get(), beside.get(), 1e-6, &distance, on_a, on_b) == CRT_OK);
  CHECK(holds(distance, 2));
  CHECK(distance.upper - distance.lower <= 2e-6);
  CHECK(on_a[0] == doctest::Approx(1));
  CHECK(on_b[0] == doctest::Approx(3));
  REQUIRE(crt_entity_clearance(ball.get(), touching.get(), 1e-6, &distance, on_a, on_b) == CRT_OK);
  CHECK(distance.lower == 0);
  CHECK(distance.upper > 0);
  CHECK(distance.upper < 1e-6);
  REQUIRE(crt_entity_clearance(ball.get(), within.get(), 1e-6, &distance, on_a, on_b) == CRT_OK);
  CHECK(distance.lower == 0);
  CHECK(distance.upper == 0);
  for (int axis = 0; axis < 3; ++axis) CHECK(on_a[axis] == on_b[axis]);
  std::int8_t side = 0;
  CHECK(crt_entity_contains(within.get(), on_a, 0, 1, &side) == CRT_OK);
  CHECK(side == 1);
}

TEST_CASE("pairs that overlap are found, however many there is room for") {
  const EntityHandle a = box({0, 0, 0}, {2, 2, 2});
  const EntityHandle b = box({2, 0, 0}, {3, 2, 2});
  const EntityHandle c = box({1, 1, 1}, {4, 4, 4});
  crt_entity* const parts[3] = {a.get(), b.get(), c.get()};
  crt_overlap overlaps[2];
  std::size_t count = 0;
  REQUIRE(crt_interference(parts, 3, 1e-6, 0, nullptr, 0, &count) == CRT_OK);
  CHECK(count == 2);
  overlaps[1].first = 7;
  REQUIRE(crt_interference(parts, 3, 1e-6, 0, overlaps, 1, &count) == CRT_OK);
  CHECK(count == 2);
  CHECK(overlaps[1].first == 7);
  REQUIRE(crt_interference(parts, 3, 1e-6, 0, overlaps, 2, &count) == CRT_OK);
  CHECK(overlaps[0].first == 0);
  CHECK(overlaps[0].second == 2);
  CHECK(holds(overlaps[0].volume, 1));
  CHECK(overlaps[1].first == 1);
  CHECK(overlaps[1].second == 2);
  CHECK(holds(overlaps[1].volume, 1));
}

TEST_CASE("the thinnest wall of a plate is the plate's, with a chord across it") {
  const EntityHandle plate = box({0, 0, 0}, {5, 0.5, 4});
  crt_interval least;
  double from[3];
  double to[3];
  REQUIRE(crt_entity_thickness(plate.get(), 0.01, &least, from, to) == CRT_OK);
  CHECK(holds(least, 0.5));
  CHECK(least.upper - least.lower <= 0.005);
  CHECK(std::abs(to[1] - from[1]) == doctest::Approx(0.5));
  CHECK(to[0] == doctest::Approx(from[0]));
  CHECK(crt_entity_thickness(plate.get(), 0, &least, from, to) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("relative_width"));
}
