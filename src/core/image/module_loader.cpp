#include "core/image/module_loader.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>

#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

namespace fs = std::filesystem;

/// A Binary is a program or shared library.
struct Binary {
  fs::path file;
  std::vector<fs::path> run_path;  ///< where it wants its libraries to be looked for
};

/// Returns what the linker's option -rpath said when the binary was made. The CMake package and
/// crt.pc use it to name the module's directory to programs with the static library in them.
std::vector<fs::path> run_path_of(const link_map& map) {
  const char* names = nullptr;
  std::optional<std::size_t> place;
  for (const ElfW(Dyn)* entry = map.l_ld; entry->d_tag != DT_NULL; ++entry) {
    if (entry->d_tag == DT_STRTAB) {
      // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader has addresses as numbers
      names = reinterpret_cast<const char*>(entry->d_un.d_ptr);
    }
    if (entry->d_tag == DT_RUNPATH || entry->d_tag == DT_RPATH) place = entry->d_un.d_val;
  }
  std::vector<fs::path> directories;
  if (names == nullptr || !place) return directories;
  std::istringstream run_path(names + *place);
  for (std::string directory; std::getline(run_path, directory, ':');) {
    // What is relative to the binary is looked at anyway.
    if (directory.starts_with('/')) directories.emplace_back(directory);
  }
  return directories;
}

/// Returns the program or shared library that this code was linked into.
Binary containing_binary() {
  // Any object of this file will do as the address.
  static const char place = 0;
  Dl_info info{};
  link_map* map = nullptr;
  if (dladdr1(&place, &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) == 0 ||
      map == nullptr)
    return {};
  std::error_code error;
  // The loader knows the program itself by no name (or by however it was called).
  const bool is_program = map->l_name == nullptr || map->l_name[0] == 0;
  return {
      is_program ? fs::read_symlink("/proc/self/exe", error) : fs::canonical(map->l_name, error),
      run_path_of(*map)};
}

/// Returns the module in this file, or null with the reason added to `reasons`.
const ImageFiles* try_load(const fs::path& file, std::string& reasons) {
  const auto give_reason = [&](const std::string& reason) {
    reasons += text::format("\n  {}: {}", file.string(), reason);
  };
  std::error_code error;
  if (!fs::exists(file, error)) {
    give_reason("not there");
    return nullptr;
  }
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* const message = dlerror();
    give_reason(message == nullptr ? "cannot be loaded" : message);
    return nullptr;
  }
  const auto entry = reinterpret_cast<ImageFilesEntry>(dlsym(library, image_files_entry_name));
  const ImageFiles* const functions = entry == nullptr ? nullptr : entry();
  if (functions == nullptr || functions->version != image_files_version) {
    give_reason("of another version of CRT");
    dlclose(library);
    return nullptr;
  }
  return functions;
}

}  // namespace

std::vector<fs::path> image_files_directories() {
  std::vector<fs::path> directories;
  const Binary binary = containing_binary();
  if (!binary.file.empty()) {
    const fs::path home = binary.file.parent_path();
    directories.push_back(home.parent_path() / "lib" / "crt");
    directories.push_back(home / "crt");
    directories.push_back(home.parent_path() / "lib" / CRT_MULTIARCH / "crt");
  }
  directories.insert(directories.end(), binary.run_path.begin(), binary.run_path.end());
#ifdef CRT_IMAGE_FILES_BUILD_DIR
  directories.emplace_back(CRT_IMAGE_FILES_BUILD_DIR);
#endif
  directories.emplace_back(CRT_IMAGE_FILES_INSTALL_DIR);
  return directories;
}

const ImageFiles& load_image_files(std::span<const fs::path> directories) {
  std::string reasons;
  for (const fs::path& directory : directories) {
    if (const ImageFiles* functions = try_load(directory / image_files_module_name, reasons))
      return *functions;
  }
  throw Error(
      ErrorCode::unsupported,
      text::format(
          "all image files but PNG files that are written need the module {}, which could not be "
          "loaded; looked for:{}",
          image_files_module_name, reasons));
}

const ImageFiles& image_files() {
  // This function only loads code and keeps it. A failure is thrown, and the next call tries again.
  static const ImageFiles& functions = load_image_files(image_files_directories());
  return functions;
}

}  // namespace crt::core
