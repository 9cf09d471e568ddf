// The message that tells a page what the tokens and the tree of a script are.
#pragma once

#include <string>

#include "studio/analyst.hpp"

namespace crt::studio {

/// Returns the message. It comes with each key stroke and is some ten times as long as the script,
/// so it is written without an object of the JSON library for each of its parts.
std::string analysis_message(const Analysis& analysis);

}  // namespace crt::studio
