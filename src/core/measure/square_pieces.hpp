// The square from -1 to 1 along s and t is cut into pieces, over which polynomials are integrated.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/math/patch_series.hpp"
#include "core/measure/simplices.hpp"

namespace crt::core {

/// A SquarePart is a square in it with a middle and half of a width.
struct SquarePart {
  double s = 0;
  double t = 0;
  double size = 1;
};

/// A SquarePiece is a part, or a triangle in a part.
struct SquarePiece {
  SquarePart part;
  FlatTriangle triangle{};
  bool is_whole = false;       ///< it is the part
  std::uint32_t negative = 0;  ///< the walls whose functions are below 0

  Vec3 middle() const {
    if (is_whole) return {part.s, part.t, 0};
    return (triangle[0] + triangle[1] + triangle[2]) * (1.0 / 3);
  }
  double area() const {
    if (is_whole) return 4 * part.size * part.size;
    return std::abs(double_area(triangle).z) / 2;
  }
};

/// A WallSegment is a part of the line in which a wall meets the square.
struct WallSegment {
  std::size_t wall = 0;
  Vec3 from;
  Vec3 to;
  std::uint32_t negative = 0;  ///< the other walls whose functions are below 0

  Vec3 at(double share) const { return from + share * (to - from); }
};

/// A NearlyLinear is a series as a linear function, with what it may differ from that.
struct NearlyLinear {
  LinearFunction function;
  double error = 0;

  explicit NearlyLinear(const PatchSeries& a);
};

/// Returns how much of the square a linear function is within an error of 0 in, at most.
double area_in_doubt(const LinearFunction& function, double error);

/// SquareMoments are the integrals of s^i t^j over pieces, rounded, in the order of a series'
/// terms.
using SquareMoments = std::array<double, PatchSeries::term_count>;

SquareMoments moments_of(const SquarePiece& piece);
/// Integrates a series over pieces, but for its error.
double integral_of(const PatchSeries& series, const SquareMoments& moments);

/// Cuts pieces where a function is 0. `bit` is added to those where it is below.
void cut_pieces(const LinearFunction& function, std::uint32_t bit,
                std::vector<SquarePiece>& pieces);

/// Returns the line where the function of a wall is 0 in a part of the square: a segment or none.
std::vector<WallSegment> line_in(const SquarePart& part, const LinearFunction& function,
                                 std::size_t wall);
/// Cuts segments likewise.
void cut_segments(const LinearFunction& function, std::uint32_t bit,
                  std::vector<WallSegment>& segments);

}  // namespace crt::core
