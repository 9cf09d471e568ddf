// The library is the scripts that come with CRT, such as "crt/metals". They are part of the
// program, so that no file is needed. CMake makes them from share/crt/*.crt.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lang/source_map.hpp"

namespace crt::lang {

struct LibraryScript {
  std::string_view name;  ///< "metals"
  std::string_view text;
};

/// Returns all scripts, by name.
std::span<const LibraryScript> library();

/// Says whether an import's path is that of a script of the library. These reach no file.
bool is_library_path(std::string_view path);

/// Returns what a path of the library names in it: "colors" for "crt/colors".
std::string_view library_name(std::string_view path);

/// Returns the text of a script. Throws a Failure at `span` if there is none of that path.
std::string_view find_library(const std::string& path, Span span);

/// Returns the path of the library's script that sets a name, such as "crt/metals" for gold, or
/// nothing.
std::string library_path_of(std::string_view name);

}  // namespace crt::lang
