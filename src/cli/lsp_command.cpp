// `crt lsp` connects the language server with standard input and output.
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <string_view>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "lsp/server.hpp"

namespace crt::cli {

namespace {

/// Passes on what has come. Returns false at the end of the input.
bool pass_input(lsp::Server& server) {
  std::array<char, 1 << 16> buffer{};
  const ssize_t count = read(STDIN_FILENO, buffer.data(), buffer.size());
  if (count < 0) return errno == EINTR;
  server.receive(std::string_view(buffer.data(), static_cast<std::size_t>(count)));
  return count > 0;
}

}  // namespace

ExitCode run_lsp(const LspRequest&) {
  bool is_heard = true;
  lsp::Server server(
      [&](std::string_view bytes) { is_heard = is_heard && write_text(stdout, bytes); });
  bool has_input = true;
  while (!server.is_finished() && is_heard && (has_input || server.has_work())) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    constexpr int forever = -1;
    const int ready = has_input ? poll(&input, 1, server.has_work() ? 0 : forever) : 0;
    if (ready > 0) {
      has_input = pass_input(server);
    } else if (ready == 0) {
      server.work();
    } else if (errno != EINTR) {
      has_input = false;
    }
  }
  if (!is_heard) return ExitCode::files;
  // The protocol wants 1 from a server that is ended without a shutdown.
  return server.was_shut_down() ? ExitCode::done : ExitCode::script;
}

}  // namespace crt::cli
