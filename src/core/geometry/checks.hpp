// The checks of parameters that the primitives share. Each throws Error (invalid_argument) naming
// the field.
#pragma once

#include "crt/vec.hpp"

namespace crt::core {

/// What any size is at least.
inline constexpr double smallest_length = 1e-100;

/// Throws for the field: "<argument> <rule>".
[[noreturn]] void reject(const char* argument, const char* rule);

/// Finite and at most 1e100 in each coordinate.
void check_coordinates(const char* argument, const Vec3& value);

/// As coordinates, and not (0, 0, 0).
void check_direction(const char* argument, const Vec3& value);

/// The end of an axis, at least 1e-100 from where that starts at `from`.
void check_end(const char* argument, const Vec3& from, const Vec3& to);

/// Between 1e-100 and 1e100.
void check_radius(const char* argument, double value);

}  // namespace crt::core
