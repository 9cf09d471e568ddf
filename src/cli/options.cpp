#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <crt/version.hpp>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/console.hpp"

namespace crt::cli {

namespace {

constexpr std::string_view main_footer = R"(Examples:
  crt render scene.crt                       renders scene.png beside the script
  crt render scene.crt -o big.png --width 1920 --height 1080 --supersampling 4
  crt render scene.crt --set n=18 --set 'tint=rgb(1, 0, 0)'
                                             sets variables of the script from outside
  crt render film.crt --frames 0-99 -o 'film_###.png'
                                             a picture for each t from 0 to 99
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

template <class Number>
bool parse_whole(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool parse_finite(std::string_view text, double& value) {
  return parse_whole(text, value) && std::isfinite(value);
}

/// A string as a script writes it.
std::string script_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    switch (c) {
      case '"':
        quoted += "\\\"";
        break;
      case '\\':
        quoted += "\\\\";
        break;
      case '\n':
        quoted += "\\n";
        break;
      case '\t':
        quoted += "\\t";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20) {
          quoted += fmt::format("\\u{:04x}", c);
        } else {
          quoted += c;
        }
    }
  }
  return quoted + '"';
}

/// "needs ..., not '...'": how every complaint about an option's value reads.
CLI::ValidationError wrong_value(const std::string& option, std::string_view needed,
                                 const std::string& value) {
  return CLI::ValidationError(fmt::format("{} needs {}, not '{}'", option, needed, value));
}

// ---- settings by their script names -----------------------------------------------------------

enum class SettingKind { integer, number, text, flag };

struct SettingOption {
  const char* name;
  SettingKind kind;
  const char* help;
};

constexpr SettingOption setting_options[] = {
    {"width", SettingKind::integer, "pixels across"},
    {"height", SettingKind::integer, "pixels down"},
    {"gamma", SettingKind::number, "8-bit files store value^(1/gamma)"},
    {"supersampling", SettingKind::integer, "n x n rays for each pixel"},
    {"dofsamples", SettingKind::integer, "points of the lens for each of them"},
    {"targeterror", SettingKind::number,
     "samples until pixels are this near the truth; 0.004 is an 8-bit step"},
    {"timebudget", SettingKind::number, "samples for so many seconds of tracing"},
    {"minsamples", SettingKind::integer, "of a pixel, with one of these two: a power of 2"},
    {"maxsamples", SettingKind::integer, "likewise"},
    {"filter", SettingKind::text, "what a pixel is the mean of: box or blackmanharris"},
    {"filterwidth", SettingKind::number, "pixels across, of filters other than the box"},
    {"recursiondepth", SettingKind::integer, "bounces followed after the camera's ray"},
    {"minweight", SettingKind::number, "rays that add less than this share are not followed"},
    {"falloffmodel", SettingKind::text, "distance that dims a light: path or light"},
    {"showclip", SettingKind::flag, "marks pixels brighter than white in red; --showclip=false does not"},
    {"seed", SettingKind::integer, "another seed, another noise"},
    {"precision", SettingKind::text, "standard, or exact: whether a line hits is always right"},
    {"projection", SettingKind::text, "pinhole, spherical, cylindrical or orthographic"},
    {"title", SettingKind::text, "of the picture, kept in its file"},
    {"author", SettingKind::text, "likewise"},
    {"date", SettingKind::text, "likewise"},
    {"notes", SettingKind::text, "likewise"},
};

/// The value of an option as a script expression.
std::string setting_expression(const SettingOption& setting, const std::string& value) {
  const std::string option = fmt::format("--{}", setting.name);
  std::int64_t whole = 0;
  double number = 0;
  switch (setting.kind) {
    case SettingKind::integer:
      if (!parse_whole(value, whole)) throw wrong_value(option, "a whole number", value);
      return value;
    case SettingKind::number:
      if (!parse_finite(value, number)) throw wrong_value(option, "a number", value);
      return value;
    case SettingKind::flag:
      if (value != "true" && value != "false") throw wrong_value(option, "true or false", value);
      return value;
    case SettingKind::text:
      break;
  }
  return script_string(value);
}

void add_settings(CLI::App& command, ScriptOptions& script) {
  for (const SettingOption& setting : setting_options) {
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
    command.add_option_function<std::string>(name, take, setting.help)->type_name(type)->group(group);
  }
}

// ---- the other options ------------------------------------------------------------------------

void take_variable(ScriptOptions& script, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == assignment.size()) {
    throw wrong_value("--set", "NAME=VALUE, such as n=18", assignment);
  }
  script.variables.emplace_back(assignment.substr(0, equals), assignment.substr(equals + 1));
}

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

Region parse_region(const std::string& text) {
  Region region;
  int* const fields[] = {&region.x, &region.y, &region.width, &region.height};
  std::string_view rest = text;
  bool fine = true;
  for (int* field : fields) {
    const std::size_t comma = rest.find(',');
    fine = fine && parse_whole(rest.substr(0, comma), *field) &&
           (comma == std::string_view::npos) == (field == &region.height);
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
  }
  if (!fine || region.x < 0 || region.y < 0 || region.width < 1 || region.height < 1) {
    throw wrong_value("--region", "X,Y,WIDTH,HEIGHT in pixels from the top left, such as 0,0,64,64", text);
  }
  return region;
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

void add_script_options(CLI::App& command, CommonRequest& request) {
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&request](const std::vector<std::string>& assignments) {
            for (const std::string& assignment : assignments) take_variable(request.script, assignment);
          },
          "sets a variable of the script to an expression, whatever the script assigns to it")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option_function<std::string>(
          "--time",
          [&request](const std::string& value) {
            if (!parse_finite(value, request.script.t)) throw wrong_value("--time", "a number", value);
          },
          "the value of t in the script")
      ->type_name("T");
  command
      .add_option_function<std::vector<std::string>>(
          "--resources",
          [&request](const std::vector<std::string>& folders) {
            for (const std::string& folder : folders) {
              if (std::error_code unreachable; !std::filesystem::is_directory(folder, unreachable))
                throw wrong_value("--resources", "a folder", folder);
              request.script.resource_directories.emplace_back(folder);
            }
          },
          "a folder where images and imports are looked for, too (repeatable)")
      ->type_name("FOLDER")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_flag("--allow-outside-files", request.script.allow_outside_files,
                   "lets the script read files outside its own folder and --resources");
  command
      .add_option_function<std::string>(
          "--max-steps",
          [&request](const std::string& value) {
            if (!parse_whole(value, request.script.limits.steps)) {
              throw wrong_value("--max-steps", "a whole number", value);
            }
          },
          fmt::format("expressions the script may evaluate ({})", request.script.limits.steps))
      ->type_name("N");
  command
      .add_option_function<std::string>(
          "--diagnostics",
          [&request](const std::string& value) {
            if (value != "text" && value != "json") throw wrong_value("--diagnostics", "text or json", value);
            request.diagnostics = value == "json" ? DiagnosticsFormat::json : DiagnosticsFormat::text;
          },
          "how errors and warnings are told: as text, or all as one JSON array on standard error")
      ->type_name("text|json");
  command.add_flag("-q,--quiet", request.quiet, "tells errors and nothing else");
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
  command
      .add_option_function<std::string>(
          "--region", [&request](const std::string& text) { request.render.region = parse_region(text); },
          "renders only this part, as a picture of its size")
      ->type_name("X,Y,W,H");
  command
      .add_option_function<std::string>(
          "--threads",
          [&request](const std::string& value) {
            if (!parse_whole(value, request.render.threads) || request.render.threads < 0) {
              throw wrong_value("--threads", "a whole number, 0 for all cores", value);
            }
          },
          "threads at most (default: all cores)")
      ->type_name("N");
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
    message = fmt::format("no command '{}': there are render and check", argv[1]);
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
  if (render_request.output.empty()) {
    const bool colors_only = render_request.render.aovs == Aovs{};
    render_request.output =
        std::filesystem::path(render_request.scene).replace_extension(colors_only ? ".png" : ".exr");
  }
  return render_request;
}

}  // namespace crt::cli
