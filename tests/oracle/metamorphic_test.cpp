// These tests ask a question in two forms that must have the same answer. No oracle says what it
// is.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "crt/query.hpp"
#include "geometry/scaled_mesh.hpp"
#include "geometry/scaled_profile.hpp"
#include "oracle/measure.hpp"
#include "oracle/number_vec.hpp"
#include "oracle/prepared_tree.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr std::array both_tiers = {Precision::standard, Precision::exact};

Primitive scaled(Primitive primitive, double factor) {
  std::visit(
      [&]<class P>(P& p) {
        if constexpr (std::is_same_v<P, Sphere> || std::is_same_v<P, Disc>) {
          p.center *= factor;
          p.radius *= factor;
        } else if constexpr (std::is_same_v<P, Box> || std::is_same_v<P, HeightField>) {
          p.corner_a *= factor;
          p.corner_b *= factor;
        } else if constexpr (std::is_same_v<P, RoundedBox>) {
          p.corner_a *= factor;
          p.corner_b *= factor;
          p.radius *= factor;
        } else if constexpr (std::is_same_v<P, Plane> || std::is_same_v<P, HalfPlane>) {
          p.position *= factor;
        } else if constexpr (std::is_same_v<P, Cylinder> || std::is_same_v<P, Capsule> ||
                             std::is_same_v<P, Cone>) {
          p.from *= factor;
          p.to *= factor;
          p.radius *= factor;
          if constexpr (std::is_same_v<P, Cone>) p.radius2 *= factor;
        } else if constexpr (std::is_same_v<P, Torus>) {
          p.center *= factor;
          p.radius *= factor;
          p.thickness *= factor;
        } else if constexpr (std::is_same_v<P, Extrusion>) {
          p.profile = scaled_profile(*p.profile, factor);
          p.from *= factor;
          p.to *= factor;
        } else if constexpr (std::is_same_v<P, Revolution>) {
          p.profile = scaled_profile(*p.profile, factor);
        } else if constexpr (std::is_same_v<P, Quadric>) {
          p.squares /= factor;
          p.squares /= factor;
          p.products /= factor;
          p.products /= factor;
          p.linear /= factor;
        } else if constexpr (std::is_same_v<P, Mesh>) {
          p = scaled_mesh(p, factor);
        } else if constexpr (WithoutOracle<P>) {
          has_no_oracle();
        } else {
          p.a *= factor;
          p.b *= factor;
          p.c *= factor;
        }
      },
      primitive);
  return primitive;
}

SolidTree scaled(SolidTree tree, double factor) {
  tree.primitive = scaled(tree.primitive, factor);
  tree.own.translation *= factor;
  for (SolidTree& part : tree.parts) part = scaled(part, factor);
  return tree;
}

SolidTree combined(SolidTree::Kind kind, const std::vector<SolidTree>& parts) {
  SolidTree result;
  result.kind = kind;
  result.parts = parts;
  return result;
}
SolidTree operator+(const SolidTree& a, const SolidTree& b) {
  return combined(SolidTree::Kind::set_union, {a, b});
}
SolidTree operator-(const SolidTree& a, const SolidTree& b) {
  return combined(SolidTree::Kind::difference, {a, b});
}
SolidTree operator^(const SolidTree& a, const SolidTree& b) {
  return combined(SolidTree::Kind::intersection, {a, b});
}

struct Answer {
  bool inside_before = false;
  core::CrossingList crossings;
};
Answer answer(const Contestant& tier, const TestRay& ray) {
  Answer result;
  std::uint64_t escalations = 0;
  result.inside_before = tier.crossings(ray, result.crossings, escalations);
  return result;
}

bool is_inside_at(double t, const FoundFlips& found) {
  const auto passed = std::count_if(found.flips.begin(), found.flips.end(),
                                    [&](const FoundFlip& flip) { return flip.t < t; });
  return (passed % 2 == 1) != found.inside_before;
}

/// Says whether two answers about one tree are equal, except next to its surfaces by the standard
/// tier's bound.
bool same_but_for_rounding(const FoundFlips& a, const FoundFlips& b, const TreeOracle& tree,
                           const GridRay& ray) {
  std::vector<double> places;
  for (const FoundFlips* found : {&a, &b}) {
    for (const FoundFlip& flip : found->flips) places.push_back(flip.t);
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double t = places[i] / 2 + places[i + 1] / 2;
    if (is_inside_at(t, a) != is_inside_at(t, b) && tree.certain_side(ray, t) != 0) return false;
  }
  return a.inside_before == b.inside_before;
}

/// Says whether two answers of the exact tier are equal to the last bit or so.
bool same_to_an_ulp(const FoundFlips& a, const FoundFlips& b) {
  return a.inside_before == b.inside_before &&
         std::equal(a.flips.begin(), a.flips.end(), b.flips.begin(), b.flips.end(),
                    [](const FoundFlip& one, const FoundFlip& other) {
                      return one.entering == other.entering &&
                             std::abs(one.t - other.t) <= ulp(one.t);
                    });
}

FoundFlips reversed(const FoundFlips& found) {
  FoundFlips result;
  result.inside_before = (found.flips.size() % 2 == 1) != found.inside_before;
  for (const FoundFlip& flip : found.flips)
    result.flips.insert(result.flips.begin(), {-flip.t, !flip.entering});
  return result;
}

}  // namespace

TEST_CASE(
    "a primitive and a ray that are scaled by a power of two meet at the same t, bit for bit") {
  constexpr std::uint64_t rays = 10'000;
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    for (std::uint64_t number = 0; number < rays; ++number) {
      const TestRay ray = make_ray(kind, number);
      // A factor more would take these out of what doubles hold.
      if (ray.kind == RayKind::extreme_length) continue;
      Counted random(300, number);
      const int exponent = random.integer(-300, 300);
      const double factor = std::ldexp(1.0, exponent);
      TestRay larger = ray;
      larger.primitive = scaled(ray.primitive, factor);
      larger.origin *= factor;
      // Either the direction or t is scaled.
      const bool with_direction = random.integer(0, 1) == 0;
      if (with_direction) larger.direction *= factor;
      for (const Contestant& tier : {standard_tier(), exact_tier()}) {
        const Answer one = answer(tier, ray);
        const Answer two = answer(tier, larger);
        const auto same = [&](const core::Crossing& a, const core::Crossing& b) {
          return a.t * (with_direction ? 1 : factor) == b.t && a.entering == b.entering &&
                 a.face == b.face;
        };
        if (one.inside_before != two.inside_before ||
            !std::equal(one.crossings.begin(), one.crossings.end(), two.crossings.begin(),
                        two.crossings.end(), same)) {
          FAIL_CHECK(fmt::format("{} tier, ray {}, 2^{}{}: {}", tier.name, number, exponent,
                                 with_direction ? " with direction" : "", description(ray)));
        }
      }
    }
  }
}

TEST_CASE("a tree of solids that is scaled by a power of two is met at the same t, bit for bit") {
  for (std::uint64_t number = 0; number < 200; ++number) {
    Counted random(301, number);
    const int exponent = random.integer(-300, 300);
    const double factor = std::ldexp(1.0, exponent);
    const SolidTree tree = random_tree(number);
    for (const Precision precision : both_tiers) {
      PreparedTree one(tree.entity(), precision);
      PreparedTree two(scaled(tree, factor).entity(), precision);
      for (std::uint64_t i = 0; i < 60; ++i) {
        const GridRay ray = random_ray(number, i);
        CAPTURE(number);
        CAPTURE(i);
        CAPTURE(exponent);
        CHECK(one.flips(ray) == two.flips({ray.origin * factor, ray.direction * factor}));
      }
    }
  }
}

TEST_CASE("a reversed ray meets a primitive at the same places") {
  constexpr std::uint64_t rays = 10'000;
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    for (std::uint64_t number = 0; number < rays; ++number) {
      const TestRay ray = make_ray(kind, number);
      TestRay back = ray;
      back.direction = -back.direction;
      const Answer one = answer(exact_tier(), ray);
      Answer two = answer(exact_tier(), back);
      std::reverse(two.crossings.begin(), two.crossings.end());
      const bool same =
          std::equal(one.crossings.begin(), one.crossings.end(), two.crossings.begin(),
                     two.crossings.end(), [](const core::Crossing& a, const core::Crossing& b) {
                       return a.entering != b.entering && std::abs(a.t + b.t) <= ulp(a.t);
                     });
      const bool odd = core::is_solid(ray.primitive) && one.crossings.size() % 2 == 1;
      if (!same || two.inside_before != (one.inside_before != odd)) {
        FAIL_CHECK(fmt::format("ray {}: {}", number, description(ray)));
      }
      Record record;
      CHECK(measure(truth_of(back), standard_tier(), number, record));
    }
  }
}

TEST_CASE("a reversed ray meets a tree of solids at the same places") {
  for (std::uint64_t number = 0; number < 200; ++number) {
    const SolidTree tree = random_tree(number);
    const TreeOracle oracle(tree);
    PreparedTree standard(tree.entity(), Precision::standard);
    PreparedTree exact(tree.entity(), Precision::exact);
    for (std::uint64_t i = 0; i < 100; ++i) {
      const GridRay ray = random_ray(number, i);
      const GridRay back{ray.origin, -ray.direction};
      CAPTURE(number);
      CAPTURE(i);
      CHECK(same_to_an_ulp(exact.flips(ray), reversed(exact.flips(back))));
      CHECK(
          same_but_for_rounding(standard.flips(ray), reversed(standard.flips(back)), oracle, ray));
    }
  }
}

TEST_CASE("a bounded solid is entered and left by turns, as often the one as the other") {
  constexpr std::uint64_t rays = 5'000;
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    if (!core::is_solid(make_ray(kind, 0).primitive)) continue;
    for (std::uint64_t number = 0; number < rays; ++number) {
      const TestRay ray = make_ray(kind, number);
      if (!core::make_shape(ray.primitive)->bounds().finite()) continue;
      for (const Contestant& tier : {standard_tier(), exact_tier()}) {
        const Answer found = answer(tier, ray);
        bool inside = found.inside_before;
        bool by_turns = !inside && found.crossings.size() % 2 == 0;
        for (const core::Crossing& crossing : found.crossings) {
          inside = !inside;
          by_turns = by_turns && crossing.entering == inside;
        }
        if (!by_turns)
          FAIL_CHECK(fmt::format("{} tier, ray {}: {}", tier.name, number, description(ray)));
      }
    }
  }
}

TEST_CASE("the laws of sets hold for trees of solids along every ray") {
  SolidTree everything;
  everything.primitive = Sphere{.center = {0, 0, 0}, .radius = 50};
  struct Law {
    const char* name;
    SolidTree one;
    SolidTree other;
  };
  for (std::uint64_t number = 0; number < 100; ++number) {
    const SolidTree a = everything ^ random_tree(2 * number);
    const SolidTree b = everything ^ random_tree(2 * number + 1);
    const Law laws[] = {
        {"A + A = A", a + a, a},
        {"A ^ A = A", a ^ a, a},
        {"A + B = B + A", a + b, b + a},
        {"(A - B) + (A ^ B) = A", (a - b) + (a ^ b), a},
        {"A - (A - B) = A ^ B", a - (a - b), a ^ b},
        {"U - (A + B) = (U - A) ^ (U - B)", everything - (a + b),
         (everything - a) ^ (everything - b)},
        {"U - (A ^ B) = (U - A) + (U - B)", everything - (a ^ b),
         (everything - a) + (everything - b)},
    };
    for (const Precision precision : both_tiers) {
      PreparedTree nothing((a - a).entity(), precision);
      for (std::uint64_t i = 0; i < 60; ++i)
        CHECK(nothing.flips(random_ray(number, i)) == FoundFlips{});
      for (const Law& law : laws) {
        const TreeOracle oracle(law.one);
        PreparedTree one(law.one.entity(), precision);
        PreparedTree other(law.other.entity(), precision);
        for (std::uint64_t i = 0; i < 40; ++i) {
          const GridRay ray = random_ray(number, i);
          const FoundFlips first = one.flips(ray);
          const FoundFlips second = other.flips(ray);
          const bool same = precision == Precision::exact
                                ? same_to_an_ulp(first, second)
                                : same_but_for_rounding(first, second, oracle, ray);
          if (!same) {
            FAIL_CHECK(fmt::format("{} tier, {}: trees {} and {}, ray {}",
                                   precision == Precision::exact ? "exact" : "standard", law.name,
                                   2 * number, 2 * number + 1, i));
          }
        }
      }
    }
  }
}

TEST_CASE("any number of threads gives the same answers") {
  constexpr std::uint64_t trees = 10;
  constexpr std::uint64_t rays_per_tree = 500;
  for (const Precision precision : both_tiers) {
    Scene description;
    description.settings.precision = precision;
    for (std::uint64_t number = 0; number < trees; ++number)
      description.entities.push_back(random_tree(number).entity());
    const PreparedScene scene = prepare(description);
    std::vector<Ray> rays;
    for (std::uint64_t i = 0; i < trees * rays_per_tree; ++i) {
      const GridRay ray = random_ray(i % trees, i);
      rays.push_back({.origin = ray.origin, .direction = ray.direction});
    }
    const auto answers = [&](int threads) {
      std::vector<std::vector<Hit>> result(rays.size());
      query_in_parallel(
          scene, rays.size(),
          [&](RayQueries& queries, std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) queries.crossings(rays[i], result[i]);
          },
          threads);
      return result;
    };
    const auto alone = answers(1);
    const auto same = [](const Hit& a, const Hit& b) {
      return a.t == b.t && a.position == b.position && a.normal == b.normal && a.u == b.u &&
             a.v == b.v && a.entity_id == b.entity_id && a.entering == b.entering;
    };
    for (const int threads : {2, 3, 8}) {
      const auto together = answers(threads);
      for (std::size_t i = 0; i < rays.size(); ++i)
        CHECK(std::equal(alone[i].begin(), alone[i].end(), together[i].begin(), together[i].end(),
                         same));
    }
  }
}
