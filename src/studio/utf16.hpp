// Pages count the units of UTF-16, the library counts bytes of UTF-8. This translates.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace crt::studio {

class Utf16Places {
 public:
  /// Takes a text, which is not kept.
  explicit Utf16Places(std::string_view text);

  /// Returns the unit that a byte is in. Places behind the end are the end.
  std::uint32_t unit_of(std::uint32_t byte) const;
  /// Returns the first byte of a unit. Places behind the end are the end.
  std::uint32_t byte_of(std::uint32_t unit) const;

 private:
  std::uint32_t size_;
  /// The unit of each byte, and of the end. It is empty for a text of ASCII, where both are equal.
  std::vector<std::uint32_t> units_;
};

}  // namespace crt::studio
