// What `crt trade` tells of its measurements: a table to read, one for programs, a plot, and which
// setting to take.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/drawing.hpp"
#include "cli/trade_ladder.hpp"
#include "cli/trade_measure.hpp"

namespace crt::cli {

/// A rung as it was rendered.
struct MeasuredRung {
  Family family = Family::as_given;
  std::string options;
  double seconds = 0;  ///< of tracing the whole picture
  double samples = 0;  ///< a pixel, in the mean
  PictureError error;
};

struct TradeReport {
  std::string scene;
  int width = 0;
  int height = 0;
  std::size_t measured_pixels = 0;
  std::size_t parts = 0;
  int threads = 0;
  std::vector<MeasuredRung> rungs;
  std::vector<std::string> left_out;  ///< options of rungs that would have taken too long
  // Of the reference.
  PictureError uncertainty;  ///< of every error that is told
  double reference_samples = 0;
  int reference_most_samples = 0;
  int reference_depth = 0;
  double reference_cutoff =
      0;  ///< the bound on what even the reference cuts off, in 8-bit steps: mean of pixels
};

/// Time and error of each rung. Errors below twice the reference's uncertainty count as that:
/// nobody can tell them apart.
std::vector<Outcome> outcomes_of(const TradeReport& report, double PictureError::*measure);

/// What the user wants to know.
struct TradeQuestion {
  std::optional<double> seconds;
  std::optional<double> error;
};

/// How the reference was made, all rungs with a mark at those that no other beats, and the answers.
std::string report_text(const TradeReport& report, const TradeQuestion& question);

/// A line for each rung, after one of names.
std::string report_csv(const TradeReport& report);

/// Seconds against both errors.
Drawing report_plot(const TradeReport& report);

}  // namespace crt::cli
