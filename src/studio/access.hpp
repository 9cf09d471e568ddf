// This decides who may talk to the server.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace crt::studio {

/// Says whether a request's Host names this server as it is reached on this machine. A page whose
/// own name was made to lead here (DNS rebinding) has another one.
bool is_own_host(std::string_view host, std::string_view address, std::uint16_t port);

/// Says whether an Origin is that of the server's own page. Programs that are no browsers send
/// none.
bool is_own_origin(std::string_view origin, std::string_view host);

/// Compares tokens in a time that tells nothing about where they differ.
bool is_token(std::string_view given, std::string_view token);

/// Returns the token in the target of a request: "/socket?token=...".
std::string_view token_of(std::string_view target);

/// Returns 32 characters that nobody can guess.
std::string make_token();

}  // namespace crt::studio
