// The options of `crt trade`.
#include <fmt/format.h>

#include <CLI/App.hpp>

#include "cli/option_groups.hpp"

namespace crt::cli {

namespace {

constexpr const char* trade_footer =
    R"(Renders the scene with a ladder of settings (supersampling 1 to 16, target errors, recursion depths, exact
precision), compares each with a reference that is far more accurate, and writes a table (.csv) and a plot (.svg) of
seconds against the error: its root mean square, and what 99.9 % of the pixels stay below, in steps of an 8-bit
picture. By default it measures bands of the picture with about 30000 pixels together; all seconds are those that
the whole picture would take.

Examples:
  crt trade scene.crt                           scene-trade.csv and scene-trade.svg
  crt trade scene.crt --budget 10               and the most accurate setting for 10 seconds a picture
  crt trade scene.crt --error 0.5 --png         and the fastest within half a step; the plot also as .png
  crt trade film.crt --time 12 --region 100,80,200,100 -o part)";

void add_positive(CLI::App& command, const std::string& name, const std::string& help, const char* type,
                  const std::function<void(double)>& take) {
  command
      .add_option_function<std::string>(
          name,
          [name, take](const std::string& text) {
            double value = 0;
            if (!parse_finite(text, value) || value <= 0) throw wrong_value(name, "a number above 0", text);
            take(value);
          },
          help)
      ->type_name(type);
}

}  // namespace

void add_trade_options(CLI::App& command, TradeRequest& request) {
  command.footer(trade_footer);
  command.add_option("scene", request.scene, "the script")->required()->type_name("SCENE.crt");
  command
      .add_option("-o,--output", request.output,
                  "what is written, without the endings (default: the script's name and -trade)")
      ->type_name("NAME");
  add_script_options(command, request);
  add_positive(command, "--budget", "asks for the most accurate setting within so many seconds a picture",
               "SECONDS", [&](double value) { request.budget = value; });
  add_positive(command, "--error", "asks for the fastest setting within so many 8-bit steps", "STEPS",
               [&](double value) { request.error = value; });
  command.add_flag("--png", request.png, "writes the plot as a picture, too");
  add_region(command, request.region, "measures only this part of the picture");
  add_positive(command, "--pixels", fmt::format("measures about so many pixels ({:.0f})", request.pixels),
               "N", [&](double value) { request.pixels = value; });
  add_positive(
      command, "--most-seconds",
      fmt::format("leaves out settings that would take longer for these pixels, and ends each of the two "
                  "reference renders then ({:.0f})",
                  request.most_seconds),
      "SECONDS", [&](double value) { request.most_seconds = value; });
  command
      .add_option_function<std::string>(
          "--reference-samples",
          [&request](const std::string& text) {
            constexpr int most = 65536;
            int& samples = request.reference_samples;
            const bool fine = parse_whole(text, samples) && samples >= 4 && samples <= most;
            if (!fine || (samples & (samples - 1)) != 0) {
              throw wrong_value("--reference-samples", "a power of 2 from 4 to 65536", text);
            }
          },
          fmt::format("samples of a pixel of the references at most ({})", request.reference_samples))
      ->type_name("N");
  add_threads(command, request.threads);
  add_settings(command, request.script);
}

}  // namespace crt::cli
