// Files as a whole: all of one into memory, all of memory into one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace crt::core {

/// The content of a regular file; throws Error (io) if there is none or it is longer than
/// `max_bytes`.
std::vector<std::byte> read_whole_file(const std::filesystem::path& path, std::size_t max_bytes);

/// Makes `path` hold `content`: crt/file.hpp tells how. Throws Error (io).
void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> content);

/// The same for content that comes piece by piece: `produce` hands each to the function that it
/// gets.
using FilePieces = std::function<void(const std::function<void(std::span<const std::byte>)>&)>;
void write_whole_file(const std::filesystem::path& path, const FilePieces& produce);

}  // namespace crt::core
