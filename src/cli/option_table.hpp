// Each command has a table of its options. options.cpp has CLI11 parse by it, and describes it for
// completions and the manual page.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/options.hpp"

namespace crt::cli {

/// An OptionRow is an option, or a value that is given by its place.
struct OptionRow {
  std::string names;  ///< "-o,--output"; without dashes it is given by its place
  std::string type;   ///< what its value is called; empty for a flag
  std::string help;
  /// Takes each value that is given. A flag's is "true", or what follows "=". Throws WrongValue.
  std::function<void(const std::string&)> take;
  bool repeatable = false;
  bool required = false;
  std::string group{};     ///< the heading that it stands under; empty for the first
  std::string excludes{};  ///< a row before this one which cannot be given beside it
};

/// A CommandTable is all of a command.
struct CommandTable {
  std::string name;
  std::string about;
  std::string footer;
  std::vector<OptionRow> rows;
};

// The tables' rows fill in the requests, which must outlive them.

CommandTable render_table(RenderRequest& request);
CommandTable farm_table(FarmRequest& request);
CommandTable watch_table(WatchRequest& request);
CommandTable trade_table(TradeRequest& request);
CommandTable measure_table(MeasureRequest& request);
CommandTable ask_table(AskRequest& request);
CommandTable check_table(CheckRequest& request);
CommandTable new_table(NewRequest& request);
CommandTable export_table(ExportRequest& request);
CommandTable import_table(ImportRequest& request);
CommandTable format_table(FormatRequest& request);
CommandTable lsp_table();
CommandTable studio_table(StudioRequest& request);
CommandTable completions_table(CompletionsRequest& request);
CommandTable man_table();
/// `command` gets the name of the command whose help is asked for, one of `commands`.
CommandTable help_table(std::string& command, const std::vector<std::string>& commands);

// These rows belong to several commands.

/// Adds what all commands take that run scripts.
void add_script_rows(std::vector<OptionRow>& rows, CommonRequest& request);
void add_diagnostics_row(std::vector<OptionRow>& rows, CommonRequest& request);
void add_quiet_row(std::vector<OptionRow>& rows, CommonRequest& request);
/// Adds the settings of a script.
void add_setting_rows(std::vector<OptionRow>& rows, ScriptOptions& script);
void add_threads_row(std::vector<OptionRow>& rows, int& threads);
void add_region_row(std::vector<OptionRow>& rows, std::optional<Region>& region,
                    const std::string& help);

/// Adds the script that a command is about, or the scripts. `help` says what it may be.
void add_scene_row(std::vector<OptionRow>& rows, std::filesystem::path& scene,
                   const std::string& help);
void add_scenes_row(std::vector<OptionRow>& rows, std::vector<std::filesystem::path>& scenes,
                    const std::string& help);

/// Returns what takes the name of a file.
std::function<void(const std::string&)> into_path(std::filesystem::path& path);
/// Returns what takes a flag.
std::function<void(const std::string&)> into_flag(const std::string& name, bool& flag);
/// Returns what takes a number above 0.
std::function<void(const std::string&)> into_positive(const std::string& name, double& number);

}  // namespace crt::cli
