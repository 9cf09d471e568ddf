// Tasks run on several threads. This is the one place that knows what runs them: oneTBB, or plain
// threads in builds with CRT_TASKS_THREADS.
#pragma once

#include <cstddef>
#include <functional>

namespace crt::core {

/// Returns how many threads may work where `threads` are asked for. 0 asks for all that the
/// caller's arena (or the machine) has. There are never more than this process may start. Throws
/// Error (invalid_argument) for a negative number.
int allowed_threads(int threads);

/// Calls task(0) ... task(count - 1) in any order, on up to allowed_threads(threads) threads at
/// once, the calling one among them. 1 starts no thread and keeps the order. Returns when all are
/// done. The first exception that a task throws stops what has not begun, and is rethrown here.
void run_tasks(std::size_t count, int threads, const std::function<void(std::size_t)>& task);

}  // namespace crt::core
