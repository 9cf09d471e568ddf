// What writes image files takes its time to load. That is done beside the rendering.
#pragma once

#include <atomic>
#include <exception>
#include <filesystem>
#include <thread>

namespace crt::cli {

/// While a FormatLoader lives, a thread loads what a picture of this name needs to be written. For
/// most formats that is OpenImageIO with the libraries behind it, and nothing for PNG.
class FormatLoader {
 public:
  explicit FormatLoader(const std::filesystem::path& picture);
  /// Waits for the end of the loading.
  ~FormatLoader();
  FormatLoader(const FormatLoader&) = delete;
  FormatLoader& operator=(const FormatLoader&) = delete;

  /// Says whether it is known by now that the picture cannot be written.
  bool has_failed() const { return has_failed_; }
  /// Waits for the end of the loading, and throws what went wrong.
  void finish();

 private:
  void load(const std::filesystem::path& picture);

  std::atomic<bool> has_failed_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace crt::cli
