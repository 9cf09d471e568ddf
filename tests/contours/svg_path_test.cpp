#include "crt/svg_path.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <string>

#include "contours/winding_oracle.hpp"
#include "crt/error.hpp"

using namespace crt;
using namespace crt::test;

namespace {

std::vector<Contour> even_odd(std::string_view path, double deviation = 0) {
  return svg_path_contours(path, {.fill = FillRule::even_odd, .deviation = deviation});
}

/// Returns the message for a wrong path.
std::string fault(std::string_view path) {
  try {
    even_odd(path);
  } catch (const Error& error) {
    CHECK(error.argument() == "path");
    CHECK(error.code() == ErrorCode::invalid_argument);
    return error.what();
  }
  return "";
}

/// Returns a point of an elliptical arc by the formulas of SVG 2, section B.2, with y downward.
/// A share of 0 is the begin.
struct SvgArc {
  long double x1, y1, rx, ry, phi;
  int large, sweep;
  long double x2, y2;

  Point at(long double share) const {
    const long double pi = std::numbers::pi_v<long double>;
    const long double c = std::cos(phi * pi / 180);
    const long double s = std::sin(phi * pi / 180);
    const long double dx = (x1 - x2) / 2;
    const long double dy = (y1 - y2) / 2;
    const long double x = c * dx + s * dy;
    const long double y = -s * dx + c * dy;
    const long double lambda = x * x / (rx * rx) + y * y / (ry * ry);
    const long double grown = std::sqrt(std::max(1.0L, lambda));
    const long double a = rx * grown;
    const long double b = ry * grown;
    const long double squared =
        (a * a * b * b - a * a * y * y - b * b * x * x) / (a * a * y * y + b * b * x * x);
    const long double factor = std::sqrt(std::max(0.0L, squared)) * (large == sweep ? -1.0L : 1.0L);
    const long double cx = factor * a * y / b;
    const long double cy = -factor * b * x / a;
    const long double first = std::atan2((y - cy) / b, (x - cx) / a);
    long double turn = std::atan2((-y - cy) / b, (-x - cx) / a) - first;
    if (sweep == 1 && turn < 0) turn += 2 * pi;
    if (sweep == 0 && turn > 0) turn -= 2 * pi;
    const long double angle = first + share * turn;
    const long double u = a * std::cos(angle) + cx;
    const long double v = b * std::sin(angle) + cy;
    return {c * u - s * v + (x1 + x2) / 2, s * u + c * v + (y1 + y2) / 2};
  }
};

}  // namespace

TEST_CASE("all commands of lines draw what SVG says, with y upward") {
  const std::vector<Contour> square = {{{1, -2}, {3, -2}, {3, -4}, {1, -4}}};
  for (const char* path :
       {"M1 2L3 2L3 4L1 4Z", "m1,2 2,0 0,2 -2,0z", "M 1 2 H 3 V 4 H 1 Z", "M1 2h2v2h-2z",
        "\tM\n1 ,2,3 2 3 4, 1 4", "M1 2 3 2 3 4 1 4", "M+1.0e0 .2e1l2 0 0 2-2-0",
        "m1 2l2 0 0 2 -2 0zm5 5z M 0 0 L 1 1", "M0 0m1 2h1 1v1 1h-1-1Z"}) {
    INFO(path);
    std::vector<Contour> found = even_odd(path);
    REQUIRE(found.size() == 1);
    // Straight pieces may be cut further.
    std::erase_if(found[0],
                  [](const ProfilePoint& corner) { return corner.x == 2 || corner.y == -3; });
    CHECK(found == square);
  }
}

TEST_CASE("numbers and flags need blanks only where they would run together") {
  CHECK(even_odd("M.5.5 1.5.5-3-2.5") == std::vector<Contour>{{{.5, -.5}, {1.5, -.5}, {-3, 2.5}}});
  CHECK(even_odd("M0 0a1 1 0 01 5 5L1 0") == even_odd("M 0 0 a 1,1 0 0,1 5,5 L 1 0"));
  CHECK(even_odd("M0 0a1 1 0 015 5L1 0") == even_odd("M0 0a1 1 0 0 1 5 5L1 0"));
  CHECK(even_odd("M0 0a1 1 0 1 15-5L1 0") == even_odd("M0 0a1 1 0 1 1 5 -5L1 0"));
  CHECK(even_odd("M0 0L1e1 0 1E1 1.e+0") == even_odd("M0 0L10 0 10 1"));
  CHECK(even_odd("M0 0L1 1e-400 0 1") == even_odd("M0 0L1 0 0 1"));
}

TEST_CASE("a subpath begins where the last one was closed") {
  CHECK(even_odd("M1 1h2v2zh-2v-2") ==
        std::vector<Contour>{{{1, -1}, {3, -1}, {3, -3}}, {{1, -1}, {-1, -1}, {-1, 1}}});
  CHECK(even_odd("M1 1h2v2zm1 1h1v1") ==
        std::vector<Contour>{{{1, -1}, {3, -1}, {3, -3}}, {{2, -2}, {3, -2}, {3, -3}}});
}

TEST_CASE("smooth curves mirror the control point of a curve of their kind alone") {
  CHECK(even_odd("M0 0C0 1 1 2 2 2S4 1 4 0") == even_odd("M0 0C0 1 1 2 2 2C3 2 4 1 4 0"));
  CHECK(even_odd("m0 0c0 1 1 2 2 2s2-1 2-2") == even_odd("M0 0C0 1 1 2 2 2C3 2 4 1 4 0"));
  CHECK(even_odd("M0 0Q1 2 2 0T4 0L4 5") == even_odd("M0 0Q1 2 2 0Q3-2 4 0L4 5"));
  CHECK(even_odd("M0 0q1 2 2 0t2 0t2 0v5") == even_odd("M0 0Q1 2 2 0Q3-2 4 0Q5 2 6 0L6 5"));
  CHECK(even_odd("M0 0L2 2S4 1 4 0") == even_odd("M0 0L2 2C2 2 4 1 4 0"));
  CHECK(even_odd("M0 0C0 1 1 2 2 2T4 0V5") == even_odd("M0 0C0 1 1 2 2 2Q2 2 4 0V5"));
  CHECK(even_odd("M0 0Q0 2 2 2S4 1 4 0") == even_odd("M0 0Q0 2 2 2C2 2 4 1 4 0"));
  CHECK(even_odd("M0 0C0 1 1 2 2 2ZS1 5 4 0") == even_odd("M0 0C0 1 1 2 2 2ZC0 0 1 5 4 0"));
}

TEST_CASE("arcs of circles are single pieces with the circle's center and radius") {
  const auto circle = profile_from_svg_path("M10 5A5 5 0 1 0 0 5A5 5 0 1 0 10 5Z");
  CHECK(circle);
  CHECK(even_odd("M10 5A5 5 0 1 0 0 5A5 5 0 1 0 10 5Z") ==
        std::vector<Contour>{{{10, -5, 0}, {0, -5, 1}, {10, -5, 1}}});
  const std::vector<Contour> quarter = even_odd("M0 0H1A1 1 0 0 0 0-1");
  REQUIRE(quarter[0].size() == 3);
  CHECK(quarter[0][2].bulge == doctest::Approx(std::sqrt(2.0) - 1).epsilon(1e-15));
  // Three quarters of a circle are two pieces of the same sign.
  const std::vector<Contour> most = even_odd("M1 0A1 1 0 1 1 0-1");
  REQUIRE(most[0].size() == 3);
  CHECK(most[0][1].x == doctest::Approx(-std::sqrt(0.5)));
  CHECK(most[0][1].y == doctest::Approx(-std::sqrt(0.5)));
  CHECK(area_of(most) == doctest::Approx(0.75 * std::numbers::pi + 0.5));
}

TEST_CASE("any arc follows the formulas of SVG") {
  Random random(6);
  for (int i = 0; i < 400; ++i) {
    SvgArc arc{random.uniform(-1, 1),    random.uniform(-1, 1),     random.uniform(0.01, 2),
               random.uniform(0.01, 2),  random.uniform(-400, 400), random.one_in(2) ? 1 : 0,
               random.one_in(2) ? 1 : 0, random.uniform(-1, 1),     random.uniform(-1, 1)};
    if (random.one_in(4)) arc.ry = arc.rx;
    const double wanted = std::pow(10, -random.uniform(1, 5));
    char path[400];
    std::snprintf(path, sizeof path, "M%.17Lg %.17LgA%.17Lg %.17Lg %.17Lg %d %d %.17Lg %.17Lg",
                  arc.x1, arc.y1, arc.rx, arc.ry, arc.phi, arc.large, arc.sweep, arc.x2, arc.y2);
    INFO(path);
    const auto pieces = pieces_of(even_odd(path, wanted)[0]);
    const auto upright = [&](long double share) {
      const Point point = arc.at(share);
      return Point{point.x, -point.y};
    };
    CHECK(static_cast<double>(largest_distance(upright, pieces, 500)) <= wanted);
    if (arc.rx == arc.ry) {
      CHECK(pieces.size() <= 2);
      CHECK(static_cast<double>(largest_distance(upright, pieces, 500)) < 1e-7);
    }
  }
}

TEST_CASE("arcs without a way or a radius are what SVG says") {
  CHECK(even_odd("M0 0A0 1 0 0 0 1 1H0") == even_odd("M0 0L1 1H0"));
  CHECK(even_odd("M0 0A1 1 0 0 0 0 0H1V1") == even_odd("M0 0H1V1"));
  CHECK(even_odd("M0 0A-2-2 0 0 0 1 1H5") == even_odd("M0 0A2 2 0 0 0 1 1H5"));
  CHECK(even_odd("M0 0A1 1 0 0 0 8 0") == std::vector<Contour>{{{0, 0}, {8, 0, 1}}});
}

TEST_CASE("the rule says what is inside of contours that cross") {
  const char* star = "M0-1 .588.809-.951-.309H.951L-.588.809Z";
  CHECK(even_odd(star).size() == 1);
  CHECK(even_odd(star)[0].size() == 5);
  const std::vector<Contour> filled = svg_path_contours(star);
  REQUIRE(filled.size() == 1);
  CHECK(filled[0].size() == 10);
  const char* rings = "M0 0H9V9H0ZM3 3H6V6H3Z";
  CHECK(even_odd(rings).size() == 2);
  CHECK(svg_path_contours(rings).size() == 1);
  CHECK(svg_path_contours("M0 0H9V9H0ZM3 3V6H6V3Z").size() == 2);
}

TEST_CASE("an error of a path says where it is") {
  CHECK(fault("") == "path must enclose an area");
  CHECK(fault("M0 0L1 1Z") == "path must enclose an area");
  CHECK(fault("L1 1") == "path has 'L' at character 1, where a path begins with M or m");
  CHECK(fault("  z") == "path has 'z' at character 3, where a path begins with M or m");
  CHECK(fault("M") == "path has the end at character 2, where a number is expected");
  CHECK(fault("M0") == "path has the end at character 3, where a number is expected");
  CHECK(fault("M,0 0") == "path has ',' at character 2, where a number is expected");
  CHECK(fault("M0 0,") == "path has the end at character 6, where a number is expected");
  CHECK(fault("M0,,0") == "path has ',' at character 4, where a number is expected");
  CHECK(fault("M0 0 1") == "path has the end at character 7, where a number is expected");
  CHECK(fault("M0 0L1 1X") ==
        "path has 'X' at character 9, where a command of a path is expected: one of MLHVCSQTAZ, "
        "or a small one");
  CHECK(fault("M0 0Z1").find("'1' at character 6, where a command") != std::string::npos);
  CHECK(fault("M0 0L1 -") == "path has '-' at character 8, where a number is expected");
  CHECK(fault("M0 0L1 .e5") == "path has '.' at character 8, where a number is expected");
  CHECK(fault("M0 0A1 1 0 2 0 1 1") ==
        "path has '2' at character 12, where a flag is expected: 0 or 1");
  CHECK(fault("M0 0L1e101 0") ==
        "path has '1' at character 6, where a number of at most 1e100 in magnitude is expected");
  CHECK(fault("M0 0L1e999999999999999999 0").find("at most 1e100") != std::string::npos);
  CHECK(fault("M\xc3\xa9 0") ==
        "path has the byte 0xc3 at character 2, where a number is expected");
  CHECK(fault("M0 0h1e100h1e100v1").find("at most 1e100") != std::string::npos);
  CHECK(fault(std::string_view("M0 0\0", 5)).find("the byte 0x00 at character 5") !=
        std::string::npos);
}

TEST_CASE("a path of too many corners is refused") {
  std::string path = "M0 0";
  for (int i = 0; i < (1 << 20); ++i) path += i % 2 == 0 ? "h1" : "v1";
  CHECK_THROWS_WITH_AS(even_odd(path), doctest::Contains("over 1048576 corners"), Error);
}
