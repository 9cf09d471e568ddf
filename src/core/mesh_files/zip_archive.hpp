// 3MF files are ZIP archives. This reads what such an archive has: PKWARE, APPNOTE.TXT 6.3.10, the
// parts that ISO/IEC 21320-1 allows in documents.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace crt::core {

/// A ZipEntry is a file in an archive.
struct ZipEntry {
  std::string_view name;
  std::uint64_t packed_size = 0;
  std::uint64_t size = 0;
  std::uint64_t header_place = 0;
  std::uint32_t checksum = 0;
  std::uint16_t method = 0;
  bool encrypted = false;
};

class ZipArchive {
 public:
  /// Reads the list of entries. The bytes must live as long as the archive. Throws RefusedMesh.
  explicit ZipArchive(std::string_view bytes);

  /// Returns the entry of this name, or null. Case means nothing, as in all packages of OPC.
  const ZipEntry* find(std::string_view name) const;

  /// Unpacks an entry and passes it to `take`, piece by piece. Throws RefusedMesh if it is broken.
  /// It also does if all that was unpacked so far is out of proportion to the file's size.
  void unpack(const ZipEntry& entry, const std::function<void(std::string_view)>& take);

 private:
  void read_entries(std::uint64_t place, std::uint64_t count);
  std::string_view packed_bytes(const ZipEntry& entry) const;
  void count_unpacked(std::size_t bytes);

  std::string_view bytes_;
  std::map<std::string, ZipEntry> entries_;  ///< by their names in lower case
  std::uint64_t unpacked_ = 0;
};

}  // namespace crt::core
