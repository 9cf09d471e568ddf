// The page's files are a part of the program.
#pragma once

#include <map>
#include <string>

#include "studio/web_server.hpp"

namespace crt::studio {

/// Returns the files of the page by their paths.
std::map<std::string, PageFile, std::less<>> page_files();

}  // namespace crt::studio
