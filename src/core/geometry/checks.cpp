#include "core/geometry/checks.hpp"

#include <cmath>

#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {
namespace {

constexpr double largest_length = 1e100;

[[noreturn]] void reject_value(const char* argument, const char* rule, const Vec3& value) {
  reject(argument,
         text::format("{} (it is ({}, {}, {}))", rule, value.x, value.y, value.z).c_str());
}

[[noreturn]] void reject_value(const char* argument, const char* rule, double value) {
  reject(argument, text::format("{} (it is {})", rule, value).c_str());
}

}  // namespace

void reject(const char* argument, const char* rule) {
  throw Error(ErrorCode::invalid_argument, text::format("{} {}", argument, rule), argument);
}

void check_coordinates(const char* argument, const Vec3& value) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(value[axis])) reject_value(argument, "must be finite", value);
    if (std::abs(value[axis]) > largest_length) {
      reject_value(argument, "must be at most 1e100 in magnitude", value);
    }
  }
}

void check_direction(const char* argument, const Vec3& value) {
  check_coordinates(argument, value);
  if (largest_component(value) == 0) reject_value(argument, "must have a length", value);
}

void check_end(const char* argument, const Vec3& from, const Vec3& to) {
  if (from == to) reject(argument, "must differ from from");
  if (largest_component(to - from) < smallest_length) {
    reject(argument, "must differ from from by at least 1e-100");
  }
}

void check_radius(const char* argument, double value) {
  if (!std::isfinite(value)) reject_value(argument, "must be finite", value);
  if (!(value > 0)) reject_value(argument, "must be greater than 0", value);
  if (value < smallest_length) reject_value(argument, "must be at least 1e-100", value);
  if (value > largest_length) reject_value(argument, "must be at most 1e100", value);
}

void check_radius_or_zero(const char* argument, double value) {
  if (value < 0) reject_value(argument, "must not be negative", value);
  if (value != 0) check_radius(argument, value);
}

}  // namespace crt::core
