#include "studio/folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <crt/error.hpp>
#include <crt/file.hpp>
#include <system_error>

#include "studio/typed_files.hpp"
#include "text/utf8.hpp"

namespace crt::studio {

namespace fs = std::filesystem;

namespace {

/// More scripts than this are not listed, nor are folders looked into that lie deeper.
constexpr std::size_t max_listed = 1000;
constexpr int deepest_listed = 3;
constexpr std::size_t max_looked_at = 20000;
/// No path is longer that the system knows.
constexpr std::size_t longest_name = 4096;

bool is_within(const fs::path& path, const fs::path& folder) {
  const auto ends = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return ends.first == folder.end() && ends.second != path.end();
}

std::string system_message(int error) {
  return std::generic_category().message(error);
}

/// Opens a regular file in a folder for reading. A pipe does not make it wait.
FileHandle open_regular(const FileHandle& folder, const std::string& name) {
  FileHandle file = open_beneath(folder.get(), name, O_RDONLY | O_NONBLOCK | O_NOCTTY);
  struct stat status {};
  if (!file.is_open() || fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return file;
}

/// Reads at most so many bytes of a file as a script may have, and one more. Nothing if it fails.
std::optional<std::string> read_some(const FileHandle& file) {
  std::string text(Folder::longest_script + 1, '\0');
  std::size_t size = 0;
  while (size < text.size()) {
    const ssize_t count = ::read(file.get(), text.data() + size, text.size() - size);
    if (count == 0) break;
    if (count > 0) {
      size += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      return std::nullopt;
    }
  }
  text.resize(size);
  return text;
}

/// Says whether something may be written to or removed: it is no link that may lead elsewhere.
bool is_plain_or_missing(const FileHandle& folder, const std::string& name) {
  struct stat status {};
  if (fstatat(folder.get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
    return errno == ENOENT;
  return S_ISREG(status.st_mode);
}

}  // namespace

Folder::Folder(const fs::path& path) {
  std::error_code failed;
  path_ = fs::canonical(path, failed);
  if (!failed) folder_ = FileHandle(open(path_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (failed || !folder_.is_open())
    throw Error(ErrorCode::io, "there is no folder '" + path.string() + "'");
}

fs::path Folder::file_of(std::string_view name) const {
  const auto refuse = [&](const char* why) {
    throw Error(ErrorCode::invalid_argument, "'" + std::string(name) + "' " + why);
  };
  if (name.size() > longest_name)
    throw Error(ErrorCode::invalid_argument, "the name of the script is too long");
  if (name.empty() || name.find('\0') != std::string_view::npos) refuse("is no name of a file");
  const fs::path relative(name);
  if (relative.extension() != ".crt") refuse("is no script: scripts end in .crt");
  if (relative.is_absolute()) refuse("is not in the opened folder");
  std::error_code failed;
  fs::path file = fs::weakly_canonical(path_ / relative, failed);
  if (failed || !is_within(file, path_)) refuse("is not in the opened folder");
  if (file.extension() != ".crt") refuse("is no script: scripts end in .crt");
  return file;
}

Folder::Place Folder::place_of(std::string_view name) const {
  fs::path file = file_of(name);
  const fs::path inner = file.lexically_relative(path_).parent_path();
  FileHandle folder =
      open_beneath(folder_.get(), inner.empty() ? "." : inner.string(), O_PATH | O_DIRECTORY);
  if (!folder.is_open())
    throw Error(ErrorCode::io, "'" + std::string(name) + "' is in no folder that can be opened: " +
                                   system_message(errno));
  return {std::move(folder), file.filename().string(), std::move(file)};
}

std::string Folder::read(std::string_view name) const {
  const Place place = place_of(name);
  const FileHandle file = open_regular(place.folder, place.name);
  if (!file.is_open()) throw Error(ErrorCode::io, "there is no script '" + std::string(name) + "'");
  std::optional<std::string> text = read_some(file);
  if (!text) throw Error(ErrorCode::io, "'" + std::string(name) + "' cannot be read");
  if (text->size() > longest_script)
    throw Error(ErrorCode::limit, "'" + std::string(name) + "' is longer than 4 MiB");
  if (!text::is_utf8(*text))
    throw Error(ErrorCode::limit, "'" + std::string(name) + "' is not in UTF-8");
  return std::move(*text);
}

void Folder::write(std::string_view name, std::string_view text) const {
  const Place place = place_of(name);
  const std::vector<TypedFile> typed = typed_files_of(place.folder, place.name);
  write_file_in(place.folder.get(), place.name, text);
  struct stat saved {};
  if (fstatat(place.folder.get(), place.name.c_str(), &saved, AT_SYMLINK_NOFOLLOW) != 0) return;
  const timespec times[] = {saved.st_mtim, saved.st_mtim};
  for (const TypedFile& file : typed)
    utimensat(place.folder.get(), file.name.c_str(), times, AT_SYMLINK_NOFOLLOW);
}

void Folder::keep_typed(std::string_view name, std::string_view page, std::string_view text) const {
  const Place place = place_of(name);
  write_file_in(place.folder.get(), typed_file_of(place.name, page), text, place.name);
}

std::optional<TypedText> Folder::typed(
    std::string_view name, const std::function<bool(const TypedText&)>& is_wanted) const {
  const Place place = place_of(name);
  for (TypedFile& file : typed_files_of(place.folder, place.name)) {
    const FileHandle handle = open_regular(place.folder, file.name);
    if (!handle.is_open()) continue;
    std::optional<std::string> text = read_some(handle);
    if (!text || text->size() > longest_script || !text::is_utf8(*text)) continue;
    TypedText typed{std::move(file.page), std::move(*text)};
    if (is_wanted(typed)) return typed;
  }
  return std::nullopt;
}

void Folder::adopt_typed(std::string_view name, std::string_view from, std::string_view to) const {
  const Place place = place_of(name);
  const std::string source = typed_file_of(place.name, from);
  const std::string target = typed_file_of(place.name, to);
  if (is_plain_or_missing(place.folder, source) && is_plain_or_missing(place.folder, target))
    renameat(place.folder.get(), source.c_str(), place.folder.get(), target.c_str());
}

void Folder::forget_typed(std::string_view name, std::string_view page) const {
  const Place place = place_of(name);
  const std::string file = typed_file_of(place.name, page);
  if (is_plain_or_missing(place.folder, file)) unlinkat(place.folder.get(), file.c_str(), 0);
}

void Folder::forget_old_typed(
    std::string_view name,
    const std::function<bool(const std::string& file, const std::string& page)>& is_used) const {
  const Place place = place_of(name);
  const std::time_t oldest =
      std::time(nullptr) - std::chrono::duration_cast<std::chrono::seconds>(typed_time).count();
  for (const TypedFile& file : all_typed_files(place.folder)) {
    if (file.time.tv_sec < oldest &&
        !is_used((place.file.parent_path() / file.script).string(), file.page))
      unlinkat(place.folder.get(), file.name.c_str(), 0);
  }
}

std::vector<std::string> Folder::scripts() const {
  std::vector<std::string> names;
  std::error_code failed;
  constexpr auto options = fs::directory_options::skip_permission_denied;
  std::size_t looked_at = 0;
  for (fs::recursive_directory_iterator place(path_, options, failed), end;
       !failed && place != end && names.size() < max_listed && ++looked_at < max_looked_at;
       place.increment(failed)) {
    if (place.depth() >= deepest_listed || place->path().filename().string().starts_with('.'))
      place.disable_recursion_pending();
    std::error_code unknown;
    if (place->path().extension() == ".crt" && place->is_regular_file(unknown))
      names.push_back(place->path().lexically_relative(path_).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace crt::studio
