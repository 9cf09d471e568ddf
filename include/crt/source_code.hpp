// Scenes become source code: programs in C++, Python or C that make the same scene, as a scene that
// was found by a script or in the studio is to go into a program. It belongs to the library
// crt::source.
#pragma once

#include <crt/scene.hpp>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace crt {

/// Lists the languages of source code.
enum class SourceLanguage {
  cpp,     ///< C++20, with crt/crt.hpp (and crt/field.hpp's parse_field() of crt::lang)
  python,  ///< the package crt
  c,       ///< C99, with crt/crt.h
};

/// SourceCode is a program, or a part of one.
struct SourceCode {
  std::string text{};
  /// They say, a line each, in what the code may differ from what it was written of.
  std::vector<std::string> warnings{};
};

/// SourceOptions say how source code is written.
struct SourceOptions {
  SourceLanguage language = SourceLanguage::cpp;
  /// The text has at most so many bytes. Meshes, height fields and images stand in it as lists of
  /// numbers.
  std::size_t most_bytes = std::size_t{16} << 20;
};

/// Returns a program that renders the scene to the file that its first argument names. What makes
/// the scene is a function in it: make_scene(). The picture is the same, byte for byte, unless a
/// warning says otherwise. That is so where nested transforms make a map of more than doubles,
/// which is then rounded.
///
/// Throws Error: unsupported for what no code can be written of (a Custom shape; an image of more
/// than 8 bits that is display_encoded(); a mesh that is closed only by triangles without area),
/// limit if there would be too much text.
SourceCode source_code(const Scene& scene, const SourceOptions& options = {});

/// Returns a function that makes the entity: make_entity(). Throws Error as the function above.
SourceCode source_code(const Entity& entity, const SourceOptions& options = {});

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

}  // namespace crt
