// `crt export` writes the scene of a script as source code.
#include <fmt/format.h>

#include <crt/file.hpp>
#include <crt/source_code.hpp>

#include "cli/commands.hpp"
#include "cli/picture_renderer.hpp"
#include "cli/reporter.hpp"

namespace crt::cli {

namespace {

/// Returns what was asked for, or what the ending of the output's name says.
SourceLanguage language_of(const ExportRequest& request) {
  if (request.language) return *request.language;
  const std::string ending = request.output.extension().string();
  if (ending == ".py") return SourceLanguage::python;
  return ending == ".c" ? SourceLanguage::c : SourceLanguage::cpp;
}

SourceCode code_of(const Scene& scene, const ExportRequest& request) {
  const SourceOptions options{.language = language_of(request)};
  if (!request.entity) return source_code(scene, options);
  const auto place = static_cast<std::size_t>(*request.entity);
  if (place < scene.entities.size()) return source_code(scene.entities[place], options);
  throw Error(ErrorCode::invalid_argument,
              fmt::format("there is no entity {}: the scene has {}, which count from 0", place,
                          scene.entities.size()));
}

void write_code(const ExportRequest& request, Reporter& reporter) {
  const bool to_stream = request.output.empty() || request.output == standard_stream;
  const ScriptResult result = run_scene(ScriptSource(request.scene, request.script.limits),
                                        request.script, !to_stream, reporter);
  if (!result.scene) return;
  const SourceCode code = code_of(*result.scene, request);
  for (const std::string& warning : code.warnings) reporter.warn(warning);
  if (to_stream) {
    reporter.print(code.text, Reporter::IfClosed::fails);
  } else {
    write_file(request.output, code.text);
  }
}

}  // namespace

ExitCode run_export(const ExportRequest& request) {
  Reporter reporter(request);
  try {
    write_code(request, reporter);
  } catch (const Error& error) {
    // What no code can be written of is in the script.
    if (error.code() == ErrorCode::unsupported) {
      reporter.add(error.code(), error.what(), ExitCode::script);
    } else {
      reporter.add(error);
    }
  }
  return reporter.finish();
}

}  // namespace crt::cli
