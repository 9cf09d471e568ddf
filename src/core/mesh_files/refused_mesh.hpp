// Readers of mesh files throw this when a file is not what it should be.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace crt::core {

/// A RefusedMesh says where in a file something is wrong, and what. The file's name comes to it
/// later.
struct RefusedMesh : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws a RefusedMesh for a line of a text. Lines count from 1.
[[noreturn]] void refuse_line(std::size_t line, const std::string& reason);

/// Throws a RefusedMesh for a byte of a file. Bytes count from 0.
[[noreturn]] void refuse_byte(std::size_t byte, const std::string& reason);

/// Returns a word of a file for a message: in quotes, cut short, and free of what cannot be
/// printed.
std::string in_quotes(std::string_view word);

}  // namespace crt::core
