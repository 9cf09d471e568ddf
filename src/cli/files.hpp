// This function checks whether `crt` can write a file.
#pragma once

#include <filesystem>

namespace crt::cli {

/// Finds out, before any work is done, whether this file can be written and its ending is a
/// picture's. If the picture has channels beside colours, the format must hold them. It loads
/// nothing. Throws Error (io, unsupported).
void check_picture(const std::filesystem::path& picture, bool with_channels);

}  // namespace crt::cli
