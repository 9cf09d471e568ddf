// Memory that is looked at here and there is better in large pages: the processor finds these
// faster.
#pragma once

#include <cstddef>

namespace crt::core {

inline constexpr std::size_t large_page = std::size_t{1} << 21;

/// Asks for large pages for what of them is within some memory that has not been written yet. Where
/// that fails, nothing is lost.
void ask_for_large_pages(void* memory, std::size_t size);

}  // namespace crt::core
