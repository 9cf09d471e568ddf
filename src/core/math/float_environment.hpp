// All of the library's guarantees hold in the floating-point mode that this file sets.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace crt::core {

#if defined(__SSE2__)
using FloatMode = unsigned;  // MXCSR

inline FloatMode float_mode() {
  return _mm_getcsr();
}
/// Sets the mode if it differs, as reading it is much cheaper than writing it.
inline void set_float_mode(FloatMode mode) {
  if (_mm_getcsr() != mode) _mm_setcsr(mode);
}
inline void set_ieee_float_mode() {
  constexpr FloatMode after_reset = 0x1f80;  // Intel SDM vol. 1, 10.2.3
  constexpr FloatMode exception_flags = 0x3f;
  if ((_mm_getcsr() & ~exception_flags) != after_reset) _mm_setcsr(after_reset);
}
#else
using FloatMode = std::fenv_t;

inline FloatMode float_mode() {
  FloatMode mode;
  std::fegetenv(&mode);
  return mode;
}
inline void set_float_mode(const FloatMode& mode) {
  std::fesetenv(&mode);
}
inline void set_ieee_float_mode() {
  std::fesetenv(FE_DFL_ENV);
}
#endif

/// While a FloatEnvironment lives, its thread rounds to nearest, keeps subnormal numbers and masks
/// all exceptions, as IEEE 754 has it by default. Its end restores the host's mode, with the host's
/// exception flags. Hosts such as audio and game engines set other modes.
class FloatEnvironment {
 public:
  FloatEnvironment() : saved_(float_mode()) {
    if (outermost_ == nullptr) outermost_ = this;
    set_ieee_float_mode();
  }
  ~FloatEnvironment() {
    if (outermost_ == this) outermost_ = nullptr;
    set_float_mode(saved_);
  }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
  friend class HostFloatEnvironment;

  FloatMode saved_;
  inline static thread_local const FloatEnvironment* outermost_ = nullptr;
};

/// While a HostFloatEnvironment lives, its thread is in the mode that it had before any
/// FloatEnvironment. The host's callbacks run in that mode.
class HostFloatEnvironment {
 public:
  HostFloatEnvironment() : saved_(float_mode()), outermost_(FloatEnvironment::outermost_) {
    if (outermost_ != nullptr) set_float_mode(outermost_->saved_);
    FloatEnvironment::outermost_ = nullptr;
  }
  ~HostFloatEnvironment() {
    FloatEnvironment::outermost_ = outermost_;
    set_float_mode(saved_);
  }
  HostFloatEnvironment(const HostFloatEnvironment&) = delete;
  HostFloatEnvironment& operator=(const HostFloatEnvironment&) = delete;

 private:
  FloatMode saved_;
  const FloatEnvironment* outermost_;
};

}  // namespace crt::core
