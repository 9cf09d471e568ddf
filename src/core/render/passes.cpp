#include "core/render/passes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <iterator>
#include <memory>
#include <optional>

#include "core/render/pixels_aside.hpp"
#include "core/render/subpixel_objects.hpp"

namespace crt::core {

namespace {

/// Without a target error pixels get samples until nobody could see the difference, even in 10
/// bits.
constexpr double finest_error = 0.25 / 255;

/// A doubling that may not be the last, or a pass, is taken for this share of what is left to be
/// done at most.
constexpr double share_of_doubling = 0.5;
constexpr double share_of_pass = share_of_doubling / passes_per_step;

/// Statistics of what is seen are passed on so far, in pixels. Out of focus things fade over many
/// pixels, each of which has few samples that hit them. So more pixels together see what one
/// overlooks.
constexpr int reach_of_statistics = 1;
constexpr int reach_of_statistics_with_lens = 2;

/// Calls use(y, begin, end) for the parts of each row of an area that are outside of a tile, which
/// is partly in the area.
template <class Use>
void for_each_beyond(const Region& area, const Region& tile, const Use& use) {
  const int right = area.x + area.width;
  for (int y = area.y; y < area.y + area.height; ++y) {
    if (y < tile.y || y >= tile.y + tile.height) {
      use(y, area.x, right);
      continue;
    }
    if (area.x < tile.x) use(y, area.x, tile.x);
    if (right > tile.x + tile.width) use(y, tile.x + tile.width, right);
  }
}

}  // namespace

bool asks_for_passes(const Settings& settings, int passes) {
  return settings.target_error > 0 || settings.time_budget > 0 || passes > 0;
}

Passes::Passes(const Frame& frame, const Region& region, int max_passes, bool with_first_hits,
               PassClock& clock, Canvas& canvas)
    : frame_(frame),
      region_(region),
      reach_(frame.features().lens ? reach_of_statistics_with_lens : reach_of_statistics),
      worked_on_(widened(region, reach_, {0, 0, frame.settings().width, frame.settings().height})),
      grid_(worked_on_),
      max_samples_(frame.settings().max_samples),
      by_clock_(max_passes == 0 && clock.has_budget()),
      clock_(clock),
      canvas_(canvas),
      scale_(frame.settings().gamma, ToneCurve(frame.settings())),
      target_(frame.settings().target_error > 0 ? frame.settings().target_error : finest_error),
      store_(pixel_count(worked_on_)),
      subpixel_objects_(subpixel_objects(frame, worked_on_)) {
  if (max_passes > 0 && max_passes < passes_until(max_samples_)) {
    const SamplesDone done = samples_after(max_passes);
    max_samples_ = done.samples;
    more_eighths_ = done.eighths;
  }
  const std::size_t pixels = pixel_count(region);
  measures_.samples.resize(pixels);
  measures_.half_widths.resize(pixels);
  if (with_first_hits) measures_.first_hits.resize(pixels);
  tiles_.resize(grid_.count());
  active_.resize(tiles_.size());
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    Tile& tile = tiles_[i];
    tile.region = grid_.tile(i);
    tile.places.resize(pixel_count(tile.region));
    const int width = tile.region.width;
    for (int k = 0; k < static_cast<int>(tile.places.size()); ++k) {
      tile.places[static_cast<std::size_t>(k)] =
          static_cast<std::uint8_t>(k / width * Tiles::side + k % width);
    }
    active_[i] = i;
  }
}

void Passes::expect_subpixel_objects(Tile& tile) const {
  if (subpixel_objects_.empty()) return;
  for (std::size_t i = 0; i < tile.places.size(); ++i) {
    const Place place = place_of(tile, i);
    if (subpixel_objects_[index_in(worked_on_, place.x, place.y)])
      tile.samples[i].expect_subpixel_objects();
  }
}

int Passes::passes() const {
  return passes_until(count_) + eighths_;
}

std::uint64_t Passes::samples_of(const Step& step) const {
  std::uint64_t pixels = 0;
  for (const std::size_t index : active_) {
    if (!tiles_[index].is_ahead) pixels += tiles_[index].places.size();
  }
  const auto share = static_cast<std::uint64_t>(step.ranks.last - step.ranks.first);
  return static_cast<std::uint64_t>(step.until - count_) * (pixels * share / passes_per_step);
}

void Passes::run(const TaskRunner& run_tasks) {
  if (count_ > 0 && eighths_ == 0 && !is_within_step()) decide(run_tasks);  // what was restored
  while (!active_.empty() && !is_complete()) {
    const Step step = next_step();
    const std::uint64_t samples = samples_of(step);
    const bool may_end = count_ > 0 && !is_within_step();
    if (by_clock_ && may_end && !clock_.has_time_for(samples)) break;
    const double share = goes_by_pass() ? share_of_pass : share_of_doubling;
    share_ =
        by_clock_ ? std::max(share_, clock_.share_after(samples)) : share_ + share * (1 - share_);
    trace(run_tasks, step);
    clock_.pass_done(samples);
    if (eighths_ == 0) decide(run_tasks);
  }
}

void Passes::finish(const TaskRunner& run_tasks) {
  settle(run_tasks, true);
}

bool Passes::is_within_step() const {
  return std::any_of(tiles_.begin(), tiles_.end(), [](const Tile& tile) { return tile.is_ahead; });
}

Passes::Step Passes::next_step() const {
  const int last_rank = count_ == max_samples_ ? more_eighths_ : passes_per_step;
  const bool is_split = count_ > 0 && count_ < samples_before_doubling;
  if (is_split && goes_by_pass()) return {count_ + 1, {eighths_, eighths_ + 1}};
  if (eighths_ > 0 || last_rank < passes_per_step) return {count_ + 1, {eighths_, last_rank}};
  if (goes_by_pass()) return {std::min(count_ + samples_of_next_step(count_), max_samples_), {}};
  const std::int64_t least = frame_.settings().min_samples;
  const auto doubled =
      2 * static_cast<std::int64_t>(std::bit_floor(static_cast<std::uint64_t>(count_)));
  return {std::min(count_ < least ? least : doubled, max_samples_), {}};
}

bool Passes::is_doubled() const {
  return count_ >= frame_.settings().min_samples &&
         std::has_single_bit(static_cast<std::uint64_t>(count_));
}

void Passes::decide(const TaskRunner& run_tasks) {
  if (count_ == frame_.settings().min_samples && !has_exchanged_statistics_)
    exchange_statistics(run_tasks);
  if (!is_complete() && is_doubled()) settle(run_tasks, false);
}

void Passes::trace(const TaskRunner& run_tasks, const Step& step) {
  std::vector<std::size_t> behind;
  std::copy_if(active_.begin(), active_.end(), std::back_inserter(behind),
               [&](std::size_t index) { return !tiles_[index].is_ahead; });
  run_tasks(behind.size(), share_, [&](std::size_t index, Workspace& work, Progress& progress) {
    Tracer tracer(frame_, work, progress);
    tracer.identify();
    trace_tile(tiles_[behind[index]], step, tracer, work);
  });
  const auto hold = this->hold();
  for (Tile& tile : tiles_) tile.is_ahead = false;
  eighths_ = step.ranks.last % passes_per_step;
  if (eighths_ == 0) count_ = step.until;
}

void Passes::trace_tile(Tile& tile, const Step& step, Tracer& tracer, Workspace& work) {
  if (decides_at_once(step)) {
    work.pixel_samples.resize(Tiles::most_pixels);
    tile.samples = std::span(work.pixel_samples).first(tile.places.size());
  } else if (count_ == 0) {
    tile.samples = store_.take(tile.places.size());
  }
  std::array<PixelPlace, Tiles::most_pixels> pixels;
  std::size_t count = 0;
  for (std::size_t i = 0; i < tile.places.size(); ++i) {
    const Place place = place_of(tile, i);
    const int rank = rank_of_pixel(place.x, place.y);
    if (rank < step.ranks.first || rank >= step.ranks.last) continue;
    PixelPlace& pixel = pixels[count++];
    pixel = {.x = place.x, .y = place.y, .samples = &tile.samples[i], .first_hits = nullptr};
    if (!measures_.first_hits.empty() && is_in_region(place)) {
      pixel.first_hits = &measures_.first_hits[index_of(place)];
    }
  }
  const std::span<PixelPlace> chosen(pixels.data(), count);
  const auto margin = std::partition(chosen.begin(), chosen.end(), [&](const PixelPlace& pixel) {
    return is_in_region({pixel.x, pixel.y});
  });
  const auto in_region = static_cast<std::size_t>(margin - chosen.begin());
  std::optional<PixelsAside> aside;
  if (is_storable()) aside.emplace(chosen, count_ > 0, work);
  const SampleRange range{count_, step.until};
  trace_passes(frame_, chosen.first(in_region), range, tracer, work.stats);
  if (in_region < count) {
    // The rays of the margin are not counted, so that the counts of regions add up to the whole's.
    const RenderStats counted = work.stats;
    trace_passes(frame_, chosen.subspan(in_region), range, tracer, work.stats);
    work.stats = counted;
  }
  const Change change(*this, work);
  if (aside) aside->put_back();
  tile.is_ahead = true;
  if (count_ == 0) expect_subpixel_objects(tile);
  show(tile.region, chosen, SampleCount(step.until));
  const bool ends_step = step.ranks.last == passes_per_step;
  if (!ends_step || step.until != frame_.settings().min_samples) return;
  keep_statistics_within(tile.region, reach_, tile.samples);
  if (decides_at_once(step)) decide_inside(tile, step.until, work);
}

void Passes::decide_inside(Tile& tile, std::int64_t count, Workspace& work) {
  tile.halo = TileHalo(tile.region, reach_).statistics(tile.samples);
  settle_tile(tile, {.count = count, .at_end = is_end(count, 0), .part = TilePart::inside}, work);
  const std::span<PixelSamples> kept = store_.take(tile.samples.size());
  std::uninitialized_copy(tile.samples.begin(), tile.samples.end(), kept.begin());
  tile.samples = kept;
}

Passes::Place Passes::place_of(const Tile& tile, std::size_t index) {
  const int place = tile.places[index];
  return {tile.region.x + place % Tiles::side, tile.region.y + place / Tiles::side};
}

bool Passes::is_in_region(const Place& place) const {
  return is_in(region_, place.x, place.y);
}

std::size_t Passes::index_of(const Place& place) const {
  return index_in(region_, place.x, place.y);
}

void Passes::show(const Region& tile, std::span<const PixelPlace> pixels,
                  const SampleCount& count) {
  if (canvas_.has_guides()) show_guides(pixels, count);
  const bool is_whole = pixels.size() == pixel_count(tile) && is_in(region_, tile.x, tile.y) &&
                        is_in(region_, tile.x + tile.width - 1, tile.y + tile.height - 1);
  if (!is_whole) {
    show_some(pixels, count);
    return;
  }
  std::array<float, pixel_channels * Tiles::most_pixels> shown;
  float* next = shown.data();
  for (const PixelPlace& pixel : pixels) {
    const FloatLanes mean = finite_floats(pixel.samples->mean(count));
    std::memcpy(next, &mean, sizeof mean);
    next += pixel_channels;
  }
  canvas_.put(tile, std::span(shown.data(), next));
}

void Passes::show_some(std::span<const PixelPlace> pixels, const SampleCount& count) {
  std::array<PlacedPixel, Tiles::most_pixels> shown;
  std::size_t shown_count = 0;
  for (const PixelPlace& pixel : pixels) {
    if (!is_in_region({pixel.x, pixel.y})) continue;
    const FloatLanes mean = finite_floats(pixel.samples->mean(count));
    PlacedPixel& out = shown[shown_count++];
    out.x = pixel.x;
    out.y = pixel.y;
    std::memcpy(out.values.data(), &mean, sizeof mean);
  }
  canvas_.put(std::span(shown).first(shown_count));
}

void Passes::show_guides(std::span<const PixelPlace> pixels, const SampleCount& count) {
  std::array<PlacedGuide, Tiles::most_pixels> shown;
  std::size_t shown_count = 0;
  for (const PixelPlace& pixel : pixels) {
    if (pixel.first_hits == nullptr) continue;  // in the margin
    FirstHit hit = *pixel.first_hits;
    hit.divide(count.samples());
    shown[shown_count++] = {
        pixel.x, pixel.y,
        guide_of(hit, pixel.samples->variance(count), PixelSamples::blocks(count))};
  }
  canvas_.put(std::span<const PlacedGuide>(shown).first(shown_count));
}

void Passes::exchange_statistics(const TaskRunner& run_tasks) {
  run_tasks(active_.size(), share_,
            [&](std::size_t index, Workspace& work, Progress& /*progress*/) {
              const Change change(*this, work);
              keep_statistics_from_beyond(tiles_[active_[index]]);
            });
  const auto hold = this->hold();
  has_exchanged_statistics_ = true;
}

void Passes::keep_statistics_from_beyond(Tile& tile) const {
  using Statistics = PixelSamples::Statistics;
  constexpr std::size_t widest = Tiles::side + 2 * reach_of_statistics_with_lens;
  std::array<Statistics, widest * widest> seen;  // in the window, around the tile
  const Region window = widened(tile.region, reach_, worked_on_);
  const auto seen_at = [&](int x, int y) { return &seen[index_in(window, x, y)]; };
  for_each_beyond(window, tile.region,
                  [&](int y, int begin, int end) { look_at(y, begin, end, seen_at(begin, y)); });
  const TileHalo halo(tile.region, reach_);
  for (std::size_t i = 0; i < tile.places.size(); ++i) {
    const Place place = place_of(tile, i);
    if (!halo.has(place.x, place.y) || !is_in_region(place)) continue;
    PixelSamples& samples = tile.samples[i];
    const Region around = widened({place.x, place.y, 1, 1}, reach_, worked_on_);
    for_each_beyond(around, tile.region, [&](int y, int begin, int end) {
      for (const Statistics* statistics = seen_at(begin, y); begin < end; ++begin)
        samples.keep(*statistics++);
    });
  }
}

void Passes::look_at(int y, int begin, int end, PixelSamples::Statistics* statistics) const {
  for (int x = begin; x < end;) {
    const Tile& tile = tiles_[grid_.index(x, y)];
    const int end_in_tile = std::min(end, tile.region.x + tile.region.width);
    if (!tile.halo.empty()) {
      const auto first = static_cast<std::ptrdiff_t>(TileHalo(tile.region, reach_).index(x, y));
      statistics = std::copy_n(tile.halo.begin() + first, end_in_tile - x, statistics);
      x = end_in_tile;
    }
    while (x < end_in_tile)
      *statistics++ = tile.samples[index_in(tile.region, x++, y)].statistics();
  }
}

void Passes::settle(const TaskRunner& run_tasks, bool at_end) {
  run_tasks(active_.size(), share_,
            [&](std::size_t index, Workspace& work, Progress& /*progress*/) {
              const Change change(*this, work);
              Tile& tile = tiles_[active_[index]];
              const TilePart part = tile.halo.empty() ? TilePart::whole : TilePart::halo;
              settle_tile(tile, {count_, eighths_, at_end, part}, work);
              tile.halo = {};
            });
  std::erase_if(active_, [&](std::size_t index) { return tiles_[index].places.empty(); });
}

void Passes::choose(const Tile& tile, TilePart part, TilePixels& chosen) const {
  const TileHalo halo(tile.region, reach_);
  for (std::size_t i = 0; i < tile.places.size(); ++i) {
    const Place place = place_of(tile, i);
    const bool is_in_part =
        part == TilePart::whole || halo.has(place.x, place.y) == (part == TilePart::halo);
    if (is_in_part && is_in_region(place))
      chosen.indices[chosen.count++] = static_cast<std::uint8_t>(i);
  }
}

void Passes::find_half_widths(const Tile& tile, const Settling& how, const TilePixels& pixels,
                              std::span<double> half_widths) const {
  const bool with_lens = frame_.features().lens;
  const SampleCount count_of_most(how.count, with_lens);
  const SampleCount count_of_some(how.count + 1, with_lens);
  for (std::size_t i = 0; i < pixels.count; i += lane_count) {
    const std::size_t count = std::min<std::size_t>(pixels.count - i, lane_count);
    const auto interval = [&](std::size_t k) {
      if (k >= count) return MeanInterval{};
      const std::size_t index = pixels.indices[i + k];
      const bool has_more = how.eighths > 0 && how.count_of(place_of(tile, index)) > how.count;
      return tile.samples[index].interval(has_more ? count_of_some : count_of_most);
    };
    const Lanes of_four = scale_.half_widths({interval(0), interval(1), interval(2), interval(3)});
    for (std::size_t k = 0; k < count; ++k) half_widths[i + k] = of_four[k];
  }
}

void Passes::settle_tile(Tile& tile, const Settling& how, Workspace& work) {
  TilePixels chosen;
  choose(tile, how.part, chosen);
  std::array<double, Tiles::most_pixels> half_widths;
  find_half_widths(tile, how, chosen, half_widths);
  std::size_t kept = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < tile.places.size(); ++i) {
    if (next < chosen.count && chosen.indices[next] == i) {
      const double half_width = half_widths[next++];
      const std::int64_t count = how.count_of(place_of(tile, i));
      const bool is_good = half_width <= target_ && tile.samples[i].has_seen_enough(count);
      if (is_good || how.at_end) {
        take_leave(tile, i, count, half_width, work);
        continue;
      }
    } else if (how.part == TilePart::whole || !is_in_region(place_of(tile, i))) {
      continue;  // the margin is there for the first samples alone
    }
    tile.samples[kept] = tile.samples[i];
    tile.places[kept++] = tile.places[i];
  }
  tile.samples = tile.samples.first(kept);
  tile.places.resize(kept);
}

void Passes::take_leave(const Tile& tile, std::size_t index, std::int64_t count, double half_width,
                        Workspace& work) {
  const Place place = place_of(tile, index);
  const std::size_t pixel = index_of(place);
  measures_.samples[pixel] = static_cast<std::uint32_t>(count);
  measures_.half_widths[pixel] = static_cast<float>(half_width);
  if (!measures_.first_hits.empty()) measures_.first_hits[pixel].divide(count);
  const double dropped = tile.samples[index].dropped(count);
  if (dropped != 0) work.cutoff.add(dropped);
  ++work.stats.pixels;
  if (half_width > target_) ++work.stats.pixels_unresolved;
}

}  // namespace crt::core
