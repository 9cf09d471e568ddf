#include "studio/ip_address.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <memory>

namespace crt::studio {

namespace {

constexpr std::size_t ipv4_begin = 12;  // of its bytes in an address of IPv6

}  // namespace

IpAddress IpAddress::of_ipv4(const void* bytes) {
  Bytes all{};
  all[10] = all[11] = 0xff;
  std::memcpy(&all[ipv4_begin], bytes, all.size() - ipv4_begin);
  return IpAddress(all);
}

IpAddress IpAddress::of_ipv6(const void* bytes) {
  Bytes all{};
  std::memcpy(all.data(), bytes, all.size());
  return IpAddress(all);
}

std::optional<IpAddress> IpAddress::parse(std::string_view text) {
  const bool has_brackets = text.size() > 2 && text.front() == '[' && text.back() == ']';
  const std::string plain(has_brackets ? text.substr(1, text.size() - 2) : text);
  if (plain.find('\0') != std::string::npos) return std::nullopt;
  in_addr four{};
  if (!has_brackets && inet_pton(AF_INET, plain.c_str(), &four) == 1) return of_ipv4(&four);
  in6_addr six{};
  if (inet_pton(AF_INET6, plain.c_str(), &six) == 1) return of_ipv6(&six);
  return std::nullopt;
}

bool IpAddress::is_ipv4() const {
  return std::all_of(bytes_.begin(), bytes_.begin() + 10, [](auto byte) { return byte == 0; }) &&
         bytes_[10] == 0xff && bytes_[11] == 0xff;
}

bool IpAddress::is_loopback() const {
  constexpr std::uint8_t loopback_net = 127;
  if (is_ipv4()) return bytes_[ipv4_begin] == loopback_net;
  Bytes loopback{};
  loopback.back() = 1;
  return bytes_ == loopback;
}

bool IpAddress::is_any() const {
  const auto begin = bytes_.begin() + (is_ipv4() ? ipv4_begin : 0);
  return std::all_of(begin, bytes_.end(), [](auto byte) { return byte == 0; });
}

std::string IpAddress::text() const {
  char text[INET6_ADDRSTRLEN] = "";
  if (is_ipv4()) {
    inet_ntop(AF_INET, &bytes_[ipv4_begin], text, sizeof text);
  } else {
    inet_ntop(AF_INET6, bytes_.data(), text, sizeof text);
  }
  return text;
}

std::string IpAddress::in_url() const {
  return is_ipv4() ? text() : "[" + text() + "]";
}

std::vector<IpAddress> machine_addresses() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, freeifaddrs);
  std::vector<IpAddress> found;
  for (const ifaddrs* at = first; at != nullptr; at = at->ifa_next) {
    if (at->ifa_addr == nullptr || (at->ifa_flags & IFF_UP) == 0) continue;
    if (at->ifa_addr->sa_family == AF_INET) {
      sockaddr_in four{};
      std::memcpy(&four, at->ifa_addr, sizeof four);
      found.push_back(IpAddress::of_ipv4(&four.sin_addr));
    } else if (at->ifa_addr->sa_family == AF_INET6) {
      sockaddr_in6 six{};
      std::memcpy(&six, at->ifa_addr, sizeof six);
      if (!IN6_IS_ADDR_LINKLOCAL(&six.sin6_addr))
        found.push_back(IpAddress::of_ipv6(&six.sin6_addr));
    }
    if (!found.empty() && found.back().is_loopback()) found.pop_back();
  }
  return found;
}

std::string machine_name() {
  constexpr std::size_t longest_name = 255;
  char name[longest_name + 1] = "";
  if (gethostname(name, longest_name) != 0) return "";
  return name;
}

}  // namespace crt::studio
