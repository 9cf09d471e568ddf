// Every primitive can be measured: what chords of rays add up to is what its volume says.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "crt/measure.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "geometry/random_instances.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns how long the parts of lines in a solid are together, times the area for each line.
double sum_of_chords(const Entity& entity, const BoundingBox& box, int lines) {
  Scene scene;
  scene.entities = {entity};
  const PreparedScene prepared = prepare(scene);
  RayQueries queries(prepared);
  const Vec3 size = box.upper - box.lower;
  std::vector<Hit> hits;
  double sum = 0;
  for (int i = 0; i < lines; ++i) {
    for (int j = 0; j < lines; ++j) {
      const Vec3 from(box.lower.x + size.x * (i + 0.5) / lines,
                      box.lower.y + size.y * (j + 0.5) / lines, box.lower.z - size.z);
      queries.crossings({.origin = from, .direction = {0, 0, 1}}, hits);
      double entered = 0;
      for (const Hit& hit : hits) {
        if (hit.entering) entered = hit.t;
        if (!hit.entering) sum += hit.t - entered;
      }
    }
  }
  return sum * size.x * size.y / (lines * lines);
}

}  // namespace

TEST_CASE("every bounded primitive has the volume that rays see, alone and cut") {
  constexpr int lines = 64;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (std::size_t kind = 0; kind < std::variant_size_v<Primitive>; ++kind) {
    Random random(100 + kind);
    for (int instance = 0; instance < 3; ++instance) {
      CAPTURE(kind);
      CAPTURE(instance);
      const Entity whole = random_instance(kind, random);
      if (!whole.is_solid()) continue;
      const BoundingBox box = bounding_box(whole);
      const Vec3 size = box.upper - box.lower;
      const double largest = size.x * size.y * size.z;
      if (!std::isfinite(largest)) continue;
      const Vec3 middle = 0.5 * (box.lower + box.upper);
      const double radius = 0.3 * std::max({size.x, size.y, size.z});
      const Entity cut = whole - Entity(Sphere{.center = middle + 0.3 * size * random.in_cube(),
                                               .radius = radius});
      for (const Entity& solid : {whole, cut}) {
        const double chords = sum_of_chords(solid, box, lines);
        const double off = 0.02 * largest;
        const bool is_custom = kind + 1 == std::variant_size_v<Primitive>;
        // Of a custom solid only the bounds are known, however long one looks.
        const Interval measured =
            volume(solid, {.relative_width = 0.05, .seconds = is_custom ? 1e-3 : infinite});
        CHECK(measured.lower <= chords + off);
        CHECK(measured.upper >= chords - off);
        CHECK(measured.lower >= 0);
        if (!is_custom) CHECK(measured.width() <= 0.05 * measured.upper);
      }
    }
  }
}
