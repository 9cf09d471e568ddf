// Functions that write files as the library does, for programs that write something beside a
// picture, and functions that find out beforehand whether that will work.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace crt {

/// Makes a file hold `content`, all of it or none. Image::write() and checkpoints use it, too.
///
/// A regular file is replaced at once by a new one that was written under another name in the same
/// folder. On failure the old one stays. The new one gets the old one's permissions, and its owner
/// and group where the system allows that. A file that was not there gets those that the process
/// gives (its umask). Other hard links of the old file keep its content. A file that may not be
/// written is not replaced.
///
/// The folder may take no new file, or none in this one's place (a folder that may only be read, a
/// file that is mounted). A file there that may be written is written in place. Then a failure
/// leaves a part of it.
///
/// Symbolic links are followed. What they lead to is replaced or made, and the links stay.
///
/// The content is on its disk before it takes the old one's place (fsync), so that a machine that
/// stops has one of both. Pictures, which can be rendered again, do not wait for that.
///
/// What is no regular file (a device, a named pipe) is written to as it is. So is a descriptor of
/// the process by its name (/dev/stdout, /dev/fd/3). Opening a pipe waits for a reader. A pipe
/// whose reader has gone is an error and no signal.
///
/// Throws Error (io). Any thread may call it.
void write_file(const std::filesystem::path& path, std::span<const std::byte> content);

/// Makes a file hold a text, otherwise as the function above.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Makes a regular file in an open folder hold a text, all of it or none, as write_file() does. No
/// link is followed, and nothing but a regular file is written to, whatever somebody does in the
/// folder meanwhile.
///
/// `folder` is a descriptor, which may have been opened with O_PATH. `name` has no slash. `like` is
/// empty, or names a file there whose permissions and group the written file gets. If there is no
/// such file, it is for its owner alone.
///
/// Throws Error (io). Any thread may call it.
void write_file_in(int folder, const std::string& name, std::string_view content,
                   const std::string& like = {});

/// Finds out, before there is anything to write, whether write_file() can begin. Throws Error (io)
/// where there is no folder, or neither it nor the file may be written. It changes nothing.
void check_writable(const std::filesystem::path& path);

/// Finds out, before there is a picture, whether Image::write() knows the format that the ending of
/// this name says. If the picture will have Image::channels(), the format must hold them. It looks
/// at the name alone, and loads nothing. Throws Error (unsupported).
void check_picture_name(const std::filesystem::path& path, bool with_channels = false);

}  // namespace crt
