// The tokens of a script with what each is, as the front end knows it.
#pragma once

#include <crt/language_service.hpp>
#include <vector>

#include "service/program.hpp"

namespace crt::service {

/// Lists the tokens and comments of the main script in their order.
std::vector<ScriptToken> tokens_of(const Program& program);

}  // namespace crt::service
