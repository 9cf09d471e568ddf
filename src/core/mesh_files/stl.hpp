// The two kinds of STL files, for what reads them and for what recognises them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace crt::core {

/// A binary STL file has a header and a number of triangles, and then only triangles.
inline constexpr std::size_t stl_header_size = 80;
inline constexpr std::size_t stl_begin_size = stl_header_size + sizeof(std::uint32_t);
inline constexpr std::size_t stl_triangle_size = 50;

/// Says whether a file has just the size that a binary STL file of its number of triangles has.
bool has_size_of_binary_stl(std::string_view content);

/// Says whether a file begins like an STL file that is text. Binary ones may begin with the same
/// word, but not with what follows.
bool is_text_stl(std::string_view content);

}  // namespace crt::core
