// Completion offers what the grammar takes at the cursor: the parser itself is asked. Names are
// those that can be seen there, attributes those that the object has and that are not set yet.
#pragma once

#include <crt/language_service.hpp>
#include <crt/script.hpp>
#include <cstdint>

#include "service/program.hpp"
#include "service/reference.hpp"

namespace crt::service {
/// Returns what may come at a byte of the main script.
CompletionList complete(const Program& program, std::uint32_t byte, const ScriptOptions& options,
                        const Reference& reference);

}  // namespace crt::service
