#include "cli/trade_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace crt::cli {

namespace {

bool is_among(const std::vector<std::size_t>& places, std::size_t place) {
  return std::find(places.begin(), places.end(), place) != places.end();
}

std::string shown_options(const MeasuredRung& rung) {
  return rung.options.empty() ? "(as the script says)" : rung.options;
}

std::string text_of_reference(const TradeReport& report) {
  std::string text = fmt::format(
      "Measured: {} of {} pixels, {}, on {} thread{}; seconds are those of tracing the whole "
      "picture.\n",
      report.measured_pixels, std::size_t(report.width) * std::size_t(report.height),
      report.parts == 1 ? "in one piece" : fmt::format("in {} bands", report.parts), report.threads,
      report.threads == 1 ? "" : "s");
  text += fmt::format(
      "Reference: the mean of two renders with other seeds, exact, {:.0f} samples a pixel in the "
      "mean and up "
      "to {}, "
      "recursion depth {}.\n",
      report.reference_samples, report.reference_most_samples, report.reference_depth);
  text += fmt::format(
      "They differ so much that the reference is uncertain by {:.3f} (RMSE) and {:.2f} (99.9 %) "
      "steps of 8 "
      "bits;\n"
      "errors below twice that count as equal.\n",
      report.uncertainty.rmse, report.uncertainty.p999);
  if (report.reference_cutoff > 0) {
    text += fmt::format(
        "Even its cut-off paths may have brought some light: at most {:.2g} steps in the mean of "
        "the "
        "pixels.\n",
        report.reference_cutoff);
  }
  return text;
}

/// Returns a line such as "RMSE: ..., 0.42 steps in 3.1 s".
std::string text_of_choice(const TradeReport& report, const char* name,
                           double PictureError::*measure, const std::optional<std::size_t>& choice,
                           const std::string& if_none) {
  if (!choice) return fmt::format("  {}: {}\n", name, if_none);
  const MeasuredRung& rung = report.rungs[*choice];
  return fmt::format("  {}: {}   ({:.3g} steps in {:.3g} s)\n", name, shown_options(rung),
                     rung.error.*measure, rung.seconds);
}

struct Measure {
  const char* name;
  double PictureError::*value;
};
constexpr Measure measures[] = {{"RMSE", &PictureError::rmse}, {"99.9 %", &PictureError::p999}};

std::string text_of_answers(const TradeReport& report, const TradeQuestion& question) {
  std::string text;
  if (question.seconds) {
    text += fmt::format("\nThe most accurate within {} s:\n", *question.seconds);
    for (const Measure& measure : measures) {
      text +=
          text_of_choice(report, measure.name, measure.value,
                         best_within_seconds(outcomes_of(report, measure.value), *question.seconds),
                         "nothing that was tried is so fast");
    }
  }
  if (question.error) {
    text += fmt::format("\nThe fastest within {} steps of 8 bits:\n", *question.error);
    for (const Measure& measure : measures) {
      text +=
          text_of_choice(report, measure.name, measure.value,
                         fastest_within_error(outcomes_of(report, measure.value), *question.error),
                         *question.error < 2 * report.uncertainty.*measure.value
                             ? "the reference is not certain enough to tell"
                             : "nothing that was tried is so accurate");
    }
  }
  return text;
}

/// Returns a field of a CSV file (RFC 4180).
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

}  // namespace

std::vector<Outcome> outcomes_of(const TradeReport& report, double PictureError::*measure) {
  const double least = 2 * report.uncertainty.*measure;
  std::vector<Outcome> outcomes;
  for (const MeasuredRung& rung : report.rungs) {
    outcomes.push_back({rung.seconds, std::max(rung.error.*measure, least)});
  }
  return outcomes;
}

std::string report_text(const TradeReport& report, const TradeQuestion& question) {
  const auto best = pareto_front(outcomes_of(report, &PictureError::rmse));
  const auto best_999 = pareto_front(outcomes_of(report, &PictureError::p999));
  std::string text = text_of_reference(report);
  text += fmt::format("\n{:>9} {:>8} {:>8} {:>9}   {}\n", "seconds", "RMSE", "99.9 %", "samples",
                      "options of crt render ('*': nothing else is faster and better)");
  for (std::size_t i = 0; i < report.rungs.size(); ++i) {
    const MeasuredRung& rung = report.rungs[i];
    text += fmt::format("{:9.3f} {:7.3f}{} {:7.2f}{} {:9.1f}   {}\n", rung.seconds, rung.error.rmse,
                        is_among(best, i) ? '*' : ' ', rung.error.p999,
                        is_among(best_999, i) ? '*' : ' ', rung.samples, shown_options(rung));
  }
  for (const std::string& options : report.left_out) {
    text += fmt::format("{:>9} {:>8} {:>8} {:>9}   {} (would take too long)\n", "-", "-", "-", "-",
                        options);
  }
  return text + text_of_answers(report, question);
}

std::string report_csv(const TradeReport& report) {
  const auto best = pareto_front(outcomes_of(report, &PictureError::rmse));
  const auto best_999 = pareto_front(outcomes_of(report, &PictureError::p999));
  std::string csv =
      "family,options,seconds,rmse,p999,samples,best_by_rmse,best_by_p999,rmse_uncertainty,p999_"
      "uncertainty\n";
  for (std::size_t i = 0; i < report.rungs.size(); ++i) {
    const MeasuredRung& rung = report.rungs[i];
    csv += fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:d},{:d},{:.6g},{:.6g}\n",
                       quoted(name_of(rung.family)), quoted(rung.options), rung.seconds,
                       rung.error.rmse, rung.error.p999, rung.samples, is_among(best, i),
                       is_among(best_999, i), report.uncertainty.rmse, report.uncertainty.p999);
  }
  return csv;
}

}  // namespace crt::cli
