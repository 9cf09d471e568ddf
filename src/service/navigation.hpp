// Navigation goes from a name to where it is set, to all its places, and renames it.
#pragma once

#include <crt/script.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source_map.hpp"
#include "service/program.hpp"

namespace crt::service {

/// A Place is a piece of one of a program's sources, or the beginning of a file.
struct Place {
  std::string file;
  /// Is null for the beginning of a file.
  const lang::Source* source = nullptr;
  lang::Span span;
};

/// Returns where the name at a byte of the main script is set, or the file that is imported there.
std::optional<Place> definition_at(const Program& program, std::uint32_t byte);

/// Returns all places of the name at a byte of the main script, in all sources.
std::vector<Place> places_of(const Program& program, std::uint32_t byte);

/// Returns the span of the name at a byte of the main script if it can be renamed.
std::optional<lang::Span> renamable_at(const Program& program, std::uint32_t byte);

/// Returns the places that get the new name. `byte` may also be in another source, behind its base.
/// Throws Error (invalid_argument) if the new name is none, or if with it any name would mean
/// something else.
std::vector<Place> rename_at(const Program& program, std::uint32_t byte,
                             const std::string& new_name, const ScriptOptions& options);

}  // namespace crt::service
