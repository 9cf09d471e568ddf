// Numbers in the bytes of mesh files and of the archives that 3MF files are.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace crt::core {

/// Returns the number that begins at a byte. All of it must be there.
template <class Number>
Number number_at(std::string_view bytes, std::size_t place,
                 std::endian order = std::endian::little) {
  std::array<char, sizeof(Number)> copy{};
  std::memcpy(copy.data(), bytes.data() + place, copy.size());
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<Number>(copy);
}

}  // namespace crt::core
