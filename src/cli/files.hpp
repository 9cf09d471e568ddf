// Names of the files that `crt render` writes, and whether it can.
#pragma once

#include <filesystem>

namespace crt::cli {

/// The name of a frame's picture: a run of '#' or a "%04d" in the file's name becomes the number
/// (with that many digits at least); where there is neither, _0001 goes before the ending.
std::filesystem::path frame_path(const std::filesystem::path& output, int frame);

/// Finds out, before any work is done, whether this file can be written and its ending is a
/// picture's, of one that holds other channels than colours if it has to. Throws Error (io,
/// unsupported).
void check_picture(const std::filesystem::path& picture, bool with_channels);

}  // namespace crt::cli
