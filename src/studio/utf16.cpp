#include "studio/utf16.hpp"

#include <algorithm>

namespace crt::studio {

namespace {

constexpr unsigned char first_beyond_ascii = 0x80;
constexpr unsigned char first_lead = 0xc0;
/// A character of four bytes takes two units.
constexpr unsigned char first_lead_of_four = 0xf0;

}  // namespace

Utf16Places::Utf16Places(std::string_view text) : size_(static_cast<std::uint32_t>(text.size())) {
  const auto byte = [](char c) { return static_cast<unsigned char>(c); };
  if (std::all_of(text.begin(), text.end(), [&](char c) { return byte(c) < first_beyond_ascii; }))
    return;
  units_.reserve(text.size() + 1);
  std::uint32_t next = 0;
  std::uint32_t current = 0;
  for (const char c : text) {
    if (byte(c) < first_beyond_ascii || byte(c) >= first_lead) {
      current = next;
      next += byte(c) >= first_lead_of_four ? 2 : 1;
    }
    units_.push_back(current);
  }
  units_.push_back(next);
}

std::uint32_t Utf16Places::unit_of(std::uint32_t byte) const {
  byte = std::min(byte, size_);
  return units_.empty() ? byte : units_[byte];
}

std::uint32_t Utf16Places::byte_of(std::uint32_t unit) const {
  if (units_.empty()) return std::min(unit, size_);
  const auto found = std::lower_bound(units_.begin(), units_.end(), unit);
  return std::min(static_cast<std::uint32_t>(found - units_.begin()), size_);
}

}  // namespace crt::studio
