// This fuzzer runs any script. It ends within its limits, in a scene or in errors, and reaches no
// file.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "crt/script.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

crt::ScriptOptions small_world() {
  crt::ScriptOptions options;
  options.limits = {.steps = 5'000,
                    .entities = 1'000,
                    .call_depth = 100,
                    .list_length = 10'000,
                    .string_bytes = 100'000,
                    .memory_bytes = 4 << 20,
                    .source_bytes = 1 << 20,
                    .errors = 20};
  // Every file that exists holds a script that is short. None is asked of the file system.
  options.open_file = [](const std::filesystem::path&) {
    const std::string_view text = "imported = 1 import \"again.crt\"";
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return std::vector<std::byte>(begin, begin + text.size());
  };
  options.print = [](std::string_view) {};
  return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const crt::ScriptResult result = crt::run_script(text, "fuzz.crt", small_world());
  bool has_error = false;
  for (const crt::Diagnostic& diagnostic : result.diagnostics) {
    has_error = has_error || diagnostic.severity == crt::Severity::error;
    require(diagnostic.code != crt::ErrorCode::internal);
    require(!crt::format_diagnostic(diagnostic).empty());
  }
  require(result.scene.has_value() != has_error);
  return 0;
}
