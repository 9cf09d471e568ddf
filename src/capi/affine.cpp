// This file implements the affine maps of the C interface: the three rows of a 3x4 matrix.
#include <algorithm>
#include <array>
#include <cmath>
#include <crt/elementary.hpp>

#include "capi/guard.hpp"
#include "crt/crt.h"

namespace crt::capi {

namespace {

constexpr std::size_t rows = 3;
constexpr std::size_t columns = 4;

using Affine = std::array<double, rows * columns>;

/// Returns the map with these numbers on the diagonal.
Affine diagonal(double x, double y, double z) {
  return {x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0};
}

void write(const Affine& map, double* out) {
  std::copy(map.begin(), map.end(), out);
}

struct SineCosine {
  double sine;
  double cosine;
};

/// Returns the sine and cosine of an angle. Where a double cannot come nearer to a quarter turn,
/// they are those of the quarter turn.
SineCosine sine_cosine(double angle) {
  // The cosine of the double next to pi / 2 is 6e-17. All other angles of some turns are farther.
  constexpr double rounding = 0x1p-52;
  const double sine = elementary::sin(angle);
  const double cosine = elementary::cos(angle);
  const double margin = rounding * std::max(1.0, std::abs(angle));
  if (std::abs(cosine) <= margin) return {std::copysign(1.0, sine), 0};
  if (std::abs(sine) <= margin && angle != 0) return {0, std::copysign(1.0, cosine)};
  return {sine, cosine};
}

/// Returns the rotation about a unit vector, by Rodrigues's formula.
Affine rotation(const std::array<double, 3>& unit, double angle) {
  const auto [sine, cosine] = sine_cosine(angle);
  const auto [x, y, z] = unit;
  const double rest = 1 - cosine;
  return {rest * x * x + cosine,   rest * x * y - sine * z, rest * x * z + sine * y, 0,
          rest * x * y + sine * z, rest * y * y + cosine,   rest * y * z - sine * x, 0,
          rest * x * z - sine * y, rest * y * z + sine * x, rest * z * z + cosine,   0};
}

std::array<double, 3> unit_vector(const double* axis) {
  require(axis, "axis");
  double largest = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    if (!std::isfinite(axis[i])) reject("axis", "must be finite");
    largest = std::max(largest, std::abs(axis[i]));
  }
  if (largest == 0) reject("axis", "must not be 0");
  // Brought to a size of about 1 first, no axis is too long or too short to be measured.
  const int exponent = -std::ilogb(largest);
  const std::array<double, 3> scaled = {std::scalbn(axis[0], exponent),
                                        std::scalbn(axis[1], exponent),
                                        std::scalbn(axis[2], exponent)};
  const double length = elementary::hypot(scaled[0], scaled[1], scaled[2]);
  return {scaled[0] / length, scaled[1] / length, scaled[2] / length};
}

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

void crt_affine_identity(double out[12]) {
  if (out != nullptr) write(diagonal(1, 1, 1), out);
}

void crt_affine_translation(const double by[3], double out[12]) {
  if (by == nullptr || out == nullptr) return;
  write({1, 0, 0, by[0], 0, 1, 0, by[1], 0, 0, 1, by[2]}, out);
}

void crt_affine_scaling(const double by[3], double out[12]) {
  if (by != nullptr && out != nullptr) write(diagonal(by[0], by[1], by[2]), out);
}

crt_status crt_affine_rotation(const double axis[3], double angle, double out[12]) {
  return guarded([&] {
    const std::array<double, 3> unit = unit_vector(axis);
    if (!std::isfinite(angle)) reject("angle", "must be finite");
    require(out, "out");
    write(rotation(unit, angle), out);
  });
}

void crt_affine_product(const double first[12], const double then[12], double out[12]) {
  if (first == nullptr || then == nullptr || out == nullptr) return;
  Affine product{};
  for (std::size_t row = 0; row < rows; ++row) {
    const double* const left = then + row * columns;
    for (std::size_t column = 0; column < columns; ++column) {
      double sum = column == rows ? left[rows] : 0;
      for (std::size_t i = 0; i < rows; ++i) sum += left[i] * first[i * columns + column];
      product[row * columns + column] = sum;
    }
  }
  write(product, out);
}
