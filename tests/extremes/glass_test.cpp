// These tests render random glass, most of whose faces coincide, overlap or touch. Light that has
// gone through is in no medium any more, and has been in each as docs/image.md says.
#include <doctest/doctest.h>

#include <algorithm>
#include <optional>

#include "extremes/support.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;

namespace {

bool has_end(const Solid& solid) {
  if (solid.kind == Solid::Kind::half_space) return false;
  return std::all_of(solid.parts.begin(), solid.parts.end(), has_end);
}

Entity random_solid(SolidMaker& maker) {
  while (true) {
    const Solid solid = maker.tree(maker.integer(0, 2));
    if (has_end(solid)) return solid.entity();
  }
}

Transform random_placement(Random& random, int round) {
  Transform placed = round % 3 == 0
                         ? Transform{}
                         : rotate_degrees({random.between(0, 360), random.between(0, 360), 0});
  placed.translation = random.between(0, 20) * random.direction();
  return placed;
}

struct Span {
  double enter;
  double leave;
};

/// Returns where the line is inside of the solid, ascending.
std::vector<Span> spans(const Entity& solid, const Ray& line) {
  Scene alone;
  alone.entities = {solid};
  std::vector<Span> result;
  for (const Hit& hit : crossings(prepare(alone), line)) {
    if (hit.entering)
      result.push_back({hit.t, hit.t});
    else if (!result.empty())
      result.back().leave = hit.t;
  }
  return result;
}

/// Returns the optical depth of a line through solids of the given absorptions. It returns nothing
/// where the rule goes in circles or a span is too short to decide.
std::optional<double> optical_depth(const std::vector<Entity>& solids,
                                    const std::vector<double>& absorption, const Ray& line) {
  constexpr double same = 1e-8;
  std::vector<std::vector<Span>> all;
  std::vector<double> cuts;
  for (const Entity& solid : solids) {
    all.push_back(spans(solid, line));
    for (const Span& span : all.back()) {
      if (span.leave - span.enter < same) return std::nullopt;
      cuts.push_back(span.enter);
      cuts.push_back(span.leave);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  double depth = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i + 1] - cuts[i] < same) continue;
    const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
    struct Around {
      std::size_t solid;
      Span span;
    };
    std::vector<Around> around;
    for (std::size_t k = 0; k < all.size(); ++k) {
      for (const Span& span : all[k]) {
        if (span.enter < middle && middle < span.leave) around.push_back({k, span});
      }
    }
    const auto is_inner = [&](const Around& a, const Around& b) {
      const auto lies_in = [](const Span& x, const Span& y) {
        return x.enter > y.enter - same && x.leave < y.leave + same;
      };
      const bool in_b = lies_in(a.span, b.span);
      return in_b != lies_in(b.span, a.span) ? in_b : a.solid >= b.solid;
    };
    if (around.empty()) continue;
    const auto innermost = std::find_if(around.begin(), around.end(), [&](const Around& a) {
      return std::all_of(around.begin(), around.end(),
                         [&](const Around& b) { return is_inner(a, b); });
    });
    if (innermost == around.end()) return std::nullopt;
    depth += absorption[innermost->solid] * (cuts[i + 1] - cuts[i]);
  }
  return depth;
}

}  // namespace

TEST_CASE("light that has gone through random glass is back in the open") {
  // A renderer that counts itself still in a medium on its endless path to the background loses all
  // of it.
  constexpr double faint = 1e-12;
  SolidMaker maker(30);
  Random random(30);
  for (int round = 0; round < 60; ++round) {
    Scene scene;
    scene.background = GradientBackground{};
    scene.settings.width = 20;
    scene.settings.height = 20;
    scene.settings.recursion_depth = 8;
    scene.settings.precision = round % 2 == 0 ? Precision::standard : Precision::exact;
    const Transform placed = random_placement(random, round);
    std::vector<Entity> solids;
    std::vector<double> indices;
    for (int i = 0; i < 3; ++i) {
      solids.push_back(random_solid(maker).transformed(placed));
      indices.push_back(random.between(1, 1.8));
    }
    scene.camera = {.position = apply(placed, 12.0 * random.direction()),
                    .pointing = placed.translation};
    Image pictures[2];
    for (int i = 0; i < 2; ++i) {
      scene.entities.clear();
      for (std::size_t k = 0; k < solids.size(); ++k) {
        Material material = glass(indices[k]);
        material.absorption = grey(i * faint);
        scene.entities.push_back(solids[k].with_material(material));
      }
      pictures[i] = render(prepare(scene), {.threads = 1});
    }
    int different = 0;
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 20; ++x)
        different += difference(pictures[0].at(x, y), pictures[1].at(x, y)) > 1e-5 ? 1 : 0;
    }
    CAPTURE(round);
    CHECK(different == 0);
  }
}

TEST_CASE(
    "straight light through random fogs is absorbed by the innermost, whichever way it goes") {
  SolidMaker maker(31);
  Random random(31);
  int compared = 0;
  for (int round = 0; round < 3000; ++round) {
    Scene scene = dark_scene();
    scene.settings.recursion_depth = 256;
    scene.settings.precision = round % 2 == 0 ? Precision::standard : Precision::exact;
    scene.background = SolidBackground{{1, 1, 1}};
    const Transform placed = random_placement(random, round);
    std::vector<Entity> solids;
    std::vector<double> absorption;
    for (int i = 0; i < 3; ++i) {
      Material material = glass(1);
      absorption.push_back(random.between(0.02, 0.5));
      material.absorption = grey(absorption.back());
      solids.push_back(random_solid(maker).with_material(material).transformed(placed));
    }
    scene.entities = solids;
    const Vec3 middle = apply(placed, random.between(0, 3) * random.direction());
    const Vec3 half_length = 25.0 * random.direction();
    const Ray line{.origin = middle - half_length, .direction = glm::normalize(half_length)};
    const std::optional<double> depth = optical_depth(solids, absorption, line);
    if (!depth) continue;
    ++compared;
    const double expected = std::exp(-*depth);
    CAPTURE(round);
    CHECK(seen(scene, middle - half_length, middle + half_length).r ==
          doctest::Approx(expected).epsilon(1e-6));
    CHECK(seen(scene, middle + half_length, middle - half_length).r ==
          doctest::Approx(expected).epsilon(1e-6));
  }
  CHECK(compared > 2500);
}
