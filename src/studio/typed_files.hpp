// What is typed and not saved is in files beside the scripts, which are found by their names.
#pragma once

#include <ctime>
#include <string>
#include <string_view>
#include <vector>

#include "studio/open_beneath.hpp"

namespace crt::studio {

/// A TypedFile has what was kept of a page.
struct TypedFile {
  std::string name;
  std::string script;  ///< that it stands beside
  std::string page;
  timespec time{};
};

/// Throws Error (invalid_argument) unless pages may have this name: at most 32 hexadecimal digits.
void check_page_name(std::string_view page);

/// Returns the name of the file beside a script. Throws as check_page_name() does.
std::string typed_file_of(const std::string& script, std::string_view page);

/// Lists those of a folder.
std::vector<TypedFile> all_typed_files(const FileHandle& folder);

/// Lists those of a script that it is not newer than, the newest first.
std::vector<TypedFile> typed_files_of(const FileHandle& folder, const std::string& script);

}  // namespace crt::studio
