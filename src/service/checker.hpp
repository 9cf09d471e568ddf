// The checker finds what is wrong with a script while it is typed. It is the front end's own run of
// the script, with low limits.
#pragma once

#include <crt/script.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "service/program.hpp"

namespace crt::service {

/// A longer script is not checked.
constexpr std::size_t longest_checked = std::size_t{1} << 20;

/// Lowers the limits of a script to what takes well under a second.
void lower_limits(ScriptLimits& limits);

/// Returns what is wrong with a script and what it imports. What a low limit ends is no error. A
/// script without Scene and Settings is one for others to import. Pictures and meshes are not read.
std::vector<Diagnostic> check_script(Program& program, ScriptOptions options);

}  // namespace crt::service
