// Sections, as `crt measure --section` finds, prints and writes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/measured.hpp"

namespace crt::cli {

/// Finds the section of an entity that was asked for.
Section find_section(const MeasureRequest& request, const Entity& entity,
                     const MeasureOptions& options);
/// Returns the lines of a report.
std::string section_text(const Section& section, std::string_view unit);
/// Returns one drawing of the sections of all. Those that overlap are drawn each.
Section all_sections(const std::vector<Measured>& parts);
/// Throws Error as write_section() does, or if there is no section to write.
void write_sections(const MeasureRequest& request, Unit unit, const std::vector<Measured>& parts);

}  // namespace crt::cli
