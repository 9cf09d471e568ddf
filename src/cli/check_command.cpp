#include <fmt/format.h>

#include <algorithm>
#include <crt/prepared_scene.hpp>

#include "cli/commands.hpp"
#include "cli/reporter.hpp"

namespace crt::cli {

ExitCode run_check(const CheckRequest& request) {
  Reporter reporter(request);
  const bool tells_verdict = !request.quiet && request.diagnostics == DiagnosticsFormat::text;
  for (const std::filesystem::path& path : request.scenes) {
    const ScriptResult result = run_script_file(path, request.script);
    reporter.add(result.diagnostics);
    if (!result.scene) continue;
    try {
      const PreparedScene prepared = prepare(*result.scene);
      for (const std::string& warning : prepared.warnings()) {
        reporter.add({Diagnostic{
            .severity = Severity::warning, .message = warning, .place = {.file = path.string()}}});
      }
      if (tells_verdict) reporter.print(fmt::format("{}: no errors\n", path.string()));
    } catch (const Error& error) {
      reporter.add(error.code(), fmt::format("{}: {}", path.string(), error.what()),
                   ExitCode::script);
    }
  }
  return reporter.finish();
}

}  // namespace crt::cli
