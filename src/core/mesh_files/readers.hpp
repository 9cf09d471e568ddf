// Each format of mesh files has a reader. All take the whole content of a file and throw
// RefusedMesh if it is broken.
#pragma once

#include <string_view>

#include "core/mesh_files/mesh_builder.hpp"

namespace crt::core {

void read_obj(std::string_view content, MeshBuilder& mesh);
void read_ply(std::string_view content, MeshBuilder& mesh);
void read_stl(std::string_view content, MeshBuilder& mesh);
void read_off(std::string_view content, MeshBuilder& mesh);
void read_three_mf(std::string_view content, MeshBuilder& mesh);

}  // namespace crt::core
