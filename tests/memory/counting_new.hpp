// This counts what the program takes from the heap by operator new, which it replaces. It needs a
// test program of its own.
#pragma once

#include <cstdint>

namespace crt::test {

/// Returns how often memory was taken since the program began, on any thread.
std::uint64_t allocations();

/// Returns how many bytes are taken and not yet given back.
std::int64_t bytes_in_use();

}  // namespace crt::test
