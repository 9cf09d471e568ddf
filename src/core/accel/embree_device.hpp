// Embree makes its trees in devices, which small trees share.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "core/accel/embree_compat.hpp"

namespace crt::core {

/// An EmbreeDevice is what Embree makes trees in. A process can have about 1000 of them, as each
/// takes one of the keys for what belongs to a thread (PTHREAD_KEYS_MAX).
class EmbreeDevice {
 public:
  /// Throws if Embree cannot make one.
  EmbreeDevice();
  ~EmbreeDevice();
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  RTCDevice handle() const { return device_; }

  /// Throws if a call that this thread has made since the last check has failed.
  void check() const;
  /// Forgets whether such a call has failed.
  void forget_failure() const;

  /// Returns the bytes of memory that all in it takes.
  std::int64_t bytes() const { return bytes_; }
  /// Returns the bytes that this thread has taken in any device, less what it has given back. The
  /// difference between two calls is what the calls of Embree in between took in this thread.
  static std::int64_t bytes_of_this_thread();

 private:
  static bool count_memory(void* device, ssize_t bytes, bool done);

  RTCDevice device_ = nullptr;
  std::atomic<std::int64_t> bytes_ = 0;
};

/// Returns the device of the small trees. All that are alive share it, and it ends with the last
/// one: between scenes there is nothing.
std::shared_ptr<EmbreeDevice> shared_embree_device();

}  // namespace crt::core
