// The rows that several commands have in common.
#include "cli/option_table.hpp"

#include <fmt/format.h>

#include "cli/option_values.hpp"

namespace crt::cli {

std::function<void(const std::string&)> into_path(std::filesystem::path& path) {
  return [&path](const std::string& name) { path = name; };
}

std::function<void(const std::string&)> into_flag(const std::string& name, bool& flag) {
  return [name, &flag](const std::string& value) {
    if (value != "true" && value != "false") throw WrongValue(name, "true or false", value);
    flag = value == "true";
  };
}

std::function<void(const std::string&)> into_positive(const std::string& name, double& number) {
  return [name, &number](const std::string& value) { number = parse_positive(name, value); };
}

void add_setting_rows(std::vector<OptionRow>& rows, ScriptOptions& script) {
  for (const SettingOption& setting : setting_options()) {
    const char* type = "NUMBER";
    if (setting.kind == SettingKind::flag) type = "";
    if (setting.kind == SettingKind::text) type = "TEXT";
    if (setting.kind == SettingKind::integer) type = "N";
    rows.push_back({.names = fmt::format("--{}", setting.name),
                    .type = type,
                    .help = std::string(setting.help),
                    .take =
                        [&script, &setting](const std::string& value) {
                          script.settings.emplace_back(setting.name,
                                                       setting_expression(setting, value));
                        },
                    .group = "Settings (they win over the script's)"});
  }
}

void add_script_rows(std::vector<OptionRow>& rows, CommonRequest& request) {
  ScriptOptions& script = request.script;
  rows.push_back({.names = "--set",
                  .type = "NAME=VALUE",
                  .help = "sets a variable of the script to an expression, whatever the script "
                          "assigns to it",
                  .take = [&script](const std::string& text) { take_variable(script, text); },
                  .repeatable = true});
  rows.push_back({.names = "--time",
                  .type = "T",
                  .help = "the value of t in the script",
                  .take = [&script](const std::string& value) {
                    if (!parse_finite(value, script.t))
                      throw WrongValue("--time", "a number", value);
                  }});
  rows.push_back({.names = "--resources",
                  .type = "FOLDER",
                  .help = "a folder where imports, images and meshes are found, too (repeatable)",
                  .take =
                      [&script](const std::string& folder) {
                        if (std::error_code unreachable;
                            !std::filesystem::is_directory(folder, unreachable))
                          throw WrongValue("--resources", "a folder", folder);
                        script.resource_directories.emplace_back(folder);
                      },
                  .repeatable = true});
  rows.push_back({.names = "--compat",
                  .type = "YEAR",
                  .help = "2015 for scripts of that year, see docs/compat.md; wins over the "
                          "script's Settings",
                  .take = [&script](const std::string& value) { take_compat(script, value); }});
  rows.push_back({.names = "--allow-outside-files",
                  .type = "",
                  .help = "lets the script read files outside its own folder and --resources",
                  .take = into_flag("--allow-outside-files", script.allow_outside_files)});
  rows.push_back(
      {.names = "--max-steps",
       .type = "N",
       .help = fmt::format("expressions the script may evaluate ({})", script.limits.steps),
       .take = [&script](const std::string& value) {
         if (!parse_whole(value, script.limits.steps))
           throw WrongValue("--max-steps", "a whole number", value);
       }});
  rows.push_back({.names = "--max-image-pixels",
                  .type = "N",
                  .help =
                      "pixels that all pictures of the script may have together (what a quarter "
                      "of the memory is enough for, and at most 134217728)",
                  .take = [&script](const std::string& value) {
                    if (!parse_whole(value, script.limits.image_pixels)) {
                      throw WrongValue("--max-image-pixels",
                                       "a whole number, 0 for what memory is enough for", value);
                    }
                  }});
  add_diagnostics_row(rows, request);
  add_quiet_row(rows, request);
}

void add_diagnostics_row(std::vector<OptionRow>& rows, CommonRequest& request) {
  rows.push_back({.names = "--diagnostics",
                  .type = "text|json",
                  .help = "how errors and warnings are written: as text, or all as one JSON array "
                          "on standard error",
                  .take = [&request](const std::string& value) {
                    if (value != "text" && value != "json")
                      throw WrongValue("--diagnostics", "text or json", value);
                    request.diagnostics =
                        value == "json" ? DiagnosticsFormat::json : DiagnosticsFormat::text;
                  }});
}

void add_quiet_row(std::vector<OptionRow>& rows, CommonRequest& request) {
  rows.push_back({.names = "-q,--quiet",
                  .type = "",
                  .help = "writes errors, what the script prints, and nothing else",
                  .take = into_flag("--quiet", request.quiet)});
}

void add_threads_row(std::vector<OptionRow>& rows, int& threads) {
  rows.push_back(
      {.names = "--threads",
       .type = "N",
       .help = "threads at most (default: all cores)",
       .take = [&threads](const std::string& value) { threads = parse_threads(value); }});
}

void add_scene_row(std::vector<OptionRow>& rows, std::filesystem::path& scene,
                   const std::string& help) {
  rows.push_back({.names = "scene",
                  .type = "SCENE.crt",
                  .help = help,
                  .take = into_path(scene),
                  .required = true});
}

void add_scenes_row(std::vector<OptionRow>& rows, std::vector<std::filesystem::path>& scenes,
                    const std::string& help) {
  rows.push_back({.names = "scene",
                  .type = "SCENE.crt",
                  .help = help,
                  .take = [&scenes](const std::string& name) { scenes.emplace_back(name); },
                  .repeatable = true,
                  .required = true});
}

void add_region_row(std::vector<OptionRow>& rows, std::optional<Region>& region,
                    const std::string& help) {
  rows.push_back({.names = "--region",
                  .type = "X,Y,W,H",
                  .help = help,
                  .take = [&region](const std::string& text) { region = parse_region(text); }});
}

}  // namespace crt::cli
