#include "core/geometry/checks.hpp"

#include <cmath>

#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "crt/schema.hpp"
#include "text/format.hpp"

namespace crt::core {
namespace {

[[noreturn]] void reject_value(std::string_view argument, std::string_view rule,
                               const Vec3& value) {
  reject(argument, text::format("{} (it is ({}, {}, {}))", rule, value.x, value.y, value.z));
}

[[noreturn]] void reject_value(std::string_view argument, std::string_view rule, double value) {
  reject(argument, text::format("{} (it is {})", rule, value));
}

void check_length(std::string_view argument, double value) {
  if (!std::isfinite(value)) reject_value(argument, "must be finite", value);
  if (!(value > 0)) reject_value(argument, "must be greater than 0", value);
  if (value < smallest_length) reject_value(argument, "must be at least 1e-100", value);
  if (value > schema::largest_length) reject_value(argument, "must be at most 1e100", value);
}

void check_corner(std::string_view argument, const Vec3& corner, const Vec3& opposite,
                  std::string_view other) {
  const Vec3 size = glm::abs(opposite - corner);
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] == 0)
      reject(argument, text::format("must differ from {} in every coordinate", other));
    if (size[axis] < smallest_length) {
      reject(argument,
             text::format("must differ from {} by at least 1e-100 in every coordinate", other));
    }
  }
}

}  // namespace

void reject(std::string_view argument, std::string_view rule) {
  throw Error(ErrorCode::invalid_argument, text::format("{} {}", argument, rule),
              std::string(argument));
}

void check_coordinates(std::string_view argument, const Vec3& value) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(value[axis])) reject_value(argument, "must be finite", value);
    if (std::abs(value[axis]) > schema::largest_length) {
      reject_value(argument, "must be at most 1e100 in magnitude", value);
    }
  }
}

void check_direction(std::string_view argument, const Vec3& value) {
  check_coordinates(argument, value);
  if (largest_component(value) == 0) reject_value(argument, "must have a length", value);
}

void check_end(std::string_view argument, const Vec3& from, const Vec3& to,
               std::string_view other) {
  if (from == to) reject(argument, text::format("must differ from {}", other));
  if (largest_component(to - from) < smallest_length)
    reject(argument, text::format("must differ from {} by at least 1e-100", other));
}

void check_number(std::string_view argument, const schema::Rule& rule, double value) {
  if (rule.kind == schema::Rule::length_or_zero) {
    if (value < 0) reject_value(argument, "must not be negative", value);
    if (value != 0) check_length(argument, value);
  } else if (rule.kind == schema::Rule::length) {
    check_length(argument, value);
  }
}

void check_vector(std::string_view argument, const schema::Rule& rule, const Vec3& value,
                  const Vec3& other) {
  using enum schema::Rule::Kind;
  if (rule.kind == direction) return check_direction(argument, value);
  if (rule.kind == any) return;
  if (rule.kind == length) {
    for (int axis = 0; axis < 3; ++axis) check_length(argument, value[axis]);
    return;
  }
  check_coordinates(argument, value);
  if (rule.kind == apart) check_end(argument, other, value, rule.other);
  if (rule.kind == corner) check_corner(argument, other, value, rule.other);
}

void check_count(std::string_view subject, std::string_view things, std::size_t count,
                 std::size_t most) {
  if (count > most)
    throw Error(ErrorCode::limit,
                text::format("{} {} {}; at most {} are possible", subject, count, things, most));
}

void check_made(std::string_view argument, const schema::Rule& rule, bool is_there) {
  if (!is_there) reject(argument, text::format("must be given (see {})", rule.other));
}

}  // namespace crt::core
