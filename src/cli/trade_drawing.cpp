#include "cli/trade_drawing.hpp"

#include <fmt/format.h>
#include <crt/elementary.hpp>

#include <algorithm>
#include <cmath>

namespace crt::cli {

namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace

Drawing::Drawing(double width, double height) {
  constexpr double font_size = 11;
  svg_ = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' viewBox='0 0 {0} {1}' "
      "font-family='sans-serif' font-size='{2}'>\n<rect width='100%' height='100%' "
      "fill='white'/>\n",
      width, height, font_size);
}

void Drawing::curve(const std::vector<Place>& places, Ink ink, double width) {
  std::string corners;
  for (const Place& place : places) corners += fmt::format(" {:.1f},{:.1f}", place.x, place.y);
  svg_ += fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='{}'/>\n",
                      corners.substr(1), ink, width);
}

void Drawing::disc(const Place& center, double radius, Ink ink) {
  svg_ += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{}' fill='{}'/>\n", center.x, center.y,
                      radius, ink);
}

void Drawing::ring(const Place& center, double radius, Ink ink) {
  svg_ += fmt::format(
      "<circle cx='{:.1f}' cy='{:.1f}' r='{}' fill='none' stroke='{}' stroke-width='1.2'/>\n",
      center.x, center.y, radius, ink);
}

void Drawing::text(const Place& place, const std::string& text, std::string_view anchor,
                   bool upwards) {
  const std::string turn =
      upwards ? fmt::format(" transform='rotate(-90 {:.1f} {:.1f})'", place.x, place.y) : "";
  svg_ += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' fill='{}'{}>{}</text>\n",
                      place.x, place.y, anchor, text_ink, turn, escaped(text));
}

double Decades::share(double value) const {
  const double least = elementary::pow(10.0, low);
  return (elementary::log10(std::max(value, least)) - low) / (high - low);
}

Decades decades_of(const std::vector<double>& values, double least) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  Decades decades;
  decades.low = static_cast<int>(std::floor(elementary::log10(std::max(*low, least))));
  decades.high = std::max(static_cast<int>(std::ceil(elementary::log10(std::max(*high, least)))),
                          decades.low + 1);
  return decades;
}

void LogAxes::draw(Drawing& drawing, const std::string& above, const std::string& name_across,
                   const std::string& name_up, double name_x) const {
  constexpr double text_below = 16;
  const auto power_of_ten = [](int exponent) {
    return fmt::format("{:g}", elementary::pow(10.0, exponent));
  };
  drawing.text({left, top - 12}, above);
  for (int power = across.low; power <= across.high; ++power) {
    const Place foot = at(elementary::pow(10.0, power), 0);
    drawing.line(foot, {foot.x, top}, grid_ink);
    drawing.text({foot.x, foot.y + text_below}, power_of_ten(power), "middle");
  }
  for (int power = up.low; power <= up.high; ++power) {
    const Place foot = at(0, elementary::pow(10.0, power));
    drawing.line(foot, {right, foot.y}, grid_ink);
    drawing.text({foot.x - 6, foot.y + 4}, power_of_ten(power), "end");
  }
  drawing.curve({{left, top}, {right, top}, {right, bottom}, {left, bottom}, {left, top}},
                frame_ink, 1);
  drawing.text({(left + right) / 2, bottom + 34}, name_across, "middle");
  drawing.text({name_x, (top + bottom) / 2}, name_up, "middle", true);
}

}  // namespace crt::cli
