// This file has the built-ins that say how much a solid is, where, how near and how thick.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "crt/elementary.hpp"
#include "crt/measure.hpp"
#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

/// A script pays so many steps for a look at a part of a solid in a box. It takes about as long,
/// which depends on what is found there.
struct StepsPerLook {
  static constexpr std::uint64_t volume = 64;
  static constexpr std::uint64_t area = 320;
  static constexpr std::uint64_t centroid = 128;
  static constexpr std::uint64_t distance = 16;
};

/// These are relative widths. Those of scripts are as narrow as takes little of their steps.
constexpr double default_width = 1e-6;
constexpr double default_width_of_slow = 1e-4;
constexpr double default_width_of_walls = 1e-2;
/// Narrower than that a single step of the search may take long.
constexpr double least_width = 1e-9;

/// Rounding leaves so much of a distance open, for the size of the solids and their places.
constexpr double rounding_of_distance = 0x1p-38;

const Entity& given_entity(const Arguments& arguments, std::size_t i = 0) {
  const auto* given = std::get_if<Entity>(&arguments[i]);
  if (!given) arguments.wrong_type(i, "an entity");
  return *given;
}

/// Returns options by which the script pays for the work, and may be ended during it. Argument
/// `place` is the relative width, if it is given.
MeasureOptions options_of(const Arguments& arguments, std::size_t place, double width,
                          std::uint64_t steps_per_look) {
  MeasureOptions options{
      .relative_width = width, .threads = 1, .go_on = arguments.context.options.go_on};
  if (arguments.size() > place) {
    options.relative_width = arguments.number(place);
    if (!(options.relative_width >= least_width && options.relative_width <= 1))
      fail(arguments.span(place), "the relative width must be from 1e-9 to 1");
  }
  options.work = [&arguments, steps_per_look](std::uint64_t looks) {
    arguments.context.spend(arguments.call, static_cast<std::size_t>(steps_per_look * looks));
  };
  return options;
}

/// Calls measure(), whose errors become those of the argument.
template <class Measure>
auto measured(const Arguments& arguments, std::string_view name, const Measure& measure) {
  // Every part is compiled and looked at once.
  for (const Value& value : arguments.values()) {
    const auto* entity = std::get_if<Entity>(&value);
    if (!entity) continue;
    const std::uint64_t parts =
        std::min(entity->primitive_count(), arguments.context.limits.entities);
    arguments.context.spend(arguments.call, static_cast<std::size_t>(StepsPerLook::volume * parts));
  }
  try {
    return measure();
  } catch (const Error& error) {
    throw Failure{.span = arguments.span(0),
                  .message = text::format("{}: {}", name, error.what()),
                  .code = error.code()};
  }
}

/// Refuses a number that is not known to the width that was asked for. A little more is what
/// rounding leaves open.
void check_width(const Arguments& arguments, std::string_view name, const Interval& found,
                 double width) {
  if (found.width() <= 2 * width) return;
  fail(arguments.span(0),
       "{}: it is between {} and {}, and cannot be found more closely: ask for a larger relative "
       "width",
       name, found.lower, found.upper);
}

/// Computes name(e) or name(e, relativewidth) by a function that gives an interval.
Value number_of(const Arguments& arguments, std::string_view name,
                Interval (*measure)(const Entity&, const MeasureOptions&),
                const MeasureOptions& options) {
  const Interval found =
      measured(arguments, name, [&] { return measure(given_entity(arguments), options); });
  check_width(arguments, name, found, options.relative_width * found.upper);
  return found.middle();
}

Value volume_of(const Arguments& arguments) {
  return number_of(arguments, "volume", volume,
                   options_of(arguments, 1, default_width, StepsPerLook::volume));
}

Value area_of(const Arguments& arguments) {
  return number_of(arguments, "area", surface_area,
                   options_of(arguments, 1, default_width_of_slow, StepsPerLook::area));
}

/// Returns half of the longest side of the box around a solid's parts.
double size_of(const Entity& entity) {
  const BoundingBox box = bounding_box(entity);
  double size = 0;
  for (int axis = 0; axis < 3; ++axis)
    size = std::max(size, 0.5 * box.upper[axis] - 0.5 * box.lower[axis]);
  return size;
}

/// Computes centroid(e) or centroid(e, relativewidth).
Value centroid_of(const Arguments& arguments) {
  const MeasureOptions options =
      options_of(arguments, 1, default_width_of_slow, StepsPerLook::centroid);
  return measured(arguments, "centroid", [&]() -> Value {
    const Entity& entity = given_entity(arguments);
    const std::array<Interval, 3> found = centroid(entity, options);
    if (!std::isfinite(found[0].lower)) {
      fail(arguments.span(0), "centroid: there is none, as nothing proves that it has a volume");
    }
    for (const Interval& number : found)
      check_width(arguments, "centroid", number, options.relative_width * size_of(entity));
    return Vec3(found[0].middle(), found[1].middle(), found[2].middle());
  });
}

/// Computes bounds(e): [lower, upper].
Value bounds_of(const Arguments& arguments) {
  const MeasureOptions options = options_of(arguments, 1, default_width, StepsPerLook::volume);
  const BoundingBox box = measured(
      arguments, "bounds", [&] { return tight_bounding_box(given_entity(arguments), options); });
  for (const Vec3& corner : {box.lower, box.upper}) {
    if (std::isfinite(corner.x) && std::isfinite(corner.y) && std::isfinite(corner.z)) continue;
    fail(arguments.span(0), "bounds: there is no box around it: it is {}",
         box.lower.x > box.upper.x ? "empty" : "infinite");
  }
  return arguments.context.make_list(arguments.call, {box.lower, box.upper});
}

/// Computes contains(e, p).
Value contains_point(const Arguments& arguments) {
  const Vec3 point = arguments.vector(1);
  return measured(arguments, "contains", [&] {
    PointSide side = PointSide::outside;
    contains(given_entity(arguments), std::span(&point, 1), std::span(&side, 1), 1);
    return side != PointSide::outside;
  });
}

/// Computes distance(e, p) or distance(a, b), either with a relative width behind.
Value distance_of(const Arguments& arguments) {
  MeasureOptions options = options_of(arguments, 2, default_width_of_slow, StepsPerLook::distance);
  const double enough = options.relative_width;
  const Entity& entity = given_entity(arguments);
  const auto* other = std::get_if<Entity>(&arguments[1]);
  const auto* point = std::get_if<Vec3>(&arguments[1]);
  if (!other && !point) arguments.wrong_type(1, "a Vec3 or an entity");
  const auto check = [&](const Interval& distance, double size) {
    const double found = std::max(std::abs(distance.lower), std::abs(distance.upper));
    if (std::isinf(distance.lower))
      fail(arguments.span(0), "distance: there is none, as a solid without points is nowhere");
    check_width(arguments, "distance", distance, enough * found + rounding_of_distance * size);
  };
  return measured(arguments, "distance", [&]() -> Value {
    if (other) {
      const Interval found = clearance(entity, *other, options).distance;
      check(found, size_of(entity) + size_of(*other));
      return found.lower > 0 ? found.upper : 0;
    }
    // That of most points is found as closely in hardly more steps.
    if (arguments.size() < 3) options.relative_width = default_width;
    const NearestPoint nearest = nearest_point(entity, *point, options);
    const double place = std::max({std::abs(point->x), std::abs(point->y), std::abs(point->z)});
    check(nearest.distance, size_of(entity) + place);
    return nearest.signed_distance();
  });
}

/// Computes how thin the thinnest wall is.
Value least_thickness(const Arguments& arguments) {
  const MeasureOptions options =
      options_of(arguments, 1, default_width_of_walls, StepsPerLook::distance);
  const Interval found = measured(arguments, "thickness", [&] {
    return least_wall(given_entity(arguments), {.measure = options}).thickness;
  });
  if (std::isinf(found.lower)) {
    fail(arguments.span(0), "thickness: it has no wall, as no two sides of it are parallel");
  }
  check_width(arguments, "thickness", found, options.relative_width * found.upper);
  return found.upper;
}

/// Computes how much of the way from one point to another is in a solid.
Value thickness_between(const Arguments& arguments) {
  const Vec3 from = arguments.vector(1);
  const Vec3 way = arguments.vector(2) - from;
  const double length = elementary::hypot(way.x, way.y, way.z);
  if (!(length > 0)) fail(arguments.span(2), "thickness: it must be another point than the first");
  const MeasureOptions options = options_of(arguments, 3, default_width, StepsPerLook::distance);
  const std::vector<LinePiece> pieces = measured(arguments, "thickness", [&] {
    return thickness_along(given_entity(arguments), from, way, options);
  });
  const auto on_way = [&](double distance) { return std::clamp(distance, 0.0, length); };
  Interval sum;
  for (const LinePiece& piece : pieces) {
    sum.lower += std::max(0.0, on_way(piece.to.lower) - on_way(piece.from.upper));
    sum.upper += on_way(piece.to.upper) - on_way(piece.from.lower);
  }
  if (sum.width() > 2 * options.relative_width * length) {
    fail(arguments.span(1), "thickness: it is between {} and {}, as the way goes along the surface",
         sum.lower, sum.upper);
  }
  return sum.middle();
}

Value thickness_of(const Arguments& arguments) {
  return arguments.size() > 2 ? thickness_between(arguments) : least_thickness(arguments);
}

constexpr std::array measures_table = {
    Builtin{"volume", "volume(entity, relativewidth)", 1, 2, volume_of},
    Builtin{"area", "area(entity, relativewidth)", 1, 2, area_of},
    Builtin{"centroid", "centroid(entity, relativewidth)", 1, 2, centroid_of},
    Builtin{"bounds", "bounds(entity, relativewidth)", 1, 2, bounds_of},
    Builtin{"contains", "contains(entity, point)", 2, 2, contains_point},
    Builtin{"distance", "distance(entity, other, relativewidth)", 2, 3, distance_of},
    Builtin{"thickness", "thickness(entity, from, to)", 1, 3, thickness_of},
};

}  // namespace

std::span<const Builtin> measure_builtins() {
  return measures_table;
}

}  // namespace crt::lang
