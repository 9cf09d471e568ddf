#include "core/geometry/profile/profile.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/math/dyadic.hpp"
#include "crt/entity.hpp"
#include "geometry/profiles.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns what is wrong with contours, or "" if nothing is.
std::string fault(const std::vector<Contour>& contours) {
  try {
    make_profile(contours);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(error.argument() == "profile");
    return error.what();
  }
  return "";
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Returns one of the doubles next to a number, as far as half the way to it.
core::Dyadic half_way(double x, double towards) {
  return core::Dyadic(0.5) * (core::Dyadic(x) + core::Dyadic(std::nextafter(x, towards)));
}

/// Returns whether no double is nearer to a truth, of which a function says the sign of a number
/// less it.
template <class Less>
bool is_nearest(double x, const Less& sign_of_rest) {
  return sign_of_rest(half_way(x, -HUGE_VAL)) <= 0 && sign_of_rest(half_way(x, HUGE_VAL)) >= 0;
}

/// Returns an arc between points of which many are such that the center or the radius is half way
/// between two doubles.
Contour random_arc(Random& random) {
  const auto number = [&](double size) {
    const double x = random.uniform(-size, size);
    return random.one_in(2) ? std::round(0x1p53 * x) * 0x1p-53 : x;
  };
  const double middle = random.one_in(3) ? 100 : 1;
  const ProfilePoint from{.x = middle + number(1), .y = random.one_in(2) ? 0 : middle + number(1)};
  const double bulge = random.one_in(2) ? random.uniform(0.1, 5)
                                        : std::array{0.5, 1.0, 2.0, 3.0, 5.0}[random.bits() % 5];
  ProfilePoint to{.x = from.x + bulge * number(0x1p-3), .y = from.y + bulge * number(0x1p-3)};
  to.bulge = random.one_in(2) ? bulge : -bulge;
  return {from, to};
}

}  // namespace

TEST_CASE("an error of a profile says which corner of which contour is wrong") {
  const Contour square = rectangle(0, 0, 1, 1);
  CHECK(fault({square}) == "");
  CHECK(fault({}) == "profile: it must have a contour");
  CHECK(fault({square, {}}) ==
        "profile: contour 1 must enclose an area (its 0 corners are on one line)");
  CHECK(fault({{{0, 0}, {1, 1}, {3, 3}}}) ==
        "profile: contour 0 must enclose an area (its 3 corners are on one line)");
  CHECK(fault({square, {{0, 0}, {1, not_a_number}, {1, 1}}}) ==
        "profile: corner 1 of contour 1 has nan");
  CHECK(fault({{{0, 0}, {1, 0}, {1, 1, HUGE_VAL}}}) == "profile: corner 2 of contour 0 has inf");
  CHECK(fault({{{0, 0}, {2e100, 0}, {1, 1}}}) ==
        "profile: corner 1 of contour 0 must be at most 1e100 in magnitude (it is (2e+100, 0))");
  CHECK(fault({{{0, 0}, {1, 0}, {1, 0, 0.5}, {1, 1}}}) ==
        "profile: corner 1 of contour 0 and corner 2 of contour 0 must be at least 1e-100 apart");
  CHECK(fault({{{0, 0, 1}}}) ==
        "profile: corner 0 of contour 0 and corner 0 of contour 0 must be at least 1e-100 apart");
  const std::string no_circle =
      "profile: the arc to corner 1 of contour 0 is too flat, or too small at its place, for "
      "doubles to say its circle (its bulge is ";
  CHECK(fault({{{0, 0}, {1, 0, 1e-9}, {1, 1}}}) == no_circle + "1e-09)");
  CHECK(fault({{{0, 0}, {1, 0, 1e300}, {1, 1}}}) == no_circle + "1e+300)");
  CHECK(fault({{{1e15, 0}, {1e15, 1, 0.3}}}) == no_circle + "0.3)");
}

TEST_CASE("a corner that repeats the one before does not count, in extrusions and revolutions") {
  const Contour plain = {{1, 0}, {2, 0, 0.5}, {2, 2}, {1, 2}};
  Contour repeated = {{1, 0}, {1, 0}, {2, 0, 0.5}, {2, -0.0}, {2, 0}, {2, 2}, {1, 2}, {1, 2}};
  const auto pieces = [](const Contour& contour) { return make_profile({{contour}})->pieces(); };
  for (const bool is_closed : {false, true}) {
    if (is_closed) repeated.insert(repeated.end(), 2, {1, 0});
    const auto expected = pieces(plain);
    const auto found = pieces(repeated);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      CHECK(found[i].from == expected[i].from);
      CHECK(found[i].to == expected[i].to);
      CHECK(found[i].arc == expected[i].arc);
    }
    CHECK_NOTHROW(Entity(Extrusion{.profile = make_profile({{repeated}})}));
    CHECK_NOTHROW(Entity(Revolution{.profile = make_profile({{repeated}})}));
  }
  // Corners keep their numbers in messages.
  const Contour wrong = {{1, 0}, {1, 0}, {2, 0}, {-1, 1}};
  try {
    const Entity entity(Revolution{.profile = make_profile({{wrong}})});
    FAIL("beyond the axis");
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find("corner 3 of contour 0") != std::string::npos);
  }
}

TEST_CASE("arcs of every size and curvature that has a circle are taken") {
  for (const double scale : {1e-98, 1.0, 1e99}) {
    for (const double bulge : {-1e5, -1.0, -1e-5, 1e-5, 0.5, 1.0, 1e5}) {
      CHECK(fault({{{0, 0}, {scale, 0, bulge}, {0, scale}}}) == "");
    }
  }
}

TEST_CASE("half and quarter circles have their center and radius exactly") {
  for (const bool by_quarters : {false, true}) {
    const auto profile = profile_of({circle(0.1, -0.7, 0.3, by_quarters)});
    for (const Profile::Arc& arc : profile->arcs()) {
      if (by_quarters) CHECK(arc.center == Vec3(0.1, -0.7, 0));
      CHECK(std::abs(arc.radius - 0.3) < 1e-16);
    }
    const auto whole = profile_of({circle(2, -3, 0.5, by_quarters)});
    for (const Profile::Arc& arc : whole->arcs()) {
      CHECK(arc.first == 0);
      CHECK(arc.center == Vec3(2, -3, 0));
      CHECK(arc.radius == 0.5);
    }
    CHECK(whole->bounds().lower == Vec3(1.5, -3.5, 0));
    CHECK(whole->bounds().upper == Vec3(2.5, -2.5, 0));
  }
}

TEST_CASE("the center and the radius of an arc are the nearest doubles") {
  using core::Dyadic;
  Random random(4);
  for (int i = 0; i < 20000; ++i) {
    const Contour contour = random_arc(random);
    const Profile::Arc arc = profile_of({contour})->arcs()[0];
    const Dyadic bulge = contour[1].bulge;
    const Dyadic x = Dyadic(contour[1].x) - Dyadic(contour[0].x);
    const Dyadic y = Dyadic(contour[1].y) - Dyadic(contour[0].y);
    // The center is half way from corner to corner, and to the left by (1 - b^2) / 4 b chords.
    const auto check_center = [&](double found, double from, double to, const Dyadic& across) {
      return is_nearest(found, [&](const Dyadic& place) {
        const Dyadic moved = Dyadic(2) * place - Dyadic(from) - Dyadic(to);
        return (Dyadic(2) * bulge * moved - (Dyadic(1) - square(bulge)) * across).sign() *
               bulge.sign();
      });
    };
    REQUIRE(check_center(arc.center.x, contour[0].x, contour[1].x, -y));
    REQUIRE(check_center(arc.center.y, contour[0].y, contour[1].y, x));
    // The radius is (1 + b^2) / 4 |b| chords.
    const Dyadic chords = square(Dyadic(1) + square(bulge)) * (square(x) + square(y));
    REQUIRE(is_nearest(arc.radius, [&](const Dyadic& radius) {
      return (square(Dyadic(4) * bulge * radius) - chords).sign();
    }));
  }
}

TEST_CASE("an arc and its reverse, and the halves of a circle, are on one circle") {
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    Contour contour = random_arc(random);
    if (random.one_in(3)) {
      // This is a quarter, but for the rounding of its corners.
      const double radius = contour[1].x - contour[0].x;
      contour[1].y = contour[0].y + radius;
      contour[1].bulge = std::numbers::sqrt2 + (random.one_in(2) ? -1 : 1);
    }
    const auto [from, to] = std::array{contour[0], contour[1]};
    const Contour reversed = {{to.x, to.y}, {from.x, from.y, -to.bulge}};
    const auto arcs = profile_of({contour, reversed})->arcs();
    REQUIRE(arcs[1].first == 0);
    const auto halves = profile_of({circle(from.x, to.y, to.bulge)})->arcs();
    REQUIRE(halves[1].first == 0);
  }
}

TEST_CASE("a last corner that repeats the first closes a contour with its own bulge") {
  const auto open = profile_of({{{0, 0, 1}, {2, 0}, {2, 1}}});
  const auto closed = profile_of({{{0, 0}, {2, 0}, {2, 1}, {0, 0, 1}}});
  CHECK(open->pieces().size() == 3);
  CHECK(closed->pieces().size() == 3);
  CHECK(closed->arcs()[0].center == open->arcs()[0].center);
}

TEST_CASE("pieces on one straight line know the first of them, and whether they are turned") {
  const auto profile =
      profile_of({{{0, 0}, {3, 1}, {6, 2}, {6, 4}, {0, 4}}, {{9, 3}, {3, 1}, {3, 9}}});
  CHECK(profile->pieces()[1].first == 0);
  CHECK(profile->pieces()[5].first == 0);
  CHECK(profile->pieces()[5].turned);
  CHECK_FALSE(profile->pieces()[1].turned);
  CHECK(profile->pieces()[2].first == 2);
}
