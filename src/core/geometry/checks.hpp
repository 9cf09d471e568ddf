// The checks of parameters that the primitives share. Each throws Error (invalid_argument) naming
// the field.
#pragma once

#include "crt/vec.hpp"

namespace crt::core {

/// Throws for the field: "<argument> <rule>".
[[noreturn]] void reject(const char* argument, const char* rule);

/// Finite and at most 1e100 in each coordinate.
void check_coordinates(const char* argument, const Vec3& value);

/// As coordinates, and not (0, 0, 0).
void check_direction(const char* argument, const Vec3& value);

/// Between 1e-100 and 1e100.
void check_radius(const char* argument, double value);

}  // namespace crt::core
