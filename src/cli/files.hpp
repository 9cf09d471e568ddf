// Names of the files that `crt render` writes, and writing them whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace crt::cli {

/// The name of a frame's picture: a run of '#' or a "%04d" in the file's name becomes the number (with
/// that many digits at least); where there is neither, _0001 goes before the ending.
std::filesystem::path frame_path(const std::filesystem::path& output, int frame);

/// Finds out, before any work is done, whether there is a folder to write this file to. Throws Error (io).
void check_folder(const std::filesystem::path& file);

/// The same, and whether the folder takes files and the ending is a picture's, of one that holds other
/// channels than colours if it has to. Throws Error (io, unsupported).
void check_picture(const std::filesystem::path& picture, bool with_channels);

/// Writes a file under another name and renames it. Throws Error (io).
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace crt::cli
