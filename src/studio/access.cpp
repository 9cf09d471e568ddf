#include "studio/access.hpp"

#include <random>

namespace crt::studio {

bool is_own_host(std::string_view host, std::string_view address, std::uint16_t port) {
  const std::string end = ":" + std::to_string(port);
  if (!host.ends_with(end)) return false;
  host.remove_suffix(end.size());
  return host == "localhost" || host == "127.0.0.1" || host == "[::1]" || host == address;
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  constexpr std::string_view scheme = "http://";
  return origin.empty() || (origin.starts_with(scheme) && origin.substr(scheme.size()) == host);
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
