// What solids say of whole boxes must hold of every point in them. These checks go over the list of
// all primitives (random_instances.hpp), so a new one is tested by being listed.
#include "core/geometry/face_functions.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "core/compile/surface_table.hpp"
#include "core/geometry/placement.hpp"
#include "core/math/vector.hpp"
#include "geometry/random_instances.hpp"

using namespace crt;
using namespace crt::test;
using core::FaceFunctions;
using core::Interval;
using core::Jet;
using core::JetOf;
using core::NearFaces;
using core::PatchSeries;
using core::PointOf;

namespace {

PointOf<Interval> box_about(const Vec3& middle, const Vec3& reach) {
  const Vec3 lower = middle - reach;
  const Vec3 upper = middle + reach;
  return {Interval{lower.x, upper.x}, Interval{lower.y, upper.y}, Interval{lower.z, upper.z}};
}

/// Returns a point of a box, which may be next to its boundary. On that it would often be on a
/// surface, where nothing is said.
Vec3 point_in(const PointOf<Interval>& box, Random& random) {
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval& range = box[static_cast<std::size_t>(axis)];
    constexpr double least = 1e-9;
    double share = random.uniform(least, 1 - least);
    if (random.one_in(8)) share = random.one_in(2) ? least : 1 - least;
    point[axis] = std::clamp(range.lo + share * range.width(), range.lo, range.hi);
  }
  return point;
}

/// Returns a point of a solid's surface, if a ray that is aimed there meets it.
std::optional<Vec3> point_of_surface(const core::Shape& shape, Random& random) {
  const core::ObjectRay ray = random_ray(random);
  const core::CrossingList list = crossings_of(shape, ray).list;
  if (list.empty()) return std::nullopt;
  return shape.surface_point(ray, list[random.bits() % list.size()], false).position;
}

/// Returns a box of any size, near the surface or anywhere. Of some the corners are numbers as
/// users write them, which are often in the planes of faces.
PointOf<Interval> random_box(const core::Shape& shape, Random& random) {
  const double size = random.power_of_ten(-3, 0.3);
  const std::optional<Vec3> near =
      random.one_in(4) ? std::nullopt : point_of_surface(shape, random);
  const Vec3 middle = near ? *near + size * random.in_cube() : 3.0 * random.in_cube();
  const auto reach = [&] { return random.uniform(0.1, 1); };
  const double x = reach();
  const double y = reach();
  PointOf<Interval> box = box_about(middle, size * Vec3(x, y, reach()));
  if (!random.one_in(3)) return box;
  for (Interval& range : box) {
    constexpr double step = 0.25;
    range.lo = step * std::floor(range.lo / step);
    range.hi = step * std::ceil(range.hi / step);
  }
  return box;
}

/// Returns whether a point is in a solid, if it is not so near to the surface that rounding
/// decides.
std::optional<bool> is_inside(const core::Shape& shape, const Vec3& point, Random& random) {
  const core::ObjectRay ray{.origin = point, .direction = random.direction()};
  const Crossings crossings = crossings_of(shape, ray);
  if (crossings.list.undecided > 0) return std::nullopt;
  bool inside = crossings.starts_inside;
  for (const core::Crossing& crossing : crossings.list) {
    constexpr double rounding = 1e-13;
    if (std::abs(crossing.t) <= crossing.error + rounding) return std::nullopt;
    if (crossing.t < 0) inside = crossing.entering;
  }
  return inside;
}

/// Returns what faces near a box say of a point, if they say it plainly.
std::optional<bool> said_of(const FaceFunctions& functions, const NearFaces& near,
                            const Vec3& point) {
  using enum NearFaces::Kind;
  if (near.kind == outside) return false;
  if (near.kind == inside) return true;
  if (near.kind == unknown) return std::nullopt;
  const bool is_all = near.kind == where_all_negative;
  bool is_open = false;
  for (const std::uint32_t face : near.faces) {
    const Interval value = functions.value(face, core::known_point(point));
    if (is_all ? value.lo > 0 : value.hi < 0) return !is_all;
    is_open = is_open || value.contains(0);
  }
  if (is_open) return std::nullopt;
  return is_all;
}

bool contains(const PointOf<Interval>& box, const Vec3& point, double margin) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double place = point[static_cast<int>(i)];
    if (!(place > box[i].lo + margin && place < box[i].hi - margin)) return false;
  }
  return true;
}

/// Requires that a ray to a point of a box crosses no surface in it that no face near it has.
void check_crossings(const core::Shape& shape, const FaceFunctions& functions,
                     const NearFaces& near, const PointOf<Interval>& box, const Vec3& to,
                     Random& random) {
  if (near.kind == NearFaces::Kind::unknown && near.faces.empty()) return;
  const core::ObjectRay ray{.origin = to, .direction = random.direction()};
  const core::CrossingList list = crossings_of(shape, ray).list;
  for (const core::Crossing& crossing : list) {
    constexpr double margin = 1e-9;
    const Vec3 place = ray.origin + crossing.t * ray.direction;
    if (crossing.error > margin || !contains(box, place, 1e-3 * margin)) continue;
    const PointOf<Interval> about = box_about(place, Vec3(margin));
    const bool is_listed =
        std::any_of(near.faces.begin(), near.faces.end(),
                    [&](std::uint32_t face) { return functions.value(face, about).contains(0); });
    REQUIRE((is_listed || list.undecided > 0));
  }
}

PointOf<Jet> as_jets(const PointOf<Interval>& box) {
  PointOf<Jet> point;
  for (std::size_t i = 0; i < 3; ++i) {
    point[i] = {.value = box[i], .slope = {}};
    point[i].slope[i] = Interval::of(1);
  }
  return point;
}

bool meet(const Interval& a, const Interval& b) {
  return a.lo <= b.hi && b.lo <= a.hi;
}

/// Returns a series' value at a place of the patch, with its error.
Interval value_at(const PatchSeries& series, const Interval& s, const Interval& t) {
  Interval sum{-series.error, series.error};
  Interval of_s = Interval::of(1);
  for (std::size_t i = 0; i <= PatchSeries::degree; ++i) {
    Interval of_both = of_s;
    for (std::size_t j = 0; i + j <= PatchSeries::degree; ++j) {
      sum = sum + of_both * Interval::of(series.terms[PatchSeries::place(i, j)]);
      of_both = of_both * t;
    }
    of_s = of_s * s;
  }
  return sum;
}

/// Checks the values of a face's function in a box against those at points of it.
void check_values(const FaceFunctions& functions, std::uint32_t face, const PointOf<Interval>& box,
                  Random& random) {
  const Interval range = functions.value(face, box);
  const Jet jet = functions.value(face, as_jets(box));
  for (int i = 0; i < 4; ++i) {
    const Vec3 one = point_in(box, random);
    const Vec3 other = point_in(box, random);
    const Interval at_one = functions.value(face, core::known_point(one));
    const Interval at_other = functions.value(face, core::known_point(other));
    REQUIRE(meet(range, at_one));
    REQUIRE(meet(jet.value, at_one));
    Interval change{0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      change = change + jet.slope[static_cast<std::size_t>(axis)] *
                            (Interval::of(other[axis]) - Interval::of(one[axis]));
    }
    REQUIRE(meet(change, at_other - at_one));
  }
}

/// Checks the series of a face's function on a patch in a box.
void check_series(const FaceFunctions& functions, std::uint32_t face, const PointOf<Interval>& box,
                  Random& random) {
  const Vec3 to_s = 0.4 * random.in_cube();
  const Vec3 to_t = 0.4 * random.in_cube();
  PointOf<PatchSeries> patch;
  PointOf<JetOf<PatchSeries>> patch_jets;
  const PatchSeries none = PatchSeries::of(Interval::of(0));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    const double half = 0.5 * box[i].width();
    patch[i] = PatchSeries::linear(box[i].lo + half, half * to_s[axis], half * to_t[axis]);
    patch_jets[i] = {patch[i], {none, none, none}};
    patch_jets[i].slope[i] = PatchSeries::of(Interval::of(1));
  }
  const PatchSeries series = functions.value(face, patch);
  const JetOf<PatchSeries> jets = functions.value(face, patch_jets);
  if (!functions.has_series()) {
    REQUIRE(series.error == core::infinity);
    REQUIRE(jets.value.error == core::infinity);
    return;
  }
  for (int i = 0; i < 4; ++i) {
    const Interval s = Interval::of(random.uniform(-1, 1));
    const Interval t = Interval::of(random.uniform(-1, 1));
    PointOf<Interval> place;
    for (std::size_t k = 0; k < 3; ++k) place[k] = value_at(patch[k], s, t);
    const Jet at_place = functions.value(face, as_jets(place));
    REQUIRE(meet(value_at(series, s, t), at_place.value));
    REQUIRE(meet(value_at(jets.value, s, t), at_place.value));
    for (std::size_t k = 0; k < 3; ++k)
      REQUIRE(meet(value_at(jets.slope[k], s, t), at_place.slope[k]));
  }
}

}  // namespace

TEST_CASE("all solids: what is said of a box holds of its points, and surfaces say nothing") {
  for_instances(200, [](const Primitive&, const core::Shape& shape, Random& random) {
    const std::unique_ptr<const FaceFunctions> functions = shape.face_functions();
    REQUIRE((functions != nullptr) == shape.is_solid());
    if (functions == nullptr) return;
    NearFaces near;
    for (int i = 0; i < 40; ++i) {
      const PointOf<Interval> box = random_box(shape, random);
      functions->look(box, near);
      for (int k = 0; k < 8; ++k) {
        const Vec3 point = point_in(box, random);
        const std::optional<bool> said = said_of(*functions, near, point);
        const std::optional<bool> truth = said ? is_inside(shape, point, random) : std::nullopt;
        if (truth) REQUIRE(*said == *truth);
        check_crossings(shape, *functions, near, box, point, random);
      }
    }
  });
}

TEST_CASE("all solids: values and slopes of faces in a box hold those of its points") {
  for_instances(60, [](const Primitive&, const core::Shape& shape, Random& random) {
    const std::unique_ptr<const FaceFunctions> functions = shape.face_functions();
    if (functions == nullptr) return;
    NearFaces near;
    for (int i = 0; i < 30; ++i) {
      const PointOf<Interval> box = random_box(shape, random);
      functions->look(box, near);
      for (const std::uint32_t face : near.faces) {
        REQUIRE(functions->max_crossings(face) >= 0);
        check_values(*functions, face, box, random);
        check_series(*functions, face, box, random);
      }
    }
  });
}

TEST_CASE("all solids but custom ones: of small boxes at the surface most are known") {
  for (std::size_t kind = 0; kind < std::variant_size_v<Primitive>; ++kind) {
    INFO(name_of(kind));
    Random random(300 + kind);
    int boxes = 0;
    int known = 0;
    bool is_custom = false;
    for (int i = 0; i < 150; ++i) {
      const Primitive primitive = random_instance(kind, random);
      const std::unique_ptr<const core::Shape> shape = core::make_shape(primitive);
      const std::unique_ptr<const FaceFunctions> functions = shape->face_functions();
      is_custom = std::holds_alternative<Custom>(primitive);
      if (functions == nullptr) break;
      NearFaces near;
      for (int k = 0; k < 40; ++k) {
        const std::optional<Vec3> point = point_of_surface(*shape, random);
        if (!point) continue;
        functions->look(box_about(*point, Vec3(1e-4)), near);
        REQUIRE(near.kind != NearFaces::Kind::inside);
        REQUIRE(near.kind != NearFaces::Kind::outside);
        ++boxes;
        if (near.kind != NearFaces::Kind::unknown) ++known;
      }
    }
    if (is_custom) {
      CHECK(known == 0);
    } else {
      CAPTURE(known);
      CAPTURE(boxes);
      CHECK(known >= 0.98 * boxes);
    }
  }
}

namespace {

/// A KeyedFace is a face with its surface in the form in which surfaces are compared.
struct KeyedFace {
  std::size_t solid;
  std::uint32_t face;
  core::CanonicalSurface surface;
};

/// Requires that the functions of faces on one surface have the same sign at random points, or the
/// opposite one if just one of them is flipped. Returns how many pairs of faces are of two solids.
int check_shared_surfaces(const std::vector<Primitive>& primitives, Random& random) {
  std::vector<std::unique_ptr<const core::Shape>> shapes;
  std::vector<std::unique_ptr<const FaceFunctions>> functions;
  std::vector<KeyedFace> faces;
  for (const Primitive& primitive : primitives) {
    shapes.push_back(core::make_shape(primitive));
    functions.push_back(shapes.back()->face_functions());
    if (functions.back() == nullptr || std::holds_alternative<Custom>(primitive)) continue;
    for (std::uint32_t face = 0; face < std::min(shapes.back()->face_count(), 60U); ++face) {
      faces.push_back({shapes.size() - 1, face,
                       core::canonical_surface(shapes.back()->surface(face), core::Placement{})});
    }
  }
  int shared = 0;
  for (const KeyedFace& a : faces) {
    for (const KeyedFace& b : faces) {
      if (&a == &b || a.surface.key != b.surface.key) continue;
      if (a.solid != b.solid) ++shared;
      for (int i = 0; i < 10; ++i) {
        const PointOf<Interval> point = core::known_point(2.0 * random.in_cube());
        const Interval of_a = functions[a.solid]->value(a.face, point);
        const Interval of_b = functions[b.solid]->value(b.face, point);
        if (of_a.contains(0) || of_b.contains(0)) continue;
        REQUIRE(((of_a.lo > 0) == (of_b.lo > 0)) == (a.surface.flipped == b.surface.flipped));
      }
    }
  }
  return shared;
}

std::shared_ptr<const Profile> profile_of(const Contour& contour) {
  return make_profile(std::vector<Contour>{contour});
}

}  // namespace

TEST_CASE("all solids: functions of faces on one surface are one function") {
  for_instances(60, [](const Primitive& primitive, const core::Shape&, Random& random) {
    check_shared_surfaces({primitive}, random);
  });
}

TEST_CASE("solids of different kinds have one function for a surface that they share") {
  Random random(1);
  const auto disc = profile_of({{0.75, 0.25, 1}, {-0.25, 0.25, 1}});
  const auto half_disc = profile_of({{0, -1}, {0, 1, 1}, {0, -1}});
  const auto ring = profile_of({{1.25, 0, 1}, {0.75, 0, 1}});
  const auto triangle = profile_of({{0, 0}, {1, 0}, {0, 2}});
  const auto downwards = profile_of({{0, 2}, {1, 0}, {0, 0}});
  const auto square = profile_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const std::vector<Primitive> pairs[] = {
      {Sphere{.center = {0, 0, 1}, .radius = 0.5},
       Capsule{.from = {0, 0, 1}, .to = {1, 1, 0}, .radius = 0.5}},
      {Cylinder{.from = {0, 0, 1}, .to = {1, 1, 0}, .radius = 0.5},
       Capsule{.from = {0, 0, 1}, .to = {1, 1, 0}, .radius = 0.5}},
      {Cylinder{.from = {0.25, 0.25, 0}, .to = {0.25, 0.25, 1}, .radius = 0.5},
       Extrusion{.profile = disc, .from = 0, .to = 1}},
      {Sphere{.center = {0, 0, 0}, .radius = 1}, Revolution{.profile = half_disc}},
      {Torus{.center = {0, 0, 0}, .radius = 1, .thickness = 0.25}, Revolution{.profile = ring}},
      {Cone{.from = {0, 0, 0}, .to = {0, 2, 0}, .radius = 1, .radius2 = 0},
       Revolution{.profile = triangle}},
      {Revolution{.profile = downwards}, Revolution{.profile = triangle}},
      {Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}},
       Extrusion{.profile = square, .from = 0, .to = 1}},
      {Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}},
       RoundedBox{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}, .radius = 0.25}},
      {Plane{.normal = {1, 2, 0}, .position = {0, 1, 0}},
       Extrusion{.profile = profile_of({{0, 1}, {2, 0}, {2, 2}}), .from = 0, .to = 1}},
  };
  for (const std::vector<Primitive>& pair : pairs) {
    CAPTURE(pair[0].index());
    CAPTURE(pair[1].index());
    CHECK(check_shared_surfaces(pair, random) > 0);
  }
}

TEST_CASE("an edge is known as where both or any of its faces have the solid behind them") {
  // An L, whose inner corner is at (1, 1).
  const auto profile = profile_of({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  const auto shape = core::make_shape(Extrusion{.profile = profile, .from = 0, .to = 1});
  const auto functions = shape->face_functions();
  const auto look = [&](double x, double y, double z) {
    NearFaces near;
    functions->look(box_about({x, y, z}, Vec3(0.125)), near);
    std::sort(near.faces.begin(), near.faces.end());
    return near;
  };
  using enum NearFaces::Kind;
  CHECK(look(1.01, 1.01, 0.5).kind == where_any_negative);
  CHECK(look(1.01, 1.01, 0.5).faces == std::vector<std::uint32_t>{6, 8});
  CHECK(look(1.99, 0.99, 0.5).kind == where_all_negative);
  CHECK(look(1.99, 0.99, 0.5).faces == std::vector<std::uint32_t>{4, 6});
  CHECK(look(1.99, 0.99, 0.99).faces == std::vector<std::uint32_t>{1, 4, 6});
  CHECK(look(1.01, 1.01, 0.99).kind == unknown);
  CHECK(look(0.5, 0.5, 0.5).kind == inside);
  CHECK(look(1.5, 1.5, 0.5).kind == outside);
  // The plane of a wall goes on within the solid, where there is no wall.
  CHECK(look(0.5, 1.01, 0.5).kind == inside);
}

TEST_CASE("a thin plate and a thin pipe are known between their walls") {
  const auto plate = profile_of({{0, 0}, {2, 0.25}, {2, 0.375}, {0, 0.125}});
  const Contour outer = {{1, 0, 1}, {-1, 0, 1}};
  const Contour inner = {{0.875, 0, 1}, {-0.875, 0, 1}};
  const auto pipe = make_profile(std::vector<Contour>{outer, inner});
  const auto look = [&](const std::shared_ptr<const Profile>& profile, const Vec3& middle) {
    const auto shape = core::make_shape(Extrusion{.profile = profile, .from = 0, .to = 1});
    NearFaces near;
    shape->face_functions()->look(box_about(middle, Vec3(0.2)), near);
    return near;
  };
  for (const NearFaces& near : {look(plate, {1, 0.1875, 0.5}), look(pipe, {0, 0.9375, 0.5}),
                                look(pipe, {0.9375, 0, 0.5})}) {
    CHECK(near.kind == NearFaces::Kind::where_all_negative);
    CHECK(near.faces.size() == 2);
  }
}
