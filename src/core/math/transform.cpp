#include "crt/transform.hpp"

#include <crt/elementary.hpp>

#include <cmath>
#include <numbers>

#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt {
namespace {

constexpr double largest_magnitude = 1e100;
constexpr double smallest_factor = 1e-100;

[[noreturn]] void fail(const char* argument, const char* rule, const Vec3& value) {
  throw Error(ErrorCode::invalid_argument,
              text::format("{} {} (it is ({}, {}, {}))", argument, rule, value.x, value.y, value.z),
              argument);
}

[[noreturn]] void fail(const char* argument, const char* rule, double value) {
  throw Error(ErrorCode::invalid_argument, text::format("{} {} (it is {})", argument, rule, value),
              argument);
}

/// Returns what is wrong with a factor of scale(), or nullptr.
const char* factor_fault(double factor) {
  if (!std::isfinite(factor)) return "must be finite";
  if (factor == 0) return "must not be 0";
  if (std::abs(factor) > largest_magnitude) return "must be at most 1e100 in magnitude";
  if (std::abs(factor) < smallest_factor) return "must be at least 1e-100 in magnitude";
  return nullptr;
}

struct SineCosine {
  double sine;
  double cosine;
};

/// Computes both exactly for multiples of 90 degrees: quarter turns are taken off before any
/// rounding can happen. So angles that are a whole number of turns apart are equal.
SineCosine sine_cosine(double degrees) {
  constexpr double quarter_turn = 90;
  constexpr double radians_per_degree = std::numbers::pi / 180;
  int quarters = 0;
  const double radians = std::remquo(degrees, quarter_turn, &quarters) * radians_per_degree;
  const double sine = elementary::sin(radians);
  const double cosine = elementary::cos(radians);
  switch (quarters & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace

Transform translate(const Vec3& offset) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(offset[axis])) fail("offset", "must be finite", offset);
    if (std::abs(offset[axis]) > largest_magnitude)
      fail("offset", "must be at most 1e100 in magnitude", offset);
  }
  Transform result;
  result.translation = offset;
  return result;
}

Transform scale(double factor) {
  if (const char* fault = factor_fault(factor)) fail("factor", fault, factor);
  return {.row_x = {factor, 0, 0}, .row_y = {0, factor, 0}, .row_z = {0, 0, factor}};
}

Transform scale(const Vec3& factors) {
  for (int axis = 0; axis < 3; ++axis) {
    if (const char* fault = factor_fault(factors[axis])) fail("factors", fault, factors);
  }
  return {.row_x = {factors.x, 0, 0}, .row_y = {0, factors.y, 0}, .row_z = {0, 0, factors.z}};
}

Transform rotate_degrees(const Vec3& degrees) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(degrees[axis])) fail("degrees", "must be finite", degrees);
  }
  const auto [sx, cx] = sine_cosine(degrees.x);
  const auto [sy, cy] = sine_cosine(degrees.y);
  const auto [sz, cz] = sine_cosine(degrees.z);
  // This is the product (about z)(about y)(about x), written out.
  return {.row_x = {cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx},
          .row_y = {sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx},
          .row_z = {-sy, cy * sx, cy * cx}};
}

}  // namespace crt
