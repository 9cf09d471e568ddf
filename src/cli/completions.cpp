#include "cli/completions.hpp"

#include <fmt/format.h>

#include <string_view>

#include "cli/process.hpp"

namespace crt::cli {

namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::vector<std::string> option_names(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const OptionDescription& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

/// Returns what is given by its place, or null.
const OptionDescription* positional_of(const CommandDescription& command) {
  for (const OptionDescription& option : command.options) {
    if (option.names.empty()) return &option;
  }
  return nullptr;
}

// ---- bash -----------------------------------------------------------------------------------

/// Returns bash's commands that offer the values of a type.
std::string bash_offer(const std::string& type) {
  switch (value_kind(type)) {
    case ValueKind::file:
      return "_crt_files -f";
    case ValueKind::folder:
      return "_crt_files -d";
    case ValueKind::script:
      return "_crt_files -f -X '!*.crt'; _crt_files -d";
    case ValueKind::choice:
      return fmt::format("_crt_words '{}'", replaced(type, "|", " "));
    case ValueKind::anything:
      break;
  }
  return ":";
}

std::string bash_command(const CommandDescription& command) {
  std::string text = fmt::format("    {})\n      case $before in\n", command.name);
  for (const OptionDescription& option : command.options) {
    if (option.names.empty() || option.type.empty()) continue;
    text += fmt::format("        {}) {}; return ;;\n", fmt::join(option.names, " | "),
                        bash_offer(option.type));
  }
  const OptionDescription* const positional = positional_of(command);
  text += fmt::format(
      "      esac\n"
      "      if [[ $word == -* ]]; then\n"
      "        _crt_words '{}'\n"
      "      else\n"
      "        {}\n"
      "      fi\n"
      "      ;;\n",
      fmt::join(option_names(command), " "),
      positional == nullptr ? ":" : bash_offer(positional->type));
  return text;
}

// ---- zsh ------------------------------------------------------------------------------------

std::string zsh_action(const std::string& type) {
  switch (value_kind(type)) {
    case ValueKind::file:
      return "_files";
    case ValueKind::folder:
      return "_files -/";
    case ValueKind::script:
      return R"(_files -g "*.crt")";
    case ValueKind::choice:
      return fmt::format("({})", replaced(type, "|", " "));
    case ValueKind::anything:
      break;
  }
  return " ";
}

/// Returns a help text as zsh's _arguments reads it between brackets.
std::string zsh_help(const std::string& help) {
  return replaced(replaced(replaced(help, "[", R"(\[)"), "]", R"(\])"), ":", R"(\:)");
}

std::string zsh_option(const OptionDescription& option) {
  const std::string help = fmt::format("[{}]", zsh_help(option.help));
  const std::string value =
      option.type.empty()
          ? ""
          : fmt::format(":{}:{}", replaced(option.type, ":", R"(\:)"), zsh_action(option.type));
  if (option.names.empty()) {
    return shell_quoted(fmt::format("{}:{}:{}", option.repeatable ? "*" : "1",
                                    zsh_help(option.help), zsh_action(option.type)));
  }
  // An option that was given is not offered again, and neither are its other names.
  const std::string once =
      option.repeatable ? "*" : fmt::format("({})", fmt::join(option.names, " "));
  std::string words;
  for (const std::string& name : option.names) {
    if (!words.empty()) words += " \\\n        ";
    const char* const joint = option.type.empty() ? "" : name.starts_with("--") ? "=" : "+";
    words += shell_quoted(fmt::format("{}{}{}{}{}", once, name, joint, help, value));
  }
  return words;
}

// ---- fish -----------------------------------------------------------------------------------

/// Returns a word between single quotes, as fish reads it.
std::string fish_quoted(const std::string& text) {
  return "'" + replaced(replaced(text, R"(\)", R"(\\)"), "'", R"(\')") + "'";
}

std::string fish_value(const std::string& type) {
  switch (value_kind(type)) {
    case ValueKind::file:
      return " -r -F";
    case ValueKind::folder:
      return " -x -a '(__fish_complete_directories)'";
    case ValueKind::script:
      return " -k -x -a '(__fish_complete_suffix .crt)'";
    case ValueKind::choice:
      return fmt::format(" -x -a '{}'", replaced(type, "|", " "));
    case ValueKind::anything:
      break;
  }
  return " -x";
}

std::string fish_option(const std::string& condition, const OptionDescription& option) {
  std::string text = "complete -c crt -n " + fish_quoted(condition);
  for (const std::string& name : option.names) {
    const bool is_long = name.starts_with("--");
    text += (is_long ? " -l " : " -s ") + name.substr(is_long ? 2 : 1);
  }
  const std::string value = option.type.empty() ? "" : fish_value(option.type);
  // A value that is given by its place needs no option before it.
  if (option.names.empty() && value == " -x") return "";
  text += option.names.empty() ? replaced(value, " -x", " -f") : value;
  if (!option.names.empty()) text += " -d " + fish_quoted(option.help);
  return text + "\n";
}

}  // namespace

std::string bash_completions(const CommandDescriptions& all) {
  std::vector<std::string> first = option_names(all.main);
  for (const CommandDescription& command : all.commands) first.push_back(command.name);
  std::string text = fmt::format(
      R"(# Completes crt in bash. `crt completions bash` wrote it.
_crt_words() {{
  mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -W "$1" -- "$word")
}}

_crt_files() {{
  compopt -o filenames 2>/dev/null
  mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen "$@" -- "$word")
}}

_crt() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _crt_words '{}'
    return
  fi
  case ${{COMP_WORDS[1]}} in
)",
      fmt::join(first, " "));
  for (const CommandDescription& command : all.commands) text += bash_command(command);
  return text + "  esac\n}\n\ncomplete -F _crt crt\n";
}

std::string zsh_completions(const CommandDescriptions& all) {
  std::string text = R"(#compdef crt
# Completes crt in zsh. `crt completions zsh` wrote it.
_crt() {
  local curcontext=$curcontext state line
  local -a commands
  commands=(
)";
  for (const CommandDescription& command : all.commands)
    text +=
        "    " + shell_quoted(command.name + ":" + replaced(command.about, ":", R"(\:)")) + "\n";
  text += "  )\n  _arguments -C";
  for (const OptionDescription& option : all.main.options) text += " \\\n    " + zsh_option(option);
  text += R"( \
    '1: :->command' '*:: :->rest'
  case $state in
    command) _describe command commands ;;
    rest)
      case $words[1] in
)";
  for (const CommandDescription& command : all.commands) {
    text += fmt::format("        {})\n          _arguments -s", command.name);
    for (const OptionDescription& option : command.options)
      text += " \\\n        " + zsh_option(option);
    text += "\n          ;;\n";
  }
  return text + "      esac\n      ;;\n  esac\n}\n\n_crt \"$@\"\n";
}

std::string fish_completions(const CommandDescriptions& all) {
  std::string text =
      "# Completes crt in fish. `crt completions fish` wrote it.\ncomplete -c crt -f\n";
  for (const OptionDescription& option : all.main.options)
    text += fish_option("__fish_use_subcommand", option);
  for (const CommandDescription& command : all.commands) {
    text += fmt::format("complete -c crt -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        fish_quoted(command.about));
  }
  for (const CommandDescription& command : all.commands) {
    for (const OptionDescription& option : command.options)
      text += fish_option("__fish_seen_subcommand_from " + command.name, option);
  }
  return text;
}

}  // namespace crt::cli
