// The commands and their options, as shell completions and the manual page need them. options.cpp
// describes what it parses by, so that nothing is described that is not there, or left out.
#pragma once

#include <string>
#include <vector>

namespace crt::cli {

struct OptionDescription {
  std::vector<std::string> names;  ///< with their dashes; none for what is given by its place
  std::string type;                ///< what its value is called; empty for a flag
  std::string help;
  std::string group;  ///< the heading that it stands under; empty for the first
  bool repeatable = false;
};

struct CommandDescription {
  std::string name;
  std::string about;   ///< a line
  std::string footer;  ///< lines that follow the options in its help
  std::vector<OptionDescription> options;
};

struct CommandDescriptions {
  CommandDescription main;  ///< crt itself
  std::vector<CommandDescription> commands;
};

/// Says what may stand for a value.
enum class ValueKind { anything, file, folder, script, choice };

/// Returns the kind of value that has this type: FILE, FOLDER, SCENE.crt, or choices as "a|b".
ValueKind value_kind(const std::string& type);

/// Returns the choices of a type "a|b".
std::vector<std::string> choices_of(const std::string& type);

}  // namespace crt::cli
