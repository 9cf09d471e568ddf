#include "import/placement.hpp"

#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <numbers>

#include "import/solid.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

double to_degrees(double radians) {
  return radians * (180 / std::numbers::pi);
}

/// Says whether a number has been rounded to the digits that a file has.
bool is_rounded(double exact, double in_file, int digits) {
  if (digits == 0) return std::abs(exact - in_file) <= 1e-14;
  // The sixth digit of what is nearly 1 is worth 1e-6. OpenSCAD writes small numbers with as many
  // digits as others, and those that come from rounding are not 0.
  const double step = std::max(std::abs(in_file), 1e-4);
  return std::abs(exact - in_file) <= step * 5.1e-6;
}

/// Finds turns about x, then y, then z in thousandths of a degree that give the rows of a rotation.
std::optional<Vec3> turns_of(const Matrix& m, int digits) {
  const double sine = std::clamp(-m[2][0], -1.0, 1.0);
  Vec3 turns{0, 0, 0};
  turns.y = to_degrees(elementary::asin(sine));
  if (std::abs(sine) < 1 - 1e-9) {
    turns.x = to_degrees(elementary::atan2(m[2][1], m[2][2]));
    turns.z = to_degrees(elementary::atan2(m[1][0], m[0][0]));
  } else {
    turns.x = to_degrees(elementary::atan2(-m[1][2], m[1][1]));
  }
  const double steps = digits == 0 ? 1e9 : 1000;
  for (double* const turn : {&turns.x, &turns.y, &turns.z})
    *turn = std::round(*turn * steps) / steps;
  const Matrix made = rotation_matrix(turns);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      if (!is_rounded(made[row][column], m[row][column], digits)) return {};
  }
  return turns;
}

/// Returns the lengths of the columns, the last one below 0 if the map mirrors.
Vec3 factors_of(const Matrix& m) {
  Vec3 factors;
  for (int column = 0; column < 3; ++column) {
    const auto at = static_cast<std::size_t>(column);
    factors[column] = elementary::hypot(m[0][at], m[1][at], m[2][at]);
  }
  return factors;
}

/// Returns a factor with the digits that a file can have shown of it.
double with_digits(double factor, int digits) {
  const double rounded = std::round(factor * 1e5) / 1e5;
  return std::abs(factor - rounded) <= (digits == 0 ? 1e-14 : 2e-6) * factor ? rounded : factor;
}

std::string scale_text(const Vec3& factors) {
  const bool is_even = factors.x == factors.y && factors.y == factors.z;
  return "scale " + (is_even ? number_text(factors.x) : vector_text(factors));
}

std::string matrix_text(const Matrix& matrix) {
  std::vector<std::string> rows;
  for (const auto& row : matrix) {
    std::vector<std::string> numbers;
    for (const double number : row) numbers.push_back(number_text(number));
    rows.push_back(list_text(numbers));
  }
  return "matrix " + list_text(rows);
}

/// Finds a scale, with or without a mirror, and a turn after it.
bool add_scale_and_turn(std::vector<std::string>& modifiers, const Matrix& matrix, int digits) {
  const Vec3 lengths = factors_of(matrix);
  if (lengths.x == 0 || lengths.y == 0 || lengths.z == 0) return false;
  const bool mirrors = determinant(matrix) < 0;
  for (int mirrored = 0; mirrored < (mirrors ? 3 : 1); ++mirrored) {
    Vec3 factors = lengths;
    if (mirrors) factors[mirrored] = -factors[mirrored];
    Matrix turn = matrix;
    for (auto& row : turn) {
      for (std::size_t column = 0; column < 3; ++column)
        row[column] /= factors[static_cast<int>(column)];
    }
    const std::optional<Vec3> turns = turns_of(turn, digits);
    if (!turns) continue;
    if (mirrors && mirrored < 2 && turns->x != 0 && turns->x == turns->y) continue;
    for (int axis = 0; axis < 3; ++axis) factors[axis] = with_digits(factors[axis], digits);
    if (factors != Vec3(1, 1, 1)) modifiers.push_back(scale_text(factors));
    if (*turns != Vec3(0, 0, 0)) modifiers.push_back("rotate " + vector_text(*turns));
    return true;
  }
  return false;
}

}  // namespace

double sine_of_degrees(double degrees) {
  const double turn = std::remainder(degrees, 360.0);
  const double acute = std::abs(turn) > 90 ? 180 - std::abs(turn) : std::abs(turn);
  const double radians = acute * (std::numbers::pi / 180);
  const double sine = acute == 30   ? 0.5
                      : acute == 90 ? 1.0
                      : acute > 45  ? elementary::cos((90 - acute) * (std::numbers::pi / 180))
                                    : elementary::sin(radians);
  return turn < 0 ? -sine : sine;
}

double cosine_of_degrees(double degrees) {
  return sine_of_degrees(90 - std::abs(std::remainder(degrees, 360.0)));
}

Matrix product(const Matrix& outer, const Matrix& inner) {
  Matrix result{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? outer[row][3] : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += outer[row][k] * inner[k][column];
      result[row][column] = sum;
    }
  }
  return result;
}

Vec3 map_point(const Matrix& matrix, const Vec3& p) {
  Vec3 result;
  for (int row = 0; row < 3; ++row) {
    const auto& numbers = matrix[static_cast<std::size_t>(row)];
    result[row] = numbers[0] * p.x + numbers[1] * p.y + numbers[2] * p.z + numbers[3];
  }
  return result;
}

double determinant(const Matrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

double mean_scale(const Matrix& matrix) {
  const double volume = std::abs(determinant(matrix));
  if (!(volume > 0) || !std::isfinite(volume)) return 1;
  const double root = elementary::pow(volume, 1.0 / 3);
  // A step of Newton's method makes the roots of 8 and the like whole.
  return root - (root * root * root - volume) / (3 * root * root);
}

std::optional<Matrix> inverted(const Matrix& m) {
  const double volume = determinant(m);
  if (volume == 0 || !std::isfinite(volume)) return {};
  Matrix result{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      const std::size_t a = (column + 1) % 3, b = (column + 2) % 3;
      const std::size_t c = (row + 1) % 3, d = (row + 2) % 3;
      result[row][column] = (m[a][c] * m[b][d] - m[a][d] * m[b][c]) / volume;
    }
  }
  for (auto& row : result) {
    double moved = 0;
    for (std::size_t k = 0; k < 3; ++k) moved -= row[k] * m[k][3];
    row[3] = moved;
  }
  return result;
}

std::optional<double> even_scale(const Matrix& matrix, double relative) {
  const Vec3 lengths = factors_of(matrix);
  const double scale = lengths.x;
  if (std::abs(lengths.y - scale) > relative * scale ||
      std::abs(lengths.z - scale) > relative * scale)
    return {};
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a + 1; b < 3; ++b) {
      double dot = 0;
      for (const auto& row : matrix) dot += row[a] * row[b];
      if (std::abs(dot) > relative * scale * scale) return {};
    }
  }
  return scale;
}

Matrix rotation_matrix(const Vec3& degrees) {
  const double cx = cosine_of_degrees(degrees.x), sx = sine_of_degrees(degrees.x);
  const double cy = cosine_of_degrees(degrees.y), sy = sine_of_degrees(degrees.y);
  const double cz = cosine_of_degrees(degrees.z), sz = sine_of_degrees(degrees.z);
  const Matrix about_x = {{{1, 0, 0, 0}, {0, cx, -sx, 0}, {0, sx, cx, 0}}};
  const Matrix about_y = {{{cy, 0, sy, 0}, {0, 1, 0, 0}, {-sy, 0, cy, 0}}};
  const Matrix about_z = {{{cz, -sz, 0, 0}, {sz, cz, 0, 0}, {0, 0, 1, 0}}};
  return product(about_z, product(about_y, about_x));
}

std::vector<std::string> modifiers_of(const Matrix& matrix, int digits) {
  std::vector<std::string> modifiers;
  if (!add_scale_and_turn(modifiers, matrix, digits)) return {matrix_text(matrix)};
  const Vec3 offset{matrix[0][3], matrix[1][3], matrix[2][3]};
  if (offset != Vec3(0, 0, 0)) modifiers.push_back("translate " + vector_text(offset));
  return modifiers;
}

}  // namespace crt::importing
