// These tests check what `crt trade` reports: texts, tables and plots.
#include "cli/trade_report.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace crt;
using namespace crt::cli;

namespace {

TradeReport small_report() {
  TradeReport report;
  report.scene = "folder/scene <1>.crt";
  report.width = 640;
  report.height = 480;
  report.measured_pixels = 30720;
  report.parts = 2;
  report.threads = 2;
  report.rungs = {
      {Family::as_given, "", 0.5, 1, {8, 90}},
      {Family::grid, "--supersampling 1", 0.5, 1, {8.5, 90}},
      {Family::grid, "--supersampling 4", 6, 16, {2, 30}},
      {Family::target, "--targeterror 0.003922", 3, 20, {0.4, 2}},
  };
  report.left_out = {"--supersampling 16"};
  report.uncertainty = {0.02, 0.3};
  report.reference_samples = 700;
  report.reference_most_samples = 8192;
  report.reference_depth = 32;
  return report;
}

std::size_t count_of(const std::string& text, const std::string& piece) {
  std::size_t count = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1))
    ++count;
  return count;
}

bool holds(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

}  // namespace

TEST_CASE("the text says how the reference was made and how far it can be trusted") {
  const std::string text = report_text(small_report(), {});
  for (const char* piece :
       {"700", "8192", "0.020", "0.30", "30720", "2 bands", "recursion depth 32"}) {
    CAPTURE(piece);
    CHECK(holds(text, piece));
  }
  CHECK(holds(text, "--supersampling 16 (would take too long)"));
  CHECK_FALSE(holds(text, "The most accurate"));
}

TEST_CASE("the text answers what was asked, and says so where nothing is good enough") {
  const std::string fitting = report_text(small_report(), {.seconds = 4.0, .error = 0.5});
  CHECK(holds(fitting, "The most accurate within 4 s:\n  RMSE: --targeterror 0.003922"));
  CHECK(holds(fitting, "The fastest within 0.5 steps of 8 bits:\n  RMSE: --targeterror 0.003922"));
  CHECK(holds(fitting, "99.9 %: the reference is not certain enough to tell"));
  CHECK(holds(report_text(small_report(), {.seconds = {}, .error = 1.5}),
              "99.9 %: nothing that was tried is so accurate"));
  CHECK(holds(report_text(small_report(), {.seconds = 0.1, .error = {}}),
              "nothing that was tried is so fast"));
}

TEST_CASE("errors that the reference cannot distinguish count as equal: the fastest is the best") {
  TradeReport report = small_report();
  report.rungs.push_back({Family::target, "--targeterror 0.000001", 300, 900, {0.03, 0.1}});
  report.rungs.push_back({Family::target, "--targeterror 0.000002", 200, 800, {0.035, 0.1}});
  CHECK(
      holds(report_text(report, {.seconds = 1000.0, .error = {}}), "RMSE: --targeterror 0.000002"));
}

TEST_CASE("the table for programs has a line a rung, with marks at the best") {
  const std::string csv = report_csv(small_report());
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 5);
  CHECK(csv.starts_with("family,options,seconds,rmse,p999,samples,best_by_rmse,"));
  CHECK(holds(csv, "\"grid\",\"--supersampling 4\",6,2,30,16,0,0,0.02,0.3\n"));
  CHECK(holds(csv, "\"target error\",\"--targeterror 0.003922\",3,0.4,2,20,1,1,"));
}

TEST_CASE("the plot has a dot for each rung in both halves, and its names are well-formed") {
  const TradeReport report = small_report();
  const std::string svg = report_plot(report);
  CHECK(svg.starts_with("<svg "));
  CHECK(svg.ends_with("</svg>\n"));
  CHECK(holds(svg, "scene &lt;1&gt;.crt"));
  const std::size_t kinds_in_legend = 3;
  CHECK(count_of(svg, "r='3.5'") == 2 * report.rungs.size() + kinds_in_legend);
}

TEST_CASE("a plot of few, equal or perfect measurements is still one") {
  TradeReport report = small_report();
  report.rungs.resize(1);
  report.rungs[0].seconds = 0;
  report.rungs[0].error = {};
  report.uncertainty = {};
  for (const std::string& text :
       {report_plot(report), report_text(report, {}), report_csv(report)}) {
    CHECK_FALSE(holds(text, "nan"));
    CHECK_FALSE(holds(text, "inf"));
  }
}
