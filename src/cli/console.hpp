// The standard streams. One that takes nothing (closed, or a full disk) is no reason to fail.
#pragma once

#include <cstdio>
#include <string_view>

namespace crt::cli {

/// Opens /dev/null in the place of standard streams that the caller closed, so that no file that is
/// opened later takes their place and gets what is meant for them. Call first of all.
void hold_standard_streams();

/// Writes text and flushes it; says whether the stream took it.
bool tell(std::FILE* stream, std::string_view text);

}  // namespace crt::cli
