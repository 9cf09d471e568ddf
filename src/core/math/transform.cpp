#include "crt/transform.hpp"

#include <crt/elementary.hpp>

#include <algorithm>
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

/// Returns the direction of a vector, of length 1.
Vec3 direction_of(const char* argument, const Vec3& vector) {
  const double largest = std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)});
  if (!std::isfinite(vector.x + vector.y + vector.z)) fail(argument, "must be finite", vector);
  if (largest == 0) fail(argument, "must not be 0", vector);
  const Vec3 scaled = vector / largest;
  return scaled / std::sqrt(scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z);
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

Transform rotate_degrees(const Vec3& axis, double degrees) {
  const Vec3 n = direction_of("axis", axis);
  if (!std::isfinite(degrees)) fail("degrees", "must be finite", degrees);
  const auto [sine, cosine] = sine_cosine(degrees);
  // This is Rodrigues' formula.
  const Vec3 cross_rows[] = {{0, -n.z, n.y}, {n.z, 0, -n.x}, {-n.y, n.x, 0}};
  const auto row = [&, s = sine, c = cosine](int i) {
    Vec3 result = (1 - c) * n[i] * n + s * cross_rows[i];
    result[i] += c;
    return result;
  };
  return {.row_x = row(0), .row_y = row(1), .row_z = row(2)};
}

Transform mirror(const Vec3& normal) {
  const Vec3 n = direction_of("normal", normal);
  const auto row = [&](int i) {
    Vec3 result = -2 * n[i] * n;
    result[i] += 1;
    return result;
  };
  return {.row_x = row(0), .row_y = row(1), .row_z = row(2)};
}

}  // namespace crt
