// The module crt_image_files is found and loaded here.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/image/files/interface.hpp"

namespace crt::core {

/// Returns where the module may be, the likeliest first. It may be near the program or library that
/// this code is in, in a directory of its run path, in the build tree if CRT is part of another
/// project, or where it gets installed.
std::vector<std::filesystem::path> image_files_directories();

/// Loads the module from the first directory that has it. Throws Error (unsupported) with where it
/// looked.
const ImageFiles& load_image_files(std::span<const std::filesystem::path> directories);

/// Returns the module, which the first call loads and nothing unloads. Throws as load_image_files
/// does.
const ImageFiles& image_files();

}  // namespace crt::core
