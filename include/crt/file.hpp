// Writing files as the library does: what goes beside a picture can go the same way.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace crt {

/// Makes a file hold `content`, all of it or none. This is how Image::write() and checkpoints are
/// written, too:
///
/// A regular file is replaced at once by a new one that was written under another name in the same
/// folder. On failure the old one stays. The new one gets the old one's permissions, and its owner
/// and group where the system lets us; what has not been there before gets those that the process
/// gives (its umask). Other hard links of the old file keep what is in it. A file that may not be
/// written is not replaced.
///
/// Where the folder takes no new file, or none in this one's place (a folder that may only be read,
/// a file that is mounted), a file that may be written is written in place: then a failure leaves a
/// part of it.
///
/// Symbolic links are followed: what they lead to is replaced or made, and they stay.
///
/// What is no regular file (a device, a named pipe) is written to as it is, and so is a descriptor
/// of the process by its name (/dev/stdout, /dev/fd/3). Opening a pipe waits for a reader. A pipe
/// whose reader has gone is an error and no signal.
///
/// Throws Error (io). From any thread.
void write_file(const std::filesystem::path& path, std::span<const std::byte> content);

/// The same for text.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Finds out, before there is anything to write, whether write_file() can begin: throws Error (io)
/// where there is no folder, or neither it nor the file may be written. Changes nothing.
void check_writable(const std::filesystem::path& path);

}  // namespace crt
