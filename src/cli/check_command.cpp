#include <fmt/format.h>

#include <crt/prepared_scene.hpp>

#include "cli/commands.hpp"
#include "cli/reporter.hpp"
#include "cli/script_source.hpp"

namespace crt::cli {

namespace {

void check(const ScriptSource& script, const CheckRequest& request, Reporter& reporter) {
  const ScriptResult result = script.run(request.script);
  reporter.add(result.diagnostics);
  if (!result.scene) return;
  try {
    const PreparedScene prepared = prepare(*result.scene);
    for (const std::string& warning : prepared.warnings()) {
      reporter.add({Diagnostic{
          .severity = Severity::warning, .message = warning, .place = {.file = script.name()}}});
    }
    const bool tells_verdict = !request.quiet && request.diagnostics == DiagnosticsFormat::text;
    if (tells_verdict) reporter.print(fmt::format("{}: no errors\n", script.name()));
  } catch (const Error& error) {
    reporter.add(error.code(), fmt::format("{}: {}", script.name(), error.what()),
                 ExitCode::script);
  }
}

}  // namespace

ExitCode run_check(const CheckRequest& request) {
  Reporter reporter(request);
  for (const std::filesystem::path& path : request.scenes) {
    try {
      check(ScriptSource(path, request.script.limits), request, reporter);
    } catch (const Error& error) {
      reporter.add(error);
    }
  }
  return reporter.finish();
}

}  // namespace crt::cli
