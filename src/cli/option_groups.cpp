#include "cli/option_groups.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

namespace crt::cli {

namespace {

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

void take_variable(ScriptOptions& script, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == assignment.size()) {
    throw wrong_value("--set", "NAME=VALUE, such as n=18", assignment);
  }
  script.variables.emplace_back(assignment.substr(0, equals), assignment.substr(equals + 1));
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

}  // namespace

bool parse_finite(std::string_view text, double& value) {
  return parse_whole(text, value) && std::isfinite(value);
}

CLI::ValidationError wrong_value(const std::string& option, std::string_view needed,
                                 const std::string& value) {
  return CLI::ValidationError(fmt::format("{} needs {}, not '{}'", option, needed, value));
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

void add_threads(CLI::App& command, int& threads) {
  command
      .add_option_function<std::string>(
          "--threads",
          [&threads](const std::string& value) {
            if (!parse_whole(value, threads) || threads < 0) {
              throw wrong_value("--threads", "a whole number, 0 for all cores", value);
            }
          },
          "threads at most (default: all cores)")
      ->type_name("N");
}

void add_region(CLI::App& command, std::optional<Region>& region, const std::string& help) {
  command
      .add_option_function<std::string>(
          "--region", [&region](const std::string& text) { region = parse_region(text); }, help)
      ->type_name("X,Y,W,H");
}

}  // namespace crt::cli
