// The opened folder has the scripts that the page may read and write. Nothing else can be reached.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studio/open_beneath.hpp"

namespace crt::studio {

/// A TypedText was typed in a page and not saved.
struct TypedText {
  std::string page;
  std::string text;
};

class Folder {
 public:
  static constexpr std::size_t longest_script = std::size_t{4} << 20;

  /// Takes a folder that exists. Throws Error (io) if it is none.
  explicit Folder(const std::filesystem::path& path);

  /// Returns the file of a name relative to the folder: "parts/wheel.crt". Throws Error
  /// (invalid_argument) for one that leads out of the folder, also by links, or that is no script.
  /// It may lead elsewhere by now: what reads and writes files here follows no link of its path.
  std::filesystem::path file_of(std::string_view name) const;

  /// Reads a script. Throws Error as file_of() does, io if it cannot be read, limit if it is too
  /// long or no text of UTF-8.
  std::string read(std::string_view name) const;

  /// Writes a script, whole or not at all. What pages have kept beside it stays newer than the
  /// script, if it was. Throws Error as file_of() does, and io.
  void write(std::string_view name, std::string_view text) const;

  // Each page keeps beside a script what was typed and not saved, in `.NAME.crt.PAGE.typed`. All of
  // these throw Error as file_of() does, and invalid_argument for what is no name of a page.

  /// What was typed is kept for so long.
  static constexpr std::chrono::days typed_time{30};

  /// Writes what was typed in a page, for those who may read the script. It throws as write(), too.
  void keep_typed(std::string_view name, std::string_view page, std::string_view text) const;
  /// Returns the newest text that was kept and is wanted, and that the script is not newer than.
  std::optional<TypedText> typed(std::string_view name,
                                 const std::function<bool(const TypedText&)>& is_wanted) const;
  /// Gives a page what another one has kept, in place of its own.
  void adopt_typed(std::string_view name, std::string_view from, std::string_view to) const;
  /// Removes what was kept of a page, if there is anything.
  void forget_typed(std::string_view name, std::string_view page) const;
  /// Removes what has been kept for too long of any script that lies beside this one, but not what
  /// is in use: that of a script's file and a page.
  void forget_old_typed(
      std::string_view name,
      const std::function<bool(const std::string& file, const std::string& page)>& is_used) const;

  /// Lists the scripts in the folder and those in it, in the order of their names.
  std::vector<std::string> scripts() const;

  const std::filesystem::path& path() const { return path_; }

 private:
  /// A Place is where a script is, or would be: a name in a folder that is open.
  struct Place {
    FileHandle folder;
    std::string name;
    std::filesystem::path file;
  };
  Place place_of(std::string_view name) const;

  std::filesystem::path path_;  ///< without links
  FileHandle folder_;
};

}  // namespace crt::studio
