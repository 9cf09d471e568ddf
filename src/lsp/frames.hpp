// Messages come framed: a header with `Content-Length`, an empty line, then so many bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace crt::lsp {

/// A longer message is passed over.
constexpr std::size_t longest_message = std::size_t{256} << 20;

/// A FrameReader cuts a stream of bytes into messages.
class FrameReader {
 public:
  void add(std::string_view bytes) { buffer_ += bytes; }

  struct Frame {
    std::string body{};
    /// Says what was wrong with the frame, which then has no body. It is empty if nothing was.
    std::string_view problem{};
  };

  /// Returns the next message, or nothing until more bytes have come.
  std::optional<Frame> next();

 private:
  std::optional<Frame> read_header();

  std::string buffer_;
  std::size_t to_skip_ = 0;
  /// Is the length of the message whose header has been read.
  std::optional<std::size_t> length_;
};

/// Returns a message with its header.
std::string framed(std::string_view body);

}  // namespace crt::lsp
