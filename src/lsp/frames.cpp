#include "lsp/frames.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "text/format.hpp"
#include "text/letters.hpp"

namespace crt::lsp {

namespace {

constexpr std::string_view header_end = "\r\n\r\n";
constexpr std::size_t longest_header = 8192;

/// Returns the number in a line of a header that gives the length, or nothing in any other line.
std::optional<std::size_t> length_in(std::string_view line) {
  constexpr std::string_view field = "content-length:";
  if (line.size() < field.size() ||
      !std::equal(field.begin(), field.end(), line.begin(),
                  [](char wanted, char c) { return text::small_letter(c) == wanted; }))
    return std::nullopt;
  line.remove_prefix(field.size());
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  std::size_t length = 0;
  const auto read = std::from_chars(line.data(), line.data() + line.size(), length);
  const std::string_view rest(read.ptr,
                              static_cast<std::size_t>(line.data() + line.size() - read.ptr));
  if (read.ec != std::errc{} || rest.find_first_not_of(' ') != std::string_view::npos)
    return std::nullopt;
  return length;
}

std::optional<std::size_t> length_of(std::string_view header) {
  std::optional<std::size_t> length;
  while (!header.empty()) {
    const std::size_t end = std::min(header.find("\r\n"), header.size());
    if (const auto found = length_in(header.substr(0, end))) length = found;
    header.remove_prefix(std::min(end + 2, header.size()));
  }
  return length;
}

}  // namespace

std::optional<FrameReader::Frame> FrameReader::next() {
  if (to_skip_ > 0) {
    const std::size_t skipped = std::min(to_skip_, buffer_.size());
    buffer_.erase(0, skipped);
    to_skip_ -= skipped;
    if (to_skip_ > 0) return std::nullopt;
  }
  if (!length_) {
    if (std::optional<Frame> problem = read_header()) return problem;
  }
  if (!length_ || buffer_.size() < *length_) return std::nullopt;
  Frame frame{.body = buffer_.substr(0, *length_), .problem = {}};
  buffer_.erase(0, *length_);
  length_.reset();
  return frame;
}

/// Reads a header if all of it has come. Returns what is wrong with it.
std::optional<FrameReader::Frame> FrameReader::read_header() {
  const std::size_t end = buffer_.find(header_end);
  if (end == std::string::npos) {
    if (buffer_.size() <= longest_header) return std::nullopt;
    // The end of the next header may have come in part.
    buffer_.erase(0, buffer_.size() - header_end.size());
    return Frame{.body = {}, .problem = "the header of a message is too long"};
  }
  const std::optional<std::size_t> length = length_of(std::string_view(buffer_).substr(0, end));
  buffer_.erase(0, end + header_end.size());
  if (!length) return Frame{.body = {}, .problem = "a message needs the header Content-Length"};
  if (*length > longest_message) {
    to_skip_ = *length;
    return Frame{.body = {}, .problem = "the message is too long"};
  }
  length_ = length;
  return std::nullopt;
}

std::string framed(std::string_view body) {
  return text::format("Content-Length: {}\r\n\r\n{}", body.size(), body);
}

}  // namespace crt::lsp
