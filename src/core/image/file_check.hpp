// Checks of a file before a library gets it that would answer badly: the PNG library prints its
// complaints to the standard error output, and OpenImageIO 2.4 reads beyond its memory for some
// run-length encoded BMP files.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace crt::core {

/// Why a file of the given format (see format_of_content) must not be read; empty if it may be.
std::string reason_to_refuse(std::string_view format, std::span<const std::byte> content);

}  // namespace crt::core
