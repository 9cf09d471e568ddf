// Curves and the arcs that they become are as close to each other as is said.
#include "crt/curves.hpp"

#include <doctest/doctest.h>

#include <array>
#include <string>

#include "contours/arc_distance.hpp"
#include "crt/error.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// A Curve is a cubic by its control points.
using Curve = std::array<CurvePoint, 4>;

Point at(const Curve& curve, long double t) {
  const long double s = 1 - t;
  const auto value = [&](const auto axis) {
    return s * s * (s * curve[0].*axis + 3 * t * curve[1].*axis) +
           t * t * (3 * s * curve[2].*axis + t * curve[3].*axis);
  };
  return {value(&CurvePoint::x), value(&CurvePoint::y)};
}

Contour contour_of(const Curve& curve, double deviation = 0) {
  Contour contour = {{curve[0].x, curve[0].y}};
  append_cubic(contour, curve[1], curve[2], curve[3], deviation);
  return contour;
}

double size_of_box(const Curve& curve) {
  double size = 0;
  for (const CurvePoint& a : curve) {
    for (const CurvePoint& b : curve) {
      size = std::max({size, std::abs(a.x - b.x), std::abs(a.y - b.y)});
    }
  }
  return size;
}

/// Returns the distance between a curve and its contour, which is the larger of both directions.
long double deviation_of(const Curve& curve, const Contour& contour) {
  constexpr int points_of_curve = 600;
  const auto along_curve = [&](long double t) { return at(curve, t); };
  const auto pieces = pieces_of(contour);
  long double largest = largest_distance(along_curve, pieces, points_of_curve);
  // The way back: the curve as many straight pieces.
  Contour dense;
  for (int i = 0; i <= points_of_curve; ++i) {
    const Point point = along_curve(static_cast<long double>(i) / points_of_curve);
    dense.push_back({static_cast<double>(point.x), static_cast<double>(point.y)});
  }
  std::vector<ArcPiece> straight;
  for (const ArcPiece& piece : pieces_of(dense)) {
    if (length(piece.to - piece.from) > 0) straight.push_back(piece);
  }
  if (straight.empty()) return largest;
  for (const ArcPiece& piece : pieces) {
    constexpr int points_of_piece = 6;
    largest = std::max(largest, largest_distance([&](long double t) { return piece.at(t); },
                                                 straight, points_of_piece));
  }
  return largest;
}

/// Returns the largest angle in which one piece does not continue the direction of the one before.
double largest_edge(const Contour& contour) {
  double largest = 0;
  const auto pieces = pieces_of(contour);
  constexpr long double tiny = 1e-6L;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const ArcPiece& last = pieces[i - 1];
    const ArcPiece& next = pieces[i];
    const auto direction = [&](const ArcPiece& piece, bool at_end) {
      const Point chord = piece.to - piece.from;
      const long double turned = (at_end ? 0.5L : -0.5L) * piece.angle;
      return Point{chord.x * std::cos(turned) - chord.y * std::sin(turned),
                   chord.x * std::sin(turned) + chord.y * std::cos(turned)};
    };
    const Point a = direction(last, true);
    const Point b = direction(next, false);
    if (length(a) < tiny || length(b) < tiny) continue;
    const long double angle = std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    largest = std::max(largest, static_cast<double>(std::fabs(angle)));
  }
  return largest;
}

const Curve quarter_turn = {{{1, 0}, {1, 0.5522847498}, {0.5522847498, 1}, {0, 1}}};

}  // namespace

TEST_CASE("a curve and its arcs are within the deviation of each other") {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    Curve curve;
    for (CurvePoint& point : curve) {
      point = {random.uniform(-1, 1), random.uniform(-1, 1)};
    }
    if (random.one_in(8)) curve[1] = curve[0];
    if (random.one_in(8)) curve[2] = curve[3];
    if (random.one_in(8)) curve[3] = curve[0];
    const double wanted = std::pow(10, -random.uniform(1, 4.5));
    const Contour contour = contour_of(curve, wanted);
    const double found = static_cast<double>(deviation_of(curve, contour));
    CHECK(found <= wanted + 2e-5);  // the dense curve is itself straight between its points
    CHECK(contour.back().x == curve[3].x);
    CHECK(contour.back().y == curve[3].y);
    CHECK(contour_of(curve).size() >= contour_of(curve, 0.1).size());
  }
}

TEST_CASE("the deviation is used up, so that there are no more arcs than it needs") {
  for (const double wanted : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const Contour contour = contour_of(quarter_turn, wanted);
    const auto pieces = pieces_of(contour);
    const long double found =
        largest_distance([&](long double t) { return at(quarter_turn, t); }, pieces, 4000);
    CHECK(found <= wanted);
    // An arc of a circle is as near to a curve as a power of 3 of its length.
    CHECK(static_cast<double>(pieces.size()) <= std::max(2.0, 8 * std::cbrt(1e-4 / wanted)));
  }
}

TEST_CASE("the default deviation is a 10000th of the curve's size, whatever that is") {
  const std::size_t pieces = contour_of(quarter_turn).size();
  for (const double scale : {0x1p-300, 0x1p-20, 0x1p10, 0x1p300}) {
    Curve scaled = quarter_turn;
    for (CurvePoint& point : scaled) point = {scale * point.x, scale * point.y};
    const Contour contour = contour_of(scaled);
    CHECK(contour.size() == pieces);
    const auto along = [&](long double t) { return at(scaled, t); };
    CHECK(largest_distance(along, pieces_of(contour), 2000) <= 1e-4L * size_of_box(scaled));
    CHECK(make_profile({&contour, 1}));
  }
}

TEST_CASE("arcs continue one another's directions") {
  const Curve bend = {{{0, 0}, {3, 2}, {-2, 1}, {2, 0}}};
  const Curve wave = {{{0, 0}, {1, 2}, {2, -2}, {3, 0}}};
  for (const Curve& curve : {quarter_turn, bend, wave}) {
    CHECK(largest_edge(contour_of(curve)) < 1e-9);
    CHECK(largest_edge(contour_of(curve, 1e-7)) < 1e-6);
  }
}

TEST_CASE("curves with cusps, loops and equal or collinear points become right contours") {
  const Curve cusp = {{{0, 0}, {1, 1}, {0, 1}, {1, 0}}};
  const Curve loop = {{{0, 0}, {2, 1}, {-1, 1}, {1, 0}}};
  const Curve closed = {{{0, 0}, {1, 1}, {-1, 1}, {0, 0}}};
  const Curve reversed = {{{0, 0}, {1, 0}, {-1, 0.001}, {0.5, 0}}};
  const Curve there_and_back = {{{0, 0}, {3, 3}, {-2, -2}, {1, 1}}};
  const Curve twice = {{{0, 0}, {1, 1}, {1, 1}, {0, 0}}};
  const Curve straight = {{{0, 0}, {0, 0}, {1, 2}, {1, 2}}};
  for (const Curve& curve : {cusp, loop, closed, reversed, there_and_back, twice, straight}) {
    for (const double wanted : {1e-2, 1e-4}) {
      const Contour contour = contour_of(curve, wanted);
      CHECK(static_cast<double>(deviation_of(curve, contour)) <= wanted + 2e-5);
      CHECK(contour.size() < 100);
    }
  }
  CHECK(contour_of(straight).size() == 2);
  const Curve point = {{{1, 2}, {1, 2}, {1, 2}, {1, 2}}};
  CHECK(contour_of(point) == Contour{{1, 2}});
}

TEST_CASE("arcs of any curve are such that a profile takes them") {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double size = std::pow(10, random.uniform(-95, 95));
    const double place = size * std::pow(10, random.uniform(-3, 15));
    Curve curve;
    for (CurvePoint& point : curve) {
      const double flat = random.one_in(3) ? std::pow(10, -random.uniform(0, 16)) : 1;
      point = {place + size * random.uniform(-1, 1), place + size * flat * random.uniform(-1, 1)};
    }
    if (place > 1e100) continue;
    Contour contour = contour_of(curve);
    contour.push_back({place + 3 * size, place + 100 * size});
    contour.push_back({place - 3 * size, place + 100 * size});
    CHECK_NOTHROW(make_profile({&contour, 1}));
  }
}

TEST_CASE("a tight deviation takes as many arcs as its cube root says") {
  const Contour contour = contour_of(quarter_turn, 0x1p-32);
  CHECK(contour.size() > 50);
  CHECK(contour.size() < 500);
  const Curve flat = {{{0, 0}, {1, 1e-7}, {2, 1e-7}, {3, 0}}};
  CHECK(contour_of(flat, 0x1p-30).size() < 2000);
}

TEST_CASE("a quadratic curve is the cubic of the same points") {
  Contour contour = {{0, 0}};
  append_quadratic(contour, {1, 2}, {3, 0}, 1e-4);
  const Curve same = {{{0, 0}, {2.0 / 3, 4.0 / 3}, {5.0 / 3, 4.0 / 3}, {3, 0}}};
  CHECK(static_cast<double>(deviation_of(same, contour)) <= 1e-4 + 2e-5);
  CHECK(contour.back().x == 3);
}

TEST_CASE("an error of a curve says what is wrong") {
  const auto fault = [](const Curve& curve, double deviation) -> std::string {
    try {
      contour_of(curve, deviation);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::invalid_argument);
      return error.what();
    }
    return "";
  };
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(fault(quarter_turn, -1).starts_with("deviation must be 0 or at least 2.328"));
  CHECK(fault(quarter_turn, 1e-12).starts_with("deviation must be 0 or at least"));
  CHECK(fault(quarter_turn, std::nan("")).starts_with("deviation must be 0 or at least"));
  CHECK(fault(quarter_turn, inf).starts_with("deviation must be 0 or at least"));
  CHECK(fault({{{0, 0}, {inf, 0}, {1, 1}, {2, 0}}}, 0).starts_with("control1 must have finite"));
  CHECK(fault({{{0, 0}, {0, 0}, {1, 2e100}, {2, 0}}}, 0).starts_with("control2 must have"));
  CHECK(fault({{{0, 0}, {0, 0}, {1, 1}, {2, std::nan("")}}}, 0).starts_with("end must have"));
  Contour empty;
  CHECK_THROWS_WITH_AS(append_cubic(empty, {}, {}, {}), doctest::Contains("must have a corner"),
                       Error);
  CHECK_THROWS_WITH_AS(append_quadratic(empty, {}, {}), doctest::Contains("must have a corner"),
                       Error);
}
