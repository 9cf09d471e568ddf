#include "core/geometry/profile/profile.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

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
