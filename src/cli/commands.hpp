#pragma once

#include "cli/options.hpp"

namespace crt::cli {

/// Renders the pictures of scripts, or those of an animation.
ExitCode run_render(const RenderRequest& request);

/// Plans, works on, merges, shows or submits a job for many machines.
ExitCode run_farm(const FarmRequest& request);

/// Renders a script's picture again whenever something changes, until it is interrupted.
ExitCode run_watch(const WatchRequest& request);

/// Measures the accuracy and the time of a script's picture with different settings.
ExitCode run_trade(const TradeRequest& request);

/// Says how much the entities of a script are, and where.
ExitCode run_measure(const MeasureRequest& request);

/// Says what rays from standard input meet, or in what points are.
ExitCode run_ask(const AskRequest& request);

/// Writes a script to begin with.
ExitCode run_new(const NewRequest& request);

/// Runs scripts for their diagnostics alone.
ExitCode run_check(const CheckRequest& request);

/// Writes the scene of a script as source code or triangles.
ExitCode run_export(const ExportRequest& request);

/// Translates a file of another program to a script.
ExitCode run_import(const ImportRequest& request);

/// Lays scripts out as the formatter does, or says which are not.
ExitCode run_format(const FormatRequest& request);

/// Serves an editor on standard input and output, until it ends that.
ExitCode run_lsp(const LspRequest& request);

/// Becomes the program that serves the studio.
ExitCode run_studio(const StudioRequest& request);

/// Prints the completions for a shell.
ExitCode run_completions(const CompletionsRequest& request);

/// Prints the manual page.
ExitCode run_man(const ManRequest& request);

}  // namespace crt::cli
