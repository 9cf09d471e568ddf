// The library of FreeType is loaded when a font is first used. So nobody else pays for it, and a
// system without it has all but text.
#pragma once

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

namespace crt::core {

/// The functions of FreeType that are used.
struct FreeType {
  decltype(&FT_Init_FreeType) init = nullptr;
  decltype(&FT_Done_FreeType) done = nullptr;
  decltype(&FT_New_Memory_Face) new_face = nullptr;
  decltype(&FT_Done_Face) done_face = nullptr;
  decltype(&FT_Get_Char_Index) glyph_index = nullptr;
  decltype(&FT_Load_Glyph) load_glyph = nullptr;
  decltype(&FT_Get_Kerning) kerning = nullptr;
  decltype(&FT_Outline_Decompose) decompose = nullptr;
};

/// Returns the functions, which the first call loads and nothing unloads. Throws Error
/// (unsupported).
const FreeType& free_type();

}  // namespace crt::core
