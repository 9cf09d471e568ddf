// The object Mesh is the triangles of a file.
#pragma once

#include "lang/objects.hpp"

namespace crt::lang {

/// Returns the row of Mesh.
ObjectType mesh_object();

}  // namespace crt::lang
