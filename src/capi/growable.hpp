// These functions read and write structs that grow from version to version. A program and the
// library may have been built with different versions of a struct: `struct_size` says where the
// program's ends, and nothing beyond it is read or written. A field that it cuts in two counts as
// missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "capi/guard.hpp"

namespace crt::capi {

/// A CField is a field of a struct of crt.h.
struct CField {
  std::string_view name;
  std::size_t offset;
  std::size_t size;
};

constexpr CField c_field(std::string_view name, std::size_t offset, std::size_t size) {
  return {name, offset, size};
}

// A field missing in a list would be read and written with the next one; the test of the layout
// finds it.
#define CRT_FIELD(Struct, field) \
  c_field(#field, offsetof(Struct, field), sizeof(decltype(Struct::field)))

/// Lists the fields of a struct in order. structs.cpp defines it for most growable structs.
template <class Struct>
std::span<const CField> c_fields();

/// Holds the values that a struct has if its owner sets none.
template <class Struct>
Struct defaults();

// Each struct's own is defined beside what reads the struct.
template <>
crt_pattern defaults<crt_pattern>();
template <>
crt_material defaults<crt_material>();
template <>
crt_principled defaults<crt_principled>();
template <>
crt_light defaults<crt_light>();
template <>
crt_camera defaults<crt_camera>();
template <>
crt_background defaults<crt_background>();
template <>
crt_mesh defaults<crt_mesh>();
template <>
crt_mesh_options defaults<crt_mesh_options>();
template <>
crt_mesh_report defaults<crt_mesh_report>();
template <>
crt_custom defaults<crt_custom>();
template <>
crt_settings defaults<crt_settings>();
template <>
crt_render_options defaults<crt_render_options>();
template <>
crt_prepare_options defaults<crt_prepare_options>();
template <>
crt_write_options defaults<crt_write_options>();
template <>
crt_measure_options defaults<crt_measure_options>();
template <>
crt_script_options defaults<crt_script_options>();
template <>
crt_diagnostic defaults<crt_diagnostic>();
template <>
crt_diagnostic_call defaults<crt_diagnostic_call>();
template <>
crt_farm_options defaults<crt_farm_options>();
template <>
crt_farm_work_options defaults<crt_farm_work_options>();
template <>
crt_farm_merge_options defaults<crt_farm_merge_options>();

/// Returns the defaults that go with a struct of some size. A program keeps those of the version
/// that it was compiled with, and the size says which that is.
template <class Struct>
Struct defaults_of_size(std::size_t) {
  return defaults<Struct>();
}
template <>
crt_settings defaults_of_size<crt_settings>(std::size_t size);
template <>
crt_light defaults_of_size<crt_light>(std::size_t size);

inline constexpr std::size_t size_field = sizeof(std::uint32_t);
/// No struct will ever be larger than this. A larger size is a mistake.
inline constexpr std::size_t largest_struct = 1 << 16;

inline void require_struct_size(std::size_t size, const char* argument) {
  if (size == 0) reject(argument, "has a struct_size of 0: initialise it with its crt_*_init()");
  if (size < size_field || size > largest_struct)
    reject(argument, "has a struct_size that cannot be");
}

/// Returns the number of bytes of the struct that both sides know.
template <class Struct>
std::size_t known_size(std::size_t size) {
  std::size_t known = size_field;
  for (const CField& field : c_fields<Struct>()) {
    if (field.offset + field.size <= size) known = field.offset + field.size;
  }
  return known;
}

template <class Struct>
std::size_t given_size(const Struct* given, const char* argument) {
  require(given, argument);
  std::uint32_t size = 0;
  std::memcpy(&size, given, sizeof size);
  require_struct_size(size, argument);
  return size;
}

/// Returns what the caller gave, with defaults for the fields beyond its end.
template <class Struct>
Struct taken(const Struct* given, const char* argument) {
  const std::size_t known = known_size<Struct>(given_size(given, argument));
  auto result = defaults_of_size<Struct>(known);
  std::memcpy(&result, given, known);
  return result;
}

/// Returns what the caller gave as options, where NULL stands for the defaults.
template <class Struct>
Struct taken_or_default(const Struct* given, const char* argument) {
  return given == nullptr ? defaults<Struct>() : taken(given, argument);
}

/// Writes all fields but the size into the caller's struct, up to its end.
template <class Struct>
void fill_in(Struct* out, const char* argument, const Struct& values) {
  const std::size_t known = known_size<Struct>(given_size(out, argument));
  std::memcpy(reinterpret_cast<char*>(out) + size_field,
              reinterpret_cast<const char*>(&values) + size_field, known - size_field);
}

/// Does what the crt_*_init functions do: it writes the values, 0 for what only the caller knows,
/// and the size.
template <class Struct>
void initialise(Struct* out, std::size_t size, const Struct& values) {
  require(out, "the struct");
  require_struct_size(size, "the struct");
  const std::size_t known = known_size<Struct>(size);
  const auto given = static_cast<std::uint32_t>(size);
  char* const bytes = reinterpret_cast<char*>(out);
  std::memset(bytes, 0, size);
  std::memcpy(bytes, &values, known);
  std::memcpy(bytes, &given, sizeof given);
}

}  // namespace crt::capi
