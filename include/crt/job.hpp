#pragma once

#include <crt/render.hpp>
#include <functional>
#include <memory>

namespace crt {

/// A RenderJob is a render on a thread of its own, which can be watched and stopped. Every function
/// is safe from any number of threads, except moving and destroying.
class RenderJob {
 public:
  /// Starts at once, with a thread of the job's own that counts as one of `options.threads`. 0
  /// threads means as many as the calling thread's TBB arena has. Callbacks come from the job's
  /// threads and must be good to call until it has ended. Throws Error: invalid_argument (threads
  /// or region), out_of_memory, limit (no thread available).
  explicit RenderJob(const PreparedScene& scene, RenderOptions options = {});

  /// Cancels the job and waits for its threads. In one of its own callbacks it does not wait.
  ~RenderJob();
  /// Continues the job under the new name. The old one is good for nothing but being assigned to or
  /// destroyed.
  RenderJob(RenderJob&&) noexcept;
  /// Continues the job under the new name. The job that was here ends as if destroyed.
  RenderJob& operator=(RenderJob&&) noexcept;

  /// Returns the share done, from 0 to 1.
  double progress() const;

  /// Returns the picture so far, in which pixels that are not yet rendered are transparent black.
  /// It may be called after the end too, even if the job was cancelled or failed.
  Image snapshot() const;

  /// Returns the picture so far as Settings::denoise has it: without noise, and without a claim of
  /// its accuracy. Without that setting the filter sees no more than the region. It may be called
  /// as snapshot() may. Any of the threads asks `go_on`, which is to return false for an end.
  /// Throws Error: cancelled, invalid_argument without RenderOptions::denoisable or
  /// Settings::denoise.
  Image denoised(const std::function<bool()>& go_on = {}) const;

  /// Asks the job to stop, which it does within a few tiles. After its end this has no effect.
  void cancel();

  /// Says whether the job has ended: it is done, was cancelled or failed.
  bool finished() const;

  /// Waits for the end. It returns the picture, or throws what ended the job (Error: cancelled,
  /// out_of_memory, or whatever a callback threw). It may be called again. In the job's own
  /// callbacks it throws Error (invalid_argument).
  Image wait() const;

 private:
  class State;
  std::shared_ptr<State> state_;
};

}  // namespace crt
