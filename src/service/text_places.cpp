#include <algorithm>
#include <crt/text_places.hpp>
#include <iterator>

#include "lang/source_map.hpp"
#include "lang/utf8.hpp"

namespace crt {

namespace {

/// Code points from here on take two units of UTF-16.
constexpr char32_t first_of_two_units = 0x10000;

bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 0x80;
}

/// Returns where the line ends that is before a place where one begins.
std::uint32_t end_of_line(std::string_view text, std::uint32_t next) {
  const bool has_two = next > 1 && text[next - 1] == '\n' && text[next - 2] == '\r';
  return next - (has_two ? 2 : 1);
}

}  // namespace

TextPlaces::TextPlaces(std::string_view text) : size_(static_cast<std::uint32_t>(text.size())) {
  for (const std::uint32_t start : lang::find_line_starts(text)) {
    if (!lines_.empty()) lines_.back().end = end_of_line(text, start);
    lines_.push_back({start, size_});
  }
  std::uint32_t behind = 0;  // the last wide character
  std::uint32_t unit = 0;
  for (std::size_t place = 0; place < text.size();) {
    const auto next =
        std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(place), text.end(), is_ascii);
    if (next == text.end()) break;
    place = static_cast<std::size_t>(next - text.begin());
    const auto byte = static_cast<std::uint32_t>(place);
    const std::uint32_t units = lang::decode_utf8(text, place) >= first_of_two_units ? 2 : 1;
    unit += byte - behind;
    behind = static_cast<std::uint32_t>(place);
    wide_.push_back({{byte, behind}, {unit, unit + units}});
    unit += units;
  }
}

std::uint32_t TextPlaces::unit_of(std::uint32_t byte) const {
  byte = std::min(byte, size_);
  const auto after = std::upper_bound(
      wide_.begin(), wide_.end(), byte,
      [](std::uint32_t place, const auto& wide) { return place < wide.first.begin; });
  if (after == wide_.begin()) return byte;
  const auto& [bytes, units] = *std::prev(after);
  return byte < bytes.end ? units.begin : units.end + (byte - bytes.end);
}

std::uint32_t TextPlaces::byte_of(std::uint32_t unit) const {
  const auto after = std::upper_bound(
      wide_.begin(), wide_.end(), unit,
      [](std::uint32_t place, const auto& wide) { return place < wide.second.begin; });
  if (after == wide_.begin()) return std::min(unit, size_);
  const auto& [bytes, units] = *std::prev(after);
  return unit < units.end ? bytes.begin : bytes.end + std::min(unit - units.end, size_ - bytes.end);
}

LineColumn TextPlaces::position_of(std::uint32_t byte, ColumnUnit unit) const {
  const auto behind = std::upper_bound(
      lines_.begin(), lines_.end(), byte,
      [](std::uint32_t place, const TextSpan& line) { return place < line.begin; });
  const TextSpan line = *std::prev(behind);
  byte = std::min(byte, line.end);
  return {static_cast<std::uint32_t>(behind - lines_.begin()) - 1,
          unit == ColumnUnit::utf8 ? byte - line.begin : unit_of(byte) - unit_of(line.begin)};
}

std::uint32_t TextPlaces::byte_at(LineColumn position, ColumnUnit unit) const {
  if (position.line >= lines_.size()) return size_;
  const TextSpan line = lines_[position.line];
  if (unit == ColumnUnit::utf8)
    return line.begin + std::min(position.column, line.end - line.begin);
  const std::uint32_t units = unit_of(line.end) - unit_of(line.begin);
  return byte_of(unit_of(line.begin) + std::min(position.column, units));
}

/// Returns the byte so many code points further on, or the end.
std::uint32_t TextPlaces::advance(std::uint32_t byte, int code_points, std::uint32_t end) const {
  auto left = static_cast<std::uint32_t>(std::max(code_points, 0));
  auto wide = std::lower_bound(
      wide_.begin(), wide_.end(), byte,
      [](const auto& known, std::uint32_t place) { return known.first.begin < place; });
  for (; wide != wide_.end() && wide->first.begin < end && wide->first.begin - byte < left;
       ++wide) {
    left -= wide->first.begin - byte + 1;
    byte = wide->first.end;
  }
  return byte + std::min(left, end - byte);
}

TextSpan TextPlaces::span_of(const SourcePlace& place) const {
  const auto index = static_cast<std::size_t>(std::max(place.line, 1)) - 1;
  if (index >= lines_.size()) return {size_, size_};
  const TextSpan line = lines_[index];
  const std::uint32_t begin = advance(line.begin, place.column - 1, line.end);
  return {begin, advance(begin, std::max(place.length, 1), line.end)};
}

}  // namespace crt
