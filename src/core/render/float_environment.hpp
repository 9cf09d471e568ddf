// The floating-point mode in which all of the library's guarantees hold.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace crt::core {

/// While it lives, this thread rounds to nearest, keeps subnormal numbers and masks all exceptions, as
/// IEEE 754 has it by default; then the host's mode (and its exception flags) are back. Hosts such as
/// audio and game engines set other modes.
class FloatEnvironment {
 public:
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

#if defined(__SSE2__)
  FloatEnvironment() : saved_(_mm_getcsr()) {
    constexpr unsigned ieee_default = 0x1f80;  // Intel SDM vol. 1, 10.2.3: MXCSR after reset
    _mm_setcsr(ieee_default);
  }
  ~FloatEnvironment() {
    _mm_setcsr(saved_);
  }

 private:
  unsigned saved_;
#else
  FloatEnvironment() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatEnvironment() {
    std::fesetenv(&saved_);
  }

 private:
  std::fenv_t saved_;
#endif
};

}  // namespace crt::core
