#include "studio/place_text.hpp"

#include <algorithm>
#include <filesystem>

namespace crt::studio {

std::string place_text(const SourcePlace& place, const std::string& script) {
  const std::string line = std::to_string(place.line);
  if (place.file == script) return "line " + line;
  const std::filesystem::path file(place.file);
  const std::filesystem::path relative =
      file.lexically_relative(std::filesystem::path(script).parent_path());
  return (relative.empty() ? file : relative).string() + ":" + line;
}

std::string first_error(const std::vector<Diagnostic>& diagnostics, const std::string& script) {
  const auto error =
      std::find_if(diagnostics.begin(), diagnostics.end(),
                   [](const Diagnostic& found) { return found.severity == Severity::error; });
  if (error == diagnostics.end()) return "the script has errors";
  return place_text(error->place, script) + ": " + error->message;
}

}  // namespace crt::studio
