// Writes ZIP archives: PKWARE, APPNOTE.TXT 6.3.10, as far as 3MF files need it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace crt::core {

class ZipWriter {
 public:
  /// Adds a file that is compressed. Throws Error (limit) if it or the archive has 4 GiB.
  void add(std::string_view name, std::string_view content);
  /// Returns the archive. Nothing can be added then.
  std::string finish();

 private:
  std::string bytes_;
  std::string entries_;
  std::uint16_t count_ = 0;
};

}  // namespace crt::core
