// The material libraries of OBJ files: Wavefront, MTL material format, 1995.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh_files/mesh_builder.hpp"
#include "crt/image.hpp"
#include "crt/material.hpp"

namespace crt::core {

/// An MtlTexture is what a line says of a picture.
struct MtlTexture {
  std::string name;
  double repeat_u = 1;
  double repeat_v = 1;
};

/// An MtlDefinition has what a library says of a material, as far as it is used.
struct MtlDefinition {
  std::optional<Color> diffuse;   ///< Kd
  std::optional<Color> specular;  ///< Ks
  double shininess = 0;           ///< Ns
  std::optional<double> opacity;  ///< d
  double transparency = 0;        ///< Tr, where there is no d
  double refractive_index = 1;    ///< Ni
  MtlTexture texture;             ///< map_Kd
};

/// An MtlLibraries has the materials that an OBJ file names, and their pictures.
class MtlLibraries {
 public:
  /// Opens files by `mesh`, which gets a warning where that fails.
  explicit MtlLibraries(MeshBuilder& mesh) : mesh_(mesh) {}

  /// Notes what a line of an OBJ file says behind mtllib: the name of a library, or several.
  /// Throws RefusedMesh if they are too many.
  void add_libraries(std::string_view names, std::size_t line);

  /// Returns the number of a material by which faces have it. It may be defined later. Throws
  /// RefusedMesh if they are too many.
  std::uint32_t number_of(std::string_view name, std::size_t line);

  /// Reads the libraries, and gives the mesh all materials that have a number. Throws RefusedMesh
  /// for a broken library, with its name and line.
  void finish();

 private:
  std::optional<std::string> text_of(const std::string& name);
  bool read_libraries(std::string_view names);
  void read(const std::string& text);
  Material made(const MtlDefinition& definition);
  std::shared_ptr<const Image> picture(const std::string& name);

  MeshBuilder& mesh_;
  std::vector<std::string> libraries_;
  std::map<std::string, std::uint32_t, std::less<>> numbers_;
  std::map<std::string, MtlDefinition, std::less<>> definitions_;  ///< of those with a number
  std::map<std::string, std::shared_ptr<const Image>> pictures_;
};

}  // namespace crt::core
