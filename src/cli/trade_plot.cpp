// The plot of `crt trade` shows seconds against each of the two errors, both logarithmic.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/trade_drawing.hpp"
#include "cli/trade_report.hpp"

namespace crt::cli {

namespace {

struct FamilyInk {
  Family family;
  Ink ink;
};
/// The script's own setting is drawn last, as it may be one of the others, too.
constexpr FamilyInk family_inks[] = {{Family::grid, "#1f5fa8"},
                                     {Family::target, "#c0392b"},
                                     {Family::depth, "#2e8b57"},
                                     {Family::precision, "#8e44ad"},
                                     {Family::as_given, "#1e1e1e"}};

/// A Panel shows one error against seconds.
class Panel {
 public:
  static constexpr double width = 390;
  static constexpr double height = 330;

  Panel(const TradeReport& report, double PictureError::*measure, const Place& corner,
        Drawing& drawing)
      : report_(report), measure_(measure), corner_(corner), drawing_(drawing) {
    std::vector<double> seconds;
    std::vector<double> errors = {report.uncertainty.*measure};
    for (const MeasuredRung& rung : report.rungs) {
      seconds.push_back(rung.seconds);
      errors.push_back(rung.error.*measure);
    }
    axes_ = {.left = corner.x + left,
             .top = corner.y + top,
             .right = corner.x + right,
             .bottom = corner.y + bottom,
             .across = decades_of(seconds),
             .up = decades_of(errors)};
  }

  void draw(const std::string& title) const {
    axes_.draw(drawing_, title, "seconds, whole picture", "error, steps of 8 bits", corner_.x + 14);
    draw_uncertainty();
    for (const FamilyInk& family : family_inks) draw_family(family);
    draw_best();
  }

 private:
  static constexpr double left = 58;
  static constexpr double top = 30;
  static constexpr double right = width - 12;
  static constexpr double bottom = height - 44;

  Place at(double seconds, double error) const { return axes_.at(seconds, error); }

  /// Errors below this line are those of the reference.
  void draw_uncertainty() const {
    const double y = at(0, report_.uncertainty.*measure_).y;
    constexpr double dash = 6;
    for (double x = left; x < right; x += 2 * dash) {
      drawing_.line({corner_.x + x, y}, {corner_.x + std::min(x + dash, right), y}, uncertain_ink,
                    1.5);
    }
  }

  void draw_family(const FamilyInk& family) const {
    constexpr double dot_radius = 3.5;
    std::vector<Place> places;
    for (const MeasuredRung& rung : report_.rungs) {
      if (rung.family == family.family) places.push_back(at(rung.seconds, rung.error.*measure_));
    }
    if (places.size() > 1) drawing_.curve(places, family.ink, 2);
    for (const Place& place : places) drawing_.disc(place, dot_radius, family.ink);
  }

  void draw_best() const {
    constexpr double ring_radius = 6.5;
    for (const std::size_t i : pareto_front(outcomes_of(report_, measure_))) {
      const MeasuredRung& rung = report_.rungs[i];
      drawing_.ring(at(rung.seconds, rung.error.*measure_), ring_radius, best_ink);
    }
  }

  const TradeReport& report_;
  double PictureError::*measure_;
  Place corner_;
  Drawing& drawing_;
  LogAxes axes_;
};

void draw_legend(const TradeReport& report, const Place& corner, Drawing& drawing) {
  constexpr double dot_radius = 3.5;
  constexpr double dot_to_text = 9;
  constexpr double letter = 6.2;
  constexpr double line_height = 18;
  double x = corner.x;
  double y = corner.y;
  const auto put = [&](const std::string& name, const auto& draw_sign) {
    draw_sign(Place{x, y - 4});
    drawing.text({x + dot_to_text, y}, name);
    x += dot_to_text + letter * static_cast<double>(name.size()) + 18;
  };
  for (const FamilyInk& family : family_inks) {
    const bool is_there =
        std::any_of(report.rungs.begin(), report.rungs.end(),
                    [&](const MeasuredRung& rung) { return rung.family == family.family; });
    if (!is_there) continue;
    put(name_of(family.family),
        [&](const Place& place) { drawing.disc(place, dot_radius, family.ink); });
  }
  x = corner.x;
  y += line_height;
  put("nothing is faster and better",
      [&](const Place& place) { drawing.ring(place, 5, best_ink); });
  put("error of the reference itself: below twice this all count as equal",
      [&](const Place& place) {
        drawing.line({place.x - 5, place.y}, {place.x + 5, place.y}, uncertain_ink, 1.5);
      });
}

}  // namespace

std::string report_plot(const TradeReport& report) {
  constexpr double legend_height = 44;
  Drawing drawing(2 * Panel::width, Panel::height + legend_height);
  const std::string scene = std::filesystem::path(report.scene).filename().string();
  const std::string size = fmt::format("{}, {} x {}", scene, report.width, report.height);
  Panel(report, &PictureError::rmse, {0, 0}, drawing).draw(size + ": RMSE");
  Panel(report, &PictureError::p999, {Panel::width, 0}, drawing)
      .draw(size + ": 99.9 % of the pixels");
  draw_legend(report, {58, Panel::height + 10}, drawing);
  return drawing.svg();
}

}  // namespace crt::cli
