// Rendering pass by pass: each gives the pixels that are not yet good enough some more samples.
//
// After min_samples, and at each doubling from then on, all threads wait for each other, and it is decided
// which pixels go on: those whose half-width is above the target error. What a pixel's neighbours saw counts
// as well, but only in their first min_samples samples, which all pixels get. So a decision depends on the
// samples of the pixel and on the first ones of its neighbours alone, and a part of the picture is rendered
// like the whole if its margin, a pixel or two wide, gets the first samples too.
#pragma once

#include <functional>
#include <vector>

#include "core/render/canvas.hpp"
#include "core/render/pass_clock.hpp"
#include "core/render/pixel.hpp"
#include "core/render/pixel_measures.hpp"
#include "core/render/tiles.hpp"
#include "core/sampling/schedule.hpp"

namespace crt::core {

/// Calls task(0) to task(count - 1), on several threads, with a workspace each; `share` is how much of the
/// picture will be done after them.
using TaskRunner = std::function<void(std::size_t count, double share,
                                      const std::function<void(std::size_t, Workspace&, Progress&)>& task)>;

/// Whether settings and options ask for it, and not for the plain grid.
bool asks_for_passes(const Settings& settings, int passes);

class Passes {
 public:
  /// `most_passes`: 0 for as many as it takes. All but the region must outlive it.
  Passes(const Frame& frame, const Region& region, int most_passes, bool with_first_hits, PassClock& clock,
         Canvas& canvas);

  /// Renders. Once.
  void run(const TaskRunner& run_tasks);

  int passes() const;
  PixelMeasures take_measures() { return std::move(measures_); }

 private:
  /// The pixels of a tile that are still worked on.
  struct Tile {
    Region region;
    std::vector<PixelSamples> samples;
    std::vector<std::uint8_t> places;  ///< in the tile, row by row
  };
  struct Place {
    int x = 0;
    int y = 0;
  };
  static Place place_of(const Tile& tile, std::size_t index);
  bool is_in_region(const Place& place) const;
  /// Of one that is.
  std::size_t index_of(const Place& place) const;

  void expect_small_things();
  std::uint64_t pixels_left() const;
  /// Gives pixels of the ranks from `first` to before `last` the samples up to `until`.
  struct Ranks {
    int first = 0;
    int last = passes_per_step;
  };
  void trace(const TaskRunner& run_tasks, std::int64_t until, const Ranks& ranks);
  void trace_tile(Tile& tile, std::int64_t until, const Ranks& ranks, Tracer& tracer, RenderStats& stats);
  void show(std::span<const PixelPlace> pixels, std::int64_t count);
  void run_to_the_end(const TaskRunner& run_tasks);
  void run_by_clock(const TaskRunner& run_tasks);
  /// What comes after each sample of all that are left; whether to go on.
  bool decide(const TaskRunner& run_tasks);
  /// Tells the pixels what their neighbours have seen; while all pixels are still there.
  void exchange_notes(const TaskRunner& run_tasks);
  void take_notes(const Place& place, PixelSamples& samples) const;
  /// Takes leave of the pixels that are good enough, at the end of all.
  void settle(const TaskRunner& run_tasks, bool at_end);
  void settle_tile(Tile& tile, bool at_end, Workspace& work);

  const Frame& frame_;
  Region region_;
  int reach_;         ///< of notes, in pixels
  Region worked_on_;  ///< the region and its margin
  Tiles grid_;
  std::int64_t most_samples_;
  int more_eighths_ = 0;  ///< after the most samples
  bool by_clock_;
  PassClock& clock_;
  Canvas& canvas_;
  DisplayScale scale_;
  double target_;
  std::vector<Tile> tiles_;
  std::vector<std::size_t> active_;  ///< of the tiles
  std::int64_t count_ = 0;           ///< samples of every pixel that is left
  int eighths_ = 0;                  ///< of them, by rank, that have one more
  double share_ = 0;
  PixelMeasures measures_;
};

}  // namespace crt::core
