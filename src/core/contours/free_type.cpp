#include "core/contours/free_type.hpp"

#include <dlfcn.h>

#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

FreeType load() {
  const char* const file = "libfreetype.so.6";
  void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  const auto refuse = [&] {
    const char* const reason = dlerror();
    throw Error(ErrorCode::unsupported,
                text::format("text needs the library {} (Debian: libfreetype6): {}", file,
                             reason == nullptr ? "it cannot be loaded" : reason));
  };
  if (library == nullptr) refuse();
  FreeType functions;
  const auto find = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
    if (function == nullptr) refuse();
  };
  find(functions.init, "FT_Init_FreeType");
  find(functions.done, "FT_Done_FreeType");
  find(functions.new_face, "FT_New_Memory_Face");
  find(functions.done_face, "FT_Done_Face");
  find(functions.glyph_index, "FT_Get_Char_Index");
  find(functions.load_glyph, "FT_Load_Glyph");
  find(functions.kerning, "FT_Get_Kerning");
  find(functions.decompose, "FT_Outline_Decompose");
  return functions;
}

}  // namespace

const FreeType& free_type() {
  // This only loads code and keeps it. A failure is thrown, and the next call tries again.
  static const FreeType functions = load();
  return functions;
}

}  // namespace crt::core
