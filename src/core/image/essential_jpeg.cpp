// A JPEG file is a list of markers and segments.
//
// Source: ITU-T T.81, Digital compression and coding of continuous-tone still images, annex B (the
// order of markers and segments).
#include <algorithm>

#include "core/image/byte_order.hpp"
#include "core/image/essential_bytes.hpp"
#include "core/image/image_limits.hpp"

namespace crt::core {

namespace {

constexpr std::byte marker_start{0xff};
constexpr unsigned start_of_image = 0xd8;
constexpr unsigned end_of_image = 0xd9;
constexpr unsigned start_of_scan = 0xda;

/// Returns whether nothing follows a marker: restart markers and one for private use.
bool stands_alone(unsigned marker) {
  return (marker >= 0xd0 && marker <= 0xd7) || marker == 0x01;
}

/// Returns whether a segment is a comment or an application's. Those of JFIF and Adobe are kept, as
/// they say how the channels make colours.
bool is_metadata(unsigned marker) {
  constexpr unsigned comment = 0xfe;
  constexpr unsigned first_application = 0xe0;
  constexpr unsigned last_application = 0xef;
  constexpr unsigned jfif = 0xe0;
  constexpr unsigned adobe = 0xee;
  const bool application = marker >= first_application && marker <= last_application;
  return marker == comment || (application && marker != jfif && marker != adobe);
}

/// Returns whether a segment is the header of a frame, which has its size.
bool is_frame_header(unsigned marker) {
  constexpr unsigned huffman_tables = 0xc4;
  constexpr unsigned extension = 0xc8;
  constexpr unsigned arithmetic_conditions = 0xcc;
  return marker >= 0xc0 && marker <= 0xcf && marker != huffman_tables && marker != extension &&
         marker != arithmetic_conditions;
}

/// Returns how long the coded data is that follows the header of a scan. It ends at a marker that
/// does not belong to it: 0xff 0x00 stands for the number 0xff, and restart markers are part of the
/// data.
std::size_t scan_length(FileView data) {
  for (std::size_t i = 0; i + 1 < data.size(); ++i) {
    const auto next = std::to_integer<unsigned>(data[i + 1]);
    if (data[i] == marker_start && next != 0 && !stands_alone(next)) return i;
  }
  return data.size();
}

}  // namespace

FileBytes essential_jpeg(FileView content, const SizeLimit& limit) {
  // A file of many scans takes long to read for its size. Encoders make about ten.
  constexpr int max_scans = 100;
  int scans = 0;
  FileBytes result;
  const auto keep = [&](FileView bytes) {
    result.insert(result.end(), bytes.begin(), bytes.end());
  };
  FileView rest = content;
  while (rest.size() >= 2) {
    if (rest[0] != marker_start) throw RefusedFile("it is damaged: a marker is missing");
    const auto marker = std::to_integer<unsigned>(rest[1]);
    if (rest[1] == marker_start) {  // one of any number of fill bytes
      rest = rest.subspan(1);
      continue;
    }
    if (marker == start_of_image || marker == end_of_image || stands_alone(marker)) {
      keep(rest.first(2));
      rest = rest.subspan(2);
      if (marker == end_of_image) return result;
      continue;
    }
    if (rest.size() < 4) break;
    const std::size_t length = big_endian(rest.subspan(2, 2));  // counts itself, not the marker
    if (length < 2) throw RefusedFile("it is damaged: a segment has no length");
    if (length + 2 > rest.size()) break;
    constexpr std::size_t height_at = 5;  // behind marker, length and precision; the width follows
    if (is_frame_header(marker) && length + 2 >= height_at + 4) {
      limit.check(big_endian(rest.subspan(height_at + 2, 2)),
                  big_endian(rest.subspan(height_at, 2)));
    }
    if (!is_metadata(marker)) keep(rest.first(length + 2));
    rest = rest.subspan(length + 2);
    if (marker == start_of_scan) {
      if (++scans > max_scans) throw RefusedFile("it has too many scans");
      const std::size_t coded = scan_length(rest);
      keep(rest.first(coded));
      rest = rest.subspan(coded);
    }
  }
  throw RefusedFile("it is cut short");
}

}  // namespace crt::core
