// In the exact tier crossings may be arbitrarily close, or at one place by different equations.
//
// The truth is known without a root. Along a line in the plane z = 0 beside the x axis, solids
// about the z axis are crossed at one of four numbers that are not rational, +-sqrt(R^2 - y^2). If
// they are moved along x by k times a tiny step, they are crossed k steps later. So whole numbers k
// decide the order, and which crossings are one.
#include "core/csg/exact_order.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/prepare/prepared_data.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;
using core::PreparedData;
using core::RayHit;
using core::RayWorkspace;
using core::WorldRay;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A Where is one of the numbers -sqrt(9/4 - y^2), -sqrt(1/4 - y^2), sqrt(1/4 - y^2), sqrt(9/4 -
/// y^2), or -5/4 and 5/4 between them, together with k.
using Where = std::pair<int, int>;
enum : int { outer_in = 0, flat_in = 1, inner_out = 2, inner_in = 3, flat_out = 4, outer_out = 5 };

/// A Piece is a solid with the spans of the line in it.
struct Piece {
  Entity entity = Sphere{};
  std::vector<std::pair<Where, Where>> spans;

  bool contains(const Where& before, const Where& after) const {
    return std::any_of(spans.begin(), spans.end(), [&](const auto& span) {
      return span.first <= before && after <= span.second;
    });
  }
};

struct Combined {
  enum class Kind { piece, set_union, intersection, difference };
  Kind kind = Kind::piece;
  Piece piece;
  std::vector<Combined> parts;

  Entity entity() const {
    if (kind == Kind::piece) return piece.entity;
    std::vector<Entity> entities;
    for (const Combined& part : parts) entities.push_back(part.entity());
    if (kind == Kind::set_union) return csg_union(entities);
    if (kind == Kind::intersection) return csg_intersection(entities);
    return csg_difference(entities[0], std::span(entities).subspan(1));
  }
  /// Returns whether the line is inside between two consecutive places.
  bool contains(const Where& before, const Where& after) const {
    if (kind == Kind::piece) return piece.contains(before, after);
    const auto is_in = [&](const Combined& part) { return part.contains(before, after); };
    if (kind == Kind::set_union) return std::any_of(parts.begin(), parts.end(), is_in);
    if (kind == Kind::intersection) return std::all_of(parts.begin(), parts.end(), is_in);
    return is_in(parts[0]) && std::none_of(parts.begin() + 1, parts.end(), is_in);
  }
  void add_places(std::vector<Where>& places) const {
    for (const auto& [enter, leave] : piece.spans) {
      places.push_back(enter);
      places.push_back(leave);
    }
    for (const Combined& part : parts) part.add_places(places);
  }
};

struct Flip {
  Where where;
  bool entering = false;
};

std::vector<Flip> flips(const Combined& solid) {
  std::vector<Where> places;
  solid.add_places(places);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<Flip> result;
  bool inside = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool now = i + 1 < places.size() && solid.contains(places[i], places[i + 1]);
    if (now != inside) result.push_back({places[i], now});
    inside = now;
  }
  return result;
}

/// A Setting is the line, and the step.
struct Setting {
  double y = 0;
  double step = 0;

  double t_of(const Where& where) const {
    const double outer = std::sqrt(2.25 - y * y);
    const double inner = std::sqrt(0.25 - y * y);
    const double places[] = {-outer, -1.25, -inner, inner, 1.25, outer};
    return 8 + places[where.first] + where.second * step;
  }
  WorldRay ray() const {
    return {.origin = {-8, y, 0},
            .direction = {1, 0, 0},
            .t_min = -infinity,
            .t_max = infinity,
            .start = {}};
  }
};

/// Returns a solid whose side the line crosses where it crosses others', by equations of degree 1,
/// 2 and 4. It is moved by at most `most` steps: once or twice, alone or with its whole wrapping.
Piece piece(SolidMaker& make, const Setting& setting, int most) {
  Piece result;
  int k = 0;
  const auto move = [&] {
    const int steps = make.integer(-most, most);
    k += steps;
    if (steps != 0)
      result.entity = result.entity.transformed(translate({steps * setting.step, 0, 0}));
  };
  const int kind = make.integer(0, 6);
  switch (kind) {
    case 0:
      result.entity = Sphere{.radius = 1.5};
      break;
    case 1:
      result.entity =
          Cylinder{.from = {0, 0, -1}, .to = {0, 0, make.integer(1, 3) * 1.0}, .radius = 1.5};
      break;
    case 2:
      result.entity = Cone{.from = {0, 0, -1}, .to = {0, 0, 1}, .radius = 1, .radius2 = 2};
      break;
    case 3:
      result.entity =
          Torus{.axis = {0, 0, make.integer(1, 2) * 1.0}, .radius = 1, .thickness = 0.5};
      break;
    case 4:
      result.entity =
          Box{.corner_a = {-1.25, -2, -1}, .corner_b = {1.25, 2, make.integer(1, 3) * 1.0}};
      break;
    case 5:  // its slanted faces meet the line on the axis of z = 0 alone
      result.entity = Entity(Plane{.normal = {1, 0, 1}, .position = {1.25, 0, 0}}) ^ Plane {
        .normal = {-1, 1, 0}, .position = { -1.25, setting.y, 0 }
      };
      break;
    default:
      result.entity = Entity(Sphere{.radius = 0.75}).transformed(scale(2));
  }
  move();
  // These turns are exact.
  if (make.integer(0, 2) == 0 && k == 0 && kind < 4) {
    result.entity = result.entity.transformed(rotate_degrees({0, 0, 90.0 * make.integer(1, 3)}));
  }
  if (make.integer(0, 1) == 0) move();
  if (kind == 3) {
    result.spans = {{{outer_in, k}, {inner_out, k}}, {{inner_in, k}, {outer_out, k}}};
  } else if (kind == 4 || kind == 5) {
    result.spans = {{{flat_in, k}, {flat_out, k}}};
  } else {
    result.spans = {{{outer_in, k}, {outer_out, k}}};
  }
  return result;
}

Combined tree(SolidMaker& make, const Setting& setting, int most, int depth) {
  Combined result;
  if (depth == 0) {
    result.piece = piece(make, setting, most);
    return result;
  }
  constexpr Combined::Kind kinds[] = {Combined::Kind::set_union, Combined::Kind::intersection,
                                      Combined::Kind::difference};
  result.kind = kinds[make.integer(0, 2)];
  for (int i = make.integer(2, 3); i > 0; --i) {
    result.parts.push_back(tree(make, setting, most, make.integer(0, depth - 1)));
  }
  return result;
}

PreparedData prepared(const std::vector<Entity>& entities, Precision precision = Precision::exact) {
  Scene scene;
  scene.entities = entities;
  scene.settings.precision = precision;
  return PreparedData(scene);
}

std::vector<RayHit> crossings(const PreparedData& data, const WorldRay& ray) {
  RayWorkspace work;
  std::vector<RayHit> hits;
  data.crossings(ray, hits, work);
  return hits;
}

Setting random_setting(SolidMaker& make) {
  return {.y = make.integer(1, 7) / 16.0, .step = std::pow(10.0, -make.integer(20, 300))};
}

void check_order(const std::vector<RayHit>& hits, const std::vector<Flip>& truth,
                 const Setting& setting) {
  REQUIRE(hits.size() == truth.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    REQUIRE(hits[i].entering == truth[i].entering);
    REQUIRE(std::abs(hits[i].t - setting.t_of(truth[i].where)) < 1e-14);
    if (i > 0) REQUIRE(hits[i].t >= hits[i - 1].t);
  }
}

}  // namespace

TEST_CASE("trees of nearly coincident solids flip where exact arithmetic says, however close") {
  std::size_t flipped = 0;
  std::size_t close = 0;
  for (std::uint32_t seed = 0; seed < 3000; ++seed) {
    CAPTURE(seed);
    SolidMaker make(seed);
    const Setting setting = random_setting(make);
    const Combined solid = tree(make, setting, 2, 3);
    const std::vector<Flip> truth = flips(solid);
    check_order(crossings(prepared({solid.entity()}), setting.ray()), truth, setting);
    flipped += truth.size();
    for (std::size_t i = 1; i < truth.size(); ++i)
      close += truth[i].where.first == truth[i - 1].where.first;
  }
  CHECK(flipped > 4000);
  CHECK(close > 500);
}

TEST_CASE(
    "objects are met in the order in which they are, however close, and touching ones left first") {
  std::size_t flipped = 0;
  for (std::uint32_t seed = 0; seed < 600; ++seed) {
    CAPTURE(seed);
    SolidMaker make(10000 + seed);
    const Setting setting = random_setting(make);
    std::vector<Entity> entities;
    struct Of {
      Flip flip;
      std::uint32_t object;
    };
    std::vector<Of> truth;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Combined solid = tree(make, setting, 2, 1);
      entities.push_back(solid.entity());
      for (const Flip& flip : flips(solid)) truth.push_back({flip, i});
    }
    std::sort(truth.begin(), truth.end(), [](const Of& a, const Of& b) {
      return std::tie(a.flip.where, a.flip.entering, a.object) <
             std::tie(b.flip.where, b.flip.entering, b.object);
    });
    const PreparedData data = prepared(entities);
    const std::vector<RayHit> hits = crossings(data, setting.ray());
    std::vector<Flip> expected;
    for (const Of& of : truth) expected.push_back(of.flip);
    check_order(hits, expected, setting);
    for (std::size_t i = 0; i < hits.size(); ++i)
      REQUIRE(data.entity_id(hits[i]) == truth[i].object);
    flipped += hits.size();
    if (hits.empty()) continue;
    // If several crossings are at the first place, the one that was written first is seen.
    std::uint32_t first = truth[0].object;
    for (const Of& of : truth) {
      if (of.flip.where == truth[0].flip.where) first = std::min(first, of.object);
    }
    RayWorkspace work;
    const RayHit nearest = data.intersect(setting.ray(), work);
    REQUIRE(nearest.found());
    REQUIRE(data.entity_id(nearest) == first);
  }
  CHECK(flipped > 1000);
}

TEST_CASE("a sphere less itself moved by 1e-40 is a crescent that is entered before it is left") {
  const Entity sphere = Sphere{};
  const Entity moved = sphere.transformed(translate({1e-40, 0, 0}));
  const std::vector<RayHit> hits = crossings(prepared({sphere - moved}), {.origin = {-3, 0, 0},
                                                                          .direction = {1, 0, 0},
                                                                          .t_min = -infinity,
                                                                          .t_max = infinity,
                                                                          .start = {}});
  REQUIRE(hits.size() == 2);
  CHECK(hits[0].entering);
  CHECK_FALSE(hits[1].entering);
  CHECK(hits[0].t == 2);
  CHECK(hits[1].t == 2);
}

TEST_CASE(
    "a solid whose ends round to one t is entered before it is left, between solids that touch "
    "it") {
  // The box is 1e-17 thick, where an ulp is 2e-16. The spheres are seen from so far away that they
  // are no longer than an ulp.
  const Box thin{.corner_a = {0, 0, 0}, .corner_b = {1e-17, 1, 1}};
  const Box before{.corner_a = {-1, 0, 0}, .corner_b = {0, 1, 1}};
  const WorldRay near{.origin = {-1.5, 0.5, 0.5},
                      .direction = {1, 0, 0},
                      .t_min = -infinity,
                      .t_max = infinity,
                      .start = {}};
  std::vector<RayHit> hits = crossings(prepared({thin, before}), near);
  REQUIRE(hits.size() == 4);
  CHECK(hits[1].t == 1.5);
  CHECK(hits[3].t == 1.5);
  CHECK(hits[1].object == hits[0].object);
  CHECK_FALSE(hits[1].entering);
  CHECK(hits[2].entering);
  CHECK_FALSE(hits[3].entering);

  WorldRay far = near;
  far.origin = {-0x1p60, 0, 0};
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    hits = crossings(
        prepared({Sphere{.center = {2, 0, 0}}, Sphere{}, Sphere{.center = {4, 0, 0}}}, precision),
        far);
    // The standard tier leaves out what has no length.
    REQUIRE(hits.size() == (precision == Precision::exact ? 6 : 0));
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (precision == Precision::exact) CHECK(hits[i].entering == (i % 2 == 0));
      if (hits[i].entering) continue;
      CHECK(std::any_of(
          hits.begin(), hits.begin() + static_cast<std::ptrdiff_t>(i),
          [&](const RayHit& other) { return other.entering && other.object == hits[i].object; }));
    }
  }
}

TEST_CASE("surfaces that are equal but for a rounding are not one in the exact tier") {
  // 0.1 + 0.2 rounds to what the other sphere is at.
  const Entity one = Entity(Sphere{.center = {0.1, 0, 0}}).transformed(translate({0.2, 0, 0}));
  const Entity other = Sphere{.center = {0.1 + 0.2, 0, 0}};
  const WorldRay ray{.origin = {-3, 0, 0},
                     .direction = {1, 0, 0},
                     .t_min = -infinity,
                     .t_max = infinity,
                     .start = {}};
  // The first is the one further to the left, as 0.1 + 0.2 was rounded up.
  CHECK(crossings(prepared({one - other}), ray).size() == 2);
  CHECK(crossings(prepared({other - one}), ray).size() == 2);
  CHECK(crossings(prepared({one - other}, Precision::standard), ray).empty());
  // It holds for planes, too. These are across directions that are only nearly the same.
  const Entity plane = Plane{.normal = {1, 3, 0}, .position = {0, 0, 0}};
  const Entity tilted = Plane{.normal = {1.0 / 3, 1, 0}, .position = {0, 0, 0}};
  const WorldRay across{.origin = {7, 5, 0},
                        .direction = {0, -1, 0},
                        .t_min = -infinity,
                        .t_max = infinity,
                        .start = {}};
  CHECK(crossings(prepared({(plane - tilted) + (tilted - plane)}), across).size() == 2);
}
