#include "core/base/large_pages.hpp"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace crt::core {

void ask_for_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t size) {
#ifdef __linux__
  auto* const begin = static_cast<std::byte*>(memory);
  const std::size_t before = -reinterpret_cast<std::uintptr_t>(memory) % large_page;
  if (size < before + large_page) return;
  madvise(begin + before, (size - before) / large_page * large_page, MADV_HUGEPAGE);
#endif
}

}  // namespace crt::core
