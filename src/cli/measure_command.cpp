// `crt measure` says how much the entities of a script are, and where.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/file.hpp>
#include <crt/measure.hpp>
#include <crt/schema_settings.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/intervals.hpp"
#include "cli/measured.hpp"
#include "cli/measured_section.hpp"
#include "cli/picture_renderer.hpp"
#include "cli/reporter.hpp"

namespace crt::cli {

namespace {

bool is_finite(const Interval& number) {
  return std::isfinite(number.lower) && std::isfinite(number.upper);
}

/// Finds the numbers of one entity that were asked for, and no others.
class EntityMeasuring {
 public:
  EntityMeasuring(const MeasureRequest& request, MeasureOptions options, Unit unit)
      : request_(request),
        options_(std::move(options)),
        unit_(unit),
        all_(!request.asks_for_some()) {}

  Measured measure(const Entity& entity, const std::string& name) const {
    Measured found{.name = name,
                   .fault = "",
                   .bounds = {},
                   .volume = {},
                   .area = {},
                   .mass = {},
                   .centroid = {},
                   .inertia = {},
                   .wall = {}};
    if (all_ || request_.bounds) found.bounds = tight_bounding_box(entity, options_);
    try {
      measure_mass(entity, found);
      if (request_.section) found.section = find_section(request_, entity, options_);
      if (request_.thickness) found.wall = least_wall(entity, wall_options());
    } catch (const Error& error) {
      if (error.code() != ErrorCode::invalid_argument) throw;
      found.fault = error.what();
    }
    return found;
  }

 private:
  WallOptions wall_options() const {
    WallOptions walls{.measure = options_};
    walls.measure.relative_width = request_.wall_width;
    return walls;
  }

  /// Returns the mass of a cubed scene unit, in kg if the density is known.
  Interval mass_of_cubed_unit(double of_materials) const {
    const double given = request_.density.value_or(1);
    if (of_materials == 0) return {given, given};
    // The unit and three products are rounded.
    constexpr double rounding = 0x1p-50;
    const double metres = metres_of(unit_);
    const double mass = of_materials * metres * metres * metres;
    return {mass * (1 - rounding), mass * (1 + rounding)};
  }

  void measure_mass(const Entity& entity, Measured& found) const {
    if (all_ || request_.mass) {
      if (request_.mass) found.density = density(entity);
      const MassProperties properties = mass_properties(entity, options_);
      found.volume = properties.volume;
      if (all_ || request_.area) found.area = properties.area;
      if (std::ranges::all_of(properties.centroid, is_finite)) found.centroid = properties.centroid;
      if (!request_.mass) return;
      found.mass_is_in_kg = found.density > 0;
      const Interval mass_of_unit = mass_of_cubed_unit(found.density);
      found.mass = product_of(properties.volume, mass_of_unit);
      found.inertia = properties.inertia;
      for (Interval& number : *found.inertia) number = product_of(number, mass_of_unit);
      return;
    }
    if (request_.volume) found.volume = volume(entity, options_);
    if (request_.area) found.area = surface_area(entity, options_);
  }

  const MeasureRequest& request_;
  MeasureOptions options_;
  Unit unit_;
  bool all_;
};

// ---- all together ---------------------------------------------------------------------------

void add(std::optional<Interval>& sum, const std::optional<Interval>& part) {
  if (part) sum = sum_of(sum.value_or(Interval{}), *part);
}

void include(std::optional<BoundingBox>& all, const std::optional<BoundingBox>& part) {
  if (!part || is_empty(*part)) return;
  if (!all) all = part;
  for (int axis = 0; axis < 3; ++axis) {
    all->lower[axis] = std::min(all->lower[axis], part->lower[axis]);
    all->upper[axis] = std::max(all->upper[axis], part->upper[axis]);
  }
}

bool has_masses(const std::vector<Measured>& parts) {
  return std::ranges::any_of(parts, [](const Measured& part) { return part.mass.has_value(); });
}

/// Finds the centroid of all: the mean of theirs, by their masses or volumes.
std::optional<std::array<Interval, 3>> common_centroid(
    const std::vector<Measured>& parts, const std::optional<Interval> Measured::*weight,
    const Interval& all) {
  if (!(all.lower > 0)) return {};
  std::array<Interval, 3> sum{};
  bool is_known = false;
  for (const Measured& part : parts) {
    if (!(part.*weight) || !part.centroid) continue;
    is_known = true;
    for (std::size_t i = 0; i < 3; ++i)
      sum[i] = sum_of(sum[i], product_of(*(part.*weight), (*part.centroid)[i]));
  }
  if (!is_known) return {};
  for (Interval& number : sum) number = quotient_of(number, all);
  return sum;
}

}  // namespace

Measured sum_of(const std::vector<Measured>& parts, bool has_density) {
  Measured sum;
  const auto is_in_kg = [](const Measured& part) { return part.density > 0 || !part.mass; };
  const bool all_in_kg = std::ranges::all_of(parts, is_in_kg);
  const bool none_in_kg =
      std::ranges::all_of(parts, [](const Measured& part) { return part.density == 0; });
  const bool has_mass = all_in_kg || none_in_kg || has_density;
  std::size_t count = 0;
  for (const Measured& part : parts) {
    include(sum.bounds, part.bounds);
    add(sum.volume, part.volume);
    add(sum.area, part.area);
    if (has_mass) add(sum.mass, part.mass);
    if (part.fault.empty()) ++count;
  }
  sum.name = fmt::format("sum of {} of {} entities (overlaps count for each)", count, parts.size());
  if (sum.mass && !none_in_kg) {
    if (all_in_kg) sum.mass_is_in_kg = true;
    sum.centroid = common_centroid(parts, &Measured::mass, *sum.mass);
  } else if (sum.volume && (has_mass || !has_masses(parts))) {
    sum.centroid = common_centroid(parts, &Measured::volume, *sum.volume);
  }
  return sum;
}

namespace {

// ---- as text --------------------------------------------------------------------------------

std::string vector_text(const Vec3& place, double width, bool up) {
  return fmt::format("({}, {}, {})", end_text(place.x, width, up), end_text(place.y, width, up),
                     end_text(place.z, width, up));
}

std::string box_text(const BoundingBox& box, double relative_width, std::string_view unit) {
  if (is_empty(box)) return "none: it is empty";
  double size = 0;
  for (int axis = 0; axis < 3; ++axis)
    size = std::max(size, 0.5 * box.upper[axis] - 0.5 * box.lower[axis]);
  const double width = std::isfinite(size) ? relative_width * size : 0;
  return fmt::format("{} to {} {}", vector_text(box.lower, width, false),
                     vector_text(box.upper, width, true), unit);
}

std::string centroid_text(const std::array<Interval, 3>& centroid, std::string_view unit) {
  double width = 0;
  for (const Interval& number : centroid) width = std::max(width, number.width());
  return fmt::format("({}, {}, {}) {}, each within {}", number_text(centroid[0]),
                     number_text(centroid[1]), number_text(centroid[2]), unit,
                     end_text(width, 100 * width, true));
}

std::string inertia_text(const std::array<Interval, 6>& inertia) {
  constexpr std::array names = {"xx", "yy", "zz", "xy", "yz", "zx"};
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += fmt::format("\n    {}      {}, {}", names[i], number_text(inertia[i]),
                        bounds_text(inertia[i]));
  }
  return text;
}

std::string wall_text(const Wall& wall, std::string_view unit) {
  if (std::isinf(wall.thickness.lower)) return "none: no two sides of it are parallel";
  if (std::isinf(wall.thickness.upper))
    return fmt::format("none is known, at least {} {}", end_text(wall.thickness.lower, 0, false),
                       unit);
  return fmt::format("{} {}, {}\n    from    {} {}\n    to      {} {}", number_text(wall.thickness),
                     unit, bounds_text(wall.thickness), point_text(wall.from), unit,
                     point_text(wall.to), unit);
}

std::string report(const Measured& found, const MeasureRequest& request, std::string_view unit) {
  std::string text = found.name + "\n";
  const auto add_line = [&](std::string_view what, const std::string& value) {
    text += fmt::format("  {:<9} {}\n", what, value);
  };
  const auto add_number = [&](std::string_view what, const std::optional<Interval>& number,
                              const std::string& unit_of_number) {
    if (number) add_line(what, number_text(*number) + unit_of_number + ", " + bounds_text(*number));
  };
  if (found.bounds) add_line("bounds", box_text(*found.bounds, request.relative_width, unit));
  if (!found.fault.empty()) add_line("unknown", found.fault);
  add_number("volume", found.volume, fmt::format(" {}3", unit));
  add_number("area", found.area, fmt::format(" {}2", unit));
  add_number("mass", found.mass, found.mass_is_in_kg ? " kg" : "");
  if (found.centroid) add_line("centroid", centroid_text(*found.centroid, unit));
  if (found.inertia) add_line("inertia", "about the centroid" + inertia_text(*found.inertia));
  if (found.section) text += section_text(*found.section, unit);
  if (found.wall) add_line("thickness", wall_text(*found.wall, unit));
  return text;
}

// ---- the command ----------------------------------------------------------------------------

std::string report_of_all(const MeasureRequest& request, std::string_view unit,
                          const std::vector<Measured>& parts) {
  std::string text;
  for (const Measured& part : parts) text += report(part, request, unit);
  if (parts.size() != 1) text += report(sum_of(parts, request.density.has_value()), request, unit);
  return text;
}

/// Returns the line of the script that an entity is from, from 1 on.
std::size_t line_of(const std::string& text, const EntityPlace& place) {
  const std::size_t end = std::min<std::size_t>(place.origin.begin, text.size());
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
}

/// Throws Error for a request that makes no sense.
void check_section_output(const MeasureRequest& request) {
  if (request.output.empty()) return;
  if (!request.section)
    throw Error(ErrorCode::invalid_argument, "-o writes a section: say which by --section");
  check_section_name(request.output);
  check_writable(request.output);
}

/// Returns what the entities of a scene are called.
std::vector<std::string> names_of(const ScriptResult& result, const std::string& script) {
  std::vector<std::string> names;
  names.reserve(result.scene->entities.size());
  for (std::size_t place = 0; place < result.scene->entities.size(); ++place)
    names.push_back(
        fmt::format("entity {} (line {})", place, line_of(script, result.entity_places.at(place))));
  return names;
}

void measure(const MeasureRequest& request, Reporter& reporter) {
  check_section_output(request);
  const InterruptScope interrupt;
  const auto go_on = [&] { return !interrupt.interrupted(); };
  ScriptOptions script_options = request.script;
  script_options.go_on = go_on;
  const ScriptSource script(request.scene, request.script.limits);
  const ScriptResult result = run_scene(script, script_options, false, reporter);
  if (!result.scene) return;
  const MeasureOptions options{.relative_width = request.relative_width,
                               .seconds = request.seconds,
                               .threads = request.threads,
                               .go_on = go_on};
  const EntityMeasuring measuring(request, options, result.scene->settings.unit);
  const std::vector<Entity>& entities = result.scene->entities;
  const std::vector<std::string> names = names_of(result, script.text());
  const MeasuredPairs pairs = measure_pairs(request, entities, names, options);
  std::vector<Measured> parts;
  for (std::size_t i = 0; i < entities.size() && request.asks_for_entities(); ++i)
    parts.push_back(measuring.measure(entities[i], names[i]));
  if (!request.output.empty()) write_sections(request, result.scene->settings.unit, parts);
  const std::string_view unit = schema::script_name_of(result.scene->settings.unit);
  std::string text;
  if (request.json) {
    text = measures_json(request, script.name(), unit, parts, pairs) + "\n";
  } else {
    if (request.asks_for_entities()) text = report_of_all(request, unit, parts);
    text += pairs_text(pairs, names, unit);
  }
  reporter.print(text, Reporter::IfClosed::fails);
}

}  // namespace

ExitCode run_measure(const MeasureRequest& request) {
  Reporter reporter(request);
  try {
    measure(request, reporter);
  } catch (const Error& error) {
    reporter.add(error);
  }
  return reporter.finish();
}

}  // namespace crt::cli
