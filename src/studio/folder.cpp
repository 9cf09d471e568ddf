#include "studio/folder.hpp"

#include <algorithm>
#include <crt/error.hpp>
#include <crt/file.hpp>
#include <fstream>
#include <system_error>

#include "text/utf8.hpp"

namespace crt::studio {

namespace fs = std::filesystem;

namespace {

/// More scripts than this are not listed, nor are folders looked into that lie deeper.
constexpr std::size_t most_listed = 1000;
constexpr int deepest_listed = 3;
constexpr std::size_t most_looked_at = 20000;

bool is_within(const fs::path& path, const fs::path& folder) {
  const auto ends = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return ends.first == folder.end() && ends.second != path.end();
}

/// Reads at most so many bytes of a file as a script may have, and one more. Nothing if it fails.
std::optional<std::string> read_some(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(Folder::longest_script + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream.eof() && stream.fail()) return std::nullopt;
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

constexpr std::string_view typed_ending = ".typed";
constexpr std::size_t longest_page = 32;

fs::path typed_file_of(const fs::path& script, std::string_view page) {
  if (!is_page_name(page))
    throw Error(ErrorCode::invalid_argument, "'" + std::string(page) + "' is no name of a page");
  std::string name = "." + script.filename().string() + ".";
  return script.parent_path() / name.append(page).append(typed_ending);
}

/// A TypedFile has what was kept of a page.
struct TypedFile {
  fs::path path;
  std::string page;
  fs::file_time_type time;
};

/// Lists what was kept beside a script which is not newer, the newest first.
std::vector<TypedFile> typed_files_of(const fs::path& script) {
  std::vector<TypedFile> files;
  std::error_code failed;
  const fs::file_time_type saved = fs::last_write_time(script, failed);
  const bool is_saved = !failed;
  const std::string beginning = "." + script.filename().string() + ".";
  for (fs::directory_iterator place(script.parent_path(), failed), end; !failed && place != end;
       place.increment(failed)) {
    std::string name = place->path().filename().string();
    if (!name.starts_with(beginning) || !name.ends_with(typed_ending)) continue;
    if (name.size() < beginning.size() + typed_ending.size()) continue;
    name.resize(name.size() - typed_ending.size());
    std::string page = name.substr(beginning.size());
    std::error_code unknown;
    if (!is_page_name(page) || !fs::is_regular_file(place->symlink_status(unknown))) continue;
    const fs::file_time_type time = place->last_write_time(unknown);
    if (!unknown && !(is_saved && saved > time))
      files.push_back({place->path(), std::move(page), time});
  }
  std::sort(files.begin(), files.end(),
            [](const TypedFile& a, const TypedFile& b) { return a.time > b.time; });
  return files;
}

/// Says whether something may be written to or removed: it is no link that may lead elsewhere.
bool is_plain_or_missing(const fs::path& file) {
  std::error_code failed;
  const fs::file_status status = fs::symlink_status(file, failed);
  return fs::is_regular_file(status) || status.type() == fs::file_type::not_found;
}

}  // namespace

bool is_page_name(std::string_view page) {
  return !page.empty() && page.size() <= longest_page &&
         page.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

Folder::Folder(const fs::path& path) {
  std::error_code failed;
  path_ = fs::canonical(path, failed);
  if (failed || !fs::is_directory(path_))
    throw Error(ErrorCode::io, "there is no folder '" + path.string() + "'");
}

fs::path Folder::file_of(std::string_view name) const {
  const auto refuse = [&](const char* why) {
    throw Error(ErrorCode::invalid_argument, "'" + std::string(name) + "' " + why);
  };
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

std::string Folder::read(std::string_view name) const {
  const fs::path file = file_of(name);
  std::error_code failed;
  if (!fs::is_regular_file(file, failed))
    throw Error(ErrorCode::io, "there is no script '" + std::string(name) + "'");
  std::optional<std::string> text = read_some(file);
  if (!text) throw Error(ErrorCode::io, "'" + std::string(name) + "' cannot be read");
  if (text->size() > longest_script)
    throw Error(ErrorCode::limit, "'" + std::string(name) + "' is longer than 4 MiB");
  if (!text::is_utf8(*text))
    throw Error(ErrorCode::limit, "'" + std::string(name) + "' is not in UTF-8");
  return std::move(*text);
}

void Folder::write(std::string_view name, std::string_view text) const {
  const fs::path script = file_of(name);
  const std::vector<TypedFile> typed = typed_files_of(script);
  write_file(script, text);
  std::error_code failed;
  const fs::file_time_type saved = fs::last_write_time(script, failed);
  if (failed) return;
  for (const TypedFile& file : typed) fs::last_write_time(file.path, saved, failed);
}

void Folder::keep_typed(std::string_view name, std::string_view page, std::string_view text) const {
  const fs::path file = typed_file_of(file_of(name), page);
  if (!is_plain_or_missing(file))
    throw Error(ErrorCode::io, "'" + file.string() + "' is no plain file");
  write_file(file, text);
}

std::optional<TypedText> Folder::typed(
    std::string_view name, const std::function<bool(const TypedText&)>& is_wanted) const {
  for (TypedFile& file : typed_files_of(file_of(name))) {
    std::optional<std::string> text = read_some(file.path);
    if (!text || text->size() > longest_script || !text::is_utf8(*text)) continue;
    TypedText typed{std::move(file.page), std::move(*text)};
    if (is_wanted(typed)) return typed;
  }
  return std::nullopt;
}

void Folder::adopt_typed(std::string_view name, std::string_view from, std::string_view to) const {
  const fs::path script = file_of(name);
  const fs::path source = typed_file_of(script, from);
  const fs::path target = typed_file_of(script, to);
  std::error_code failed;
  if (is_plain_or_missing(source) && is_plain_or_missing(target))
    fs::rename(source, target, failed);
}

void Folder::forget_typed(std::string_view name, std::string_view page) const {
  const fs::path file = typed_file_of(file_of(name), page);
  std::error_code failed;
  if (is_plain_or_missing(file)) fs::remove(file, failed);
}

std::vector<std::string> Folder::scripts() const {
  std::vector<std::string> names;
  std::error_code failed;
  constexpr auto options = fs::directory_options::skip_permission_denied;
  std::size_t looked_at = 0;
  for (fs::recursive_directory_iterator place(path_, options, failed), end;
       !failed && place != end && names.size() < most_listed && ++looked_at < most_looked_at;
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
