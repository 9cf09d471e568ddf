#include "oracle/accuracy_plot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace crt::test {
namespace {

constexpr double panel_width = 250;
constexpr double panel_height = 170;
constexpr double left = 46;
constexpr double top = 28;
constexpr double plot_width = panel_width - left - 20;
constexpr double plot_height = panel_height - top - 34;
constexpr std::size_t columns = 3;
constexpr double lowest_power = -1;  // of ten, in ulps
constexpr double highest_power = 17;
constexpr std::array colors = {"#1f5fa8", "#2e8b57", "#c0392b"};
constexpr std::array dashes = {"none", "4 3", "none"};

double x_of(double decade) {
  return left + plot_width * (decade - lowest_decade) / (highest_decade + 1 - lowest_decade);
}
double y_of(double ulps) {
  const double power = std::clamp(std::log10(std::max(ulps, 1e-9)), lowest_power, highest_power);
  return top + plot_height * (highest_power - power) / (highest_power - lowest_power);
}

std::string line(const Record& record, const char* color, const char* dash) {
  std::string points;
  for (int decade = lowest_decade; decade <= highest_decade; ++decade) {
    const Histogram& ulps = record.ulps_by_decade[static_cast<std::size_t>(decade - lowest_decade)];
    if (ulps.count() == 0) continue;
    points += fmt::format("{:.1f},{:.1f} ", x_of(decade + 0.5), y_of(ulps.quantile(0.999)));
  }
  return fmt::format(
      "<polyline points='{}' fill='none' stroke='{}' stroke-width='2' stroke-dasharray='{}'/>\n",
      points, color, dash);
}

std::string panel(const Measured& measured) {
  std::string result = fmt::format("<text x='{}' y='{}' font-weight='bold'>{}</text>\n", left,
                                   top - 8, name_of_primitive(measured.kind));
  for (int power = 0; power <= 16; power += 4) {
    const double y = y_of(std::pow(10.0, power));
    result += fmt::format("<line x1='{}' x2='{}' y1='{y:.1f}' y2='{y:.1f}' stroke='#ddd'/>\n", left,
                          left + plot_width, fmt::arg("y", y));
    result += fmt::format("<text x='{}' y='{:.1f}' text-anchor='end'>10^{}</text>\n", left - 4,
                          y + 4, power);
  }
  for (int decade = lowest_decade; decade <= highest_decade + 1; decade += 3) {
    result += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>10^{}</text>\n",
                          x_of(decade), top + plot_height + 16, decade);
  }
  result += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#888'/>\n",
                        left, top, plot_width, plot_height);
  for (std::size_t i = 0; i < measured.tiers.size(); ++i)
    result += line(measured.tiers[i].record, colors[i], dashes[i]);
  return result;
}

}  // namespace

std::string accuracy_plot(const std::vector<Measured>& all) {
  const double rows = std::ceil(static_cast<double>(all.size()) / columns);
  const double width = panel_width * columns;
  const double height = panel_height * rows + 30;
  std::string result = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {} {}' font-family='sans-serif' "
      "font-size='11'>\n"
      "<rect width='100%' height='100%' fill='white'/>\n",
      width, height);
  for (std::size_t i = 0; i < all.size(); ++i) {
    result += fmt::format("<g transform='translate({} {})'>\n{}</g>\n",
                          panel_width * static_cast<double>(i % columns),
                          panel_height * static_cast<double>(i / columns), panel(all[i]));
  }
  result += fmt::format(
      "<text x='{}' y='{}'>ulps of t, 99.9 % of plain rays, against the distance in sizes:", left,
      height - 12);
  for (std::size_t i = 0; i < colors.size() && !all.empty(); ++i) {
    result += fmt::format(" <tspan fill='{}' font-weight='bold'>{}</tspan>", colors[i],
                          all[0].tiers[i].name);
  }
  result += "</text>\n</svg>\n";
  return result;
}

}  // namespace crt::test
