// Finds and loads the module crt_image_files.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/image/files/interface.hpp"

namespace crt::core {

/// Where the module may be, the likeliest first: near the program or library that this code is in,
/// in the build tree if CRT is part of another project, where it gets installed.
std::vector<std::filesystem::path> image_files_directories();

/// Loads the module from the first directory that has it. Throws Error (unsupported) telling where
/// it looked.
const ImageFiles& load_image_files(std::span<const std::filesystem::path> directories);

/// The module, loaded by the first call and never unloaded. Throws as load_image_files does.
const ImageFiles& image_files();

}  // namespace crt::core
