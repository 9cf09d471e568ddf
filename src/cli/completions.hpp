// These functions write the scripts by which shells complete `crt`: commands, options, and files,
// folders or choices where a value is one.
#pragma once

#include <string>

#include "cli/command_description.hpp"

namespace crt::cli {

std::string bash_completions(const CommandDescriptions& all);
std::string zsh_completions(const CommandDescriptions& all);
std::string fish_completions(const CommandDescriptions& all);

}  // namespace crt::cli
