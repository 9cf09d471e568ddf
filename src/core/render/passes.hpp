// Passes render a picture pass by pass: each pass gives the active pixels some more samples.
//
// After min_samples, and at each doubling from then on, all threads wait for each other, and it is
// decided which pixels stay active: those whose half-width is above the target error. What a
// pixel's neighbours saw counts as well, but only in their first min_samples samples, which all
// pixels get. So a decision depends only on the samples of the pixel and on the first ones of its
// neighbours. A part of the picture is rendered like the whole if its margin, a pixel or two wide,
// gets the first samples too.
//
// Where the first step brings all of min_samples, and nobody wants the picture before that, a
// tile's pixels are decided on as soon as they are traced. They are in the processor's caches then.
// Only those on the tile's halo wait, as they have neighbours in other tiles. Only these and the
// active ones are kept.
#pragma once

#include <array>
#include <functional>
#include <mutex>
#include <shared_mutex>
#include <vector>

#include "core/base/state_file.hpp"
#include "core/render/canvas.hpp"
#include "core/render/neighbour_statistics.hpp"
#include "core/render/pass_clock.hpp"
#include "core/render/pixel.hpp"
#include "core/render/pixel_measures.hpp"
#include "core/render/pixel_store.hpp"
#include "core/render/tiles.hpp"
#include "core/sampling/schedule.hpp"

namespace crt::core {

/// A TaskRunner calls task(0) to task(count - 1), on several threads, with a workspace each.
/// `share` is how much of the picture will be done after them.
using TaskRunner =
    std::function<void(std::size_t count, double share,
                       const std::function<void(std::size_t, Workspace&, Progress&)>& task)>;

/// Returns whether settings and options ask for passes, and not for the plain grid.
bool asks_for_passes(const Settings& settings, int passes);

class Passes {
 public:
  /// `max_passes` is 0 for as many as it takes. All but the region must outlive the passes.
  Passes(const Frame& frame, const Region& region, int max_passes, bool with_first_hits,
         PassClock& clock, Canvas& canvas);

  /// Renders. It is to be called once, and finish() after it.
  void run(const TaskRunner& run_tasks);
  /// Retires all pixels that are left.
  void finish(const TaskRunner& run_tasks);

  /// Makes everything storable at any time, even if run() ends by an exception. It must be called
  /// before run(), which then goes from pass to pass, also where nothing is decided between them.
  /// What has been counted for work that is kept is handed to `settle`, from any thread.
  void make_storable(std::function<void(Workspace&)> settle) { settle_counts_ = std::move(settle); }
  /// Makes run() go from pass to pass, so that what is shown is even at any time.
  void go_by_pass() { is_even_ = true; }
  /// Locks all that can be stored, with what goes with it into the canvas and to `settle`.
  std::unique_lock<std::shared_mutex> hold() const { return std::unique_lock(changing_); }
  /// Stores everything that is known of the picture. It must be held, and finish() not called yet.
  void store(StateWriter& out) const;
  /// Restores what was stored, before run(). The passes must be made alike but for their clock and
  /// number. Throws Error: io for what cannot be, invalid_argument if there are more passes than
  /// wanted.
  void restore(StateReader& in);

  int passes() const;
  PixelMeasures take_measures() { return std::move(measures_); }

 private:
  /// A Tile has the pixels of a tile that are active.
  struct Tile {
    Region region;
    std::span<PixelSamples> samples;   ///< from the first ones on
    std::vector<std::uint8_t> places;  ///< in a whole tile, row by row
    /// These are the statistics of the halo, if the tile was decided on before the other tiles had
    /// theirs.
    std::vector<PixelSamples::Statistics> halo;
    bool is_ahead = false;  ///< has had the step that others are still to have
  };
  /// While a Change lives, its thread changes what can be stored. Other threads may do so, too.
  class Change {
   public:
    Change(Passes& passes, Workspace& work) : passes_(passes), work_(work) {
      if (passes.is_storable()) lock_ = std::shared_lock(passes.changing_);
    }
    ~Change() {
      if (lock_) passes_.settle_counts_(work_);
    }
    Change(const Change&) = delete;
    Change& operator=(const Change&) = delete;

   private:
    Passes& passes_;
    Workspace& work_;
    std::shared_lock<std::shared_mutex> lock_;
  };
  struct Place {
    int x = 0;
    int y = 0;
  };
  static Place place_of(const Tile& tile, std::size_t index);
  void store_tile(const Tile& tile, StateWriter& out) const;
  /// Returns whether a step has been begun, and not ended.
  bool is_within_step() const;
  bool is_storable() const { return static_cast<bool>(settle_counts_); }
  bool has_samples(const Tile& tile) const { return count_ > 0 || tile.is_ahead; }
  void restore_tile(Tile& tile, StateReader& in);
  bool is_in_region(const Place& place) const;
  /// Returns the index of a place that is in the region.
  std::size_t index_of(const Place& place) const;

  /// Marks the pixels where subpixel objects may be. It must be called after the first samples.
  void expect_subpixel_objects(Tile& tile) const;
  /// Pixels of the ranks from `first` to before `last` get the samples up to `until` in a Step.
  struct Ranks {
    int first = 0;
    int last = passes_per_step;
  };
  struct Step {
    std::int64_t until = 0;
    Ranks ranks;
  };
  bool goes_by_pass() const { return by_clock_ || is_even_ || is_storable(); }
  bool is_end(std::int64_t count, int eighths) const {
    return count == max_samples_ && eighths == more_eighths_;
  }
  bool is_complete() const { return is_end(count_, eighths_); }
  Step next_step() const;
  std::uint64_t samples_of(const Step& step) const;
  void trace(const TaskRunner& run_tasks, const Step& step);
  void trace_tile(Tile& tile, const Step& step, Tracer& tracer, Workspace& work);
  /// Returns whether a tile's pixels are decided on as soon as the step has been traced.
  bool decides_at_once(const Step& step) const {
    return count_ == 0 && step.until == frame_.settings().min_samples && !is_storable();
  }
  /// Retires pixels inside a tile that are good enough, and keeps the samples of the others.
  void decide_inside(Tile& tile, std::int64_t count, Workspace& work);
  void show(const Region& tile, std::span<const PixelPlace> pixels, const SampleCount& count);
  void show_guides(std::span<const PixelPlace> pixels, const SampleCount& count);
  void show_some(std::span<const PixelPlace> pixels, const SampleCount& count);
  /// Does what follows when all active pixels have got another sample.
  void decide(const TaskRunner& run_tasks);
  /// Returns whether it is time to ask which pixels are good enough.
  bool is_doubled() const;
  /// Passes statistics to pixels from their neighbours in other tiles.
  void exchange_statistics(const TaskRunner& run_tasks);
  void keep_statistics_from_beyond(Tile& tile) const;
  /// Gets the statistics of pixels in a row, from `begin` to before `end`, after all have their
  /// first samples.
  void look_at(int y, int begin, int end, PixelSamples::Statistics* statistics) const;
  /// Retires the pixels that are good enough, or all of them at the end.
  void settle(const TaskRunner& run_tasks, bool at_end);
  enum class TilePart : std::uint8_t { whole, inside, halo };
  struct Settling {
    std::int64_t count = 0;
    int eighths = 0;
    bool at_end = false;
    TilePart part = TilePart::whole;

    std::int64_t count_of(const Place& place) const {
      return count + (rank_of_pixel(place.x, place.y) < eighths ? 1 : 0);
    }
  };
  void settle_tile(Tile& tile, const Settling& how, Workspace& work);
  /// TilePixels are those pixels of a tile that are in the region and in the part, by index.
  struct TilePixels {
    std::size_t count = 0;
    std::array<std::uint8_t, Tiles::most_pixels> indices;
  };
  void choose(const Tile& tile, TilePart part, TilePixels& chosen) const;
  void find_half_widths(const Tile& tile, const Settling& how, const TilePixels& pixels,
                        std::span<double> half_widths) const;
  void take_leave(const Tile& tile, std::size_t index, std::int64_t count, double half_width,
                  Workspace& work);

  const Frame& frame_;
  Region region_;
  int reach_;         ///< of statistics, in pixels
  Region worked_on_;  ///< the region and its margin
  Tiles grid_;
  std::int64_t max_samples_;
  int more_eighths_ = 0;  ///< after the most samples
  bool by_clock_;
  bool is_even_ = false;
  PassClock& clock_;
  Canvas& canvas_;
  DisplayScale scale_;
  double target_;
  PixelStore store_;
  std::vector<bool> subpixel_objects_;  ///< the pixels where some may be; empty if there are none
  std::vector<Tile> tiles_;
  std::vector<std::size_t> active_;  ///< of the tiles
  std::int64_t count_ = 0;           ///< samples of every active pixel
  int eighths_ = 0;                  ///< the eighths of the active pixels, by rank, that have one
                                     ///< more
  double share_ = 0;
  PixelMeasures measures_;
  bool has_exchanged_statistics_ = false;
  std::function<void(Workspace&)> settle_counts_;
  mutable std::shared_mutex changing_;
};

}  // namespace crt::core
