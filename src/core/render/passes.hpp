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

#include "core/files/state_file.hpp"
#include "core/render/canvas.hpp"
#include "core/render/pass_clock.hpp"
#include "core/render/pixel.hpp"
#include "core/render/pixel_measures.hpp"
#include "core/render/pixel_store.hpp"
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

  /// From now on goes from pass to pass, also where nothing is decided between them, and calls
  /// pause(at_end) after each and at the end: then everything can be stored.
  void pause_with(std::function<void(bool)> pause) { pause_ = std::move(pause); }
  /// Everything that is known of the picture after the passes so far.
  void store(StateWriter& out) const;
  /// Takes it up before run(), in one that was made alike but for its clock and number of passes. Throws
  /// Error: io for what cannot be, invalid_argument if there are more passes than wanted.
  void restore(StateReader& in);

  int passes() const;
  PixelMeasures take_measures() { return std::move(measures_); }

 private:
  /// The pixels of a tile that are still worked on.
  struct Tile {
    Region region;
    std::span<PixelSamples> samples;
    std::vector<std::uint8_t> places;  ///< in the tile, row by row
  };
  struct Place {
    int x = 0;
    int y = 0;
  };
  static Place place_of(const Tile& tile, std::size_t index);
  static void store_tile(const Tile& tile, StateWriter& out);
  static void restore_tile(Tile& tile, StateReader& in);
  bool is_in_region(const Place& place) const;
  /// Of one that is.
  std::size_t index_of(const Place& place) const;

  /// Where there may be some; after the first samples.
  void expect_small_things(Tile& tile) const;
  /// Gives pixels of the ranks from `first` to before `last` the samples up to `until`.
  struct Ranks {
    int first = 0;
    int last = passes_per_step;
  };
  struct Step {
    std::int64_t until = 0;
    Ranks ranks;
  };
  bool goes_by_pass() const { return by_clock_ || pause_; }
  bool is_complete() const { return count_ == most_samples_ && eighths_ == more_eighths_; }
  Step next_step() const;
  std::uint64_t samples_of(const Step& step) const;
  void trace(const TaskRunner& run_tasks, const Step& step);
  void trace_tile(Tile& tile, const Step& step, Tracer& tracer, RenderStats& stats);
  void show(std::span<const PixelPlace> pixels, std::int64_t count);
  /// What comes after each sample of all that are left.
  void decide(const TaskRunner& run_tasks);
  /// Whether it is the time to ask which pixels are good enough.
  bool is_doubled() const;
  /// Tells the pixels what their neighbours have seen; while all pixels are still there.
  void exchange_notes(const TaskRunner& run_tasks);
  void keep_notes(Tile& tile);
  /// What is seen in each pixel of a window, row by row.
  void look_around(const Region& window, std::span<PixelSamples::Notes> notes) const;
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
  PixelStore store_;
  std::vector<bool> small_things_;  ///< the pixels where some may be; empty if there are none
  std::vector<Tile> tiles_;
  std::vector<std::size_t> active_;  ///< of the tiles
  std::int64_t count_ = 0;           ///< samples of every pixel that is left
  int eighths_ = 0;                  ///< of them, by rank, that have one more
  double share_ = 0;
  PixelMeasures measures_;
  std::function<void(bool)> pause_;
};

}  // namespace crt::core
