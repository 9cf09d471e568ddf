// Drivers have the tasks of a job done by programs that there are for that.
#pragma once

#include <vector>

#include "cli/interrupt.hpp"
#include "cli/options.hpp"

namespace crt::cli {

/// A Driving is what all drivers need.
struct Driving {
  const FarmRequest& request;
  const std::vector<int>& tasks;  ///< that have no part
  const InterruptScope& interrupt;
};

// These throw Error: io (a program cannot be started), cancelled. Tasks may have failed
// nevertheless.

/// Runs tasks by processes on this machine.
void drive_local(const Driving& driving);
/// Runs tasks by GNU parallel.
void drive_parallel(const Driving& driving);
/// Submits tasks to Slurm as an array job, with another job behind it that merges. Follows them
/// until both have ended, unless the request says otherwise.
void drive_slurm(const Driving& driving);

}  // namespace crt::cli
