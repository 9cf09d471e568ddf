#include "studio/folder.hpp"

#include <algorithm>
#include <crt/error.hpp>
#include <crt/file.hpp>
#include <fstream>
#include <system_error>

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

/// Says whether a text is UTF-8 as far as its lead and continuation bytes go.
bool is_utf8(std::string_view text) {
  int expected = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool continues = (byte & 0xc0U) == 0x80U;
    if (continues != (expected > 0)) return false;
    if (continues) {
      --expected;
    } else if (byte >= 0xf8U) {
      return false;
    } else {
      expected = byte >= 0xf0U ? 3 : byte >= 0xe0U ? 2 : byte >= 0xc0U ? 1 : 0;
    }
  }
  return expected == 0;
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

fs::path typed_file_of(const fs::path& script) {
  return script.parent_path() / ("." + script.filename().string() + ".typed");
}

/// Says whether something may be written to or removed: it is no link that may lead elsewhere.
bool is_plain_or_missing(const fs::path& file) {
  std::error_code failed;
  const fs::file_status status = fs::symlink_status(file, failed);
  return fs::is_regular_file(status) || status.type() == fs::file_type::not_found;
}

}  // namespace

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
  if (!is_utf8(*text)) throw Error(ErrorCode::limit, "'" + std::string(name) + "' is not in UTF-8");
  return std::move(*text);
}

void Folder::write(std::string_view name, std::string_view text) const {
  write_file(file_of(name), text);
}

void Folder::keep_typed(std::string_view name, std::string_view text) const {
  const fs::path file = typed_file_of(file_of(name));
  if (!is_plain_or_missing(file))
    throw Error(ErrorCode::io, "'" + file.string() + "' is no plain file");
  write_file(file, text);
}

std::optional<std::string> Folder::typed(std::string_view name) const {
  const fs::path script = file_of(name);
  const fs::path file = typed_file_of(script);
  std::error_code failed;
  if (!fs::is_regular_file(fs::symlink_status(file, failed))) return std::nullopt;
  const fs::file_time_type kept = fs::last_write_time(file, failed);
  if (failed) return std::nullopt;
  const fs::file_time_type saved = fs::last_write_time(script, failed);
  if (!failed && saved > kept) return std::nullopt;
  std::optional<std::string> text = read_some(file);
  if (!text || text->size() > longest_script || !is_utf8(*text)) return std::nullopt;
  return text;
}

void Folder::forget_typed(std::string_view name) const {
  const fs::path file = typed_file_of(file_of(name));
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
