#include "core/render/pixel_store.hpp"

#include <new>
#include <type_traits>

#include "core/base/large_pages.hpp"

namespace crt::core {

static_assert(std::is_trivially_copyable_v<PixelSamples> &&
              std::is_trivially_destructible_v<PixelSamples>);

PixelStore::PixelStore(std::size_t count) {
  const std::size_t size = count * sizeof(PixelSamples);
  const std::size_t page = size < large_page ? alignof(PixelSamples) : large_page;
  const std::size_t whole_pages = (size + page - 1) / page * page;
  void* const memory = std::aligned_alloc(page, whole_pages);
  if (memory == nullptr) throw std::bad_alloc();
  ask_for_large_pages(memory, whole_pages);
  samples_.reset(static_cast<PixelSamples*>(memory));
}

}  // namespace crt::core
