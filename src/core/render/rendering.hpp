// A Rendering is one render from its options to its picture. render() runs it at once, and a
// RenderJob follows it.
#pragma once

#include <functional>
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
  /// Checks the options. Throws Error (invalid_argument, limit, out_of_memory). `data` must outlive
  /// the rendering. `seconds` is the clock for a time budget, and for when a checkpoint is due.
  Rendering(const PreparedData& data, RenderOptions options,
            PassClock::Seconds seconds = steady_seconds);

  /// Renders on this thread and those that the options allow. It is to be called once. Throws
  /// Error: cancelled, out_of_memory.
  void run();

  /// Returns the picture and takes it from the rendering. It is to be called after run().
  Image take() { return canvas_.take(); }

  /// Returns what is known of each of its pixels. It is to be called after run().
  const PixelMeasures& measures() const { return measures_; }

  // These may be called from any thread, before, during and after run():

  /// Returns the picture with what is done at the time.
  Image picture() const;
  /// Returns it without noise. Throws Error: cancelled, and invalid_argument if nothing is kept for
  /// the filter.
  Image denoised(const std::function<bool()>& go_on) const;
  double share_done() const { return progress_.share(); }
  void cancel() { progress_.stop(); }

 private:
  static double steady_seconds();
  RenderStats render_picture();
  /// Renders, and leaves a checkpoint however it ends.
  void run_with_checkpoint(const Frame& frame, Passes& passes, WorkspacePool& pool,
                           const TaskRunner& run_tasks, double begin);
  /// Makes sure that there is a checkpoint, an empty one if need be, when a render ends before one
  /// can be kept.
  void leave_checkpoint() const;
  /// Logs what kept a checkpoint from being written, unless it is "".
  void tell_of_checkpoint(const std::string& complaint) const;
  /// Puts in the AOVs of a picture that was rendered pass by pass.
  void put_aovs(const Frame& frame, const TaskRunner& run_tasks);
  void render_grid(const Frame& frame, const TaskRunner& run_tasks);
  /// Runs tasks on the threads that the options allow.
  void run(std::size_t count, WorkspacePool& pool,
           const std::function<void(std::size_t, Workspace&, Progress&)>& task);
  void render_tile(const Frame& frame, const Region& tile, Workspace& work);
  /// Renders the colours of a tile. What its pixels meet first goes into `first_hits`, unless that
  /// is empty.
  void trace_tile(const Frame& frame, const Region& tile, Tracer& tracer,
                  std::span<FirstHit> first_hits, Workspace& work);
  void put_guides(const Frame& frame, const Region& tile, std::span<const FirstHit> first_hits,
                  std::span<const PixelNoise> noise);
  /// Returns whether somebody asks how the surfaces look that samples meet first.
  bool keeps_first_hits() const { return keeps_guides() || ask_for_first_hits(options_.aovs); }
  /// Returns whether there is to be all that a filter needs to know.
  bool keeps_guides() const { return settings_.denoise || options_.denoisable; }
  /// Returns the picture with what is done at the time, filtered as far as that was not done yet.
  Image filtered(const std::function<bool()>& go_on = {}) const;
  /// Returns what filters the picture at the end, until somebody cancels.
  StripRunner strip_runner();
  void report(const RenderStats& stats) const;
  void log(LogLevel level, const std::string& line) const;

  const PreparedData& data_;
  RenderOptions options_;
  Settings settings_;
  Region region_;  ///< that is asked for
  Canvas canvas_;  ///< of it, or of more that a filter needs
  Progress progress_;
  StepRules rules_;  ///< of every ray
  PassClock::Seconds seconds_;
  PixelMeasures measures_;
};

}  // namespace crt::core
