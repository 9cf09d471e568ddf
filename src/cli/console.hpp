// These functions look after the standard streams.
//
// Nothing is written to a stream that the caller has closed. The command only fails for that if the
// output was asked for (`--stats -`, `--help`). It ends with 3 where a stream is open but does not
// take what it gets (a full disk, a pipe whose reader has gone).
#pragma once

#include <cstdio>
#include <string_view>

namespace crt::cli {

/// Replaces standard streams that the caller closed by something that takes nothing. So no file
/// that is opened later takes their numbers and gets what is meant for them. It also lets a pipe
/// without a reader, and a file that grows beyond what the process may write, be errors instead of
/// the end of the process. It must be called before anything else.
void hold_standard_streams();

/// Writes text and flushes it, and says whether the stream took it. If not, errno says why.
bool write_text(std::FILE* stream, std::string_view text);

/// Says whether a value of errno means that the caller has closed the stream.
bool is_closed(int error);

}  // namespace crt::cli
