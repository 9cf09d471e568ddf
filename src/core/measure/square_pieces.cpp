#include "core/measure/square_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace crt::core {

NearlyLinear::NearlyLinear(const PatchSeries& a)
    : function{a.terms[0], {a.terms[1], a.terms[2], 0}} {
  // Of a square the half is nearest.
  for (const std::size_t place : {PatchSeries::place(2, 0), PatchSeries::place(0, 2)}) {
    function.value += 0.5 * a.terms[place];
    error += 0.5 * std::abs(a.terms[place]);
  }
  error += std::abs(a.terms[PatchSeries::place(1, 1)]);
  for (std::size_t i = 6; i < PatchSeries::term_count; ++i) error += std::abs(a.terms[i]);
  error = (error + a.error) * (1 + 0x1p-40) + 0x1p-50 * std::abs(function.value);
}

double area_in_doubt(const LinearFunction& function, double error) {
  const double across = std::abs(function.slope.x) + std::abs(function.slope.y);
  if (std::abs(function.value) - across > error) return 0;
  const double steepest = std::max(std::abs(function.slope.x), std::abs(function.slope.y));
  return error < steepest ? 4 * (error / steepest) * (1 + 0x1p-40) : 4;
}

double integral_over(const SquarePiece& piece, const PatchSeries& series) {
  if (piece.is_whole)
    return integral_over_part(series, piece.part.s, piece.part.t, piece.part.size);
  // This rule is exact for polynomials of degree 6: Dunavant, High degree efficient symmetrical
  // Gaussian quadrature rules for the triangle, 1985.
  const FlatTriangle& triangle = piece.triangle;
  static_assert(PatchSeries::degree <= 6);
  struct Place {
    double weight;
    std::array<double, 3> shares;
  };
  constexpr auto rule = [] {
    std::array<Place, 12> places{};
    std::size_t count = 0;
    const auto add = [&](double weight, double a, double b, double c) {
      places[count++] = {weight, {a, b, c}};
      places[count++] = {weight, {b, c, a}};
      places[count++] = {weight, {c, a, b}};
    };
    add(0.116786275726379, 0.501426509658179, 0.249286745170910, 0.249286745170910);
    add(0.050844906370207, 0.873821971016996, 0.063089014491502, 0.063089014491502);
    add(0.082851075618374, 0.053145049844817, 0.310352451033784, 0.636502499121399);
    add(0.082851075618374, 0.053145049844817, 0.636502499121399, 0.310352451033784);
    return places;
  }();
  double sum = 0;
  for (const auto& [weight, shares] : rule) {
    const Vec3 place = shares[0] * triangle[0] + shares[1] * triangle[1] + shares[2] * triangle[2];
    sum += weight * value_at(series, place.x, place.y);
  }
  return piece.area() * sum;
}

void cut_pieces(const LinearFunction& function, std::uint32_t bit,
                std::vector<SquarePiece>& pieces) {
  std::vector<SquarePiece> result;
  std::vector<FlatTriangle> below;
  std::vector<FlatTriangle> above;
  for (const SquarePiece& piece : pieces) {
    below.clear();
    above.clear();
    cut(piece.triangle, function, below, above);
    for (const FlatTriangle& triangle : below)
      result.push_back(
          {.part = piece.part, .triangle = triangle, .negative = piece.negative | bit});
    for (const FlatTriangle& triangle : above)
      result.push_back({.part = piece.part, .triangle = triangle, .negative = piece.negative});
  }
  pieces = std::move(result);
}

/// Returns the line where a function is 0 in a part of the square.
std::vector<WallSegment> line_in(const SquarePart& part, const LinearFunction& function,
                                 std::size_t wall) {
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = Vec3(part.s + (i == 1 || i == 2 ? part.size : -part.size),
                      part.t + (i >= 2 ? part.size : -part.size), 0);
  }
  std::vector<Vec3> ends;
  for (std::size_t i = 0; i < 4; ++i) {
    const double a = function.at(corners[i]);
    const double b = function.at(corners[(i + 1) % 4]);
    if ((a < 0) != (b < 0))
      ends.push_back(corners[i] + (a / (a - b)) * (corners[(i + 1) % 4] - corners[i]));
  }
  if (ends.size() < 2) return {};
  return {{.wall = wall, .from = ends[0], .to = ends[1]}};
}
void cut_segments(const LinearFunction& function, std::uint32_t bit,
                  std::vector<WallSegment>& segments) {
  std::vector<WallSegment> result;
  for (const WallSegment& segment : segments) {
    const double a = function.at(segment.from);
    const double b = function.at(segment.to);
    WallSegment first = segment;
    if (a < 0) first.negative |= bit;
    if ((a < 0) != (b < 0)) {
      first.to = segment.at(a / (a - b));
      WallSegment second = segment;
      second.from = first.to;
      if (b < 0) second.negative |= bit;
      result.push_back(second);
    }
    result.push_back(first);
  }
  segments = std::move(result);
}
}  // namespace crt::core
