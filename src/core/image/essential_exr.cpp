// A header of an EXR file is a list of attributes (name, type, size, value) and ends with an empty
// name. A file of several parts has a list of headers that ends with an empty one.
//
// Source: The OpenEXR File Layout (openexr.com).
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/image/byte_order.hpp"
#include "core/image/essential_bytes.hpp"
#include "core/image/image_limits.hpp"

namespace crt::core {

namespace {

struct Attribute {
  std::string_view name;
  FileView value;
};

/// A Reader reads the file from its beginning, and refuses the file if it ends too early.
class Reader {
 public:
  explicit Reader(FileView rest) : rest_(rest) {}

  FileView bytes(std::uint64_t count) {
    if (count > rest_.size()) throw RefusedFile("it is cut short");
    const FileView taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  std::uint64_t number() { return little_endian(bytes(4)); }

  /// Reads up to a zero byte, and returns what is before it.
  std::string_view text() {
    const auto end = std::find(rest_.begin(), rest_.end(), std::byte{0});
    const auto length = static_cast<std::size_t>(end - rest_.begin());
    const FileView taken = bytes(length + 1);
    return {reinterpret_cast<const char*>(taken.data()), length};
  }

  /// Reads the next attribute, or nothing at the end of the header.
  std::optional<Attribute> attribute() {
    const std::string_view name = text();
    if (name.empty()) return {};
    text();  // the type
    const std::uint64_t size = number();
    return Attribute{name, bytes(size)};
  }

 private:
  FileView rest_;
};

std::int64_t signed_number(FileView value, std::size_t index) {
  return static_cast<std::int32_t>(little_endian(value.subspan(4 * index, 4)));
}

/// Returns whether a picture of this size may be in a file of so many bytes.
bool is_plausible(std::int64_t width, std::int64_t height, std::size_t file_size) {
  if (width < 1 || height < 1) return false;
  if (static_cast<std::uint64_t>(width) > most_image_pixels / static_cast<std::uint64_t>(height))
    return false;
  // Each block of rows has an offset of 8 bytes and at least as much of a header.
  constexpr std::uint64_t max_rows_a_block = 256;
  constexpr std::uint64_t least_bytes_a_block = 16;
  return static_cast<std::uint64_t>(height) / max_rows_a_block * least_bytes_a_block <= file_size;
}

void check_attribute(const Attribute& attribute, std::size_t file_size, const SizeLimit& limit) {
  constexpr std::size_t window_size = 16;  // the corners: least x and y, greatest x and y
  constexpr std::size_t tiles_size = 9;    // width, height, mode
  if (attribute.name == "dataWindow" && attribute.value.size() == window_size) {
    const std::int64_t width =
        signed_number(attribute.value, 2) - signed_number(attribute.value, 0) + 1;
    const std::int64_t height =
        signed_number(attribute.value, 3) - signed_number(attribute.value, 1) + 1;
    if (!is_plausible(width, height, file_size))
      throw RefusedFile("its header gives it an impossible size");
    limit.check(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
  }
  if (attribute.name == "tiles" && attribute.value.size() == tiles_size) {
    const std::int64_t width = signed_number(attribute.value, 0);
    const std::int64_t height = signed_number(attribute.value, 1);
    if (!is_plausible(width, height, max_image_file_bytes)) {
      throw RefusedFile("its header gives its tiles an impossible size");
    }
  }
}

}  // namespace

void check_exr(FileView content, const SizeLimit& limit) {
  Reader reader(content);
  reader.number();  // the signature
  constexpr std::uint64_t several_parts = 0x1000;
  const bool has_parts = (reader.number() & several_parts) != 0;
  bool empty_header = false;
  do {
    empty_header = true;
    while (const std::optional<Attribute> attribute = reader.attribute()) {
      empty_header = false;
      check_attribute(*attribute, content.size(), limit);
    }
  } while (has_parts && !empty_header);
}

}  // namespace crt::core
