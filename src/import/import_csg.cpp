// A .csg file becomes a script.
#include <algorithm>
#include <crt/error.hpp>
#include <functional>
#include <utility>

#include "import/import.hpp"
#include "import/openscad.hpp"
#include "import/scene_text.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

/// OpenSCAD's z is up and its y leads away, so these two are exchanged.
const std::vector<std::string>& frame_of_openscad() {
  static const std::vector<std::string> modifiers{"rotate vec3(-90, 0, 0)", "scale vec3(1, 1, -1)"};
  return modifiers;
}

/// Finds the node that a '!' makes the root, if there is one.
const CsgNode* root_of(const std::vector<CsgNode>& nodes) {
  for (const CsgNode& node : nodes) {
    if (node.modifier == '!') return &node;
    if (const CsgNode* const root = root_of(node.children)) return root;
  }
  return nullptr;
}

/// Lists what is shown beside the part, with what places it.
void find_ghosts(const std::vector<CsgNode>& nodes, std::vector<const CsgNode*>& path,
                 const std::function<void(const CsgNode&)>& found) {
  for (const CsgNode& node : nodes) {
    if (node.modifier == '*') continue;
    if (node.modifier == '%') {
      found(node);
      continue;
    }
    path.push_back(&node);
    find_ghosts(node.children, path, found);
    path.pop_back();
  }
}

SharedSolid ghosts_of(const std::vector<CsgNode>& nodes, OpenScad& scad) {
  std::vector<SharedSolid> ghosts;
  std::vector<const CsgNode*> path;
  find_ghosts(nodes, path, [&](const CsgNode& node) {
    SharedSolid ghost = dimension_of(node) == 2 ? nullptr : scad.solid(node, true);
    for (auto above = path.rbegin(); above != path.rend(); ++above) {
      if ((*above)->name != "multmatrix") continue;
      const auto matrix = matrix_of(**above);
      if (matrix && determinant(*matrix) != 0)
        ghost = make_changed(ghost, modifiers_of(*matrix, csg_digits));
    }
    ghosts.push_back(ghost);
  });
  return make_sum(std::move(ghosts));
}

std::vector<const CsgNode*> top_of(const std::vector<CsgNode>& nodes) {
  CsgNode all;
  std::vector<const CsgNode*> top;
  if (const CsgNode* const root = root_of(nodes)) return {root};
  for (const CsgNode& node : nodes)
    if (node.modifier != '%' && node.modifier != '*') top.push_back(&node);
  return top;
}

/// Draws out flat things by 1, as OpenSCAD shows them, if the file has nothing else.
SharedSolid flat_part(const std::vector<const CsgNode*>& top, OpenScad& scad, Notes& notes) {
  notes.differs(top.front()->place,
                "this file is flat: it is drawn out by 1, as OpenSCAD's preview shows it");
  std::vector<SharedSolid> parts;
  parts.reserve(top.size());
  for (const CsgNode* const node : top) parts.push_back(scad.extruded(*node, 1));
  return make_sum(std::move(parts));
}

constexpr const char* plain_material = "Material { color -> srgb(\"#f9d72c\") specular -> 0.2 }";
constexpr const char* ghost_material =
    "Material { color -> rgb(0.6, 0.6, 0.6) transparency -> 0.75 }";

std::string definition(ScriptWriter& writer, const std::string& name, const SharedSolid& solid) {
  const std::string text = writer.write(solid);
  return name + " = " + text + "\n";
}

std::string script_of(const std::string& name, ScriptWriter& writer, const SharedSolid& part,
                      const SharedSolid& ghosts, bool has_plain) {
  writer.count(part);
  writer.count(ghosts);
  if (has_plain) writer.material(plain_material, "plain");
  if (ghosts) writer.material(ghost_material, "ghost");
  const std::string parts =
      definition(writer, "part", part) + (ghosts ? definition(writer, "ghosts", ghosts) : "");
  std::string body = writer.materials().empty() ? "" : "\n" + writer.materials();
  if (!writer.definitions().empty()) body += "\n" + writer.definitions();
  const std::string scene = text::format(
      "\nScene {{\n    part{}\n{}}}\n",
      has_plain ? " <material " + writer.material(plain_material, "plain") + ">" : "",
      ghosts
          ? "    ghosts <material " + writer.material(ghost_material, "ghost") + ", shadow false>\n"
          : "");
  const std::string rest = body + "\n" + parts + scene;
  // What the camera has to see is asked of the script itself.
  const ScriptResult result = run_script(rest, name);
  if (!result.scene) {
    std::string message = "the script that was made has an error";
    for (const Diagnostic& diagnostic : result.diagnostics)
      if (diagnostic.severity == Severity::error) message += ": " + diagnostic.message;
    throw Error(ErrorCode::unsupported, message);
  }
  return heading_of(name) +
         "-- (x, y, z) of OpenSCAD is (x, z, y) here. The part is called "
         "`part`.\n" +
         settings_for(box_around(result.scene->entities)) + rest;
}

}  // namespace

std::optional<Entity> entity_of(const SharedSolid& solid, const std::string& materials,
                                const std::string& name) {
  ScriptWriter writer;
  writer.count(solid);
  const std::string expression = writer.write(solid);
  const std::string script = materials + writer.definitions() + "Scene { " + expression + " }\n";
  const ScriptResult result = run_script(script, name);
  if (!result.scene || result.scene->entities.empty()) return {};
  return csg_union(result.scene->entities);
}

ImportResult import_csg(std::string_view text, const std::string& name,
                        const ImportOptions& options) {
  Notes notes(options.partial);
  ImportResult result;
  const int file = notes.add_file(name, std::string(text));
  const Place start{.file = file};
  try {
    const std::vector<CsgNode> nodes = parse_csg(text, file);
    ScriptWriter writer;
    OpenScad scad(notes, writer, options, name);
    const std::vector<const CsgNode*> top = top_of(nodes);
    const bool is_flat =
        !top.empty() &&
        std::none_of(top.begin(), top.end(),
                     [](const CsgNode* node) { return dimension_of(*node) == 3; }) &&
        std::any_of(top.begin(), top.end(),
                    [](const CsgNode* node) { return dimension_of(*node) == 2; });
    SharedSolid part = is_flat ? flat_part(top, scad, notes) : scad.all(top, false);
    part = make_changed(part, frame_of_openscad());
    const SharedSolid ghosts = make_changed(ghosts_of(nodes, scad), frame_of_openscad());
    if (!part && !notes.has_errors())
      throw Failure(start, "there is no solid in this file: it has nothing, or only what is empty");
    if (part && !notes.has_errors())
      result.script = script_of(name, writer, part, ghosts, scad.has_plain());
  } catch (const Failure& failure) {
    notes.failed(failure);
  } catch (const Error& error) {
    notes.failed(Failure(start, error.what(), error.code()));
  }
  result.diagnostics = notes.take();
  return result;
}

}  // namespace crt::importing
