// Whole files are read into memory, and written from it, at once.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace crt::core {

/// Returns the content of a regular file. Throws Error (io) if there is none, and if it is longer
/// than `max_bytes` or than half of the memory that the process may have.
std::vector<std::byte> read_whole_file(const std::filesystem::path& path, std::size_t max_bytes);

/// Returns the beginning of a regular file, of at most so many bytes, otherwise as
/// read_whole_file().
std::vector<std::byte> read_file_start(const std::filesystem::path& path, std::size_t max_bytes);

/// Says when what is written is on its disk: when the system thinks fit, or before the file takes
/// its place. The latter takes the time of the disk.
enum class Flush { later, at_once };

/// Makes `path` hold `content`, as crt/file.hpp describes. Throws Error (io).
void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> content,
                      Flush flush);

/// A FilePieces function produces content piece by piece. It passes each piece to the function that
/// it gets.
using FilePieces = std::function<void(const std::function<void(std::span<const std::byte>)>&)>;
void write_whole_file(const std::filesystem::path& path, const FilePieces& produce, Flush flush);

}  // namespace crt::core
