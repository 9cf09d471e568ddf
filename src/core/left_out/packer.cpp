// Without zlib, bytes are stored as they are, in blocks that say so.
//
// Source: RFC 1950 (zlib) and RFC 1951 (deflate), section 3.2.4.
#include "core/image/packer.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace crt::core {

struct Packer::State {
  static constexpr std::size_t max_in_block = 65535;

  Write write;
  std::vector<std::uint8_t> piece{0x78, 0x01};  ///< the stream begins so
  std::vector<std::uint8_t> block{};
  std::uint32_t sum = 1;  ///< Adler's, in two halves
  std::uint32_t sum_of_sums = 0;

  void add(std::span<const std::uint8_t> bytes) {
    constexpr std::uint32_t modulus = 65521;
    for (const std::uint8_t byte : bytes) {
      sum = (sum + byte) % modulus;
      sum_of_sums = (sum_of_sums + sum) % modulus;
    }
    while (!bytes.empty()) {
      if (block.size() == max_in_block) write_block(false);
      const std::size_t count = std::min(bytes.size(), max_in_block - block.size());
      block.insert(block.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
      bytes = bytes.subspan(count);
    }
  }

  void write_block(bool is_last) {
    const auto length = static_cast<int>(block.size());
    piece.push_back(is_last ? 1 : 0);
    for (const int number : {length, ~length}) {
      piece.push_back(static_cast<std::uint8_t>(number));
      piece.push_back(static_cast<std::uint8_t>(number >> 8));
    }
    piece.insert(piece.end(), block.begin(), block.end());
    if (is_last) {
      for (const std::uint32_t half : {sum_of_sums, sum}) {
        piece.push_back(static_cast<std::uint8_t>(half >> 8));
        piece.push_back(static_cast<std::uint8_t>(half));
      }
    }
    write(piece);
    piece.clear();
    block.clear();
  }
};

Packer::Packer(Write write) : state_(new State{.write = std::move(write)}) {}

Packer::~Packer() = default;

void Packer::add(std::span<const std::uint8_t> bytes) {
  state_->add(bytes);
}

void Packer::finish() {
  state_->write_block(true);
}

}  // namespace crt::core
