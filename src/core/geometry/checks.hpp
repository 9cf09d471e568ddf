// Primitives share these checks of parameters. Each throws Error (invalid_argument) naming the
// field.
#pragma once

#include "crt/vec.hpp"

namespace crt::core {

/// Every size is at least this.
inline constexpr double smallest_length = 1e-100;

/// Throws for the field: "<argument> <rule>".
[[noreturn]] void reject(const char* argument, const char* rule);

/// Checks that each coordinate is finite and at most 1e100 in magnitude.
void check_coordinates(const char* argument, const Vec3& value);

/// Checks a direction like coordinates. It must not be (0, 0, 0).
void check_direction(const char* argument, const Vec3& value);

/// Checks the end of an axis, which must be at least 1e-100 from its begin at `from`.
void check_end(const char* argument, const Vec3& from, const Vec3& to);

/// Checks that a radius is between 1e-100 and 1e100.
void check_radius(const char* argument, double value);

/// Checks a radius that may also be 0.
void check_radius_or_zero(const char* argument, double value);

}  // namespace crt::core
