// A script may reach these files: imports, images, meshes and fonts, in its own directory and those
// that the caller lists, and nowhere else.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "crt/entity.hpp"
#include "crt/image.hpp"
#include "crt/script.hpp"
#include "crt/svg_path.hpp"
#include "crt/text.hpp"
#include "lang/reporter.hpp"
#include "lang/source_map.hpp"

namespace crt::lang {

/// A MeshWay says how a mesh file becomes an entity: see MeshAttributes and MeshOptions.
struct MeshWay {
  std::optional<double> smooth{};  ///< in radians
  std::optional<FillRule> fill{};
  double weld = 0;
  double stitch = 0;

  friend bool operator<(const MeshWay& a, const MeshWay& b) {
    return std::tie(a.smooth, a.fill, a.weld, a.stitch) <
           std::tie(b.smooth, b.fill, b.weld, b.stitch);
  }
};

class Files {
 public:
  explicit Files(const ScriptOptions& options);

  /// Says where the main script lies: its directory is open to the script.
  void set_script_directory(const std::filesystem::path& directory) {
    script_directory_ = directory;
  }

  /// Holds a file that was found, and its content where the caller's callback gave it.
  struct Found {
    std::filesystem::path shown;  ///< its path as messages have it
    std::filesystem::path path;   ///< free of symbolic links, so that a file has one
    std::optional<std::vector<std::byte>> content;
  };

  /// Looks for `name` as a script in `directory` writes it. Throws Failure (io) at `span`.
  Found find(const std::string& name, const std::filesystem::path& directory, Span span) const;

  /// Returns the text of a found file, of at most `most_bytes`.
  std::string read_text(Found found, std::size_t most_bytes, Span span) const;

  /// Returns an image, which is decoded once a run. A warning about values that are not finite
  /// comes then.
  std::shared_ptr<const Image> image(const std::string& name,
                                     const std::filesystem::path& directory, Span span,
                                     Reporter& reporter);

  /// Returns the heights that an image has, which is decoded once a run for them.
  std::shared_ptr<const HeightGrid> heights(const std::string& name,
                                            const std::filesystem::path& directory, Span span,
                                            Reporter& reporter);

  /// Returns the entity of a mesh file, which is read once a run for each way. Warnings go to the
  /// reporter. Without one the mesh keeps them.
  std::shared_ptr<const Entity> mesh(const std::string& name,
                                     const std::filesystem::path& directory, Span span,
                                     const MeshWay& way, Reporter* reporter);

  /// Takes so many pixels from those that the script's pictures may have. Throws Failure (limit) if
  /// there are not so many left.
  void take_pixels(std::uint64_t count, Span span);

  /// Returns a font, which is read once a run.
  std::shared_ptr<const Font> font(const std::string& name, const std::filesystem::path& directory,
                                   Span span);

 private:
  std::vector<std::filesystem::path> candidates(const std::string& name,
                                                const std::filesystem::path& directory) const;
  bool is_open(const std::filesystem::path& candidate) const;
  bool is_really_open(const std::filesystem::path& canonical) const;
  std::vector<std::byte> part_of_mesh(const std::string& name,
                                      const std::filesystem::path& directory, Span span) const;
  std::uint64_t most_pixels();
  [[noreturn]] void pass_pixel_limit(Span span, const std::string& message);
  Image read_image(const Found& found, Span span, Reporter* reporter);
  std::shared_ptr<const Image> picture_of_mesh(const std::string& name,
                                               const std::filesystem::path& directory, Span span,
                                               Reporter* reporter);
  std::shared_ptr<const Image> picture(const std::string& name,
                                       const std::filesystem::path& directory, Span span,
                                       Reporter* reporter);

  const ScriptOptions& options_;
  std::filesystem::path script_directory_;
  std::map<std::filesystem::path, std::shared_ptr<const Image>> images_;
  using MeshesByWay = std::map<MeshWay, std::shared_ptr<const Entity>>;
  std::map<std::filesystem::path, MeshesByWay> meshes_;
  std::map<std::filesystem::path, std::shared_ptr<const Font>> fonts_;
  std::map<std::filesystem::path, std::shared_ptr<const HeightGrid>> heights_;
  std::uint64_t max_pixels_ = 0;  ///< that pictures may have together; 0 until it is known
  std::uint64_t pixels_ = 0;      ///< that they have
};

/// Returns the whole of a regular file, or nothing if it cannot be read or has more than
/// `most_bytes`.
std::optional<std::string> read_regular_file(const std::filesystem::path& path,
                                             std::size_t most_bytes);

}  // namespace crt::lang
