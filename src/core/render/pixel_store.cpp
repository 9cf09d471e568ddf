#include "core/render/pixel_store.hpp"

#include <new>
#include <type_traits>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace crt::core {

static_assert(std::is_trivially_copyable_v<PixelSamples> &&
              std::is_trivially_destructible_v<PixelSamples>);

PixelStore::PixelStore(std::size_t count) {
  constexpr std::size_t large_page = std::size_t{1} << 21;
  const std::size_t size = count * sizeof(PixelSamples);
  const std::size_t page = size < large_page ? alignof(PixelSamples) : large_page;
  const std::size_t whole_pages = (size + page - 1) / page * page;
  void* const memory = std::aligned_alloc(page, whole_pages);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
  if (page == large_page)
    madvise(memory, whole_pages, MADV_HUGEPAGE);  // where it fails, nothing is lost
#endif
  samples_.reset(static_cast<PixelSamples*>(memory));
}

}  // namespace crt::core
