// Finds out which format a mesh file has.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "crt/mesh_file.hpp"

namespace crt::core {

/// Returns the format that the content shows, else the one that the ending of the name says, else
/// nothing.
std::optional<MeshFormat> mesh_format(std::string_view content, const std::string& name);

}  // namespace crt::core
