// `crt import` translates files of other programs to scripts.
#include "import/import.hpp"

#include <fmt/format.h>

#include <crt/error.hpp>
#include <crt/file.hpp>
#include <system_error>

#include "cli/commands.hpp"
#include "cli/openscad_run.hpp"
#include "cli/reporter.hpp"
#include "cli/script_source.hpp"
#include "format/format.hpp"
#include "text/letters.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;
using importing::ImportOptions;
using importing::ImportResult;

std::string text_of_file(const fs::path& path) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed))
    throw Error(ErrorCode::io, fmt::format("{}: there is no such file", path.string()));
  constexpr std::uintmax_t most_bytes = ScriptLimits{}.source_bytes;
  if (fs::file_size(path, failed) > most_bytes)
    throw Error(ErrorCode::limit,
                fmt::format("{}: it has over {} bytes", path.string(), most_bytes));
  return ScriptSource(path).text();
}

ImportResult translate(const ImportRequest& request) {
  const ImportOptions options{.facets = request.facets,
                              .partial = request.partial,
                              .include_folders = request.include_folders};
  const std::string ending = text::in_small_letters(request.file.extension().string());
  const std::string name = request.file.string();
  if (ending == ".csg") return import_csg(text_of_file(request.file), name, options);
  if (ending == ".scad")
    return import_csg(csg_of_scad(request.file, request.seconds), name, options);
  if (ending == ".pov") return import_pov(text_of_file(request.file), name, options);
  throw Error(ErrorCode::invalid_argument,
              fmt::format("{}: the ending is none that is understood: .csg, .scad, .pov", name));
}

/// Says whether files that a script names are found from the folder of the output.
void warn_of_folder(const ImportRequest& request, const std::string& script, Reporter& reporter) {
  if (script.find("file -> \"") == std::string::npos) return;
  const auto folder = [](const fs::path& path) { return fs::absolute(path).parent_path(); };
  if (!request.output.empty() && folder(request.output) == folder(request.file)) return;
  reporter.warn(
      fmt::format("the script names files that lie beside {}: it finds them from "
                  "another folder with --resources",
                  request.file.string()));
}

void import_one(const ImportRequest& request, Reporter& reporter) {
  std::error_code failed;
  if (fs::equivalent(request.output, request.file, failed))
    throw Error(ErrorCode::invalid_argument,
                "the output is the file itself, which would be lost: give it another name");
  const ImportResult result = translate(request);
  reporter.add(result.diagnostics);
  if (!result.script) return;
  const format::Formatted laid_out = format::format_script(*result.script, request.file.string());
  const std::string script = laid_out.text.value_or(*result.script);
  warn_of_folder(request, script, reporter);
  if (request.output.empty() || request.output == standard_stream) {
    reporter.print(script, Reporter::IfClosed::fails);
  } else {
    write_file(request.output, script);
  }
}

}  // namespace

ExitCode run_import(const ImportRequest& request) {
  Reporter reporter(request);
  try {
    import_one(request, reporter);
  } catch (const Error& error) {
    reporter.add(error);
  }
  return reporter.finish();
}

}  // namespace crt::cli
