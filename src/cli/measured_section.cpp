#include "cli/measured_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <crt/error.hpp>

#include "cli/intervals.hpp"

namespace crt::cli {

Section find_section(const MeasureRequest& request, const Entity& entity,
                     const MeasureOptions& options) {
  double deviation = request.deviation;
  if (deviation == 0) {
    constexpr double share_of_size = 1e-4;
    const BoundingBox box = bounding_box(entity);
    const Vec3 size = box.upper - box.lower;
    deviation = share_of_size * std::max({size.x, size.y, size.z});
    // What has no size is refused or empty, whatever the deviation.
    if (!(deviation > 0 && std::isfinite(deviation))) deviation = share_of_size;
  }
  return section(entity, request.section->normal, request.section->offset, deviation, options);
}

std::string section_text(const Section& section, std::string_view unit) {
  std::string text;
  const auto add_line = [&](std::string_view what, const std::string& value) {
    text += fmt::format("  {:<9} {}\n", what, value);
  };
  if (section.empty() && section.area.upper == 0) {
    add_line("section", "none");
    return text;
  }
  add_line("section",
           fmt::format("{} {}2, {}", number_text(section.area), unit, bounds_text(section.area)));
  const double off = section.deviation;
  add_line("contours", std::isfinite(off)
                           ? fmt::format("{}, within {} {}", section.contours.size(),
                                         end_text(off, 100 * off, true), unit)
                           : fmt::format("{}, and there may be more", section.contours.size()));
  if (section.empty()) return text;
  const auto place = [&](const std::array<double, 2>& p) {
    return fmt::format("({}, {})", end_text(p[0], off, false), end_text(p[1], off, false));
  };
  add_line("drawn", fmt::format("{} to {} {}", place(section.lower), place(section.upper), unit));
  return text;
}

Section all_sections(const std::vector<Measured>& parts) {
  Section all;
  for (const Measured& part : parts) {
    if (!part.section) continue;
    const Section& one = *part.section;
    all.frame = one.frame;
    all.deviation = std::max(all.deviation, one.deviation);
    all.area = sum_of(all.area, one.area);
    if (one.empty()) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const bool is_first = all.contours.empty();
      all.lower[i] = is_first ? one.lower[i] : std::min(all.lower[i], one.lower[i]);
      all.upper[i] = is_first ? one.upper[i] : std::max(all.upper[i], one.upper[i]);
    }
    all.contours.insert(all.contours.end(), one.contours.begin(), one.contours.end());
  }
  return all;
}

void write_sections(const MeasureRequest& request, Unit unit, const std::vector<Measured>& parts) {
  const auto has_section = [](const Measured& part) { return part.section.has_value(); };
  if (std::ranges::none_of(parts, has_section))
    throw Error(ErrorCode::invalid_argument, "no entity of the scene has a section");
  write_section(request.output, all_sections(parts), {.unit = unit, .hatch = request.hatch});
}

}  // namespace crt::cli
