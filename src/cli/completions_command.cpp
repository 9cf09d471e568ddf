#include "cli/commands.hpp"
#include "cli/completions.hpp"
#include "cli/reporter.hpp"

namespace crt::cli {

ExitCode run_completions(const CompletionsRequest& request) {
  Reporter reporter(CommonRequest{});
  std::string script;
  if (request.shell == "bash") script = bash_completions(request.commands);
  if (request.shell == "zsh") script = zsh_completions(request.commands);
  if (request.shell == "fish") script = fish_completions(request.commands);
  reporter.print(script, Reporter::IfClosed::fails);
  return reporter.finish();
}

}  // namespace crt::cli
