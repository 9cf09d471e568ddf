// The fuzzer of the C interface keeps some handles of each kind.
#pragma once

#include <crt/crt.h>

#include <array>
#include <cstdint>

#include "fuzz_input.hpp"

namespace crt::test {

/// Slots hold a few handles of one kind. The newest takes the place of the oldest.
template <class Handle, auto release>
class Slots {
 public:
  ~Slots() {
    for (Handle* handle : slots_) release(handle);
  }

  /// Returns any of them, possibly NULL.
  Handle* any(Input& input) const { return slots_[input.below(count)]; }

  template <class Call>
  void make(const Call& call) {
    Handle* out = nullptr;
    const crt_status status = call(&out);
    require((status == CRT_OK) == (out != nullptr));
    require(crt_error_message() != nullptr);
    if (status == CRT_OK) keep(out);
  }

  void keep(Handle* handle) {
    release(slots_[next_]);
    slots_[next_] = handle;
    next_ = (next_ + 1) % count;
  }

 private:
  static constexpr std::uint32_t count = 6;
  std::array<Handle*, count> slots_{};
  std::uint32_t next_ = 0;
};

}  // namespace crt::test
