// The opened folder has the scripts that the page may read and write. Nothing else can be reached.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crt::studio {

class Folder {
 public:
  static constexpr std::size_t longest_script = std::size_t{4} << 20;

  /// Takes a folder that exists. Throws Error (io) if it is none.
  explicit Folder(const std::filesystem::path& path);

  /// Returns the file of a name relative to the folder: "parts/wheel.crt". Throws Error
  /// (invalid_argument) for one that leads out of the folder, also by links, or that is no script.
  std::filesystem::path file_of(std::string_view name) const;

  /// Reads a script. Throws Error as file_of() does, io if it cannot be read, limit if it is too
  /// long or no text of UTF-8.
  std::string read(std::string_view name) const;

  /// Writes a script, whole or not at all. Throws Error as file_of() does, and io.
  void write(std::string_view name, std::string_view text) const;

  /// Keeps beside a script what was typed and not saved, in `.NAME.crt.typed`. It throws as
  /// write().
  void keep_typed(std::string_view name, std::string_view text) const;
  /// Returns what was kept beside a script if that is not newer. Throws Error as file_of() does.
  std::optional<std::string> typed(std::string_view name) const;
  /// Removes what was kept beside a script, if there is anything. Throws Error as file_of() does.
  void forget_typed(std::string_view name) const;

  /// Lists the scripts in the folder and those in it, in the order of their names.
  std::vector<std::string> scripts() const;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;  ///< without links
};

}  // namespace crt::studio
