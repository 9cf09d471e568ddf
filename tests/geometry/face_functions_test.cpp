// What solids say of whole boxes must hold of every point in them. These checks go over the list of
// all primitives (random_instances.hpp), so a new one is tested by being listed.
#include "core/geometry/face_functions.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "core/math/vector.hpp"
#include "geometry/face_tools.hpp"
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
