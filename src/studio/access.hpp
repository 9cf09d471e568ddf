// This decides who may talk to the server.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "studio/ip_address.hpp"

namespace crt::studio {

/// HostNames are what this server is called in the Host of a request. A page whose own name was
/// made to lead here (DNS rebinding) calls it by another name. One that was loaded by an address
/// came from there, so where all addresses are listened on, any will do.
class HostNames {
 public:
  /// Takes the address that is listened on, and names beside those that follow from it.
  HostNames(const IpAddress& listened, const std::vector<std::string>& names);

  /// Says whether a Host, with its port, names the server. It has no port if that is the usual one
  /// of the scheme.
  bool has(std::string_view host, std::uint16_t port, std::uint16_t usual_port) const;

 private:
  bool has_name(std::string_view name) const;

  IpAddress listened_;
  std::set<std::string, std::less<>> names_;
};

/// Says whether an Origin is that of the server's own page, whose scheme is "http" or "https".
/// Programs that are no browsers send none.
bool is_own_origin(std::string_view origin, std::string_view scheme, std::string_view host);

/// Compares tokens in a time that tells nothing about where they differ.
bool is_token(std::string_view given, std::string_view token);

/// Returns the token in the target of a request: "/socket?token=...".
std::string_view token_of(std::string_view target);

/// Returns 32 characters that nobody can guess.
std::string make_token();

}  // namespace crt::studio
