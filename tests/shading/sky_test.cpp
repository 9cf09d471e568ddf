// The sky is compared with numbers of its paper's formulas, which other code has computed.
#include "core/shading/sky.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/shading/prepared_light.hpp"

using namespace crt::core;
using crt::SkyBackground;
using crt::Vec3;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double kilocandela = 1.0 / 42;  ///< per square metre, as a colour

/// Returns the direction at angles from the zenith and from the sun's side, in degrees.
Vec3 direction(double zenith, double turn) {
  const double z = zenith * pi / 180;
  const double t = turn * pi / 180;
  return {std::sin(z) * std::sin(t), std::cos(z), std::sin(z) * std::cos(t)};
}

SkyBackground sky_at(double altitude, double turbidity = 3) {
  return {.sun = direction(90 - altitude, 0), .turbidity = turbidity};
}

Rgb light(const Sky& sky, const Vec3& direction) {
  return sky.light(lanes_of(direction)).lane(0);
}
Rgb sun(const Sky& sky, const Vec3& direction) {
  return sky.sun(lanes_of(direction)).lane(0);
}
double luminance_of(const Rgb& light) {
  return 0.2126 * light.x + 0.7152 * light.y + 0.0722 * light.z;
}
Rgb sunlight(const Sky& sky) {
  return rgb(sky.sunlight().color);
}

/// Adds up what the dome gives a white level surface, by angles.
Rgb on_level(const Sky& sky) {
  constexpr int rows = 360;
  constexpr int columns = 720;
  Rgb sum(0);
  for (int row = 0; row < rows; ++row) {
    const double zenith = 90 * (row + 0.5) / rows;
    const double z = zenith * pi / 180;
    const double area = std::sin(z) * std::cos(z) * (pi / 2 / rows) * (2 * pi / columns);
    for (int column = 0; column < columns; ++column)
      sum += area * light(sky, direction(zenith, 360 * (column + 0.5) / columns));
  }
  return sum / pi;
}

}  // namespace

TEST_CASE("the dome has the luminance and the chromaticity of the paper's formulas") {
  struct Row {
    double turbidity, altitude, zenith, turn, luminance, x, y;
  };
  constexpr std::array rows = {Row{2, 60, 0, 0, 5.88674, 0.25142, 0.25592},
                               Row{3, 45, 0, 0, 7.32036, 0.24568, 0.25148},
                               Row{3, 45, 60, 0, 21.72236, 0.28114, 0.29060},
                               Row{3, 45, 60, 180, 5.83670, 0.24322, 0.25803},
                               Row{6, 10, 45, 90, 3.84836, 0.29375, 0.31678},
                               Row{8, 30, 80, 30, 18.12111, 0.37868, 0.36976}};
  for (const Row& row : rows) {
    CAPTURE(row.turbidity);
    CAPTURE(row.zenith);
    const Sky sky(sky_at(row.altitude, row.turbidity));
    const Rgb seen = light(sky, direction(row.zenith, row.turn)) / kilocandela;
    // These are the rows of sRGB's matrix to XYZ.
    const double X = 0.4124 * seen.x + 0.3576 * seen.y + 0.1805 * seen.z;
    const double Y = luminance_of(seen);
    const double Z = 0.0193 * seen.x + 0.1192 * seen.y + 0.9505 * seen.z;
    CHECK(Y == doctest::Approx(row.luminance).epsilon(1e-3));
    CHECK(X / (X + Y + Z) == doctest::Approx(row.x).epsilon(1e-3));
    CHECK(Y / (X + Y + Z) == doctest::Approx(row.y).epsilon(1e-3));
  }
}

TEST_CASE("the scale multiplies all light of a sky") {
  SkyBackground background = sky_at(30);
  const Sky plain(background);
  background.scale = 3;
  const Sky scaled(background);
  for (const Vec3& direction : {direction(20, 50), direction(120, 0)})
    CHECK(luminance_of(light(scaled, direction)) ==
          doctest::Approx(3 * luminance_of(light(plain, direction))).epsilon(1e-12));
  CHECK(sunlight(scaled).y == doctest::Approx(3 * sunlight(plain).y).epsilon(1e-12));
}

TEST_CASE("a clear sky is darkest away from the sun, about a quarter of a turn from it") {
  const Sky sky(sky_at(40, 2.5));
  Vec3 darkest(0);
  double least = std::numeric_limits<double>::infinity();
  for (int zenith = 0; zenith < 90; ++zenith) {
    for (int turn = 0; turn < 360; turn += 2) {
      const double luminance = luminance_of(light(sky, direction(zenith, turn)));
      if (luminance >= least) continue;
      least = luminance;
      darkest = direction(zenith, turn);
    }
  }
  CHECK(darkest.z < 0);  // The sun is on the side of +z.
  CHECK(std::abs(glm::dot(darkest, direction(50, 0))) < std::sin(25 * pi / 180));
}

TEST_CASE("the sun gets weaker and redder towards the horizon, and in haze") {
  Rgb before = sunlight(Sky(sky_at(90)));
  for (double altitude = 75; altitude > 0; altitude -= 15) {
    const Rgb now = sunlight(Sky(sky_at(altitude)));
    CHECK(now.y < before.y);
    CHECK(now.x / now.z > before.x / before.z);
    before = now;
  }
  const Rgb hazy = sunlight(Sky(sky_at(30, 8)));
  const Rgb clear = sunlight(Sky(sky_at(30, 2)));
  CHECK(hazy.y < 0.5 * clear.y);
  CHECK(hazy.x / hazy.z > clear.x / clear.z);
  // The formulas of the paper give these, in klx over pi.
  const Rgb at_45 = sunlight(Sky(sky_at(45))) * pi / kilocandela;
  CHECK(at_45.x == doctest::Approx(95.499).epsilon(1e-4));
  CHECK(at_45.y == doctest::Approx(78.225).epsilon(1e-4));
  CHECK(at_45.z == doctest::Approx(61.853).epsilon(1e-4));
}

TEST_CASE("a white level surface under a sun in the zenith at turbidity 3 is 1") {
  const Sky sky(sky_at(90));
  CHECK(luminance_of(on_level(sky) + sunlight(sky)) == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("the ground is as bright as a level surface of its colour") {
  for (const double altitude : {90.0, 40.0, 5.0, -3.0}) {
    CAPTURE(altitude);
    SkyBackground background = sky_at(altitude, 4);
    background.ground = {0.5, 0.2, 0.1};
    const Sky sky(background);
    const double falling = std::max(0.0, std::sin(altitude * pi / 180));
    const Rgb exact = Rgb(0.5, 0.2, 0.1) * (on_level(sky) + falling * sunlight(sky));
    const Rgb seen = light(sky, direction(120, 77));
    for (int i = 0; i < 3; ++i) CHECK(seen[i] == doctest::Approx(exact[i]).epsilon(1e-3));
  }
}

TEST_CASE("the sun is seen as bright as it lights, half a degree wide") {
  const Sky sky(sky_at(35));
  const Vec3 middle = direction(55, 0);
  const double half_angle = crt::sun_angle / 2 * 180 / pi;
  const double within = 55 + 0.99 * half_angle;
  const double beside = 55 + 1.01 * half_angle;
  const Rgb radiance = sun(sky, middle);
  CHECK(sun(sky, direction(within, 0)) == radiance);
  CHECK(sun(sky, direction(beside, 0)) == Rgb(0));
  const double projected = pi * std::pow(std::sin(crt::sun_angle / 2), 2);
  CHECK(radiance.y * projected / pi == doctest::Approx(sunlight(sky).y).epsilon(1e-9));
  // What faces the light gets its colour.
  const PreparedLight light(sky.sunlight(), crt::FalloffModel::light);
  CHECK(light.color() == sunlight(sky));
  CHECK(sky.brightest() >= radiance.x);
}

TEST_CASE("when the sun has set there is none, and the sky gets dark") {
  const Vec3 high = direction(30, 100);
  double before = luminance_of(light(Sky(sky_at(0.5)), high));
  for (double altitude = 0; altitude > -18; altitude -= 1) {
    const Sky sky(sky_at(altitude));
    const double now = luminance_of(light(sky, high));
    CHECK(now < before);
    CHECK(now > 0.3 * before);  // without a jump
    before = now;
    CHECK(sky.has_sun() == (altitude > -0.26));
    CHECK(sun(sky, direction(90.1 - altitude, 0)) == Rgb(0));
  }
  CHECK(before < 1e-5);
}

TEST_CASE("a sky is finite, not negative, and within its bound for any sun and turbidity") {
  for (const double turbidity : {2.0, 3.0, 7.9, 10.0}) {
    for (int altitude = -90; altitude <= 90; altitude += 10) {
      for (const double length : {1e-300, 1.0, 1e100}) {
        SkyBackground background = sky_at(altitude, turbidity);
        background.sun *= length;
        const Sky sky(background);
        const double most = 1.001 * sky.brightest();
        for (int zenith = 0; zenith <= 180; zenith += 6) {
          for (int turn = 0; turn < 360; turn += 45) {
            const Vec3 there = direction(zenith, turn);
            const Rgb seen = light(sky, there) + sun(sky, there);
            for (int i = 0; i < 3; ++i) {
              REQUIRE(seen[i] >= 0);
              REQUIRE(seen[i] <= most);
            }
          }
        }
      }
    }
  }
}
