// This says in words where something stands in a script, or in one that it imports.
#pragma once

#include <crt/error.hpp>
#include <crt/script.hpp>
#include <string>
#include <vector>

namespace crt::studio {

/// Returns "line 3", or "parts/wheel.crt:3" for a place in another file than the script's own.
std::string place_text(const SourcePlace& place, const std::string& script);

/// Says the first error of a script and its place, as far as it is known.
std::string first_error(const std::vector<Diagnostic>& diagnostics, const std::string& script);

}  // namespace crt::studio
