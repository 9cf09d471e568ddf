#include "studio/access.hpp"

#include <optional>
#include <random>

#include "text/letters.hpp"

namespace crt::studio {

HostNames::HostNames(const IpAddress& listened, const std::vector<std::string>& names)
    : listened_(listened) {
  for (const std::string& name : names) names_.insert(text::in_small_letters(name));
  if (listened.is_loopback() || listened.is_any()) names_.insert("localhost");
  if (!listened.is_loopback()) names_.insert(text::in_small_letters(machine_name()));
  names_.erase("");
}

bool HostNames::has(std::string_view host, std::uint16_t port, std::uint16_t usual_port) const {
  const std::string end = ":" + std::to_string(port);
  if (host.ends_with(end)) {
    host.remove_suffix(end.size());
  } else if (port != usual_port) {
    return false;
  }
  return has_name(host);
}

bool HostNames::has_name(std::string_view name) const {
  if (names_.contains(text::in_small_letters(name))) return true;
  if (!name.starts_with('[') && name.find(':') != std::string_view::npos) return false;
  const std::optional<IpAddress> address = IpAddress::parse(name);
  if (!address) return false;
  if (listened_.is_any()) return true;
  return *address == listened_ || (listened_.is_loopback() && address->is_loopback());
}

bool is_own_origin(std::string_view origin, std::string_view scheme, std::string_view host) {
  if (origin.empty()) return true;
  if (!origin.starts_with(scheme)) return false;
  origin.remove_prefix(scheme.size());
  return origin.starts_with("://") && origin.substr(3) == host;
}

bool is_token(std::string_view given, std::string_view token) {
  if (given.size() != token.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < token.size(); ++i)
    difference |= static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(token[i]);
  return difference == 0;
}

std::string_view token_of(std::string_view target) {
  constexpr std::string_view key = "token=";
  const std::size_t question = target.find('?');
  if (question == std::string_view::npos) return {};
  std::string_view query = target.substr(question + 1);
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    if (pair.starts_with(key)) return pair.substr(key.size());
    query.remove_prefix(pair.size() < query.size() ? pair.size() + 1 : query.size());
  }
  return {};
}

std::string make_token() {
  constexpr std::string_view digits = "0123456789abcdef";
  constexpr int words = 4;
  std::random_device source;  // the kernel's
  std::string token;
  for (int word = 0; word < words; ++word) {
    std::uint32_t bits = source();
    for (int digit = 0; digit < 8; ++digit, bits >>= 4) token += digits[bits & 15U];
  }
  return token;
}

}  // namespace crt::studio
