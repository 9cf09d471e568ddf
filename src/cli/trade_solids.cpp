// `crt trade --measure` shows what time narrower bounds of a measure take.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <crt/file.hpp>
#include <crt/measure.hpp>
#include <filesystem>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/picture_renderer.hpp"
#include "cli/reporter.hpp"
#include "cli/script_source.hpp"
#include "cli/trade_drawing.hpp"
#include "cli/trade_solids.hpp"

namespace crt::cli {

namespace {

/// A WidthRung is a width that was asked for, and what came of it.
struct WidthRung {
  double asked = 0;
  double reached = 0;  ///< the sum of the widths over that of the numbers
  double seconds = 0;
  Interval sum;
};

Interval measure_of(SolidMeasure measure, const Entity& entity, const MeasureOptions& options) {
  switch (measure) {
    case SolidMeasure::volume:
      return volume(entity, options);
    case SolidMeasure::area:
      return surface_area(entity, options);
    case SolidMeasure::mass:
      return mass_properties(entity, options).volume;
  }
  return {};
}

/// Measures all solids to a relative width.
WidthRung measured_to(double asked, SolidMeasure measure, const std::vector<Entity>& solids,
                      MeasureOptions options) {
  WidthRung rung{.asked = asked, .reached = 0, .seconds = 0, .sum = {}};
  options.relative_width = asked;
  const auto start = std::chrono::steady_clock::now();
  for (const Entity& solid : solids) {
    const Interval number = measure_of(measure, solid, options);
    rung.sum.lower += number.lower;
    rung.sum.upper += number.upper;
  }
  rung.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  rung.reached = rung.sum.width() / rung.sum.middle();
  return rung;
}

std::string table_of(const std::vector<WidthRung>& rungs) {
  std::string text =
      fmt::format("{:>9} {:>12} {:>10}   {}\n", "seconds", "width asked", "reached", "between");
  for (const WidthRung& rung : rungs) {
    text += fmt::format("{:9.3f} {:12.0e} {:10.1e}   {:.12g} and {:.12g}\n", rung.seconds,
                        rung.asked, rung.reached, rung.sum.lower, rung.sum.upper);
  }
  return text;
}

std::string rungs_csv(const std::vector<WidthRung>& rungs) {
  std::string csv = "relative_width,reached,seconds,lower,upper\n";
  for (const WidthRung& rung : rungs) {
    csv += fmt::format("{:.6g},{:.6g},{:.6g},{:.17g},{:.17g}\n", rung.asked, rung.reached,
                       rung.seconds, rung.sum.lower, rung.sum.upper);
  }
  return csv;
}

std::string rungs_plot(const std::vector<WidthRung>& rungs, const std::string& title) {
  constexpr double width = 480;
  constexpr double height = 330;
  constexpr double least_width = 1e-15;
  constexpr Ink ink = "#1f5fa8";
  std::vector<double> seconds;
  std::vector<double> widths;
  seconds.reserve(rungs.size());
  widths.reserve(rungs.size());
  for (const WidthRung& rung : rungs) {
    seconds.push_back(rung.seconds);
    widths.push_back(rung.reached);
  }
  const LogAxes axes{.left = 64,
                     .top = 34,
                     .right = width - 16,
                     .bottom = height - 46,
                     .across = decades_of(seconds),
                     .up = decades_of(widths, least_width)};
  Drawing drawing(width, height);
  axes.draw(drawing, title, "seconds", "width of the interval, relative", 14);
  std::vector<Place> places;
  places.reserve(rungs.size());
  for (const WidthRung& rung : rungs) places.push_back(axes.at(rung.seconds, rung.reached));
  drawing.curve(places, ink, 2);
  constexpr double dot_radius = 3.5;
  for (const Place& place : places) drawing.disc(place, dot_radius, ink);
  return drawing.svg();
}

/// Returns the solids of a scene that have bounds.
std::vector<Entity> solids_of(const Scene& scene) {
  std::vector<Entity> solids;
  for (const Entity& entity : scene.entities) {
    if (!entity.is_solid()) continue;
    const BoundingBox box = bounding_box(entity);
    const Vec3 size = box.upper - box.lower;
    if (std::isfinite(size.x) && std::isfinite(size.y) && std::isfinite(size.z))
      solids.push_back(entity);
  }
  return solids;
}

}  // namespace

void trade_solids(const TradeRequest& request, const std::filesystem::path& name,
                  Reporter& reporter) {
  const ScriptSource script(request.scene, request.script.limits);
  const ScriptResult result = run_scene(script, request.script, false, reporter);
  if (!result.scene) return;
  const std::vector<Entity> solids = solids_of(*result.scene);
  if (solids.empty())
    throw Error(ErrorCode::invalid_argument, "the scene has no solid with an end to measure");
  const InterruptScope interrupt;
  const MeasureOptions options{.seconds = request.max_seconds,
                               .threads = request.threads,
                               .go_on = [&] { return !interrupt.interrupted(); }};
  std::vector<WidthRung> rungs;
  constexpr double narrowest = 1e-12;
  for (double asked = 0.1; asked > 0.5 * narrowest; asked *= 0.1) {
    rungs.push_back(measured_to(asked, *request.measure, solids, options));
    const WidthRung& last = rungs.back();
    // The next takes longer, and would end with what is known by then.
    if (last.reached > 2 * asked || last.seconds > 0.5 * request.max_seconds) break;
  }
  if (!(rungs.front().sum.upper > 0 && std::isfinite(rungs.front().reached))) {
    throw Error(ErrorCode::limit,
                "nothing is known of it within the seconds: give it more by --most-seconds");
  }
  std::erase_if(rungs, [](const WidthRung& rung) { return !std::isfinite(rung.reached); });
  if (!request.quiet) reporter.print(table_of(rungs));
  const auto with_ending = [&](const char* ending) {
    std::filesystem::path path = name;
    path += ending;
    return path;
  };
  const std::string title =
      fmt::format("{}: {}", request.scene.filename().string(), name_of(*request.measure));
  write_file(with_ending(".csv"), rungs_csv(rungs));
  write_file(with_ending(".svg"), rungs_plot(rungs, title));
  reporter.note(fmt::format("{}: the table; {}: the plot", with_ending(".csv").string(),
                            with_ending(".svg").string()));
}

std::string name_of(SolidMeasure measure) {
  for (const SolidMeasureName& known : solid_measure_names)
    if (known.measure == measure) return std::string(known.name);
  return "";
}

}  // namespace crt::cli
