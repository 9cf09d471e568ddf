#include "core/image/module_loader.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <string>
#include <system_error>

#include "crt/error.hpp"

namespace crt::core {

namespace {

namespace fs = std::filesystem;

/// Returns the file of the program or shared library that this code was linked into.
fs::path containing_binary() {
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
  return is_program ? fs::read_symlink("/proc/self/exe", error) : fs::canonical(map->l_name, error);
}

/// Returns the module in this file, or null with the reason added to `reasons`.
const ImageFiles* try_load(const fs::path& file, std::string& reasons) {
  const auto give_reason = [&](const std::string& reason) {
    reasons += fmt::format("\n  {}: {}", file.string(), reason);
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
  const fs::path binary = containing_binary();
  if (!binary.empty()) {
    const fs::path home = binary.parent_path();
    directories.push_back(home.parent_path() / "lib" / "crt");
    directories.push_back(home / "crt");
    directories.push_back(home.parent_path() / "lib" / CRT_MULTIARCH / "crt");
  }
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
      fmt::format(
          "image files cannot be read or written: the module {} was not found; looked for:{}",
          image_files_module_name, reasons));
}

const ImageFiles& image_files() {
  // This function only loads code and keeps it. A failure is thrown, and the next call tries again.
  static const ImageFiles& functions = load_image_files(image_files_directories());
  return functions;
}

}  // namespace crt::core
