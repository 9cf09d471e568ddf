#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <crt/version.hpp>
#include <cstdio>
#include <exception>
#include <functional>
#include <sstream>
#include <string_view>
#include <utility>

#include "cli/console.hpp"
#include "cli/option_values.hpp"
#include "cli/reporter.hpp"

namespace crt::cli {

namespace {

constexpr std::string_view main_footer = R"(Examples:
  crt new scene.crt                          writes a script to begin with
  crt render scene.crt                       renders scene.png beside the script
  crt render scene.crt -o big.png --width 1920 --height 1080 --supersampling 4
  crt render scene.crt --set n=18 --set 'tint=rgb(1, 0, 0)'
                                             sets variables of the script from outside
  crt render film.crt --frames 0-99 -o 'film_###.png'
                                             a picture for each t from 0 to 99
  crt trade scene.crt --budget 10            shows which settings give most for ten seconds
  crt check scene.crt                        reports what is wrong with a script, renders nothing
  crt format scene.crt                       lays the script out

'crt render --help' lists all options. Every setting of a script is an option, too.

Ends with 0: all done; 1: the script is wrong; 2: the command line is wrong; 3: a file could not be
read or written, or standard output did not take what was for it; 70: a bug in crt, or no memory
left; 130: interrupted.)";

constexpr std::string_view render_footer =
    R"(The ending of the picture's name says its format: .png, .tif, .jpg and others (8 bits, gamma
applied), .exr and .hdr (linear light). Nothing is left behind under its name unless it is whole. A
link is followed, and what is a device or a pipe is written to as it is.
An .exr file also holds what --aov asks for: depth (channel Z), normal (N.X, N.Y, N.Z), id, albedo,
and of each pixel how many samples it has (samples) and how far it may be from the truth (error).

Examples:
  crt render scene.crt -o draft.png --width 320 --height 240
  crt render scene.crt -o corner.png --region 0,0,64,64     only that part of the picture
  crt render film.crt --frames 1-48                         film_0001.png to film_0048.png
  crt render scene.crt -o scene.exr --aov depth,id          distances and objects beside the colours
  crt render scene.crt --stats -                            what it took, as JSON)";

constexpr std::string_view trade_footer =
    R"(Renders the scene with a ladder of settings (supersampling 1 to 16, target errors, recursion
depths, exact precision), compares each with a reference that is far more accurate, and writes a
table (.csv) and a plot (.svg) of seconds against the error: its root mean square, and what 99.9 %
of the pixels stay below, in steps of an 8-bit picture. By default it measures bands of the picture
with about 30000 pixels together; all seconds are those that the whole picture would take.

Examples:
  crt trade scene.crt                      scene-trade.csv and scene-trade.svg
  crt trade scene.crt --budget 10          and the most accurate setting for 10 seconds a picture
  crt trade scene.crt --error 0.5 --png    and the fastest within half a step; the plot also as .png
  crt trade film.crt --time 12 --region 100,80,200,100 -o part)";

void add_settings(CLI::App& command, ScriptOptions& script) {
  for (const SettingOption& setting : setting_options()) {
    const auto take = [&script, &setting](const std::string& value) {
      script.settings.emplace_back(setting.name, setting_expression(setting, value));
    };
    const std::string name = fmt::format("--{}", setting.name);
    constexpr const char* group = "Settings (they win over the script's)";
    if (setting.kind == SettingKind::flag) {
      command.add_flag(name, setting.help)->group(group)->each(take);
      continue;
    }
    const char* type = setting.kind == SettingKind::text      ? "TEXT"
                       : setting.kind == SettingKind::integer ? "N"
                                                              : "NUMBER";
    command.add_option_function<std::string>(name, take, setting.help)
        ->type_name(type)
        ->group(group);
  }
}

void add_script_options(CLI::App& command, CommonRequest& request) {
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&request](const std::vector<std::string>& assignments) {
            for (const std::string& assignment : assignments)
              take_variable(request.script, assignment);
          },
          "sets a variable of the script to an expression, whatever the script assigns to it")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option_function<std::string>(
          "--time",
          [&request](const std::string& value) {
            if (!parse_finite(value, request.script.t))
              throw WrongValue("--time", "a number", value);
          },
          "the value of t in the script")
      ->type_name("T");
  command
      .add_option_function<std::vector<std::string>>(
          "--resources",
          [&request](const std::vector<std::string>& folders) {
            for (const std::string& folder : folders) {
              if (std::error_code unreachable; !std::filesystem::is_directory(folder, unreachable))
                throw WrongValue("--resources", "a folder", folder);
              request.script.resource_directories.emplace_back(folder);
            }
          },
          "a folder where images and imports are looked for, too (repeatable)")
      ->type_name("FOLDER")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option_function<std::string>(
          "--compat", [&request](const std::string& value) { take_compat(request.script, value); },
          "2015 for scripts of that year, see docs/compat.md; wins over the script's Settings")
      ->type_name("YEAR");
  command.add_flag("--allow-outside-files", request.script.allow_outside_files,
                   "lets the script read files outside its own folder and --resources");
  command
      .add_option_function<std::string>(
          "--max-steps",
          [&request](const std::string& value) {
            if (!parse_whole(value, request.script.limits.steps)) {
              throw WrongValue("--max-steps", "a whole number", value);
            }
          },
          fmt::format("expressions the script may evaluate ({})", request.script.limits.steps))
      ->type_name("N");
  command
      .add_option_function<std::string>(
          "--diagnostics",
          [&request](const std::string& value) {
            if (value != "text" && value != "json")
              throw WrongValue("--diagnostics", "text or json", value);
            request.diagnostics =
                value == "json" ? DiagnosticsFormat::json : DiagnosticsFormat::text;
          },
          "how errors and warnings are written: as text, or all as one JSON array on standard "
          "error")
      ->type_name("text|json");
  command.add_flag("-q,--quiet", request.quiet, "prints errors and nothing else");
}

void add_threads(CLI::App& command, int& threads) {
  command
      .add_option_function<std::string>(
          "--threads", [&threads](const std::string& value) { threads = parse_threads(value); },
          "threads at most (default: all cores)")
      ->type_name("N");
}

void add_region(CLI::App& command, std::optional<Region>& region, const std::string& help) {
  command
      .add_option_function<std::string>(
          "--region", [&region](const std::string& text) { region = parse_region(text); }, help)
      ->type_name("X,Y,W,H");
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
              "--frames",
              [&request](const std::string& text) { request.frames = parse_frames(text); },
              "renders a picture for each whole t in the range; ### in the output's name is the "
              "number")
          ->type_name("A-B");
  frames->excludes(command.get_option("--time"));
  add_region(command, request.render.region, "renders only this part, as a picture of its size");
  add_threads(command, request.render.threads);
  command
      .add_option_function<std::string>(
          "--passes",
          [&request](const std::string& value) {
            if (!parse_whole(value, request.render.passes) || request.render.passes < 0) {
              throw WrongValue("--passes", "a whole number, 0 for as many as it takes", value);
            }
          },
          "stops after so many passes: with the number that --stats gave, the same picture again")
      ->type_name("N");
  command
      .add_option_function<std::string>(
          "--max-ray-steps",
          [&request](const std::string& value) {
            if (!parse_whole(value, request.render.max_ray_steps)) {
              throw WrongValue("--max-ray-steps", "a whole number, 0 for the usual bound", value);
            }
          },
          "things that one ray may be tested against before the render ends with an error "
          "(4194304)")
      ->type_name("N");
  command
      .add_option_function<std::string>(
          "--max-primitives",
          [&request](const std::string& value) {
            if (!parse_whole(value, request.max_primitives)) {
              throw WrongValue("--max-primitives",
                               "a whole number, 0 for what memory is enough for", value);
            }
          },
          "primitives that the scene may have before it ends with an error (what memory is enough "
          "for)")
      ->type_name("N");
  command
      .add_option("--checkpoint", request.render.checkpoint,
                  "with --targeterror, --timebudget or --passes: keeps what is done there, also "
                  "when interrupted, and continues from it if it is there")
      ->type_name("FILE")
      ->excludes(frames);
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
      .add_option("--stats", request.stats,
                  "writes what the rendering did as JSON; '-' is standard output")
      ->type_name("FILE");
  command.add_flag("--reproducible", request.reproducible,
                   "leaves the render time out of the picture's file: same picture, same bytes");
  add_settings(command, request.script);
}

void add_positive(CLI::App& command, const std::string& name, const std::string& help,
                  const char* type, const std::function<void(double)>& take) {
  command
      .add_option_function<std::string>(
          name, [name, take](const std::string& text) { take(parse_positive(name, text)); }, help)
      ->type_name(type);
}

void add_trade_options(CLI::App& command, TradeRequest& request) {
  command.footer(std::string(trade_footer));
  command.add_option("scene", request.scene, "the script")->required()->type_name("SCENE.crt");
  command
      .add_option("-o,--output", request.output,
                  "what is written, without the endings (default: the script's name and -trade)")
      ->type_name("NAME");
  add_script_options(command, request);
  add_positive(command, "--budget",
               "asks for the most accurate setting within so many seconds a picture", "SECONDS",
               [&](double value) { request.budget = value; });
  add_positive(command, "--error", "asks for the fastest setting within so many 8-bit steps",
               "STEPS", [&](double value) { request.error = value; });
  command.add_flag("--png", request.png, "writes the plot as a picture, too");
  add_region(command, request.region, "measures only this part of the picture");
  add_positive(command, "--pixels",
               fmt::format("measures about so many pixels ({:.0f})", request.pixels), "N",
               [&](double value) { request.pixels = value; });
  add_positive(
      command, "--most-seconds",
      fmt::format(
          "leaves out settings that would take longer for these pixels, and ends each of the two "
          "reference renders then ({:.0f})",
          request.most_seconds),
      "SECONDS", [&](double value) { request.most_seconds = value; });
  command
      .add_option_function<std::string>(
          "--reference-samples",
          [&request](const std::string& text) {
            request.reference_samples = parse_sample_count("--reference-samples", text);
          },
          fmt::format("samples of a pixel of the references at most ({})",
                      request.reference_samples))
      ->type_name("N");
  add_threads(command, request.threads);
  add_settings(command, request.script);
}

ExitCode complain(const std::exception& error, const CLI::App& app, int argc,
                  const char* const* argv) {
  std::string command = "crt";
  for (const CLI::App* chosen : app.get_subcommands()) command += " " + chosen->get_name();
  std::string message = error.what();
  if (command == "crt" && argc > 1 && std::filesystem::path(argv[1]).extension() == ".crt") {
    message = fmt::format("what to do with '{0}'? To render it: crt render {0}", argv[1]);
  } else if (command == "crt" && argc > 1 && argv[1][0] != '-') {
    message = fmt::format("no command '{}': there are new, render, trade, check, format and lsp",
                          argv[1]);
  } else if (argc <= 1) {
    message = "say what to do, such as: crt render scene.crt";
  }
  write_text(stderr, fmt::format("crt: error: {}\nSee {} --help.\n", message, command));
  return ExitCode::usage;
}

/// Prints the help or the version that was asked for.
ExitCode show(const CLI::Success& request, const CLI::App& app) {
  std::ostringstream text;
  app.exit(request, text, text);
  Reporter reporter(CommonRequest{});
  reporter.print(text.str(), Reporter::IfClosed::fails);
  return reporter.finish();
}

}  // namespace

Request parse_command_line(int argc, const char* const* argv) {
  CLI::App app("Renders scenes written in the CRT language: analytic solids, combined by CSG.",
               "crt");
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
  CLI::App* check = app.add_subcommand(
      "check", "Runs scripts and reports their errors and warnings; renders nothing.");
  check->add_option("scene", check_request.scenes, "the scripts")
      ->required()
      ->type_name("SCENE.crt");
  add_script_options(*check, check_request);

  FormatRequest format_request;
  CLI::App* format =
      app.add_subcommand("format", "Lays scripts out: indentation, blanks, blank lines, comments.");
  format->add_option("scene", format_request.scenes, "the scripts; - for standard input and output")
      ->required()
      ->type_name("SCENE.crt");
  format->add_flag("--check", format_request.check,
                   "writes nothing; names the scripts that would change, and then ends with 1");
  format->add_flag("-q,--quiet", format_request.quiet, "prints errors and nothing else");

  CLI::App* lsp = app.add_subcommand(
      "lsp", "Serves editors by the Language Server Protocol, see docs/editors.md.");
  lsp->add_flag_callback(
      "--stdio", [] {}, "on standard input and output, which it does anyway");

  NewRequest new_request;
  CLI::App* create = app.add_subcommand("new", "Writes a script to begin with.");
  create->add_option("scene", new_request.scene, "the script, which does not exist yet")
      ->required()
      ->type_name("SCENE.crt");
  create->add_flag("-q,--quiet", new_request.quiet, "prints errors and nothing else");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return show(help_or_version, app);
  } catch (const CLI::ParseError& error) {
    return complain(error, app, argc, argv);
  } catch (const WrongValue& error) {
    return complain(error, app, argc, argv);
  }
  if (check->parsed()) return check_request;
  if (format->parsed()) return format_request;
  if (lsp->parsed()) return LspRequest{};
  if (create->parsed()) return new_request;
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
    render_request.output = std::filesystem::path(render_request.scene)
                                .replace_extension(colors_only ? ".png" : ".exr");
  }
  return render_request;
}

}  // namespace crt::cli
