// What a machine has memory for bounds what a scene may take.
#pragma once

#include <cstdint>

namespace crt::core {

/// Returns the bytes that a process may have. The limits are those of the machine, of its container
/// (Linux's control groups, of either version) and of itself, whichever is the lowest.
std::uint64_t memory_limit();

}  // namespace crt::core
