#include "core/accel/embree_device.hpp"

#include <mutex>

#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

thread_local std::int64_t thread_bytes = 0;

[[noreturn]] void fail(RTCError error) {
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw Error(ErrorCode::out_of_memory, "not enough memory for the acceleration structure");
  }
  if (error == RTC_ERROR_UNSUPPORTED_CPU) {
    throw Error(ErrorCode::unsupported, "this processor is too old for Embree");
  }
  throw Error(ErrorCode::internal,
              text::format("Embree failed with error {}", static_cast<int>(error)));
}

[[noreturn]] void fail_to_start(RTCError error) {
  if (error != RTC_ERROR_UNKNOWN) fail(error);
  throw Error(ErrorCode::limit,
              text::format("Embree cannot be started (its error {}). A process can have about 1000"
                           " prepared scenes with thousands of entities at a time; release some",
                           static_cast<int>(error)));
}

}  // namespace

EmbreeDevice::EmbreeDevice() {
#ifdef CRT_TASKS_THREADS
  // ThreadSanitizer does not see how Embree's own threads agree, so that builds for it use one
  // thread.
  device_ = rtcNewDevice("threads=1");
#else
  device_ = rtcNewDevice(nullptr);
#endif
  if (device_ == nullptr) fail_to_start(rtcGetDeviceError(nullptr));
  rtcSetDeviceMemoryMonitorFunction(device_, count_memory, this);
}

EmbreeDevice::~EmbreeDevice() {
  rtcReleaseDevice(device_);
}

void EmbreeDevice::check() const {
  const RTCError error = rtcGetDeviceError(device_);
  if (error != RTC_ERROR_NONE) fail(error);
}

void EmbreeDevice::forget_failure() const {
  rtcGetDeviceError(device_);
}

std::int64_t EmbreeDevice::bytes_of_this_thread() {
  return thread_bytes;
}

/// Counts the memory that Embree takes or, as a negative number, gives back. It returns true, which
/// allows it.
bool EmbreeDevice::count_memory(void* device, ssize_t bytes, bool /*done*/) {
  static_cast<EmbreeDevice*>(device)->bytes_ += bytes;
  thread_bytes += bytes;
  return true;
}

std::shared_ptr<EmbreeDevice> shared_embree_device() {
  // This is the one place that scenes share. The pointer is weak, so that it keeps nothing.
  static std::mutex mutex;
  static std::weak_ptr<EmbreeDevice> shared;
  const std::lock_guard lock(mutex);
  std::shared_ptr<EmbreeDevice> device = shared.lock();
  if (device == nullptr) {
    device = std::make_shared<EmbreeDevice>();
    shared = device;
  }
  return device;
}

}  // namespace crt::core
