// libFuzzer gives any bytes as a scene of POV-Ray, behind a first byte that chooses the options.
// What comes out is a script or an error, and the script has run.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "import/import.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const crt::importing::ImportOptions options{.partial = (data[0] & 1U) != 0};
  const crt::importing::ImportResult result = crt::importing::import_pov(
      {reinterpret_cast<const char*>(data) + 1, size - 1}, "fuzz.pov", options);
  if (!result.script && result.diagnostics.empty()) __builtin_trap();
  return 0;
}
