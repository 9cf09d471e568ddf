// Blobs and superellipsoids are implicit solids.
// Sources: Wyvill, McPheeters, Wyvill, Data structure for soft objects, 1986 (sums of parts that
// end); Barr, Superquadrics and angle-preserving transformations, 1981.
#include "crt/implicit_shapes.hpp"

#include <cmath>
#include <vector>

#include "core/geometry/bounds.hpp"
#include "core/geometry/checks.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

[[noreturn]] void reject_part(std::size_t part, const char* rule) {
  throw Error(ErrorCode::invalid_argument, text::format("parts: part {} {}", part, rule), "parts");
}

void check_part(const BlobPart& part, std::size_t number) {
  const auto is_fair = [](double x) { return std::abs(x) <= 1e100; };
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_fair(part.from[axis]) || !is_fair(part.to[axis]))
      reject_part(number, "must be at finite coordinates of at most 1e100");
  }
  if (part.from != part.to && !(glm::length(part.to - part.from) >= core::smallest_length))
    reject_part(number, "must have ends that are equal or at least 1e-100 from each other");
  if (!(part.radius >= core::smallest_length && is_fair(part.radius)))
    reject_part(number, "must have a radius from 1e-100 to 1e100");
  if (!(is_fair(part.strength) && part.strength != 0))
    reject_part(number, "must have a strength other than 0, of at most 1e100");
}

/// Returns what a part adds, in units of its radius.
Field added(const BlobPart& part) {
  const std::array<Field, 3> place = {Field::x() - part.from.x, Field::y() - part.from.y,
                                      Field::z() - part.from.z};
  const Vec3 along = part.to - part.from;
  Field share = 0;
  if (part.from != part.to) {
    const Field way = place[0] * along.x + place[1] * along.y + place[2] * along.z;
    share = max(min(way / glm::dot(along, along), 1), 0);
  }
  Field squares = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Field& from = place[static_cast<std::size_t>(axis)];
    const Field off = part.from == part.to ? from : from - share * along[axis];
    squares = axis == 0 ? pow(off / part.radius, 2) : squares + pow(off / part.radius, 2);
  }
  return part.strength * pow(max(1 - squares, 0), 2);
}

/// Adds fields two by two, so that sums are not deep.
Field sum_of(std::span<const Field> fields) {
  if (fields.size() == 1) return fields[0];
  const std::size_t half = fields.size() / 2;
  return sum_of(fields.first(half)) + sum_of(fields.subspan(half));
}

}  // namespace

Implicit blob(std::span<const BlobPart> parts, double threshold) {
  if (!(threshold > 0 && threshold <= 1e100)) {
    core::reject("threshold", "must be above 0 and at most 1e100");
  }
  if (parts.size() > most_blob_parts) core::reject("parts", "are too many for a blob");
  std::vector<Field> fields;
  core::Bounds box;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const BlobPart& part = parts[i];
    check_part(part, i);
    fields.push_back(added(part));
    if (part.strength < 0) continue;
    box.include_around(part.from, Vec3(part.radius));
    box.include_around(part.to, Vec3(part.radius));
  }
  if (box.empty()) core::reject("parts", "must have one of a strength above 0");
  return {.field = threshold - sum_of(fields), .lower = box.lower, .upper = box.upper};
}

Implicit superellipsoid(double east_west, double north_south) {
  constexpr double least = 0.01;
  constexpr double most = 10;
  if (!(east_west >= least && east_west <= most))
    core::reject("east_west", "must be from 0.01 to 10");
  if (!(north_south >= least && north_south <= most))
    core::reject("north_south", "must be from 0.01 to 10");
  const auto power = [](const Field& coordinate, double exponent) {
    return exponent == 2 ? pow(coordinate, 2) : pow(abs(coordinate), exponent);
  };
  const Field across = power(Field::x(), 2 / east_west) + power(Field::y(), 2 / east_west);
  // The box leaves room around it, so that it crosses nothing.
  constexpr double reach = 1.0625;
  return {.field = pow(across, east_west / north_south) + power(Field::z(), 2 / north_south) - 1,
          .lower = Vec3(-reach),
          .upper = Vec3(reach)};
}

}  // namespace crt
