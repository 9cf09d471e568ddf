// This file has the built-ins that say how much a solid is, and where.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "crt/measure.hpp"
#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

/// To look at a part of a solid in a box takes about as long as so many steps of a script.
constexpr std::uint64_t steps_per_look = 64;
constexpr double default_width = 1e-6;
/// Narrower than that a single step of the search may take long.
constexpr double least_width = 1e-9;

const Entity& given_entity(const Arguments& arguments) {
  const auto* given = std::get_if<Entity>(&arguments[0]);
  if (!given) arguments.wrong_type(0, "an entity");
  return *given;
}

/// Returns options by which the script pays for the work, and may be ended during it.
MeasureOptions options_of(const Arguments& arguments) {
  MeasureOptions options{
      .relative_width = default_width, .threads = 1, .go_on = arguments.context.options.go_on};
  if (arguments.size() > 1) {
    options.relative_width = arguments.number(1);
    if (!(options.relative_width >= least_width && options.relative_width <= 1))
      fail(arguments.span(1), "the relative width must be from 1e-9 to 1");
  }
  options.work = [&arguments](std::uint64_t looks) {
    arguments.context.spend(arguments.call, static_cast<std::size_t>(steps_per_look * looks));
  };
  return options;
}

/// Calls measure(), whose errors become those of the argument.
template <class Measure>
auto measured(const Arguments& arguments, std::string_view name, const Measure& measure) {
  // Every part is compiled and looked at once.
  const std::uint64_t parts =
      std::min(given_entity(arguments).primitive_count(), arguments.context.limits.entities);
  arguments.context.spend(arguments.call, static_cast<std::size_t>(steps_per_look * parts));
  try {
    return measure();
  } catch (const Error& error) {
    throw Failure{.span = arguments.span(0),
                  .message = text::format("{}: {}", name, error.what()),
                  .code = error.code()};
  }
}

/// Computes volume(e) or volume(e, relativewidth).
Value volume_of(const Arguments& arguments) {
  const MeasureOptions options = options_of(arguments);
  const Interval found =
      measured(arguments, "volume", [&] { return volume(given_entity(arguments), options); });
  // A little more is what rounding leaves open.
  if (found.width() > 2 * options.relative_width * found.upper) {
    fail(arguments.span(0),
         "volume: it is between {} and {}, and cannot be found more closely: ask for a larger "
         "relative width",
         found.lower, found.upper);
  }
  return found.middle();
}

/// Computes bounds(e): [lower, upper].
Value bounds_of(const Arguments& arguments) {
  const MeasureOptions options = options_of(arguments);
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

constexpr std::array measures_table = {
    Builtin{"volume", "volume(entity, relativewidth)", 1, 2, volume_of},
    Builtin{"bounds", "bounds(entity, relativewidth)", 1, 2, bounds_of},
    Builtin{"contains", "contains(entity, point)", 2, 2, contains_point},
};

}  // namespace

std::span<const Builtin> measure_builtins() {
  return measures_table;
}

}  // namespace crt::lang
