// A scene of POV-Ray becomes a script.
#include <crt/error.hpp>
#include <utility>

#include "import/import.hpp"
#include "import/pov_scene.hpp"
#include "import/scene_text.hpp"

namespace crt::importing {

namespace {

/// Says with a script's own message if it has an error.
void check_script(const std::string& script, const std::string& name) {
  const ScriptResult result = run_script(script, name);
  if (result.scene) return;
  for (const Diagnostic& diagnostic : result.diagnostics) {
    if (diagnostic.severity != Severity::error) continue;
    throw Error(ErrorCode::unsupported, "the script that was made has an error: " +
                                            diagnostic.message + ": " + diagnostic.source_line);
  }
  throw Error(ErrorCode::internal, "the script that was made has an error");
}

std::string script_of_scene(const PovScene& scene, ScriptWriter& writer, const std::string& name) {
  for (const SharedSolid& solid : scene.solids()) writer.count(solid);
  std::string shown = "\nScene {\n";
  for (const SharedSolid& solid : scene.solids())
    shown += "    " + indented_text(writer.write(solid), 4) + "\n";
  std::string script = heading_of(name) + scene.settings();
  const std::string materials = writer.materials_of(writer.definitions() + shown);
  if (!materials.empty()) script += "\n" + materials;
  if (!writer.definitions().empty()) script += "\n" + writer.definitions();
  script += shown + "}\n";
  check_script(script, name);
  return script;
}

}  // namespace

ImportResult import_pov(std::string_view text, const std::string& name,
                        const ImportOptions& options) {
  Notes notes(options.partial);
  ImportResult result;
  try {
    ScriptWriter writer;
    PovScene scene(notes, writer, options);
    scene.read(name, std::string(text));
    if (!notes.has_errors()) result.script = script_of_scene(scene, writer, name);
  } catch (const Failure& failure) {
    notes.failed(failure);
  } catch (const Error& error) {
    notes.failed(Failure(Place{}, error.what(), error.code()));
  }
  result.diagnostics = notes.take();
  return result;
}

}  // namespace crt::importing
