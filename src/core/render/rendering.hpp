// One render from its options to its picture: what render() does at once and RenderJob follows.
#pragma once

#include <string>

#include "core/prepare/prepared_data.hpp"
#include "core/render/canvas.hpp"
#include "core/render/frame.hpp"
#include "core/render/passes.hpp"
#include "core/render/progress.hpp"
#include "core/render/tiles.hpp"
#include "crt/render.hpp"

namespace crt::core {

class Rendering {
 public:
  /// Checks the options; throws Error (invalid_argument, limit, out_of_memory). `data` must outlive
  /// it. `seconds` is what a time budget goes by, and when a checkpoint is due.
  Rendering(const PreparedData& data, RenderOptions options,
            PassClock::Seconds seconds = steady_seconds);

  /// Renders on this thread and those that the options allow. Once. Throws Error: cancelled,
  /// out_of_memory.
  void run();

  /// The picture, which is then no longer here. After run().
  Image take() { return canvas_.take(); }

  /// What is known of each of its pixels. After run().
  const PixelMeasures& measures() const { return measures_; }

  // From any thread, before, during and after run():

  /// The picture so far.
  Image picture() const { return canvas_.copy(); }
  double share_done() const { return progress_.share(); }
  void cancel() { progress_.stop(); }

 private:
  static double steady_seconds();
  RenderStats render_picture();
  /// Leaves one however it ends.
  void run_with_checkpoint(const Frame& frame, Passes& passes, WorkspacePool& pool,
                           const TaskRunner& run_tasks, double begin);
  /// Sees to it that there is one, of nothing if need be, when a render ends before it can be kept.
  void leave_checkpoint() const;
  /// Tells what kept a checkpoint from being written, unless it is "".
  void tell_of_checkpoint(const std::string& complaint) const;
  /// Tells what there is beside the colours of a picture that was rendered pass by pass.
  void put_aovs(const Frame& frame, const TaskRunner& run_tasks);
  void render_grid(const Frame& frame, const TaskRunner& run_tasks);
  /// Runs tasks on the threads that the options allow.
  void run(std::size_t count, WorkspacePool& pool,
           const std::function<void(std::size_t, Workspace&, Progress&)>& task);
  void render_tile(const Frame& frame, const Region& tile, Workspace& work);
  /// Its colours; what its pixels meet first goes into `first_hits`, if that has margin for them.
  void trace_tile(const Frame& frame, const Region& tile, Tracer& tracer,
                  std::span<FirstHit> first_hits, Workspace& work);
  void tell(const RenderStats& stats) const;
  void log(LogLevel level, const std::string& line) const;

  const PreparedData& data_;
  RenderOptions options_;
  Settings settings_;
  Canvas canvas_;
  Progress progress_;
  StepRules rules_;  ///< of every ray
  PassClock::Seconds seconds_;
  PixelMeasures measures_;
};

}  // namespace crt::core
