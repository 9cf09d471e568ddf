// What a fuzzer gives is taken for numbers, vectors and texts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

namespace crt::test {

/// An Input reads what the fuzzer gives as values, and gives zeros when it is used up.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool empty() const { return size_ == 0; }

  template <class Value>
  Value raw() {
    Value value{};
    const std::size_t count = std::min(size_, sizeof value);
    std::memcpy(&value, data_, count);
    data_ += count;
    size_ -= count;
    return value;
  }

  std::uint8_t byte() { return raw<std::uint8_t>(); }
  std::uint32_t below(std::uint32_t limit) { return byte() % limit; }

  /// Returns mostly an ordinary number, sometimes an extreme one, sometimes any bits at all.
  double number() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    static const std::array special = {0.0,       -0.0,         1.0,    -1.0, 0.5,   1e-300,
                                       1e300,     1e100,        1e-100, 1e18, 1e-18, infinity,
                                       -infinity, std::nan(""), 5e-324, 2.0};
    const std::uint8_t kind = byte();
    if (kind < 16) return special[kind];
    if (kind < 20) return raw<double>();
    return (static_cast<double>(kind) - 128) / 16;
  }

  std::array<double, 3> vector() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }

  std::string text() {
    std::string result;
    for (std::uint32_t i = below(40); i > 0; --i) result += static_cast<char>(byte());
    return result;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

/// Makes a struct with its defaults, sometimes of a wrong size.
template <class Struct, class Init>
Struct scrambled(Input& input, const Init& init) {
  Struct result;
  init(&result, sizeof result);
  if (input.below(8) == 0) result.struct_size = input.raw<std::uint16_t>();
  return result;
}

inline void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace crt::test
