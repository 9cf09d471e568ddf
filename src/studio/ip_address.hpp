// This knows the addresses of the network: what a text says, and which ones this machine has.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crt::studio {

/// An IpAddress is one of IPv6, or one of IPv4 as IPv6 has it: ::ffff:127.0.0.1.
class IpAddress {
 public:
  /// Reads "127.0.0.1" or "::1", which may stand in brackets. There is none in any other text.
  static std::optional<IpAddress> parse(std::string_view text);

  bool is_ipv4() const;
  bool is_loopback() const;
  /// Says whether it is 0.0.0.0 or ::, which stand for all addresses of a machine.
  bool is_any() const;

  /// Returns "127.0.0.1" or "::1".
  std::string text() const;
  /// Returns it as URLs have it: "127.0.0.1" or "[::1]".
  std::string in_url() const;

  bool operator==(const IpAddress&) const = default;

 private:
  friend std::vector<IpAddress> machine_addresses();

  using Bytes = std::array<std::uint8_t, 16>;
  explicit IpAddress(const Bytes& bytes) : bytes_(bytes) {}
  static IpAddress of_ipv4(const void* bytes);
  static IpAddress of_ipv6(const void* bytes);

  Bytes bytes_;
};

/// Lists the addresses by which other machines may reach this one: not those of the loopback, and
/// not those of a single link, which browsers do not take.
std::vector<IpAddress> machine_addresses();

/// Returns what this machine is called, or "" if it has no name.
std::string machine_name();

}  // namespace crt::studio
