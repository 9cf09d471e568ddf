// Placements: affine maps, and the modifiers of scripts that say them.
#pragma once

#include <array>
#include <crt/vec.hpp>
#include <optional>
#include <string>
#include <vector>

namespace crt::importing {

/// Has the rows of an affine map, each with the translation at its end.
using Matrix = std::array<std::array<double, 4>, 3>;

inline constexpr Matrix identity_matrix = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

/// Returns the map that applies `inner` first.
Matrix product(const Matrix& outer, const Matrix& inner);
Vec3 map_point(const Matrix& matrix, const Vec3& point);
double determinant(const Matrix& matrix);
/// Returns the factor by which a map scales lengths, as a mean over the axes.
double mean_scale(const Matrix& matrix);
/// Returns the map that undoes another, or nothing if that flattens space.
std::optional<Matrix> inverted(const Matrix& matrix);
/// Returns by what factor a map scales all lengths, if it does so evenly within a relative error.
std::optional<double> even_scale(const Matrix& matrix, double relative);
/// Returns the linear part of turns by degrees about x, then y, then z.
Matrix rotation_matrix(const Vec3& degrees);

/// Returns the modifiers that make a map, which does not flatten space. `digits` is how many
/// significant digits the numbers have in the file, or 0 if they are exact: turns by whole
/// thousandths of a degree and simple factors are taken for what they are if they give these
/// digits.
std::vector<std::string> modifiers_of(const Matrix& matrix, int digits);

// Sines of degrees are exact for multiples of 30 degrees.
double sine_of_degrees(double degrees);
double cosine_of_degrees(double degrees);

}  // namespace crt::importing
