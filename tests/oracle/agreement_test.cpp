// Whatever query a ray is asked by, the answers agree.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "crt/entity.hpp"
#include "crt/scene.hpp"
#include "oracle/agreement.hpp"
#include "oracle/ray_maker.hpp"

using namespace crt;
using namespace crt::test;

namespace {

// These are some 10^5 rays in all. `./dev oracle` asks as many as one likes.
constexpr std::uint64_t rays = 6'000;

void check(Precision precision) {
  for (std::size_t kind = 0; kind < agreement_kinds; ++kind) {
    const std::string name = name_of_agreement(kind);
    CAPTURE(name);
    const AgreementRecord record = measure_agreement(kind, precision, rays);
    // (Those that start on a surface do not meet it.)
    CHECK(record.hits > record.rays / 5);
    for (const std::string& failure : record.failures) FAIL_CHECK(failure);
    CHECK(record.disagreements == 0);
  }
}

PreparedScene alone(const Entity& entity) {
  Scene scene;
  scene.entities = {entity};
  return prepare(scene);
}

}  // namespace

TEST_CASE("all queries tell one story in the standard tier") {
  check(Precision::standard);
}

TEST_CASE("all queries tell one story in the exact tier") {
  check(Precision::exact);
}

TEST_CASE("a ray that starts on a torus by rounded coordinates finds where it leaves") {
  const Torus torus{.axis = {0, 0, 1}, .radius = 2, .thickness = 1};
  const PreparedScene scene = alone(torus);
  const Ray found{.origin = {1.1083332445564722, -0.31094251211785834, -0.52859298338069438},
                  .direction = {0.31460807906212662, 0.71735265185933228, -0.12088016100268817}};
  const std::optional<Hit> hit = intersect(scene, found);
  REQUIRE(hit);
  CHECK(hit->t == doctest::Approx(2.67079));
  CHECK_FALSE(hit->entering);

  std::vector<Ray> starts;
  for (std::uint64_t number = 0; number < 4000; ++number) {
    Counted random(1, number);
    const double a = random.uniform(0, 2 * std::numbers::pi);
    const double b = random.uniform(0, 2 * std::numbers::pi);
    const double rho = torus.radius + torus.thickness * std::cos(b);
    starts.push_back(
        {.origin = {rho * std::cos(a), rho * std::sin(a), torus.thickness * std::sin(b)},
         .direction = random.in_cube()});
  }
  AgreementRecord record;
  compare_queries(scene, "torus", starts, record);
  CHECK(record.hits > 1500);
  for (const std::string& failure : record.failures) FAIL_CHECK(failure);
  CHECK(record.disagreements == 0);
}

TEST_CASE("a ray along the axis of a spindle torus meets it") {
  const PreparedScene scene =
      alone(Torus{.center = {-0x1.1042f92928f3fp-13, -0x1.8517fc8259594p-12, 0x1.423fb0c596ecfp-12},
                  .axis = {0, 0, -0x1.60d9267bf850bp-1},
                  .radius = 0x1.205d3e7499614p-12,
                  .thickness = 0x1.4b1bd38c131dep-11});
  const Ray ray{.origin = {-0x1.1042f92928f3fp-13, -0x1.8517fc8259594p-12, -0x1.b5d938a9f7537p-3},
                .direction = {0, 0, 0x1.b67a58825a1eep-3}};
  CHECK(intersect(scene, ray));
  CHECK(occluded(scene, ray));
  CHECK(crossings(scene, ray).size() == 2);
}

TEST_CASE("what a ray meets where points have no numbers any more is nothing") {
  const PreparedScene scene =
      alone(Plane{.normal = {0, -1, 0}, .position = {0, -0x1.3f03d8a3f9066p+24, 0}});
  std::vector<Ray> beyond;
  for (int exponent = -360; exponent < -330; ++exponent) {
    beyond.push_back(
        {.origin = {0x1.250247e009544p+18, -0x1.627d25886c4b3p+24, -0x1.0f18c0056b427p+23},
         .direction = {-0x1.f08197608d847p+654, std::ldexp(1.0, exponent),
                       -0x1.5c0f94997241fp+655}});
  }
  AgreementRecord record;
  compare_queries(scene, "plane", beyond, record);
  CHECK(record.hits > 0);
  CHECK(record.hits < beyond.size());
  for (const std::string& failure : record.failures) FAIL_CHECK(failure);
  CHECK(record.disagreements == 0);
  for (const Ray& ray : beyond) {
    if (const std::optional<Hit> hit = intersect(scene, ray)) CHECK(std::isfinite(hit->position.z));
  }
}
