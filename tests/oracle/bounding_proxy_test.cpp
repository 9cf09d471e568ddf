// The conservative tests of tori (geometry/torus/enclose.hpp) against the oracle: what they call
// certain is true.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/compile/compile.hpp"
#include "core/geometry/torus/enclose.hpp"
#include "core/math/vector.hpp"
#include "oracle/line_oracle.hpp"
#include "oracle/ray_maker.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr std::uint64_t lines = 100'000;
#else
constexpr std::uint64_t lines = 10'000;
#endif

/// A PlacedTorus is a torus somewhere in the world: a ring, or now and then a horn or a spindle.
class PlacedTorus {
 public:
  explicit PlacedTorus(Counted& random) {
    const double ring = random.power_of_ten(-3, 3);
    const double tube =
        ring * (random.integer(0, 3) == 0 ? random.uniform(0.5, 3) : random.power_of_ten(-2, 0));
    torus_ = {.axis = random.direction(), .radius = ring, .thickness = tube};
    Entity entity(torus_);
    if (random.integer(0, 1) == 0) {
      const double factor = random.power_of_ten(-2, 2);
      entity = entity.transformed(scale(Vec3(factor)))
                   .transformed(rotate_degrees(180.0 * random.in_cube()))
                   .transformed(
                       translate(factor * ring * random.power_of_ten(-1, 2) * random.in_cube()));
    }
    const Entity entities[] = {entity};
    scene_ = compile(entities);
    const EnclosedTorus solid{torus_.center, glm::normalize(torus_.axis), ring, tube};
    enclosed_ = solid.placed(*scene_.leaves.front().placement);
  }

  /// Returns what encloses the torus; nothing if it is too far from the origin.
  const std::optional<EnclosedTorus>& enclosed() const { return enclosed_; }
  double size() const { return enclosed_->ring + tube(); }
  double tube() const { return torus_.thickness * enclosed_->ring / torus_.radius; }

  /// Returns the normal of the surface. `turn` goes about the ring from outside to the top.
  Vec3 normal(const Vec3& radial, double turn) const {
    return std::cos(turn) * radial + std::sin(turn) * enclosed_->axis;
  }
  Vec3 point(const Vec3& radial, double turn) const {
    return enclosed_->center + enclosed_->ring * radial + tube() * normal(radial, turn);
  }

  TrueLine truth(const Vec3& origin, const Vec3& direction) const {
    return true_crossings({.primitive = torus_,
                           .origin = origin,
                           .direction = direction,
                           .to_world = scene_.leaves.front().placement->to_world()});
  }

 private:
  Torus torus_;
  CompiledScene scene_;
  std::optional<EnclosedTorus> enclosed_;
};

Vec3 across(const Vec3& axis, Counted& random) {
  Vec3 result = glm::cross(axis, random.direction());
  while (glm::length(result) < 0.1) result = glm::cross(axis, random.in_cube());
  return glm::normalize(result);
}

/// Returns an angle: any, or nearly at the top or bottom, or at the in- or outside.
double any_turn(Counted& random) {
  constexpr double quarter = 1.5707963267948966;
  if (random.integer(0, 1) == 0) return random.uniform(0, 4 * quarter);
  return quarter * random.integer(0, 3) + random.sign() * random.power_of_ten(-12, -1);
}

FilterLine<double> filter_line(const Vec3& origin, const Vec3& direction, double end) {
  FilterLine<double> line{};
  line.origin = {origin.x, origin.y, origin.z};
  line.direction = {direction.x, direction.y, direction.z};
  line.squared_length = glm::dot(direction, direction);
  line.inverse_squared_length = 1 / line.squared_length;
  line.inverse_length = std::sqrt(line.inverse_squared_length);
  line.begin = 0;
  line.certain_from = 0;
  line.certain_to = end;
  return line;
}

/// Says whether a line is inside somewhere after its start and before `end`.
bool is_met(const TrueLine& truth, double end) {
  return std::any_of(truth.crossings.begin(), truth.crossings.end(),
                     [&](const TrueCrossing& crossing) {
                       return crossing.t.value() > 0 && crossing.t.value() < end;
                     });
}

}  // namespace

TEST_CASE("a line that an enclosure says to miss a torus, or to meet it, does") {
  int missing = 0;
  int missed = 0;
  int meeting = 0;
  int met = 0;
  for (std::uint64_t i = 0; i < lines; ++i) {
    Counted random(71, i);
    const PlacedTorus torus(random);
    if (!torus.enclosed()) continue;
    // The line is along the surface, a little out- or inside of it, or anywhere through the ball
    // around the torus.
    const Vec3 radial = across(torus.enclosed()->axis, random);
    const double turn = any_turn(random);
    const Vec3 normal = torus.normal(radial, turn);
    const bool grazes = random.integer(0, 3) != 0;
    const Vec3 direction = grazes ? across(normal, random) : glm::normalize(random.direction());
    const double off = random.sign() * random.power_of_ten(-12, -1) * torus.tube();
    const Vec3 place = grazes ? torus.point(radial, turn) + off * normal
                              : torus.enclosed()->center + torus.size() * random.in_cube();
    const double distance =
        random.power_of_ten(-2, random.integer(0, 7) == 0 ? 6 : 2) * torus.size();
    const Vec3 origin = place - distance * direction;
    const double end = random.integer(0, 1) == 0 ? 0x1p100 : random.uniform(0, 2) * distance;

    const FilterLine<double> line = filter_line(origin, direction, end);
    Enclosure<double> part;
    const Decision<bool> decision = enclose(*torus.enclosed(), line, true, part)
                                        ? decide(part, line, end, true)
                                        : Decision<bool>{.rejected = true, .accepted = false};
    const bool truth = is_met(torus.truth(origin, direction), end);
    CAPTURE(i);
    REQUIRE_FALSE((decision.rejected && truth));
    REQUIRE_FALSE((decision.accepted && !truth));
    if (grazes && std::abs(off) < 0x1p-16 * torus.size()) continue;
    (truth ? meeting : missing) += 1;
    missed += decision.rejected ? 1 : 0;
    met += decision.accepted ? 1 : 0;
  }
  CHECK(missed > missing * 3 / 4);
  CHECK(met > meeting / 4);
}

TEST_CASE("a ray of which an enclosure says that it leaves its torus for good does") {
  int outer = 0;
  int left = 0;
  for (std::uint64_t i = 0; i < lines; ++i) {
    Counted random(73, i);
    const PlacedTorus torus(random);
    if (!torus.enclosed()) continue;
    const Vec3 radial = across(torus.enclosed()->axis, random);
    const double turn = any_turn(random);
    const Vec3 normal = torus.normal(radial, turn);
    if (torus.enclosed()->ring + torus.tube() * std::cos(turn) < 0) continue;  // within a spindle
    const double tilt = (random.integer(0, 7) == 0 ? -1 : 1) * random.power_of_ten(-8, 0);
    const Vec3 direction = glm::normalize(across(normal, random) + tilt * normal);
    const Vec3 origin = torus.point(radial, turn);
    const bool leaves = leaves_for_good(*torus.enclosed(), filter_line(origin, direction, 0x1p100));
    // The start is off the surface by rounding, and the flattest line meets it again that much
    // farther on.
    const double start = 0x1p-24 * torus.size();
    const TrueLine truth = torus.truth(origin, direction);
    const bool meets_again =
        std::any_of(truth.crossings.begin(), truth.crossings.end(),
                    [&](const TrueCrossing& crossing) { return crossing.t.value() > start; });
    CAPTURE(i);
    REQUIRE_FALSE((leaves && meets_again));
    left += leaves ? 1 : 0;
    outer += std::cos(turn) > 0 ? 1 : 0;
  }
  CHECK(left > outer / 3);
}
