#include "crt/version.hpp"

namespace crt {

const char* version() noexcept {
  return CRT_VERSION;
}

}  // namespace crt
