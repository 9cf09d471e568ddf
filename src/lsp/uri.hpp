// Editors name files by URIs (RFC 8089), and the file system by paths.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace crt::lsp {

/// Returns the path of a file's URI, or nothing if it is another kind of URI, such as that of a
/// text that is not saved yet.
std::filesystem::path path_of(std::string_view uri);

std::string uri_of(const std::filesystem::path& path);

}  // namespace crt::lsp
