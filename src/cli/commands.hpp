#pragma once

#include "cli/options.hpp"

namespace crt::cli {

/// Renders a script's picture, or those of an animation.
ExitCode run_render(const RenderRequest& request);

/// Measures the accuracy and the time of a script's picture with different settings.
ExitCode run_trade(const TradeRequest& request);

/// Writes a script to begin with.
ExitCode run_new(const NewRequest& request);

/// Runs scripts for their diagnostics alone.
ExitCode run_check(const CheckRequest& request);

/// Lays scripts out as the formatter does, or says which are not.
ExitCode run_format(const FormatRequest& request);

/// Serves an editor on standard input and output, until it ends that.
ExitCode run_lsp(const LspRequest& request);

}  // namespace crt::cli
