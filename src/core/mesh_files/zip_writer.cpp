#include "core/mesh_files/zip_writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <memory>
#include <new>

#include "core/mesh_files/surface_writers.hpp"

namespace crt::core {

namespace {

constexpr std::uint16_t version_of_zip = 20;  ///< 2.0, which has deflate
constexpr std::uint16_t deflate_method = 8;
constexpr std::uint16_t utf8_name = 1U << 11U;
constexpr std::uint16_t first_date = (1U << 5U) | 1U;  ///< 1 January 1980
constexpr std::size_t piece_of_zip = 1U << 16U;

/// Compresses a content, piece by piece, as zlib's counts may have 32 bits.
class Deflating {
 public:
  Deflating() {
    constexpr int memory_level = 8;
    if (deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, memory_level,
                     Z_DEFAULT_STRATEGY) != Z_OK)
      throw std::bad_alloc();
  }
  Deflating(const Deflating&) = delete;
  Deflating& operator=(const Deflating&) = delete;
  ~Deflating() { deflateEnd(&stream_); }

  std::string pack(std::string_view content) {
    std::string packed;
    std::string piece(piece_of_zip, 0);
    std::size_t taken = 0;
    int state = Z_OK;
    while (state != Z_STREAM_END) {
      const std::size_t given = std::min(piece_of_zip, content.size() - taken);
      // zlib does not write there.
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data() + taken));
      stream_.avail_in = static_cast<uInt>(given);
      stream_.next_out = reinterpret_cast<Bytef*>(piece.data());
      stream_.avail_out = static_cast<uInt>(piece.size());
      state = deflate(&stream_, taken + given == content.size() ? Z_FINISH : Z_NO_FLUSH);
      taken += given - stream_.avail_in;
      packed.append(piece, 0, piece.size() - stream_.avail_out);
    }
    return packed;
  }

 private:
  z_stream stream_{};
};

std::uint32_t checksum_of(std::string_view content) {
  uLong sum = crc32(0, nullptr, 0);
  for (std::size_t place = 0; place < content.size(); place += piece_of_zip) {
    const std::string_view piece = content.substr(place, piece_of_zip);
    sum = crc32(sum, reinterpret_cast<const Bytef*>(piece.data()), static_cast<uInt>(piece.size()));
  }
  return static_cast<std::uint32_t>(sum);
}

}  // namespace

void ZipWriter::add(std::string_view name, std::string_view content) {
  check_bytes("3MF", content.size());
  const std::string packed = Deflating().pack(content);
  const auto place = static_cast<std::uint32_t>(bytes_.size());
  constexpr std::size_t heads = 256;  // both headers, and the end
  check_bytes("3MF", bytes_.size() + packed.size() + entries_.size() + 4 * name.size() + heads);
  // What both headers have.
  std::string head;
  append_bytes(head, version_of_zip);
  append_bytes(head, utf8_name);
  append_bytes(head, deflate_method);
  append_bytes(head, std::uint16_t{0});
  append_bytes(head, first_date);
  append_bytes(head, checksum_of(content));
  append_bytes(head, static_cast<std::uint32_t>(packed.size()));
  append_bytes(head, static_cast<std::uint32_t>(content.size()));
  append_bytes(head, static_cast<std::uint16_t>(name.size()));
  append_bytes(head, std::uint16_t{0});  // no extra field
  bytes_ += "PK\3\4" + head;
  bytes_ += name;
  bytes_ += packed;
  entries_ += "PK\1\2";
  append_bytes(entries_, version_of_zip);
  entries_ += head;
  append_bytes(entries_, std::uint16_t{0});  // no comment
  append_bytes(entries_, std::uint16_t{0});  // the one disk
  append_bytes(entries_, std::uint16_t{0});
  append_bytes(entries_, std::uint32_t{0});
  append_bytes(entries_, place);
  entries_ += name;
  ++count_;
}

std::string ZipWriter::finish() {
  const auto place = static_cast<std::uint32_t>(bytes_.size());
  const auto size = static_cast<std::uint32_t>(entries_.size());
  bytes_ += entries_;
  bytes_ += "PK\5\6";
  append_bytes(bytes_, std::uint32_t{0});  // one disk
  append_bytes(bytes_, count_);
  append_bytes(bytes_, count_);
  append_bytes(bytes_, size);
  append_bytes(bytes_, place);
  append_bytes(bytes_, std::uint16_t{0});  // no comment
  return std::move(bytes_);
}

}  // namespace crt::core
