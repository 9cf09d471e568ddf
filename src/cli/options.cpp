#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <crt/version.hpp>
#include <cstdio>
#include <string_view>
#include <utility>

#include "cli/console.hpp"
#include "cli/option_groups.hpp"

namespace crt::cli {

namespace {

constexpr std::string_view main_footer = R"(Examples:
  crt render scene.crt                       renders scene.png beside the script
  crt render scene.crt -o big.png --width 1920 --height 1080 --supersampling 4
  crt render scene.crt --set n=18 --set 'tint=rgb(1, 0, 0)'
                                             sets variables of the script from outside
  crt render film.crt --frames 0-99 -o 'film_###.png'
                                             a picture for each t from 0 to 99
  crt trade scene.crt --budget 10            tells which settings give most for ten seconds
  crt check scene.crt                        tells what is wrong with a script, renders nothing

'crt render --help' lists all options. Every setting of a script is an option, too.

Ends with 0: all done; 1: the script is wrong; 2: the command line is wrong; 3: a file could not be
read or written; 70: a bug in crt, or no memory left; 130: interrupted.)";

constexpr std::string_view render_footer =
    R"(The ending of the picture's name says its format: .png, .tif, .jpg and others (8 bits, gamma applied),
.exr and .hdr (linear light). Nothing is left behind under its name unless it is whole.
An .exr file also holds what --aov asks for: depth (channel Z), normal (N.X, N.Y, N.Z), id, albedo, and of each
pixel how many samples it has (samples) and how far it may be from the truth (error).

Examples:
  crt render scene.crt -o draft.png --width 320 --height 240
  crt render scene.crt -o corner.png --region 0,0,64,64     only that part of the picture
  crt render film.crt --frames 1-48                         film_0001.png to film_0048.png
  crt render scene.crt -o scene.exr --aov depth,id          distances and objects beside the colours
  crt render scene.crt --stats -                            what it took, as JSON)";

FrameRange parse_frames(const std::string& text) {
  FrameRange frames;
  const std::size_t dash = text.find('-');
  const std::string_view view = text;
  const bool fine = dash == std::string::npos
                        ? parse_whole(view, frames.first) && parse_whole(view, frames.last)
                        : parse_whole(view.substr(0, dash), frames.first) &&
                              parse_whole(view.substr(dash + 1), frames.last);
  if (!fine || frames.first < 0 || frames.last < frames.first) {
    throw wrong_value("--frames", "FIRST-LAST, such as 0-99", text);
  }
  return frames;
}

struct AovName {
  std::string_view name;
  bool Aovs::*asked;
};

constexpr AovName aov_names[] = {
    {"depth", &Aovs::depth},   {"normal", &Aovs::normal},   {"id", &Aovs::id},
    {"albedo", &Aovs::albedo}, {"samples", &Aovs::samples}, {"error", &Aovs::error},
};

std::string all_aov_names() {
  std::string names;
  for (const AovName& aov : aov_names) names += fmt::format("{}{}", names.empty() ? "" : ",", aov.name);
  return names;
}

/// Adds those of a list to what is asked for.
void take_aovs(const std::string& list, Aovs& aovs) {
  std::string_view rest = list;
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string_view name = rest.substr(0, comma);
    const auto* const found = std::find_if(std::begin(aov_names), std::end(aov_names),
                                           [&](const AovName& aov) { return aov.name == name; });
    if (found == std::end(aov_names)) {
      throw wrong_value("--aov", fmt::format("one or several of {}", all_aov_names()), list);
    }
    aovs.*(found->asked) = true;
    if (comma == std::string_view::npos) return;
    rest.remove_prefix(comma + 1);
  }
}

void add_render_options(CLI::App& command, RenderRequest& request) {
  command.add_option("scene", request.scene, "the script")->required()->type_name("SCENE.crt");
  command
      .add_option("-o,--output", request.output,
                  "the picture (default: the script's name, ending in .png, with --aov in .exr)")
      ->type_name("FILE");
  add_script_options(command, request);
  CLI::Option* frames =
      command
          .add_option_function<std::string>(
              "--frames", [&request](const std::string& text) { request.frames = parse_frames(text); },
              "renders a picture for each whole t in the range; ### in the output's name is the number")
          ->type_name("A-B");
  frames->excludes(command.get_option("--time"));
  add_region(command, request.render.region, "renders only this part, as a picture of its size");
  add_threads(command, request.render.threads);
  command
      .add_option_function<std::string>(
          "--passes",
          [&request](const std::string& value) {
            if (!parse_whole(value, request.render.passes) || request.render.passes < 0) {
              throw wrong_value("--passes", "a whole number, 0 for as many as it takes", value);
            }
          },
          "stops after so many passes: with what --stats told, the same picture again")
      ->type_name("N");
  command
      .add_option_function<std::vector<std::string>>(
          "--aov",
          [&request](const std::vector<std::string>& lists) {
            for (const std::string& list : lists) take_aovs(list, request.render.aovs);
          },
          fmt::format("channels beside the colours, for an .exr file: some of {}", all_aov_names()))
      ->type_name("LIST")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--stats", request.stats, "writes what the rendering did as JSON; '-' is standard output")
      ->type_name("FILE");
  command.add_flag("--reproducible", request.reproducible,
                   "leaves the render time out of the picture's file: same picture, same bytes");
  add_settings(command, request.script);
}

ExitCode complain(const CLI::ParseError& error, const CLI::App& app, int argc, const char* const* argv) {
  std::string command = "crt";
  for (const CLI::App* chosen : app.get_subcommands()) command += " " + chosen->get_name();
  std::string message = error.what();
  if (command == "crt" && argc > 1 && std::filesystem::path(argv[1]).extension() == ".crt") {
    message = fmt::format("what to do with '{0}'? To render it: crt render {0}", argv[1]);
  } else if (command == "crt" && argc > 1 && argv[1][0] != '-') {
    message = fmt::format("no command '{}': there are render, trade and check", argv[1]);
  } else if (argc <= 1) {
    message = "say what to do, such as: crt render scene.crt";
  }
  tell(stderr, fmt::format("crt: error: {}\nSee {} --help.\n", message, command));
  return ExitCode::usage;
}

}  // namespace

Request parse_command_line(int argc, const char* const* argv) {
  CLI::App app("Renders scenes written in the CRT language: analytic solids, combined by CSG.", "crt");
  app.set_version_flag("--version", fmt::format("crt {}", version()));
  app.footer(std::string(main_footer));
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);

  RenderRequest render_request;
  CLI::App* render = app.add_subcommand("render", "Renders a script to a picture, or several.");
  render->footer(std::string(render_footer));
  add_render_options(*render, render_request);

  TradeRequest trade_request;
  CLI::App* trade = app.add_subcommand(
      "trade", "Measures which settings give a script's picture what accuracy for what time.");
  add_trade_options(*trade, trade_request);

  CheckRequest check_request;
  CLI::App* check =
      app.add_subcommand("check", "Runs scripts and tells their errors and warnings; renders nothing.");
  check->add_option("scene", check_request.scenes, "the scripts")->required()->type_name("SCENE.crt");
  add_script_options(*check, check_request);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    app.exit(help_or_version);
    return ExitCode::done;
  } catch (const CLI::ParseError& error) {
    return complain(error, app, argc, argv);
  }
  if (check->parsed()) return check_request;
  if (trade->parsed()) {
    if (trade_request.output.empty()) {
      trade_request.output = trade_request.scene;
      trade_request.output.replace_extension();
      trade_request.output += "-trade";
    }
    return trade_request;
  }
  if (render_request.output.empty()) {
    const bool colors_only = render_request.render.aovs == Aovs{};
    render_request.output =
        std::filesystem::path(render_request.scene).replace_extension(colors_only ? ".png" : ".exr");
  }
  return render_request;
}

}  // namespace crt::cli
