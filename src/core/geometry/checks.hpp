// Primitives share these checks of parameters. Each throws Error (invalid_argument) naming the
// field.
#pragma once

#include <string_view>

#include "crt/vec.hpp"

namespace crt::schema {
struct Rule;
}

namespace crt::core {

/// Every size is at least this.
inline constexpr double smallest_length = 1e-100;

/// Throws for the field: "<argument> <rule>".
[[noreturn]] void reject(std::string_view argument, std::string_view rule);

/// Checks that each coordinate is finite and at most 1e100 in magnitude.
void check_coordinates(std::string_view argument, const Vec3& value);

/// Checks a direction like coordinates. It must not be (0, 0, 0).
void check_direction(std::string_view argument, const Vec3& value);

/// Checks the end of an axis, which must be at least 1e-100 from its begin in another argument.
void check_end(std::string_view argument, const Vec3& from, const Vec3& to,
               std::string_view other = "from");

/// Checks a number by the rule of its field.
void check_number(std::string_view argument, const schema::Rule& rule, double value);

/// Checks a vector by the rule of its field. `other` is the value of the field that the rule names.
void check_vector(std::string_view argument, const schema::Rule& rule, const Vec3& value,
                  const Vec3& other);

/// Checks that there are at most so many of what a subject has ("path has", "points"). Throws Error
/// (limit).
void check_count(std::string_view subject, std::string_view things, std::size_t count,
                 std::size_t most);

/// Checks that something is there, which the function that the rule names makes.
void check_made(std::string_view argument, const schema::Rule& rule, bool is_there);

}  // namespace crt::core
