#include "core/base/state_file.hpp"

#include "core/base/whole_file.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// This is more than the largest picture takes that can be rendered pass by pass.
constexpr std::size_t most_bytes = std::size_t{1} << 34;

}  // namespace

void ByteHash::add(std::span<const std::byte> bytes) {
  constexpr std::uint64_t factor = 0x9e3779b97f4a7c15u;  // 2^64 / the golden ratio
  constexpr std::size_t word_size = sizeof(std::uint64_t);
  constexpr int half = 32;
  while (!bytes.empty()) {
    const std::size_t size = std::min(bytes.size(), word_size);
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), size);
    value_ = (value_ ^ word ^ size) * factor;
    value_ ^= value_ >> half;
    bytes = bytes.subspan(size);
  }
}

void StateWriter::append(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::size_t size = std::min(bytes.size(), buffer_size - buffer_.size());
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    bytes = bytes.subspan(size);
    if (buffer_.size() == buffer_size) flush();
  }
}

void StateWriter::flush() {
  hash_.add(buffer_);
  sink_(buffer_);
  buffer_.clear();
}

void write_state_file(const std::filesystem::path& path,
                      const std::function<void(StateWriter&)>& store) {
  const auto produce = [&](const StateWriter::Sink& sink) {
    StateWriter writer(sink);
    store(writer);
    writer.flush();
    const std::uint64_t hash = writer.hash_.value();
    sink(std::as_bytes(std::span(&hash, 1)));
  };
  write_whole_file(path, produce, Flush::at_once);
}

StateReader::StateReader(const std::filesystem::path& path)
    : name_(path.string()), content_(read_whole_file(path, most_bytes)), rest_(content_) {
  std::uint64_t expected = 0;
  if (content_.size() < sizeof expected) fail();
  rest_ = rest_.first(content_.size() - sizeof expected);
  std::memcpy(&expected, content_.data() + rest_.size(), sizeof expected);
  constexpr std::size_t piece = std::size_t{1} << 16;  // the bytes that StateWriter hashes at once
  ByteHash hash;
  for (std::size_t first = 0; first < rest_.size(); first += piece) {
    hash.add(rest_.subspan(first, std::min(piece, rest_.size() - first)));
  }
  if (hash.value() != expected) fail();
}

std::span<const std::byte> StateReader::next(std::size_t size) {
  if (size > rest_.size()) fail();
  const std::span<const std::byte> bytes = rest_.first(size);
  rest_ = rest_.subspan(size);
  return bytes;
}

void StateReader::fail() const {
  throw Error(ErrorCode::io, text::format("'{}' is damaged, or no checkpoint of a picture", name_));
}

}  // namespace crt::core
