#include "core/mesh_files/zip_archive.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <string>

#include "core/mesh_files/binary_numbers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "text/format.hpp"
#include "text/letters.hpp"

namespace crt::core {

namespace {

// The records of an archive begin with these numbers, and have at least these sizes.
constexpr std::uint32_t entry_mark = 0x02014b50;
constexpr std::uint32_t file_mark = 0x04034b50;
constexpr std::uint32_t end_mark = 0x06054b50;
constexpr std::uint32_t end_64_mark = 0x06064b50;
constexpr std::uint32_t locator_64_mark = 0x07064b50;
constexpr std::size_t entry_size = 46;
constexpr std::size_t file_size = 30;
constexpr std::size_t end_size = 22;
constexpr std::size_t end_64_size = 56;
constexpr std::size_t locator_64_size = 20;

constexpr std::uint16_t method_stored = 0;
constexpr std::uint16_t method_deflated = 8;

/// Content is passed on in pieces of this size.
constexpr std::size_t piece_size = 1 << 16;

/// A number of these bits alone stands elsewhere, with 64 bits.
constexpr std::uint64_t is_in_64 = 0xffffffff;

[[noreturn]] void refuse_truncated() {
  throw RefusedMesh("it is a ZIP archive without its end: the file is cut off or broken");
}

/// Throws unless the bytes from `place` on are there.
void need(std::string_view bytes, std::uint64_t place, std::uint64_t size) {
  if (place > bytes.size() || size > bytes.size() - place) refuse_truncated();
}

/// Returns where the record is that ends an archive. A comment may follow it.
std::size_t end_of_archive(std::string_view bytes) {
  if (bytes.size() < end_size) refuse_truncated();
  const std::size_t last = bytes.size() - end_size;
  const std::size_t longest_comment = std::numeric_limits<std::uint16_t>::max();
  const std::size_t first = last - std::min(last, longest_comment);
  for (std::size_t place = last + 1; place-- > first;) {
    if (number_at<std::uint32_t>(bytes, place) == end_mark) return place;
  }
  refuse_truncated();
}

/// Fills in the numbers of an entry that did not fit into 32 bits.
void read_64_bits(ZipEntry& entry, std::string_view extra) {
  constexpr std::size_t head = 4;
  while (extra.size() >= head) {
    const auto kind = number_at<std::uint16_t>(extra, 0);
    const std::size_t size =
        std::min<std::size_t>(number_at<std::uint16_t>(extra, 2), extra.size() - head);
    std::string_view numbers = extra.substr(head, size);
    extra.remove_prefix(head + size);
    if (kind != 1) continue;
    for (std::uint64_t* number : {&entry.size, &entry.packed_size, &entry.header_place}) {
      if (*number != is_in_64 || numbers.size() < sizeof *number) continue;
      *number = number_at<std::uint64_t>(numbers, 0);
      numbers.remove_prefix(sizeof *number);
    }
  }
}

/// An Inflater unpacks a stream without the header that zlib's own have.
class Inflater {
 public:
  Inflater() {
    if (inflateInit2(&stream_, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }

  z_stream& stream() { return stream_; }

 private:
  z_stream stream_{};
};

/// Unpacks a stream and passes it on piece by piece. Returns false if it is broken or cut off.
template <class PassOn>
bool inflate_all(std::string_view packed, const PassOn& pass_on) {
  Inflater inflater;
  z_stream& stream = inflater.stream();
  const auto buffer = std::make_unique<char[]>(piece_size);
  for (int status = Z_OK; status != Z_STREAM_END;) {
    const std::size_t given = std::min(packed.size(), piece_size);
    // zlib does not write to its input.
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(packed.data()));
    stream.avail_in = static_cast<uInt>(given);
    stream.next_out = reinterpret_cast<Bytef*>(buffer.get());
    stream.avail_out = static_cast<uInt>(piece_size);
    status = inflate(&stream, Z_NO_FLUSH);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    // A call that neither takes nor gives anything is Z_BUF_ERROR: the stream has no end.
    if (status != Z_OK && status != Z_STREAM_END) return false;
    packed.remove_prefix(given - stream.avail_in);
    pass_on(std::string_view(buffer.get(), piece_size - stream.avail_out));
  }
  return true;
}

}  // namespace

ZipArchive::ZipArchive(std::string_view bytes) : bytes_(bytes) {
  const std::size_t end = end_of_archive(bytes);
  std::uint64_t count = number_at<std::uint16_t>(bytes, end + 10);
  std::uint64_t place = number_at<std::uint32_t>(bytes, end + 16);
  if (end >= locator_64_size &&
      number_at<std::uint32_t>(bytes, end - locator_64_size) == locator_64_mark) {
    const auto end_64 = number_at<std::uint64_t>(bytes, end - locator_64_size + 8);
    need(bytes, end_64, end_64_size);
    if (number_at<std::uint32_t>(bytes, end_64) != end_64_mark) refuse_truncated();
    count = number_at<std::uint64_t>(bytes, end_64 + 32);
    place = number_at<std::uint64_t>(bytes, end_64 + 48);
  }
  read_entries(place, count);
}

void ZipArchive::read_entries(std::uint64_t place, std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) {
    need(bytes_, place, entry_size);
    if (number_at<std::uint32_t>(bytes_, place) != entry_mark)
      refuse_byte(place, "the list of the archive's files is broken");
    const std::uint64_t name_size = number_at<std::uint16_t>(bytes_, place + 28);
    const std::uint64_t extra_size = number_at<std::uint16_t>(bytes_, place + 30);
    const std::uint64_t comment_size = number_at<std::uint16_t>(bytes_, place + 32);
    need(bytes_, place + entry_size, name_size + extra_size + comment_size);
    ZipEntry entry{
        .name = bytes_.substr(place + entry_size, name_size),
        .packed_size = number_at<std::uint32_t>(bytes_, place + 20),
        .size = number_at<std::uint32_t>(bytes_, place + 24),
        .header_place = number_at<std::uint32_t>(bytes_, place + 42),
        .checksum = number_at<std::uint32_t>(bytes_, place + 16),
        .method = number_at<std::uint16_t>(bytes_, place + 10),
        .encrypted = (number_at<std::uint16_t>(bytes_, place + 8) & 1u) != 0,
    };
    read_64_bits(entry, bytes_.substr(place + entry_size + name_size, extra_size));
    entries_.emplace(text::in_small_letters(entry.name), entry);
    place += entry_size + name_size + extra_size + comment_size;
  }
}

const ZipEntry* ZipArchive::find(std::string_view name) const {
  const auto found = entries_.find(text::in_small_letters(name));
  return found == entries_.end() ? nullptr : &found->second;
}

std::string_view ZipArchive::packed_bytes(const ZipEntry& entry) const {
  need(bytes_, entry.header_place, file_size);
  if (number_at<std::uint32_t>(bytes_, entry.header_place) != file_mark)
    refuse_byte(entry.header_place, text::format("here {} should begin", in_quotes(entry.name)));
  const std::uint64_t begin = entry.header_place + file_size +
                              number_at<std::uint16_t>(bytes_, entry.header_place + 26) +
                              number_at<std::uint16_t>(bytes_, entry.header_place + 28);
  need(bytes_, begin, entry.packed_size);
  return bytes_.substr(begin, entry.packed_size);
}

void ZipArchive::count_unpacked(std::size_t bytes) {
  // Models are packed to a tenth or so. A small one may be packed better.
  constexpr std::uint64_t max_for_each_byte = 100;
  constexpr std::uint64_t always_allowed = 1 << 24;
  unpacked_ += bytes;
  if (unpacked_ > always_allowed + max_for_each_byte * bytes_.size()) {
    throw RefusedMesh(text::format("it unpacks to more than {} times its size, as no model does",
                                   max_for_each_byte));
  }
}

void ZipArchive::unpack(const ZipEntry& entry, const std::function<void(std::string_view)>& take) {
  const std::string name = in_quotes(entry.name);
  if (entry.encrypted) throw RefusedMesh(text::format("{} in it is encrypted", name));
  if (entry.method != method_stored && entry.method != method_deflated) {
    throw RefusedMesh(
        text::format("{} in it is packed by method {}; CRT reads stored (0) and "
                     "deflated (8)",
                     name, entry.method));
  }
  uLong checksum = crc32(0, nullptr, 0);
  std::uint64_t size = 0;
  const auto pass_on = [&](std::string_view piece) {
    count_unpacked(piece.size());
    checksum = crc32_z(checksum, reinterpret_cast<const Bytef*>(piece.data()), piece.size());
    size += piece.size();
    take(piece);
  };
  std::string_view packed = packed_bytes(entry);
  if (entry.method == method_deflated) {
    if (!inflate_all(packed, pass_on))
      throw RefusedMesh(text::format("{} in it cannot be unpacked: the file is broken", name));
  } else {
    for (; !packed.empty(); packed.remove_prefix(std::min(packed.size(), piece_size)))
      pass_on(packed.substr(0, piece_size));
  }
  if (size != entry.size || checksum != entry.checksum)
    throw RefusedMesh(text::format("{} in it is not what was packed: the file is broken", name));
}

}  // namespace crt::core
