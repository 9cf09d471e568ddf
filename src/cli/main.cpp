// The command `crt` renders CRT scripts and checks them.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/options.hpp"

namespace {

using namespace crt::cli;

struct Run {
  ExitCode operator()(const RenderRequest& request) const { return run_render(request); }
  ExitCode operator()(const FarmRequest& request) const { return run_farm(request); }
  ExitCode operator()(const CheckRequest& request) const { return run_check(request); }
  ExitCode operator()(const NewRequest& request) const { return run_new(request); }
  ExitCode operator()(const TradeRequest& request) const { return run_trade(request); }
  ExitCode operator()(const MeasureRequest& request) const { return run_measure(request); }
  ExitCode operator()(const AskRequest& request) const { return run_ask(request); }
  ExitCode operator()(const ExportRequest& request) const { return run_export(request); }
  ExitCode operator()(const ImportRequest& request) const { return run_import(request); }
  ExitCode operator()(const FormatRequest& request) const { return run_format(request); }
  ExitCode operator()(const LspRequest& request) const { return run_lsp(request); }
  ExitCode operator()(const StudioRequest& request) const { return run_studio(request); }
  ExitCode operator()(const WatchRequest& request) const { return run_watch(request); }
  ExitCode operator()(const CompletionsRequest& request) const { return run_completions(request); }
  ExitCode operator()(const ManRequest& request) const { return run_man(request); }
  ExitCode operator()(ExitCode code) const { return code; }
};

}  // namespace

int main(int argc, char** argv) try {
  hold_standard_streams();
  return static_cast<int>(std::visit(Run{}, parse_command_line(argc, argv)));
} catch (const std::bad_alloc&) {
  write_text(stderr, "crt: error: not enough memory; try a smaller picture or a simpler scene\n");
  return static_cast<int>(ExitCode::internal);
} catch (const std::exception& error) {
  write_text(stderr,
             fmt::format(
                 "crt: error: {}\n"
                 "This should not happen: please report it with the script and the command line.\n",
                 error.what()));
  return static_cast<int>(ExitCode::internal);
}
