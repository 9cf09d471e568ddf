#pragma once

#include <crt/render.hpp>
#include <memory>

namespace crt {

/// A render on a thread of its own, which can be watched and stopped. Every function is safe from
/// any number of threads; moving and destroying are not.
class RenderJob {
 public:
  /// Starts at once, with a thread of the job's own that counts as one of `options.threads`; 0
  /// means as many as the calling thread's TBB arena has. Callbacks come from the job's threads and
  /// must be good to call until it has ended. Throws Error: invalid_argument (threads or region),
  /// out_of_memory, limit (no thread to be had).
  explicit RenderJob(const PreparedScene& scene, RenderOptions options = {});

  /// Cancels the job and waits for its threads; in one of its own callbacks it does not wait.
  ~RenderJob();
  /// The job goes on under the new name; the old one is good for nothing but being assigned to or
  /// destroyed.
  RenderJob(RenderJob&&) noexcept;
  /// The same; what was here ends as if destroyed.
  RenderJob& operator=(RenderJob&&) noexcept;

  /// The share done, from 0 to 1.
  double progress() const;

  /// The picture so far; what is not yet rendered is transparent black. Good after the end too,
  /// however it came.
  Image snapshot() const;

  /// Asks the job to stop, which it does within a few tiles. Harmless after its end.
  void cancel();

  /// Whether the job has ended, in one way or the other.
  bool finished() const;

  /// Waits for the end; gives the picture, or throws what ended the job (Error: cancelled,
  /// out_of_memory, or whatever a callback threw). May be called again. In the job's own callbacks
  /// it throws Error (invalid_argument).
  Image wait() const;

 private:
  class State;
  std::shared_ptr<State> state_;
};

}  // namespace crt
