#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <crt/version.hpp>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string_view>
#include <utility>

#include "cli/console.hpp"
#include "cli/option_table.hpp"
#include "cli/option_values.hpp"
#include "cli/reporter.hpp"
#include "cli/suggestion.hpp"
#include "text/words.hpp"

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
  crt render film.crt --frames 0-99 -o film.gif
                                             one film of them
  crt watch scene.crt                        renders again at each change of the script
  crt farm plan film.crt --frames 0-99 -o job
                                             splits a film into tasks for many machines
  crt trade scene.crt --budget 10            shows which settings give most for ten seconds
  crt measure part.crt                       volume, area, bounds and centroid of each entity
  crt ask scene.crt <rays.csv                what rays meet
  crt check scene.crt                        reports what is wrong with a script, renders nothing
  crt format scene.crt                       lays the script out
  crt export scene.crt -o scene.cpp          writes a program that makes the same picture
  crt import part.scad -o part.crt           translates a file of OpenSCAD or POV-Ray to a script

'crt help render' lists all options. Every setting of a script is an option, too.

Ends with 0: all done; 1: the script is wrong; 2: the command line is wrong; 3: a file could not be
read or written, or standard output did not take what was for it; 70: a bug in crt, or no memory
left; 130: interrupted.)";

void add_row(CLI::App& command, const OptionRow& row) {
  CLI::Option* option = nullptr;
  if (row.type.empty()) {
    option = command.add_flag(row.names, row.help)->each(row.take);
  } else if (row.repeatable) {
    option = command.add_option_function<std::vector<std::string>>(
        row.names,
        [take = row.take](const std::vector<std::string>& values) {
          for (const std::string& value : values) take(value);
        },
        row.help);
    const bool has_name = row.names.starts_with('-');
    if (has_name) option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  } else {
    option = command.add_option_function<std::string>(row.names, row.take, row.help);
  }
  option->required(row.required);
  if (!row.type.empty()) option->type_name(row.type);
  if (!row.group.empty()) option->group(row.group);
  if (!row.excludes.empty()) option->excludes(command.get_option(row.excludes));
}

CLI::App& add_command(CLI::App& app, const CommandTable& table) {
  CLI::App* const command = app.add_subcommand(table.name, table.about);
  command->footer(table.footer);
  for (const OptionRow& row : table.rows) add_row(*command, row);
  return *command;
}

// ---- what is there --------------------------------------------------------------------------

CommandDescription describe(const CLI::App& app) {
  CommandDescription description{.name = app.get_name(),
                                 .about = app.get_description(),
                                 .footer = app.get_footer(),
                                 .options = {}};
  for (const CLI::Option* option : app.get_options()) {
    OptionDescription& added = description.options.emplace_back();
    for (const std::string& name : option->get_snames()) added.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) added.names.push_back("--" + name);
    // CLI11 names a type also where there is no value.
    const bool is_flag = option->get_items_expected_max() == 0;
    added.type = is_flag ? "" : option->get_type_name();
    added.help = option->get_description();
    if (option->get_group() != "Options") added.group = option->get_group();
    added.repeatable = option->get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll ||
                       option->get_expected_max() > 1;
  }
  return description;
}

CommandDescriptions describe_all(const CLI::App& app) {
  CommandDescriptions all{.main = describe(app), .commands = {}};
  for (const CLI::App* command : app.get_subcommands({}))
    all.commands.push_back(describe(*command));
  return all;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

// ---- complaints -----------------------------------------------------------------------------

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  const std::string meant = nearest_word(word, known);
  return meant.empty() ? "" : fmt::format("; did you mean {}?", meant);
}

/// Proposes long options for an unknown one of one letter, of which any other letter is as near.
std::string long_names_of(const std::string& option, const std::vector<std::string>& known) {
  constexpr std::size_t most = 4;
  std::vector<std::string> meant;
  for (const std::string& name : known) {
    if (name.starts_with("-" + option)) meant.push_back(name);
  }
  if (meant.empty() || meant.size() > most) return "";
  return fmt::format("; did you mean {}?", text::enumerate(meant));
}

/// Says what does instead what an option sounds like that there is not.
std::string instead_of(const std::string& option) {
  struct Other {
    std::string_view option;
    const char* what;
  };
  constexpr Other others[] = {
      {"--png", "the plot is an SVG file, which browsers show, and Inkscape converts"},
      {"--show", "crt render scene.crt -o - | chafa shows a picture in a terminal"},
      {"--display", "crt watch shows a picture in progress in its file, which viewers follow"},
  };
  for (const Other& other : others) {
    if (other.option == option) return fmt::format(": {}", other.what);
  }
  return "";
}

/// Says what is wrong with the first word that is no option and has no place.
std::string complaint_about_unknown(const CLI::App& app, int argc, const char* const* argv) {
  const std::vector<std::string> unknown = app.remaining(true);
  const auto is_unknown = [&](const std::string& word) {
    return std::find(unknown.begin(), unknown.end(), word) != unknown.end();
  };
  const auto* const found = std::find_if(argv + 1, argv + argc, is_unknown);
  if (found == argv + argc) return "";
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const CommandDescription command = describe(chosen.empty() ? app : *chosen.front());
  const std::string title = chosen.empty() ? "crt" : "crt " + command.name;
  const std::string word = *found;
  if (!word.starts_with('-')) return fmt::format("'{}' is one word too many for '{}'", word, title);
  std::vector<std::string> names;
  for (const OptionDescription& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  const std::string name = word.substr(0, word.find('='));
  if (const std::string instead = instead_of(name); !instead.empty())
    return fmt::format("'{}' has no option {}{}", title, name, instead);
  constexpr std::size_t of_one_letter = 2;
  return fmt::format(
      "'{}' has no option {}{}", title, name,
      name.size() == of_one_letter ? long_names_of(name, names) : did_you_mean(name, names));
}

bool has_unknown_option(const CLI::App& app) {
  const std::vector<std::string> unknown = app.remaining(true);
  return std::any_of(unknown.begin(), unknown.end(),
                     [](const std::string& word) { return word.starts_with('-'); });
}

ExitCode refuse(const std::string& message, const std::string& command) {
  write_text(stderr, fmt::format("crt: error: {}\nSee {} --help.\n", message, command));
  return ExitCode::usage;
}

std::string complaint_about_command(const CLI::App& app, const std::string& word) {
  const std::vector<std::string> names = command_names(app);
  const std::string hint = did_you_mean(word, names);
  return fmt::format("no command '{}'{}", word,
                     hint.empty() ? ": there are " + text::enumerate(names, "and") : hint);
}

ExitCode complain(const std::exception& error, const CLI::App& app, int argc,
                  const char* const* argv) {
  std::string command = "crt";
  for (const CLI::App* chosen : app.get_subcommands()) command += " " + chosen->get_name();
  std::string message = error.what();
  const std::string word = argc > 1 ? argv[1] : "";
  if (command == "crt" && std::filesystem::path(word).extension() == ".crt") {
    message = fmt::format("what to do with '{0}'? To render it: crt render {0}", word);
  } else if (command == "crt" && !word.empty() && !word.starts_with('-')) {
    message = complaint_about_command(app, word);
  } else if (argc <= 1) {
    message = "say what to do, such as: crt render scene.crt";
  } else if (const std::string unknown = complaint_about_unknown(app, argc, argv);
             !unknown.empty()) {
    message = unknown;
  }
  return refuse(message, command);
}

/// Prints the help or the version that was asked for.
ExitCode show(const CLI::Success& request, const CLI::App& app) {
  std::ostringstream text;
  app.exit(request, text, text);
  Reporter reporter(CommonRequest{});
  reporter.print(text.str(), Reporter::IfClosed::fails);
  return reporter.finish();
}

/// Prints the help of a command, or that of crt if it is empty.
Request show_help(const CLI::App& app, const std::string& command) {
  const std::vector<std::string> names = command_names(app);
  if (command.empty()) {
    const char* const words[] = {"crt", "--help"};
    return parse_command_line(2, words);
  }
  if (std::find(names.begin(), names.end(), command) == names.end())
    return refuse(complaint_about_command(app, command), "crt");
  const char* const words[] = {"crt", command.c_str(), "--help"};
  return parse_command_line(3, words);
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
  add_command(app, render_table(render_request));
  FarmRequest farm_request;
  const CLI::App& farm = add_command(app, farm_table(farm_request));
  WatchRequest watch_request;
  const CLI::App& watch = add_command(app, watch_table(watch_request));
  TradeRequest trade_request;
  const CLI::App& trade = add_command(app, trade_table(trade_request));
  MeasureRequest measure_request;
  const CLI::App& measure = add_command(app, measure_table(measure_request));
  AskRequest ask_request;
  const CLI::App& ask = add_command(app, ask_table(ask_request));
  CheckRequest check_request;
  const CLI::App& check = add_command(app, check_table(check_request));
  NewRequest new_request;
  const CLI::App& create = add_command(app, new_table(new_request));
  ExportRequest export_request;
  const CLI::App& exporting = add_command(app, export_table(export_request));
  ImportRequest import_request;
  const CLI::App& importing = add_command(app, import_table(import_request));
  FormatRequest format_request;
  const CLI::App& format = add_command(app, format_table(format_request));
  const CLI::App& lsp = add_command(app, lsp_table());
  StudioRequest studio_request;
  const CLI::App& studio = add_command(app, studio_table(studio_request));
  CompletionsRequest completions_request;
  const CLI::App& completions = add_command(app, completions_table(completions_request));
  const CLI::App& man = add_command(app, man_table());
  std::string helped;
  const CLI::App& help = add_command(app, help_table(helped, command_names(app)));

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    // In `-w 100 -h 100` no help is meant.
    if (has_unknown_option(app)) return complain(help_or_version, app, argc, argv);
    return show(help_or_version, app);
  } catch (const CLI::ParseError& error) {
    return complain(error, app, argc, argv);
  } catch (const WrongValue& error) {
    return complain(error, app, argc, argv);
  }
  if (help.parsed()) return show_help(app, helped);
  if (completions.parsed()) {
    completions_request.commands = describe_all(app);
    return completions_request;
  }
  if (man.parsed()) return ManRequest{describe_all(app)};
  if (measure.parsed()) return measure_request;
  if (ask.parsed()) return ask_request;
  if (check.parsed()) return check_request;
  if (create.parsed()) return new_request;
  if (exporting.parsed()) return export_request;
  if (importing.parsed()) return import_request;
  if (format.parsed()) return format_request;
  if (lsp.parsed()) return LspRequest{};
  if (studio.parsed()) return studio_request;
  if (trade.parsed()) return trade_request;
  if (farm.parsed()) return farm_request;
  if (watch.parsed()) return watch_request;
  return render_request;
}

}  // namespace crt::cli
