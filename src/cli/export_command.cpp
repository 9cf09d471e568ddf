// `crt export` writes the scene of a script as source code.
#include <fmt/format.h>

#include <crt/source_code.hpp>
#include <filesystem>
#include <system_error>

#include "cli/commands.hpp"
#include "cli/export_mesh.hpp"
#include "cli/picture_renderer.hpp"
#include "cli/reporter.hpp"

namespace crt::cli {

namespace {

/// Returns what was asked for, or what the ending of the output's name says.
SourceLanguage language_of(const ExportRequest& request) {
  if (request.language) return *request.language;
  const std::string ending = request.output.extension().string();
  if (ending == ".py") return SourceLanguage::python;
  if (ending == ".crt") return SourceLanguage::script;
  return ending == ".c" ? SourceLanguage::c : SourceLanguage::cpp;
}

SourceCode code_of(const Scene& scene, const ExportRequest& request) {
  SourceOptions options{.language = language_of(request)};
  if (request.output.has_stem()) options.name = request.output.stem().string();
  if (!request.entity) return source_code(scene, options);
  const auto place = static_cast<std::size_t>(*request.entity);
  if (place < scene.entities.size()) return source_code(scene.entities[place], options);
  throw Error(ErrorCode::invalid_argument,
              fmt::format("there is no entity {}: the scene has {}, which count from 0", place,
                          scene.entities.size()));
}

void check_output(const ExportRequest& request) {
  std::error_code failed;
  if (std::filesystem::equivalent(request.output, request.scene, failed)) {
    throw Error(ErrorCode::invalid_argument,
                "the output is the script itself, which would be lost: give it another name");
  }
}

void write_code(const ExportRequest& request, Reporter& reporter) {
  const bool to_stream = request.output.empty() || request.output == standard_stream;
  check_output(request);
  const ScriptResult result = run_scene(ScriptSource(request.scene, request.script.limits),
                                        request.script, !to_stream, reporter);
  if (!result.scene) return;
  if (writes_mesh(request)) return export_mesh(*result.scene, request, reporter);
  if (request.deviation || request.seconds)
    throw Error(ErrorCode::invalid_argument,
                "--deviation and --seconds are for meshes: give the output an ending such as .stl "
                "or .3mf");
  const SourceCode code = code_of(*result.scene, request);
  for (const std::string& warning : code.warnings) reporter.warn(warning);
  if (to_stream && !code.files.empty()) {
    throw Error(ErrorCode::invalid_argument,
                "the meshes and images of this scene go into files beside the script: give the "
                "script a name with -o");
  }
  if (to_stream) {
    reporter.print(code.text, Reporter::IfClosed::fails);
  } else {
    write_source_code(code, request.output);
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
