// A PixelStore is memory for what is kept of all pixels' samples.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <span>

#include "core/sampling/pixel_samples.hpp"

namespace crt::core {

/// It has large pages where the system offers them, as getting small ones takes as long as a few
/// rays through each pixel. Nothing is written there, so what is never taken costs nothing.
class PixelStore {
 public:
  /// Allocates for so many pixels together. Throws std::bad_alloc.
  explicit PixelStore(std::size_t count);

  /// Returns the samples of `count` pixels that nobody else has. They are to be constructed. It may
  /// be called from any thread.
  std::span<PixelSamples> take(std::size_t count) {
    return {samples_.get() + taken_.fetch_add(count, std::memory_order_relaxed), count};
  }

 private:
  struct Free {
    void operator()(PixelSamples* memory) const { std::free(memory); }
  };
  std::unique_ptr<PixelSamples, Free> samples_;
  std::atomic<std::size_t> taken_ = 0;
};

}  // namespace crt::core
