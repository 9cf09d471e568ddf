// Meshes are taken apart, and become files for scripts.
#pragma once

#include <string>
#include <vector>

#include "crt/mesh.hpp"
#include "source/program.hpp"

namespace crt::source {

/// MeshParts are what a mesh can be made of again.
struct MeshParts {
  std::vector<Vec3> positions;
  std::vector<TriangleIndices> triangles;
  MeshAttributes attributes;
  FillRule fill = FillRule::even_odd;
};

/// Adds an OBJ file that is read as the same mesh, and the library of its materials. Returns its
/// name between quotes. Throws Error (unsupported) for materials that such libraries cannot have.
std::string obj_file_name(Program& program, const MeshParts& parts);

}  // namespace crt::source
