// Memory for what is kept of all pixels' samples.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <span>

#include "core/sampling/pixel_samples.hpp"

namespace crt::core {

/// In large pages where the system has them: to be given small ones takes as long as a few rays through each
/// pixel. Nothing is written there, so that each thread may be given the pages that it needs.
class PixelStore {
 public:
  /// Throws std::bad_alloc.
  explicit PixelStore(std::size_t count);

  /// The samples of `count` pixels, which are to be constructed.
  std::span<PixelSamples> part(std::size_t first, std::size_t count) {
    return {samples_.get() + first, count};
  }

 private:
  struct Free {
    void operator()(PixelSamples* memory) const { std::free(memory); }
  };
  std::unique_ptr<PixelSamples, Free> samples_;
};

}  // namespace crt::core
