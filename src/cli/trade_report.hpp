// `crt trade` reports its measurements as a table to read, one for programs and a plot, and says
// which setting to take.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/trade_ladder.hpp"
#include "cli/trade_measure.hpp"

namespace crt::cli {

/// A MeasuredRung is a rung as it was rendered.
struct MeasuredRung {
  Family family = Family::as_given;
  std::string options;
  double seconds = 0;  ///< of tracing the whole picture
  double samples = 0;  ///< a pixel, on average
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
  // These are about the reference.
  PictureError uncertainty;  ///< of every error that is reported
  double reference_samples = 0;
  int reference_most_samples = 0;
  int reference_depth = 0;
  double reference_cutoff =
      0;  ///< the bound on what even the reference cuts off, in 8-bit steps: mean of pixels
};

/// Returns time and error of each rung. Errors below twice the reference's uncertainty count as
/// that, as they cannot be distinguished.
std::vector<Outcome> outcomes_of(const TradeReport& report, double PictureError::*measure);

/// A TradeQuestion is what the user asks.
struct TradeQuestion {
  std::optional<double> seconds;
  std::optional<double> error;
};

/// Returns a text: how the reference was made, all rungs with a mark at those that no other beats,
/// and the answers.
std::string report_text(const TradeReport& report, const TradeQuestion& question);

/// Returns a line for each rung, after one of names.
std::string report_csv(const TradeReport& report);

/// Returns a plot of seconds against both errors, as an SVG file has it.
std::string report_plot(const TradeReport& report);

}  // namespace crt::cli
