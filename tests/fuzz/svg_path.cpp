// libFuzzer gives any bytes as an SVG path, behind a first byte that chooses the fill rule and the
// deviation. Whatever contours come out, a profile takes them or says why not.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "crt/error.hpp"
#include "crt/svg_path.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  crt::PathOptions options;
  if ((data[0] & 1U) != 0) options.fill = crt::FillRule::even_odd;
  if ((data[0] & 2U) != 0) options.deviation = 1e-3;
  std::uint64_t done = 0;
  options.work = [&](std::uint64_t work) {
    done += work;
    constexpr std::uint64_t enough = 50'000'000;
    if (done > enough) throw crt::Error(crt::ErrorCode::cancelled, "enough");
  };
  try {
    crt::profile_from_svg_path({reinterpret_cast<const char*>(data) + 1, size - 1}, options);
  } catch (const crt::Error& error) {
    if (error.code() == crt::ErrorCode::internal) __builtin_trap();
  }
  return 0;
}
