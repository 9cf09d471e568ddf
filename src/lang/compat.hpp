// This finds whether a text is a script of 2015, before it is parsed. See docs/compat.md.
#pragma once

#include <cstdint>

#include "lang/source_map.hpp"

namespace crt::lang {

/// Returns the whole number that a script's Settings give to `compat`, or 0 if they give none. It
/// decides which words are keywords, so it is looked for among the tokens. An expression is not
/// evaluated.
std::int64_t written_compat(const SourceMap& sources, const Source& source);

}  // namespace crt::lang
