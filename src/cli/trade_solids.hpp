// `crt trade --measure` shows what time narrower bounds of a measure take.
#pragma once

#include <filesystem>
#include <string>

#include "cli/options.hpp"

namespace crt::cli {

class Reporter;

struct SolidMeasureName {
  SolidMeasure measure;
  std::string_view name;
};
inline constexpr SolidMeasureName solid_measure_names[] = {
    {SolidMeasure::volume, "volume"}, {SolidMeasure::area, "area"}, {SolidMeasure::mass, "mass"}};
std::string name_of(SolidMeasure measure);

/// Measures the solids of a scene together, to ever narrower widths, and writes `name` with .csv
/// and .svg. Throws Error.
void trade_solids(const TradeRequest& request, const std::filesystem::path& name,
                  Reporter& reporter);

}  // namespace crt::cli
