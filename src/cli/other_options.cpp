// The options of `crt trade`, `crt check`, `crt new`, `crt export`, `crt format`, `crt lsp`,
// `crt studio` and the commands about the command itself.
#include <fmt/format.h>

#include <string_view>

#include "cli/option_table.hpp"
#include "cli/option_values.hpp"
#include "cli/trade_solids.hpp"

namespace crt::cli {

namespace {

constexpr std::string_view trade_footer =
    R"(Renders the scene with a ladder of settings (supersampling 1 to 16, target errors, recursion
depths, exact precision), compares each with a reference that is far more accurate, and writes a
table (.csv) and a plot (.svg) of seconds against the error: its root mean square, and what 99.9 %
of the pixels stay below, in steps of an 8-bit picture. By default it measures bands of the picture
with about 30000 pixels together; all seconds are those that the whole picture would take. It takes
half a minute to some minutes, which --most-seconds and --pixels make less.

With --measure it measures the scene's solids instead, to ever narrower widths, and the plot shows
the seconds against the width of the interval.

Examples:
  crt trade scene.crt                      scene-trade.csv and scene-trade.svg
  crt trade scene.crt --budget 10          and the most accurate setting for 10 seconds a picture
  crt trade scene.crt --error 0.5          and the fastest within half a step
  crt trade film.crt --time 12 --region 100,80,200,100 -o part
  crt trade part.crt --measure volume      and how narrow bounds of the volume are for what time)";

SolidMeasure parse_solid_measure(const std::string& text) {
  for (const SolidMeasureName& known : solid_measure_names)
    if (known.name == text) return known.measure;
  throw WrongValue("--measure", "volume, area or mass", text);
}

}  // namespace

CommandTable trade_table(TradeRequest& request) {
  CommandTable table{
      .name = "trade",
      .about = "Measures which settings give a script's picture what accuracy for what time.",
      .footer = std::string(trade_footer),
      .rows = {}};
  std::vector<OptionRow>& rows = table.rows;
  add_scene_row(rows, request.scene, "the script; - is standard input");
  rows.push_back({.names = "-o,--output",
                  .type = "NAME",
                  .help = "what is written, without the endings (default: the script's name and "
                          "-trade)",
                  .take = into_path(request.output)});
  add_script_rows(rows, request);
  rows.push_back({.names = "--budget",
                  .type = "SECONDS",
                  .help = "asks for the most accurate setting within so many seconds a picture, "
                          "however long the measuring takes",
                  .take = [&request](const std::string& text) {
                    request.budget = parse_positive("--budget", text);
                  }});
  rows.push_back({.names = "--error",
                  .type = "STEPS",
                  .help = "asks for the fastest setting within so many 8-bit steps",
                  .take = [&request](const std::string& text) {
                    request.error = parse_positive("--error", text);
                  }});
  add_region_row(rows, request.region, "measures only this part of the picture");
  rows.push_back({.names = "--measure",
                  .type = "WHAT",
                  .help = "measures solids instead of pictures: volume, area or mass",
                  .take = [&request](const std::string& text) {
                    request.measure = parse_solid_measure(text);
                  }});
  rows.push_back({.names = "--pixels",
                  .type = "N",
                  .help = fmt::format("measures about so many pixels ({:.0f})", request.pixels),
                  .take = into_positive("--pixels", request.pixels)});
  rows.push_back({.names = "--most-seconds",
                  .type = "SECONDS",
                  .help = fmt::format("leaves out settings that would take longer for these "
                                      "pixels, and ends each of the two reference renders then "
                                      "({:.0f})",
                                      request.max_seconds),
                  .take = into_positive("--most-seconds", request.max_seconds)});
  rows.push_back({.names = "--reference-samples",
                  .type = "N",
                  .help = fmt::format("samples of a pixel of the references at most ({})",
                                      request.reference_samples),
                  .take = [&request](const std::string& text) {
                    request.reference_samples = parse_sample_count("--reference-samples", text);
                  }});
  add_threads_row(rows, request.threads);
  add_setting_rows(rows, request.script);
  return table;
}

CommandTable check_table(CheckRequest& request) {
  CommandTable table{.name = "check",
                     .about =
                         "Runs scripts and reports their errors and warnings; renders "
                         "nothing.",
                     .footer = "",
                     .rows = {}};
  add_scenes_row(table.rows, request.scenes, "the scripts; - is standard input");
  add_script_rows(table.rows, request);
  return table;
}

CommandTable new_table(NewRequest& request) {
  CommandTable table{
      .name = "new", .about = "Writes a script to begin with.", .footer = "", .rows = {}};
  add_scene_row(table.rows, request.scene, "the script, which does not exist yet");
  add_quiet_row(table.rows, request);
  return table;
}

CommandTable export_table(ExportRequest& request) {
  CommandTable table{
      .name = "export",
      .about = "Writes a script's scene as a program, as a plain script, or as triangles.",
      .footer = R"(The program renders the same picture, byte for byte, to the file that its first
argument names. What makes the scene is a function in it, make_scene(). It has the numbers that the
script computes, and no loops or macros. Meshes and images are in it as numbers, up to 16 MiB. Those
of a script go into files beside it.

Files that end in .stl, .obj, .ply, .3mf or .glb get the surfaces of all solids as triangles, which
are nowhere farther from them than the deviation. Each entity is a part of its own, with its colour
and the unit of the script's Settings, where the format has that.

Examples:
  crt export scene.crt -o scene.cpp         the ending says the language: .cpp, .py, .c or .crt
  crt export scene.crt --as python          to standard output
  crt export scene.crt --entity 0 --as c    a function that makes the first entity
  crt export part.crt -o part.3mf --deviation 0.01
                                            triangles for a slicer)",
      .rows = {}};
  std::vector<OptionRow>& rows = table.rows;
  add_scene_row(rows, request.scene, "the script; - is standard input");
  rows.push_back({.names = "-o,--output",
                  .type = "FILE",
                  .help = "the program, script or mesh (default: standard output)",
                  .take = into_path(request.output)});
  rows.push_back({.names = "--deviation",
                  .type = "D",
                  .help = "how far triangles may be from the surface, in scene units (a thousandth "
                          "of the longest side of the box around all)",
                  .take = [&request](const std::string& text) {
                    request.deviation = parse_positive("--deviation", text);
                  }});
  rows.push_back({.names = "--seconds",
                  .type = "SECONDS",
                  .help = "the triangles of each entity are as good as they are by then",
                  .take = [&request](const std::string& text) {
                    request.seconds = parse_positive("--seconds", text);
                  }});
  rows.push_back({.names = "--as",
                  .type = "cpp|python|c|script",
                  .help = "the language (default: as the ending says, or else cpp)",
                  .take = [&request](const std::string& name) {
                    if (name == "cpp") {
                      request.language = SourceLanguage::cpp;
                    } else if (name == "python") {
                      request.language = SourceLanguage::python;
                    } else if (name == "c") {
                      request.language = SourceLanguage::c;
                    } else if (name == "script") {
                      request.language = SourceLanguage::script;
                    } else {
                      throw WrongValue("--as", "cpp, python, c or script", name);
                    }
                  }});
  rows.push_back({.names = "--entity",
                  .type = "N",
                  .help = "writes only the entity at this place in the scene, from 0 on",
                  .take = [&request](const std::string& text) {
                    int place = 0;
                    if (!parse_whole(text, place) || place < 0)
                      throw WrongValue("--entity", "a whole number from 0 on", text);
                    request.entity = place;
                  }});
  add_script_rows(rows, request);
  add_setting_rows(rows, request.script);
  return table;
}

CommandTable format_table(FormatRequest& request) {
  CommandTable table{.name = "format",
                     .about = "Lays scripts out: indentation, blanks, blank lines, comments.",
                     .footer = "",
                     .rows = {}};
  add_scenes_row(table.rows, request.scenes,
                 "the scripts; - is standard input, and goes to standard output");
  table.rows.push_back(
      {.names = "--check",
       .type = "",
       .help = "writes nothing; names the scripts that would change, and then ends with 1",
       .take = into_flag("--check", request.check)});
  add_quiet_row(table.rows, request);
  return table;
}

CommandTable lsp_table() {
  return {.name = "lsp",
          .about = "Serves editors by the Language Server Protocol, see docs/editors.md.",
          .footer = "",
          .rows = {{.names = "--stdio",
                    .type = "",
                    .help = "on standard input and output, which it does anyway",
                    .take = [](const std::string&) {}}}};
}

namespace {

/// Adds how browsers on other machines reach the studio.
void add_network_rows(std::vector<OptionRow>& rows, StudioRequest& request) {
  rows.push_back({.names = "--listen",
                  .type = "ADDRESS",
                  .help = "listens on this IP address of the machine, also for other machines; "
                          "0.0.0.0 or :: is all it has (default: 127.0.0.1)",
                  .take = [&request](const std::string& text) {
                    request.listen = parse_ip_address("--listen", text);
                  }});
  rows.push_back({.names = "--name",
                  .type = "HOST",
                  .help = "lets browsers call this machine by this name, too, and prints it",
                  .take =
                      [&request](const std::string& text) {
                        request.names.push_back(parse_host_name("--name", text));
                      },
                  .repeatable = true});
  rows.push_back({.names = "--tls-cert",
                  .type = "FILE",
                  .help = "encrypts by HTTPS: a certificate in PEM, and those that lead to it",
                  .take = into_path(request.tls_certificate)});
  rows.push_back({.names = "--tls-key",
                  .type = "FILE",
                  .help = "its private key in PEM (default: in the certificate's file)",
                  .take = into_path(request.tls_key)});
}

}  // namespace

CommandTable studio_table(StudioRequest& request) {
  CommandTable table{
      .name = "studio",
      .about = "Serves a page to write a script in and to see its picture meanwhile.",
      .footer = R"(Open the address that it prints in a browser on the same machine. It
serves until it is interrupted. The page can read and write scripts in the script's folder alone.
docs/studio.md says how it is used, also from another machine.

Examples:
  crt studio scene.crt
  crt studio --listen 0.0.0.0 --port 8443 --tls-cert cert.pem --tls-key key.pem scene.crt)",
      .rows = {}};
  table.rows.push_back({.names = "scene",
                        .type = "SCENE.crt",
                        .help = "the script, or a folder with scripts (default: this folder)",
                        .take = into_path(request.scene)});
  table.rows.push_back({.names = "--port",
                        .type = "N",
                        .help = "the port, from 1 to 65535 (default: one that is free)",
                        .take = [&request](const std::string& text) {
                          constexpr int highest = 65535;
                          if (!parse_whole(text, request.port) || request.port < 1 ||
                              request.port > highest)
                            throw WrongValue("--port", "a whole number from 1 to 65535", text);
                        }});
  add_network_rows(table.rows, request);
  table.rows.push_back({.names = "--embed",
                        .type = "",
                        .help = "lets pages of this machine show it in a frame, as notebooks do, "
                                "and ends when standard input does",
                        .take = into_flag("--embed", request.embed)});
  add_threads_row(table.rows, request.threads);
  return table;
}

CommandTable completions_table(CompletionsRequest& request) {
  CommandTable table{.name = "completions",
                     .about = "Prints a script by which a shell completes commands and options.",
                     .footer = R"(What is installed has them in place. Otherwise:
  crt completions bash >~/.local/share/bash-completion/completions/crt
  crt completions zsh >~/.zfunc/_crt        with ~/.zfunc in your fpath
  crt completions fish >~/.config/fish/completions/crt.fish)",
                     .rows = {}};
  table.rows.push_back({.names = "shell",
                        .type = "bash|zsh|fish",
                        .help = "the shell",
                        .take =
                            [&request](const std::string& shell) {
                              if (shell != "bash" && shell != "zsh" && shell != "fish")
                                throw WrongValue("crt completions", "bash, zsh or fish", shell);
                              request.shell = shell;
                            },
                        .required = true});
  return table;
}

CommandTable man_table() {
  return {.name = "man",
          .about = "Prints the manual page.",
          .footer = "To read it where it is not installed:\n  crt man | man -l -",
          .rows = {}};
}

CommandTable help_table(std::string& command, const std::vector<std::string>& commands) {
  return {.name = "help",
          .about = "Prints the help of a command, or that of crt.",
          .footer = "",
          .rows = {{.names = "command",
                    .type = fmt::format("{}", fmt::join(commands, "|")),
                    .help = "the command",
                    .take = [&command](const std::string& name) { command = name; }}}};
}

}  // namespace crt::cli
