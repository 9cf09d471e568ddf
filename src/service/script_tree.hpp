// The tree of a script as property sheets want it: objects with their attributes, and
// the statements and combinations that lead to them.
#pragma once

#include <crt/language_service.hpp>
#include <vector>

#include "service/program.hpp"

namespace crt::service {

/// Lists the nodes of the main script. Each comes behind the node around it.
std::vector<ScriptNode> tree_of(const Program& program);

}  // namespace crt::service
