// These functions name the files that `crt render` writes, and check whether it can.
#pragma once

#include <filesystem>

namespace crt::cli {

/// Returns the name of a frame's picture. A run of '#' or a "%04d" in the file's name becomes the
/// number (with that many digits at least). Where there is neither, _0001 goes before the ending.
std::filesystem::path frame_path(const std::filesystem::path& output, int frame);

/// Finds out, before any work is done, whether this file can be written and its ending is a
/// picture's. If the picture has channels beside colours, the format must hold them. It loads
/// nothing. Throws Error (io, unsupported).
void check_picture(const std::filesystem::path& picture, bool with_channels);

}  // namespace crt::cli
