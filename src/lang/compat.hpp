// Scripts of 2015: what a text says of itself before it is parsed. See docs/compat.md.
#pragma once

#include <cstdint>

#include "lang/source_map.hpp"

namespace crt::lang {

/// The whole number that a script's Settings give to `compat`; 0 if they give none. It decides
/// which words are keywords, so that it is looked for among the tokens: an expression is not
/// evaluated.
std::int64_t written_compat(const SourceMap& sources, const Source& source);

}  // namespace crt::lang
