// The standard streams.
//
// One that the caller has closed is not to hear anything, which is no reason to fail unless it was
// asked for
// (`--stats -`, `--help`). One that is there but does not take what it gets (a full disk, a pipe
// whose reader has gone) is: the command ends with 3.
#pragma once

#include <cstdio>
#include <string_view>

namespace crt::cli {

/// Puts something that takes nothing in the place of standard streams that the caller closed, so
/// that no file that is opened later takes their place and gets what is meant for them; and lets a
/// pipe without a reader be an error instead of the end of the process. Call first of all.
void hold_standard_streams();

/// Writes text and flushes it; says whether the stream took it. If not, errno tells why.
bool tell(std::FILE* stream, std::string_view text);

/// Whether a value of errno says that the caller has closed the stream.
bool is_closed(int error);

}  // namespace crt::cli
