// This file implements scripts through the C interface, and their diagnostics.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "capi/structs.hpp"
#include "crt/mesh_file.hpp"
#include "crt/script.hpp"
#include "text/format.hpp"

namespace crt::capi {

namespace {

std::span<const char* const> texts(const char* const* first, std::uint64_t count,
                                   const char* argument) {
  if (count == 0) return {};
  require(first, argument);
  const std::span all(first, static_cast<std::size_t>(count));
  for (const char* text : all) require(text, argument);
  return all;
}

std::vector<std::pair<std::string, std::string>> pairs(const char* const* names,
                                                       const char* const* values,
                                                       std::uint64_t count,
                                                       const char* names_argument,
                                                       const char* values_argument) {
  const auto first = texts(names, count, names_argument);
  const auto second = texts(values, count, values_argument);
  std::vector<std::pair<std::string, std::string>> result;
  for (std::size_t i = 0; i < first.size(); ++i) result.emplace_back(first[i], second[i]);
  return result;
}

/// Sets a limit, unless the value is 0.
template <class Limit>
void take_limit(Limit& limit, std::uint64_t given) {
  if (given != 0) limit = static_cast<Limit>(given);
}

void take_callbacks(ScriptOptions& options, const crt_script_options& given) {
  if (given.print != nullptr) {
    options.print = [call = given.print, user = given.print_user](std::string_view line) {
      const int answer = call(std::string(line).c_str(), line.size(), user);
      if (answer != 0) throw CancelledByCallback{answer};
    };
  }
  if (given.open_file != nullptr) {
    options.open_file =
        [call = given.open_file, user = given.open_file_user](
            const std::filesystem::path& path) -> std::optional<std::vector<std::byte>> {
      crt_file_content content;
      const int answer = call(path.c_str(), &content, user);
      if (answer == CRT_FILE_NOT_GIVEN) return std::nullopt;
      if (answer != CRT_FILE_GIVEN) throw CancelledByCallback{answer};
      return std::move(content.bytes);
    };
  }
  if (given.poll != nullptr) {
    options.go_on = [call = given.poll, user = given.poll_user] {
      const int answer = call(user);
      if (answer != 0) set_cancel_value(answer);
      return answer == 0;
    };
  }
}

}  // namespace

ScriptOptions to_options(const crt_script_options* options) {
  const auto given = taken_or_default(options, "options");
  ScriptOptions result;
  for (const char* directory :
       texts(given.resource_directories, given.resource_directory_count, "resource_directories")) {
    result.resource_directories.emplace_back(directory);
  }
  result.allow_outside_files = given.allow_outside_files != 0;
  if (!std::isfinite(given.t)) reject("t", "must be finite");
  result.t = given.t;
  result.variables = pairs(given.variable_names, given.variable_values, given.variable_count,
                           "variable_names", "variable_values");
  result.settings = pairs(given.setting_names, given.setting_values, given.setting_count,
                          "setting_names", "setting_values");
  take_limit(result.limits.steps, given.max_steps);
  take_limit(result.limits.entities, given.max_entities);
  take_limit(result.limits.call_depth, given.max_call_depth);
  take_limit(result.limits.list_length, given.max_list_length);
  take_limit(result.limits.string_bytes, given.max_string_bytes);
  take_limit(result.limits.memory_bytes, given.max_memory_bytes);
  take_limit(result.limits.source_bytes, given.max_source_bytes);
  take_limit(result.limits.errors, given.max_errors);
  take_limit(result.limits.image_pixels, given.max_image_pixels);
  take_callbacks(result, given);
  if (given.compat != 0 && given.compat != compat_2015) reject("compat", "must be 0 or 2015");
  result.compat = given.compat;
  return result;
}

namespace {

/// Returns what kind of error a script has. A value in it that is out of range is no wrong argument
/// of the C caller.
ErrorCode script_code(ErrorCode code) {
  return code == ErrorCode::invalid_argument ? ErrorCode::script : code;
}

/// Returns the text of the error that decided the script's status, on one line.
Error error_of(const std::vector<Diagnostic>& diagnostics) {
  const auto first = std::find_if(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& d) {
    return d.severity == Severity::error;
  });
  if (first == diagnostics.end()) return {ErrorCode::internal, "the script failed without a word"};
  const SourcePlace& place = first->place;
  return {script_code(first->code),
          place.line == 0
              ? text::format("{}: {}", place.file, first->message)
              : text::format("{}:{}:{}: {}", place.file, place.line, place.column, first->message)};
}

/// Hands out the diagnostics, then the scene or the error.
void hand_out(ScriptResult result, crt_diagnostics** diagnostics, crt_scene** out) {
  std::unique_ptr<crt_scene> scene;
  std::optional<Error> error;
  if (result.scene) {
    scene = std::make_unique<crt_scene>();
    scene->value = std::move(*result.scene);
  } else {
    error = error_of(result.diagnostics);
  }
  if (diagnostics != nullptr) *diagnostics = new crt_diagnostics(std::move(result.diagnostics));
  if (error) throw Error(*error);
  *out = scene.release();
}

const Diagnostic& diagnostic_at(const crt_diagnostics* diagnostics, std::size_t index) {
  require(diagnostics, "diagnostics");
  const std::size_t count = diagnostics->list.size();
  if (index >= count) reject("index", text::format("is {}, but there are only {}", index, count));
  return diagnostics->list[index];
}

}  // namespace

template <>
crt_diagnostic defaults<crt_diagnostic>() {
  return {};
}

template <>
crt_diagnostic_call defaults<crt_diagnostic_call>() {
  return {};
}

}  // namespace crt::capi

using namespace crt::capi;

crt_diagnostics::crt_diagnostics(std::vector<crt::Diagnostic> new_list)
    : list(std::move(new_list)) {
  for (const crt::Diagnostic& diagnostic : list) text += crt::format_diagnostic(diagnostic);
  json = crt::diagnostics_to_json(list);
}

crt_status crt_file_content_append(crt_file_content* content, const void* bytes, size_t count) {
  return guarded([&] {
    require(content, "content");
    if (count == 0) return;
    require(bytes, "bytes");
    const auto* const first = static_cast<const std::byte*>(bytes);
    content->bytes.insert(content->bytes.end(), first, first + count);
  });
}

crt_status crt_scene_from_script(const char* text, size_t length, const char* name,
                                 const crt_script_options* options, crt_diagnostics** diagnostics,
                                 crt_scene** out) {
  return guarded([&] {
    if (length > 0) require(text, "text");
    require(name, "name");
    require(out, "out");
    const std::string_view script =
        length == 0 ? std::string_view() : std::string_view(text, length);
    hand_out(crt::run_script(script, name, to_options(options)), diagnostics, out);
  });
}

crt_status crt_scene_from_script_file(const char* path, const crt_script_options* options,
                                      crt_diagnostics** diagnostics, crt_scene** out) {
  return guarded([&] {
    require(path, "path");
    require(out, "out");
    hand_out(crt::run_script_file(path, to_options(options)), diagnostics, out);
  });
}

crt_status crt_mesh_load(const char* path, const crt_script_options* options, crt_entity** out) {
  constexpr double as_the_file_has_it = -1;
  return crt_mesh_load_smooth(path, options, as_the_file_has_it, out);
}

crt_status crt_mesh_load_smooth(const char* path, const crt_script_options* options, double smooth,
                                crt_entity** out) {
  return crt_mesh_load_with(path, options, smooth, nullptr, out);
}

crt_status crt_mesh_load_with(const char* path, const crt_script_options* options, double smooth,
                              const crt_mesh_options* mesh, crt_entity** out) {
  return create(out, [&] {
    require(path, "path");
    if (!(smooth <= std::numbers::pi)) reject("smooth", "must be an angle of at most pi");
    const std::optional<double> angle = smooth < 0 ? std::nullopt : std::optional(smooth);
    const crt::MeshOptions way = to_mesh_options(mesh);
    return options == nullptr ? crt::load_mesh(path, angle, way)
                              : crt::load_mesh(path, to_options(options), angle, way);
  });
}

size_t crt_diagnostics_count(const crt_diagnostics* diagnostics) {
  return diagnostics == nullptr ? 0 : diagnostics->list.size();
}

crt_status crt_diagnostics_get(const crt_diagnostics* diagnostics, size_t index,
                               crt_diagnostic* diagnostic) {
  return guarded([&] {
    const crt::Diagnostic& source = diagnostic_at(diagnostics, index);
    crt_diagnostic values{};
    values.severity =
        source.severity == crt::Severity::error ? CRT_SEVERITY_ERROR : CRT_SEVERITY_WARNING;
    values.status = to_status(script_code(source.code));
    values.line = source.place.line;
    values.column = source.place.column;
    values.length = source.place.length;
    values.message = source.message.c_str();
    values.file = source.place.file.c_str();
    values.source_line = source.source_line.c_str();
    values.call_count = source.calls.size();
    fill_in(diagnostic, "diagnostic", values);
  });
}

crt_status crt_diagnostics_get_call(const crt_diagnostics* diagnostics, size_t index,
                                    size_t call_index, crt_diagnostic_call* call) {
  return guarded([&] {
    const crt::Diagnostic& source = diagnostic_at(diagnostics, index);
    if (call_index >= source.calls.size()) {
      reject("call_index",
             crt::text::format("is {}, but there are only {}", call_index, source.calls.size()));
    }
    const auto& [name, place] = source.calls[call_index];
    crt_diagnostic_call values{};
    values.line = place.line;
    values.column = place.column;
    values.name = name.c_str();
    values.file = place.file.c_str();
    fill_in(call, "call", values);
  });
}

const char* crt_diagnostics_text(const crt_diagnostics* diagnostics) {
  return diagnostics == nullptr ? "" : diagnostics->text.c_str();
}

const char* crt_diagnostics_json(const crt_diagnostics* diagnostics) {
  return diagnostics == nullptr ? "[]" : diagnostics->json.c_str();
}
