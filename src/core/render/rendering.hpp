// One render from its options to its picture: what render() does at once and RenderJob follows.
#pragma once

#include <string>

#include "core/render/canvas.hpp"
#include "core/render/frame.hpp"
#include "core/render/progress.hpp"
#include "core/render/tiles.hpp"
#include "core/scene/prepared_data.hpp"
#include "crt/render.hpp"

namespace crt::core {

class Rendering {
 public:
  /// Checks the options; throws Error (invalid_argument, out_of_memory). `data` must outlive it.
  Rendering(const PreparedData& data, RenderOptions options);

  /// Renders on this thread and those that the options allow. Once. Throws Error: cancelled, out_of_memory.
  void run();

  /// The picture, which is then no longer here. After run().
  Image take() { return canvas_.take(); }

  // From any thread, before, during and after run():

  /// The picture so far.
  Image picture() const { return canvas_.copy(); }
  double share_done() const { return progress_.share(); }
  void cancel() { progress_.stop(); }

 private:
  RenderStats render_tiles();
  void render_tile(const Frame& frame, const Region& tile, Workspace& work);
  void tell(const RenderStats& stats) const;
  void log(LogLevel level, const std::string& line) const;

  const PreparedData& data_;
  RenderOptions options_;
  Settings settings_;
  Canvas canvas_;
  Tiles tiles_;
  Progress progress_;
};

}  // namespace crt::core
