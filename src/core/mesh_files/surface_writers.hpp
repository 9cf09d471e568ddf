// What the writers of surface meshes have in common: parts that were checked, numbers as text and
// as bytes, and how large files may be.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crt/surface_mesh.hpp"

namespace crt::core {

/// A SurfacePart is a part with triangles, all of whose numbers a file can have.
struct SurfacePart {
  const SurfaceMesh* mesh = nullptr;
  std::string name;  ///< UTF-8 without control characters, and not empty
  std::optional<Color> color{};
};

/// A SurfaceFile is what a writer writes.
struct SurfaceFile {
  std::vector<SurfacePart> parts;  ///< at least one
  Unit unit = Unit::m;
  double deviation = 0;  ///< the largest
};

/// SurfaceCounts say how much there is.
struct SurfaceCounts {
  std::uint64_t positions = 0;
  std::uint64_t triangles = 0;
  std::uint64_t parts = 0;
};

SurfaceCounts counts_of(const SurfaceFile& file);
/// Throws Error (limit) for more than the format has room for, as far as the counts say it.
void check_room(SurfaceMeshFormat format, const SurfaceCounts& counts);
/// Throws Error (limit) for more bytes than 32 bits count.
void check_bytes(std::string_view format, std::uint64_t bytes);

std::string stl_bytes(const SurfaceFile& file);
std::string obj_bytes(const SurfaceFile& file);
std::string ply_bytes(const SurfaceFile& file);
std::string three_mf_bytes(const SurfaceFile& file);
std::string glb_bytes(const SurfaceFile& file);

/// Returns "m", "cm", "mm" or "in".
std::string_view unit_name(Unit unit);
/// Returns a sentence for comments: the deviation, if there is one.
std::string deviation_text(const SurfaceFile& file);

/// Appends a number in little-endian order.
template <class Number>
requires std::integral<Number> || std::floating_point<Number>
void append_bytes(std::string& bytes, Number number) {
  static_assert(std::endian::native == std::endian::little);
  char copy[sizeof number];
  std::memcpy(copy, &number, sizeof number);
  bytes.append(copy, sizeof number);
}

/// Appends the shortest text that says which number it is.
void append_number(std::string& text, double number);
void append_number(std::string& text, std::uint64_t number);

/// Returns a channel of a linear colour as 8 bits of sRGB (IEC 61966-2-1).
std::uint8_t srgb_of(double linear);
/// Returns coverage as 8 bits.
std::uint8_t byte_of(double coverage);

}  // namespace crt::core
