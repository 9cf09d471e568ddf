// Scenes become source code: scripts, or programs in C++, Python or C, that make the same scene. So
// what a program has made can be saved, and what was found by a script or in the studio can go into
// a program. It belongs to the library crt::source.
#pragma once

#include <crt/scene.hpp>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace crt {

/// Lists the languages of source code.
enum class SourceLanguage {
  cpp,     ///< C++20, with crt/crt.hpp (and crt/field.hpp's parse_field() of crt::lang)
  python,  ///< the package crt
  c,       ///< C99, with crt/crt.h
  script,  ///< the CRT language
};

/// A SourceFile is to lie beside a script, which names it.
struct SourceFile {
  std::string name{};
  std::vector<std::byte> content{};
};

/// SourceCode is a program or a script, or a part of one.
struct SourceCode {
  std::string text{};
  /// They say, a line each, in what the code may differ from what it was written of.
  std::vector<std::string> warnings{};
  /// These are the meshes and images of a script. Programs have theirs as lists of numbers.
  std::vector<SourceFile> files{};
};

/// SourceOptions say how source code is written.
struct SourceOptions {
  SourceLanguage language = SourceLanguage::cpp;
  /// The text has at most so many bytes. Meshes, height fields and images stand in that of programs
  /// as lists of numbers, and so do the heights in that of scripts.
  std::size_t most_bytes = std::size_t{16} << 20;
  /// The files of a script are called by this, a hash of what is in them and their ending.
  std::string name = "scene";
};

/// Returns a script that has the scene, or a program that renders it to the file that its first
/// argument names. What makes the scene in a program is a function in it: make_scene(). The picture
/// is the same, byte for byte, unless a warning says otherwise. That is so where nested transforms
/// make a map of more than doubles, which is then rounded, and in scripts for an angle that no
/// number of degrees gives, and for an Extrusion that does not begin at z = 0.
///
/// Throws Error: unsupported for what no code can be written of (a Custom shape; an image of more
/// than 8 bits that is display_encoded(); a mesh that is closed only by triangles without area; in
/// scripts a mesh whose own materials are more than OBJ files can say, and what scripts of 2015
/// lack in a scene of theirs), limit if there would be too much text.
SourceCode source_code(const Scene& scene, const SourceOptions& options = {});

/// Returns a function, or in a script a macro, that makes the entity: make_entity(). Throws Error
/// as the function above.
SourceCode source_code(const Entity& entity, const SourceOptions& options = {});

/// Writes source code to a file, and the files that it names beside that. They go first, and no
/// file ever has another content under the same name. So the text that was there before stays
/// whole, and with it its files, whatever fails. Throws Error as write_file() does.
void write_source_code(const SourceCode& code, const std::filesystem::path& path);

/// Writes a scene as a script to a file, as the function above does. Its other files begin with the
/// same name. Returns the warnings. Throws Error as both functions do. The text may be as long as
/// scripts are by default, which is 64 MiB.
std::vector<std::string> save_script(const Scene& scene, const std::filesystem::path& path);

/// An EntityDescription says what a part of an entity is.
struct EntityDescription {
  /// The type of a primitive ("Sphere"), "Union", "Intersection", "Difference" or "Placed".
  std::string kind{};
  /// This is the place in the list of what it is a part of, or `no_parent` for an entity of the
  /// scene.
  std::size_t parent = no_parent;
  /// These are the names and values of its fields, as Python writes them: "(0, 1, 0)".
  std::vector<std::pair<std::string, std::string>> values{};

  static constexpr std::size_t no_parent = static_cast<std::size_t>(-1);
};

/// Describes the entities of a scene, each before its parts, in their order. After so many
/// descriptions the parts of entities are left out, but not the entities themselves.
std::vector<EntityDescription> describe_entities(const Scene& scene, std::size_t most = 10000);

/// Returns a JSON array of objects with kind, parent (null for an entity of the scene) and values:
/// an object of numbers, arrays of numbers and texts.
std::string descriptions_to_json(const std::vector<EntityDescription>& descriptions);

}  // namespace crt
