// The statements of OBJ files, for what reads them and for what recognises them.
#pragma once

#include <string_view>

namespace crt::core {

enum class ObjStatement {
  vertex,
  face,
  normal,
  uv,
  material,  ///< of the faces that follow
  library,   ///< of materials
  other,     ///< about what is no part of the shape, or about points and lines
  curved,    ///< makes curves or curved surfaces
  unknown,   ///< none of OBJ's
};

/// Returns the kind of statement that a line begins with.
ObjStatement obj_statement(std::string_view word);

}  // namespace crt::core
