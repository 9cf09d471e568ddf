// The headers of PLY files say what is in them: G. Turk, The PLY polygon file format (1994).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace crt::core {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Returns how many bytes a number of this type has.
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string_view name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type;  ///< of a list
};

/// A PlyElement is a table: rows of numbers and lists, one for each property.
struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  std::optional<std::endian> binary;  ///< the order of bytes, or nothing for text
  std::vector<PlyElement> elements;
  std::size_t size = 0;   ///< in bytes
  std::size_t lines = 0;  ///< of text
};

/// Says whether a file begins as every PLY file does.
bool is_ply(std::string_view content);

/// Reads the header of a file. Names are parts of the file. Throws RefusedMesh.
PlyHeader read_ply_header(std::string_view content);

}  // namespace crt::core
