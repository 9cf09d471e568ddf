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

namespace {

/// A TriangleRule is exact for polynomials of degree 6: Dunavant, High degree efficient symmetrical
/// Gaussian quadrature rules for the triangle, 1985.
struct TriangleRule {
  static constexpr std::size_t count = 12;
  using Places = std::array<double, count>;  ///< has a number for each

  Places weights{};
  std::array<Places, 3> shares{};  ///< of the corners

  constexpr TriangleRule() {
    std::size_t place = 0;
    const auto add = [&](double weight, double a, double b, double c) {
      const std::array<double, 3> of_corners = {a, b, c};
      for (std::size_t turn = 0; turn < 3; ++turn, ++place) {
        weights[place] = weight;
        for (std::size_t i = 0; i < 3; ++i) shares[i][place] = of_corners[(i + turn) % 3];
      }
    };
    add(0.116786275726379, 0.501426509658179, 0.249286745170910, 0.249286745170910);
    add(0.050844906370207, 0.873821971016996, 0.063089014491502, 0.063089014491502);
    add(0.082851075618374, 0.053145049844817, 0.310352451033784, 0.636502499121399);
    add(0.082851075618374, 0.053145049844817, 0.636502499121399, 0.310352451033784);
  }
};

/// Adds up four at a time, as processors do.
double sum_of(const TriangleRule::Places& x) {
  std::array<double, 4> sums;
  for (std::size_t i = 0; i < 4; ++i) sums[i] = x[i] + x[i + 4] + x[i + 8];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

SquareMoments moments_of_triangle(const FlatTriangle& triangle, double area) {
  static_assert(PatchSeries::degree <= 6);
  constexpr TriangleRule rule;
  constexpr std::size_t count = TriangleRule::count;
  TriangleRule::Places s;
  TriangleRule::Places t;
  std::array<TriangleRule::Places, PatchSeries::degree + 1> terms;  // of one degree, weighted
  for (std::size_t k = 0; k < count; ++k) {
    const auto at_place = [&](int axis) {
      return rule.shares[0][k] * triangle[0][axis] + rule.shares[1][k] * triangle[1][axis] +
             rule.shares[2][k] * triangle[2][axis];
    };
    s[k] = at_place(0);
    t[k] = at_place(1);
    terms[0][k] = area * rule.weights[k];
  }
  SquareMoments moments;
  moments[0] = sum_of(terms[0]);
  for (std::size_t i = 1; i <= PatchSeries::degree; ++i) {
    for (std::size_t k = 0; k < count; ++k) terms[i][k] = t[k] * terms[i - 1][k];
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < count; ++k) terms[j][k] *= s[k];
    for (std::size_t j = 0; j <= i; ++j) moments[PatchSeries::place(i - j, j)] = sum_of(terms[j]);
  }
  return moments;
}

SquareMoments moments_of_part(const SquarePart& part) {
  constexpr std::size_t degree = PatchSeries::degree;
  // These are the integrals of powers over an interval.
  const auto powers = [&](double middle) {
    std::array<double, degree + 1> result{};
    const double low = middle - part.size;
    const double high = middle + part.size;
    double low_power = low;
    double high_power = high;
    result[0] = 2 * part.size;
    for (std::size_t i = 1; i <= degree; ++i) {
      low_power *= low;
      high_power *= high;
      result[i] = (high_power - low_power) / static_cast<double>(i + 1);
    }
    return result;
  };
  const auto of_s = powers(part.s);
  const auto of_t = powers(part.t);
  SquareMoments moments{};
  for (std::size_t i = 0; i <= degree; ++i)
    for (std::size_t j = 0; i + j <= degree; ++j)
      moments[PatchSeries::place(i, j)] = of_s[i] * of_t[j];
  return moments;
}

}  // namespace

SquareMoments moments_of(const SquarePiece& piece) {
  return piece.is_whole ? moments_of_part(piece.part)
                        : moments_of_triangle(piece.triangle, piece.area());
}

double integral_of(const PatchSeries& series, const SquareMoments& moments) {
  double sum = 0;
  for (std::size_t i = 0; i < moments.size(); ++i) sum += series.terms[i] * moments[i];
  return sum;
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
