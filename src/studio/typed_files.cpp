#include "studio/typed_files.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <crt/error.hpp>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

namespace crt::studio {

namespace {

constexpr std::string_view typed_ending = ".typed";
constexpr std::string_view script_ending = ".crt";
constexpr std::size_t longest_page = 32;

bool is_older(const timespec& a, const timespec& b) {
  return std::tie(a.tv_sec, a.tv_nsec) < std::tie(b.tv_sec, b.tv_nsec);
}

bool is_page_name(std::string_view page) {
  return !page.empty() && page.size() <= longest_page &&
         page.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Takes `.NAME.crt.PAGE.typed` apart.
std::optional<TypedFile> parse_name(std::string_view name) {
  if (!name.starts_with('.') || !name.ends_with(typed_ending)) return std::nullopt;
  std::string_view rest = name.substr(1, name.size() - 1 - typed_ending.size());
  const std::size_t dot = rest.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const std::string_view script = rest.substr(0, dot);
  const std::string_view page = rest.substr(dot + 1);
  if (!script.ends_with(script_ending) || !is_page_name(page)) return std::nullopt;
  return TypedFile{std::string(name), std::string(script), std::string(page)};
}

}  // namespace

void check_page_name(std::string_view page) {
  if (!is_page_name(page))
    throw Error(ErrorCode::invalid_argument, "a page is called by up to 32 hexadecimal digits");
}

std::string typed_file_of(const std::string& script, std::string_view page) {
  check_page_name(page);
  return ("." + script + ".").append(page).append(typed_ending);
}

std::vector<TypedFile> all_typed_files(const FileHandle& folder) {
  std::vector<TypedFile> files;
  FileHandle listed = open_beneath(folder.get(), ".", O_RDONLY | O_DIRECTORY);
  if (!listed.is_open()) return files;
  const std::unique_ptr<DIR, int (*)(DIR*)> list(fdopendir(listed.get()), closedir);
  if (!list) return files;
  listed.release();
  while (const dirent* entry = readdir(list.get())) {
    std::optional<TypedFile> file = parse_name(entry->d_name);
    struct stat status {};
    if (!file || fstatat(folder.get(), entry->d_name, &status, AT_SYMLINK_NOFOLLOW) != 0 ||
        !S_ISREG(status.st_mode))
      continue;
    file->time = status.st_mtim;
    files.push_back(std::move(*file));
  }
  return files;
}

std::vector<TypedFile> typed_files_of(const FileHandle& folder, const std::string& script) {
  std::vector<TypedFile> files = all_typed_files(folder);
  struct stat saved {};
  const bool is_saved = fstatat(folder.get(), script.c_str(), &saved, AT_SYMLINK_NOFOLLOW) == 0;
  std::erase_if(files, [&](const TypedFile& file) {
    return file.script != script || (is_saved && is_older(file.time, saved.st_mtim));
  });
  std::sort(files.begin(), files.end(),
            [](const TypedFile& a, const TypedFile& b) { return is_older(b.time, a.time); });
  return files;
}

}  // namespace crt::studio
