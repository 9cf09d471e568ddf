// This finds what decides how a script is read before it runs: whether it is one of 2015
// (docs/compat.md), and what its scene's unit is.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "crt/settings.hpp"
#include "lang/source_map.hpp"

namespace crt::lang {

/// Returns the whole number that a script's Settings give to `compat`, or 0 if they give none. It
/// decides which words are keywords, so it is looked for among the tokens. An expression is not
/// evaluated.
std::int64_t written_compat(const SourceMap& sources, const Source& source);

/// Returns the unit that scripts call so, or nothing if there is none.
std::optional<Unit> unit_of_name(std::string_view name);

/// Returns the unit that a script's Settings name, which is the default if they name none. Nothing
/// comes of an expression, as it is not evaluated, and of what is no unit.
std::optional<Unit> written_unit(const SourceMap& sources, const Source& source);

}  // namespace crt::lang
