#include "lang/files.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <span>
#include <system_error>
#include <utility>

#include "crt/image_limits.hpp"
#include "crt/mesh_file.hpp"
#include "lang/utf8.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_reading(Span span, std::string message) {
  throw Failure{.span = span, .message = std::move(message), .code = ErrorCode::io};
}

/// Says whether `path` is `directory` or lies below it, by the names alone. Both are normal.
bool lies_in(const fs::path& path, fs::path directory) {
  if (!directory.has_filename()) directory = directory.parent_path();  // "a/" is "a"
  if (directory.empty() || directory == ".")
    return path.is_relative() && (path.empty() || *path.begin() != "..");
  const auto ends = std::mismatch(directory.begin(), directory.end(), path.begin(), path.end());
  return ends.first == directory.end() &&
         std::find(ends.second, path.end(), fs::path("..")) == path.end();
}

fs::path in_directory(const fs::path& directory, const fs::path& name) {
  return (directory / name).lexically_normal();
}

}  // namespace

Files::Files(const ScriptOptions& options) : options_(options) {}

std::vector<fs::path> Files::candidates(const std::string& name, const fs::path& directory) const {
  const fs::path path(name);
  std::vector<fs::path> result;
  // A leading '/' is the root of a resource directory, not that of the file system.
  const bool from_root = path.has_root_directory();
  if (!from_root) {
    result.push_back(in_directory(directory, path));
    result.push_back(in_directory(script_directory_, path));
  }
  for (const fs::path& resources : options_.resource_directories)
    result.push_back(in_directory(resources, path.relative_path()));
  std::set<fs::path> seen;
  std::erase_if(result, [&seen](const fs::path& p) { return !seen.insert(p).second; });
  return result;
}

bool Files::is_open(const fs::path& candidate) const {
  if (options_.allow_outside_files) return true;
  const auto holds = [&](const fs::path& directory) {
    return lies_in(candidate, directory.lexically_normal());
  };
  return holds(script_directory_) || std::any_of(options_.resource_directories.begin(),
                                                 options_.resource_directories.end(), holds);
}

bool Files::is_really_open(const fs::path& canonical) const {
  if (options_.allow_outside_files) return true;
  const auto holds = [&](const fs::path& directory) {
    std::error_code failed;
    const fs::path real = fs::canonical(directory.empty() ? fs::path(".") : directory, failed);
    return !failed && lies_in(canonical, real);
  };
  return holds(script_directory_) || std::any_of(options_.resource_directories.begin(),
                                                 options_.resource_directories.end(), holds);
}

Files::Found Files::find(const std::string& name, const fs::path& directory, Span span) const {
  const std::string shown = abbreviated(name);
  if (name.empty()) fail_reading(span, "a file's name must not be empty");
  if (name.find('\0') != std::string::npos)
    fail_reading(span, "a file's name must not hold the character U+0000");
  bool outside = false;
  for (const fs::path& candidate : candidates(name, directory)) {
    if (!is_open(candidate)) {
      outside = true;
      continue;
    }
    if (options_.open_file) {
      if (auto content = options_.open_file(candidate))
        return {candidate, candidate, std::move(content)};
    }
    std::error_code failed;
    const fs::path canonical = fs::canonical(candidate, failed);
    if (failed) continue;
    if (!is_really_open(canonical)) {
      outside = true;
      continue;
    }
    if (!fs::is_regular_file(canonical, failed))
      fail_reading(span, text::format("'{}' is not a regular file", shown));
    return {candidate, canonical, std::nullopt};
  }
  if (outside)
    fail_reading(
        span,
        text::format(
            "'{}' lies outside the directories that a script may read: its own and the resource "
            "directories",
            shown));
  if (fs::path(name).has_root_directory() && options_.resource_directories.empty())
    fail_reading(
        span,
        text::format(
            "there is no file '{}': a leading '/' means a resource directory, and none is set",
            shown));
  fail_reading(span, text::format("there is no file '{}'", shown));
}

std::string Files::read_text(Found found, std::size_t most_bytes, Span span) const {
  const std::string shown = abbreviated(found.shown.string());
  if (found.content) {
    const std::vector<std::byte>& bytes = *found.content;
    if (bytes.size() > most_bytes)
      throw Failure{.span = span,
                    .message = text::format("'{}' is too long", shown),
                    .code = ErrorCode::limit};
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  std::error_code failed;
  if (fs::file_size(found.path, failed) > most_bytes && !failed)
    throw Failure{
        .span = span, .message = text::format("'{}' is too long", shown), .code = ErrorCode::limit};
  std::optional<std::string> text = read_regular_file(found.path, most_bytes);
  if (!text) fail_reading(span, text::format("'{}' cannot be read", shown));
  return std::move(*text);
}

std::uint64_t Files::most_pixels() {
  if (max_pixels_ == 0) {
    const std::uint64_t given = options_.limits.image_pixels;
    max_pixels_ = given == 0 ? std::max<std::uint64_t>(affordable_image_pixels(), 1) : given;
  }
  return max_pixels_;
}

void Files::pass_pixel_limit(Span span, const std::string& message) {
  throw Failure{.span = span,
                .message = text::format("{}: all pictures of a script may have {} pixels together",
                                        message, most_pixels()),
                .code = ErrorCode::limit};
}

void Files::take_pixels(std::uint64_t count, Span span) {
  if (count > most_pixels() - pixels_) pass_pixel_limit(span, "there are too many heights");
  pixels_ += count;
}

/// Decodes an image. Values that are not finite become 0, of which it warns.
Image Files::read_image(const Found& found, Span span, Reporter* reporter) {
  const std::string shown = found.shown.string();
  const std::uint64_t left = most_pixels() - pixels_;
  if (left == 0) pass_pixel_limit(span, text::format("cannot read '{}'", abbreviated(shown)));
  try {
    Image image = found.content ? decode_image(*found.content, shown, left)
                                : crt::read_image(found.shown, left);
    pixels_ += image.pixels().size() / 4;
    if (reporter != nullptr && image.not_finite().pixels > 0) {
      reporter->warning(span, printable(image.not_finite().message()));
      image.set_not_finite({});
    }
    return image;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::limit) pass_pixel_limit(span, printable(error.what()));
    throw;
  }
}

namespace {

/// Calls make(), whose errors are about a file that is named at `span`.
template <class Make>
auto made_of_file(Span span, const Make& make) {
  try {
    return make();
  } catch (const Error& error) {
    throw Failure{.span = span, .message = printable(error.what()), .code = error.code()};
  }
}

}  // namespace

std::shared_ptr<const Image> Files::picture(const std::string& name, const fs::path& directory,
                                            Span span, Reporter* reporter) {
  const Found found = find(name, directory, span);
  std::shared_ptr<const Image>& image = images_[found.path];
  if (!image) {
    image = made_of_file(
        span, [&] { return std::make_shared<const Image>(read_image(found, span, reporter)); });
  }
  return image;
}

std::shared_ptr<const Image> Files::image(const std::string& name, const fs::path& directory,
                                          Span span, Reporter& reporter) {
  return picture(name, directory, span, &reporter);
}

/// Returns the content of a file that a mesh file names, such as a picture.
std::vector<std::byte> Files::part_of_mesh(const std::string& name, const fs::path& directory,
                                           Span span) const {
  constexpr std::size_t most_bytes = std::size_t{1} << 32;
  try {
    Found found = find(name, directory, span);
    if (found.content) return std::move(*found.content);
    const std::string text = read_text(std::move(found), most_bytes, span);
    const auto* const bytes = reinterpret_cast<const std::byte*>(text.data());
    return {bytes, bytes + text.size()};
  } catch (const Failure& failure) {
    throw Error(ErrorCode::io, failure.message);
  }
}

std::shared_ptr<const Image> Files::picture_of_mesh(const std::string& name,
                                                    const fs::path& directory, Span span,
                                                    Reporter* reporter) {
  try {
    return picture(name, directory, span, reporter);
  } catch (const Failure& failure) {
    throw Error(failure.code, failure.message);
  }
}

std::shared_ptr<const HeightGrid> Files::heights(const std::string& name, const fs::path& directory,
                                                 Span span, Reporter& reporter) {
  const Found found = find(name, directory, span);
  std::shared_ptr<const HeightGrid>& heights = heights_[found.path];
  if (!heights) {
    heights =
        made_of_file(span, [&] { return make_height_grid(read_image(found, span, &reporter)); });
  }
  return heights;
}

std::shared_ptr<const Entity> Files::mesh(const std::string& name, const fs::path& directory,
                                          Span span, const MeshWay& way, Reporter* reporter) {
  const Found found = find(name, directory, span);
  MeshesByWay& meshes = meshes_[found.path];
  const auto known = meshes.find(way);
  if (known != meshes.end()) return known->second;
  constexpr std::size_t max_ways = 16;
  if (meshes.size() == max_ways) {
    throw Failure{.span = span,
                  .message = text::format("'{}' is smoothed, filled, welded or stitched in more "
                                          "than {} different ways",
                                          abbreviated(name), max_ways),
                  .code = ErrorCode::limit};
  }
  return made_of_file(span, [&] {
    const std::string shown = found.shown.string();
    const OpenMeshPart open = [&](const std::string& part) {
      return part_of_mesh(part, found.shown.parent_path(), span);
    };
    const OpenMeshPicture open_picture = [&](const std::string& part) {
      return picture_of_mesh(part, found.shown.parent_path(), span, reporter);
    };
    MeshFile file = found.content ? decode_mesh_file(*found.content, shown, {}, open, open_picture)
                                  : read_mesh_file(found.shown, open, open_picture);
    file.attributes.smooth = way.smooth;
    MeshOptions options{.fill = way.fill, .weld = way.weld, .stitch = way.stitch};
    if (reporter != nullptr) {
      options.warn = [&](const std::string& warning) {
        reporter->warning(span, printable(text::format("'{}': {}", shown, warning)));
      };
    }
    return meshes[way] = std::make_shared<const Entity>(load_mesh(file, shown, options));
  });
}

std::shared_ptr<const Font> Files::font(const std::string& name, const fs::path& directory,
                                        Span span) {
  const Found found = find(name, directory, span);
  std::shared_ptr<const Font>& font = fonts_[found.path];
  if (!font) {
    font = made_of_file(span, [&] {
      return found.content ? decode_font(*found.content, found.shown.string())
                           : read_font(found.shown);
    });
  }
  return font;
}

std::optional<std::string> read_regular_file(const fs::path& path, std::size_t most_bytes) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::string text;
  constexpr std::size_t piece = 1 << 16;
  while (file && text.size() <= most_bytes) {
    const std::size_t before = text.size();
    text.resize(before + piece);
    file.read(text.data() + before, static_cast<std::streamsize>(piece));
    text.resize(before + static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof() || text.size() > most_bytes) return std::nullopt;
  return text;
}

}  // namespace crt::lang
