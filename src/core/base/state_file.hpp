// A state file holds numbers one after the other, with a hash that shows whether it is whole.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace crt::core {

/// Mixes bytes into a number that other bytes hardly give.
class ByteHash {
 public:
  void add(std::span<const std::byte> bytes);
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0x243f6a8885a308d3u;  // digits of pi
};

template <class T>
concept Storable = std::is_arithmetic_v<T> || std::is_same_v<T, std::byte>;

class StateWriter {
 public:
  template <Storable T>
  void put(T number) {
    put_all(std::span<const T>(&number, 1));
  }
  template <Storable T>
  void put_all(std::span<const T> numbers) {
    append(std::as_bytes(numbers));
  }

 private:
  friend void write_state_file(const std::filesystem::path& path,
                               const std::function<void(StateWriter&)>& store);
  using Sink = std::function<void(std::span<const std::byte>)>;

  explicit StateWriter(const Sink& sink) : sink_(sink) {}
  void append(std::span<const std::byte> bytes);
  void flush();

  static constexpr std::size_t buffer_size = std::size_t{1} << 16;
  const Sink& sink_;
  std::vector<std::byte> buffer_;
  ByteHash hash_;
};

/// Writes a state file in place of the file that is there, whole or not at all. Throws Error (io).
void write_state_file(const std::filesystem::path& path,
                      const std::function<void(StateWriter&)>& store);

class StateReader {
 public:
  /// Reads all of a file. Throws Error (io) if there is none, or if it is not as it was written.
  explicit StateReader(const std::filesystem::path& path);

  template <Storable T>
  T get() {
    T number{};
    get_all(std::span<T>(&number, 1));
    return number;
  }
  template <Storable T>
  void get_all(std::span<T> numbers) {
    const std::span<const std::byte> bytes = next(numbers.size_bytes());
    if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  }

  bool at_end() const { return rest_.empty(); }
  /// Returns the number of bytes that have not been read.
  std::size_t bytes_left() const { return rest_.size(); }
  /// Throws the Error (io) for content that a state file cannot have.
  [[noreturn]] void fail() const;

 private:
  std::span<const std::byte> next(std::size_t size);

  std::string name_;
  std::vector<std::byte> content_;
  std::span<const std::byte> rest_;
};

}  // namespace crt::core
