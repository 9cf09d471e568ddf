#include "core/render/passes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <functional>

#include "core/render/small_things.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

/// Without a target error pixels go on until nobody could see the difference, be it in 10 bits.
constexpr double finest_error = 0.25 / 255;

/// Of what is left to be done at most, how much a doubling is taken for that may not be the last, and a pass.
constexpr double share_of_doubling = 0.5;
constexpr double share_of_pass = share_of_doubling / passes_per_step;

constexpr std::size_t most_tile_pixels = std::size_t{Tiles::side} * Tiles::side;

/// How far notes of what is seen are passed on, in pixels. Out of focus things fade over many pixels, of
/// which each has few samples that hit them: more pixels together see what one overlooks.
constexpr int reach_of_notes = 1;
constexpr int reach_of_notes_with_lens = 2;

/// The region and the pixels around it, but no others than those within `limits`.
Region widened(const Region& region, int margin, const Region& limits) {
  const int left = std::max(region.x - margin, limits.x);
  const int top = std::max(region.y - margin, limits.y);
  const int right = std::min(region.x + region.width + margin, limits.x + limits.width);
  const int bottom = std::min(region.y + region.height + margin, limits.y + limits.height);
  return {left, top, right - left, bottom - top};
}

}  // namespace

bool asks_for_passes(const Settings& settings, int passes) {
  return settings.target_error > 0 || settings.time_budget > 0 || passes > 0;
}

Passes::Passes(const Frame& frame, const Region& region, int most_passes, bool with_first_hits,
               PassClock& clock, Canvas& canvas)
    : frame_(frame),
      region_(region),
      reach_(frame.features().lens ? reach_of_notes_with_lens : reach_of_notes),
      worked_on_(widened(region, reach_, {0, 0, frame.settings().width, frame.settings().height})),
      grid_(worked_on_),
      most_samples_(frame.settings().max_samples),
      by_clock_(most_passes == 0 && clock.has_budget()),
      clock_(clock),
      canvas_(canvas),
      scale_(frame.settings().gamma),
      target_(frame.settings().target_error > 0 ? frame.settings().target_error : finest_error),
      store_(pixel_count(worked_on_)),
      small_things_(small_things(frame, worked_on_)) {
  if (most_passes > 0 && most_passes < passes_until(most_samples_)) {
    const SamplesDone done = samples_after(most_passes);
    most_samples_ = done.samples;
    more_eighths_ = done.eighths;
  }
  const std::size_t pixels = pixel_count(region);
  measures_.samples.resize(pixels);
  measures_.half_widths.resize(pixels);
  if (with_first_hits) measures_.first_hits.resize(pixels);
  tiles_.resize(grid_.count());
  active_.resize(tiles_.size());
  std::size_t stored = 0;
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    Tile& tile = tiles_[i];
    tile.region = grid_.tile(i);
    tile.samples = store_.part(stored, pixel_count(tile.region));
    stored += tile.samples.size();
    tile.places.resize(tile.samples.size());
    for (std::size_t k = 0; k < tile.places.size(); ++k) tile.places[k] = static_cast<std::uint8_t>(k);
    active_[i] = i;
  }
}

void Passes::expect_small_things(Tile& tile) const {
  if (small_things_.empty()) return;
  for (std::size_t i = 0; i < tile.places.size(); ++i) {
    const Place place = place_of(tile, i);
    if (small_things_[index_in(worked_on_, place.x, place.y)]) tile.samples[i].expect_small_things();
  }
}

int Passes::passes() const {
  return passes_until(count_) + eighths_;
}

std::uint64_t Passes::samples_of(const Step& step) const {
  std::uint64_t pixels = 0;
  for (const std::size_t index : active_) pixels += tiles_[index].places.size();
  const auto share = static_cast<std::uint64_t>(step.ranks.last - step.ranks.first);
  return static_cast<std::uint64_t>(step.until - count_) * (pixels * share / passes_per_step);
}

void Passes::run(const TaskRunner& run_tasks) {
  if (count_ > 0 && eighths_ == 0 && is_doubled()) settle(run_tasks, false);  // what was taken up
  while (!active_.empty() && !is_complete()) {
    const Step step = next_step();
    const std::uint64_t samples = samples_of(step);
    if (by_clock_ && count_ > 0 && !clock_.has_time_for(samples)) break;
    const double share = goes_by_pass() ? share_of_pass : share_of_doubling;
    share_ = by_clock_ ? std::max(share_, clock_.share_after(samples)) : share_ + share * (1 - share_);
    trace(run_tasks, step);
    clock_.pass_done(samples);
    if (eighths_ == 0) decide(run_tasks);
    if (pause_) pause_(false);
  }
  if (pause_) pause_(true);
  settle(run_tasks, true);
}

Passes::Step Passes::next_step() const {
  const int last_rank = count_ == most_samples_ ? more_eighths_ : passes_per_step;
  const bool is_split = count_ > 0 && count_ < samples_before_doubling;
  if (is_split && goes_by_pass()) return {count_ + 1, {eighths_, eighths_ + 1}};
  if (eighths_ > 0 || last_rank < passes_per_step) return {count_ + 1, {eighths_, last_rank}};
  if (goes_by_pass()) return {std::min(count_ + samples_of_next_step(count_), most_samples_), {}};
  const std::int64_t least = frame_.settings().min_samples;
  const auto doubled = 2 * static_cast<std::int64_t>(std::bit_floor(static_cast<std::uint64_t>(count_)));
  return {std::min(count_ < least ? least : doubled, most_samples_), {}};
}

bool Passes::is_doubled() const {
  return count_ >= frame_.settings().min_samples && std::has_single_bit(static_cast<std::uint64_t>(count_));
}

void Passes::decide(const TaskRunner& run_tasks) {
  if (count_ == frame_.settings().min_samples) exchange_notes(run_tasks);
  if (!is_complete() && is_doubled()) settle(run_tasks, false);
}

void Passes::trace(const TaskRunner& run_tasks, const Step& step) {
  run_tasks(active_.size(), share_, [&](std::size_t index, Workspace& work, Progress& progress) {
    Tracer tracer(frame_, work, progress);
    tracer.identify();
    trace_tile(tiles_[active_[index]], step, tracer, work.stats);
  });
  eighths_ = step.ranks.last % passes_per_step;
  if (eighths_ == 0) count_ = step.until;
}

void Passes::trace_tile(Tile& tile, const Step& step, Tracer& tracer, RenderStats& stats) {
  std::array<PixelPlace, most_tile_pixels> pixels;
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
  const std::span<const PixelPlace> chosen(pixels.data(), count);
  trace_passes(frame_, chosen, {count_, step.until}, tracer, stats);
  if (count_ == 0) expect_small_things(tile);
  show(chosen, step.until);
}

Passes::Place Passes::place_of(const Tile& tile, std::size_t index) {
  const int place = tile.places[index];
  return {tile.region.x + place % tile.region.width, tile.region.y + place / tile.region.width};
}

bool Passes::is_in_region(const Place& place) const {
  return place.x >= region_.x && place.x < region_.x + region_.width && place.y >= region_.y &&
         place.y < region_.y + region_.height;
}

std::size_t Passes::index_of(const Place& place) const {
  return index_in(region_, place.x, place.y);
}

void Passes::show(std::span<const PixelPlace> pixels, std::int64_t count) {
  std::array<PlacedPixel, most_tile_pixels> shown;
  std::size_t shown_count = 0;
  for (const PixelPlace& pixel : pixels) {
    if (!is_in_region({pixel.x, pixel.y})) continue;
    const Lanes mean = pixel.samples->mean(count);
    PlacedPixel& out = shown[shown_count++];
    out.x = pixel.x;
    out.y = pixel.y;
    for (int c = 0; c < pixel_channels; ++c) out.values[static_cast<std::size_t>(c)] = finite_float(mean[c]);
  }
  canvas_.put(std::span(shown).first(shown_count));
}

void Passes::exchange_notes(const TaskRunner& run_tasks) {
  run_tasks(active_.size(), share_, [&](std::size_t index, Workspace& /*work*/, Progress& /*progress*/) {
    keep_notes(tiles_[active_[index]]);
  });
}

void Passes::look_around(const Region& window, std::span<PixelSamples::Notes> notes) const {
  std::size_t index = 0;
  for (int y = window.y; y < window.y + window.height; ++y) {
    for (int x = window.x; x < window.x + window.width;) {
      const Tile& tile = tiles_[grid_.index(x, y)];
      const int end = std::min(window.x + window.width, tile.region.x + tile.region.width);
      const PixelSamples* samples = &tile.samples[index_in(tile.region, x, y)];
      for (; x < end; ++x) notes[index++] = (samples++)->notes();
    }
  }
}

void Passes::keep_notes(Tile& tile) {
  // A square's notes are those of its rows, and these those of the pixels in them.
  using Notes = PixelSamples::Notes;
  constexpr std::size_t widest = Tiles::side + 2 * reach_of_notes_with_lens;
  std::array<Notes, widest * widest> seen;
  std::array<Notes, widest * Tiles::side> of_rows;
  const Region window = widened(tile.region, reach_, worked_on_);
  const auto width = static_cast<std::size_t>(tile.region.width);
  const auto first_column = static_cast<std::size_t>(tile.region.x - window.x);
  const auto first_row = static_cast<std::size_t>(tile.region.y - window.y);
  look_around(window, seen);
  // Those of `count` places, `stride` apart, as far from `place` as notes reach.
  const auto around = [this](const Notes* row, std::size_t stride, std::size_t place, std::size_t count) {
    const auto reach = static_cast<std::size_t>(reach_);
    const std::size_t last = std::min(place + reach, count - 1);
    std::size_t next = place - std::min(place, reach);
    Notes notes = row[next * stride];
    while (++next <= last) notes.take(row[next * stride]);
    return notes;
  };
  const auto window_width = static_cast<std::size_t>(window.width);
  const auto window_height = static_cast<std::size_t>(window.height);
  for (std::size_t y = 0; y < window_height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      of_rows[y * width + x] = around(&seen[y * window_width], 1, first_column + x, window_width);
    }
  }
  for (std::size_t i = 0; i < tile.samples.size(); ++i) {
    if (!is_in_region(place_of(tile, i))) continue;
    tile.samples[i].keep(around(&of_rows[i % width], width, first_row + i / width, window_height));
  }
}

void Passes::settle(const TaskRunner& run_tasks, bool at_end) {
  run_tasks(active_.size(), share_, [&](std::size_t index, Workspace& work, Progress& /*progress*/) {
    settle_tile(tiles_[active_[index]], at_end, work);
  });
  std::erase_if(active_, [&](std::size_t index) { return tiles_[index].places.empty(); });
}

void Passes::settle_tile(Tile& tile, bool at_end, Workspace& work) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < tile.places.size(); ++i) {
    const Place place = place_of(tile, i);
    if (!is_in_region(place)) continue;
    const std::int64_t count = count_ + (rank_of_pixel(place.x, place.y) < eighths_ ? 1 : 0);
    const double half_width = tile.samples[i].half_width(count, scale_);
    const bool is_good = half_width <= target_ && tile.samples[i].has_seen_enough(count);
    if (!is_good && !at_end) {
      tile.samples[kept] = tile.samples[i];
      tile.places[kept++] = tile.places[i];
      continue;
    }
    const std::size_t pixel = index_of(place);
    measures_.samples[pixel] = static_cast<std::uint32_t>(count);
    measures_.half_widths[pixel] = static_cast<float>(half_width);
    if (!measures_.first_hits.empty()) measures_.first_hits[pixel].divide(count);
    work.cutoff.add(tile.samples[i].dropped(count));
    ++work.stats.pixels;
    if (half_width > target_) ++work.stats.pixels_unresolved;
  }
  tile.samples = tile.samples.first(kept);
  tile.places.resize(kept);
}

void Passes::store_tile(const Tile& tile, StateWriter& out) {
  out.put(static_cast<std::uint16_t>(tile.places.size()));
  out.put_all(std::span<const std::uint8_t>(tile.places));
  for (const PixelSamples& samples : tile.samples) out.put_all(std::span<const std::byte>(samples.stored()));
}

void Passes::restore_tile(Tile& tile, StateReader& in) {
  const std::size_t count = in.get<std::uint16_t>();
  const std::size_t most = tile.places.size();
  if (count > most) in.fail();
  tile.places.resize(count);
  in.get_all(std::span<std::uint8_t>(tile.places));
  // Each pixel once, in its order, and in the tile.
  const bool in_order =
      std::adjacent_find(tile.places.begin(), tile.places.end(), std::greater_equal<>()) == tile.places.end();
  if (!in_order || (count > 0 && tile.places.back() >= most)) in.fail();
  tile.samples = tile.samples.first(count);
  PixelSamples::Stored bytes;
  for (PixelSamples& samples : tile.samples) {
    in.get_all(std::span<std::byte>(bytes));
    samples = PixelSamples::restored(bytes);
  }
}

void Passes::store(StateWriter& out) const {
  out.put(count_);
  out.put(eighths_);
  out.put_all(std::span<const std::uint32_t>(measures_.samples));
  out.put_all(std::span<const float>(measures_.half_widths));
  for (const FirstHit& hit : measures_.first_hits) {
    for (const Vec3& v : {hit.normal, hit.color}) {
      for (int axis = 0; axis < 3; ++axis) out.put(v[axis]);
    }
  }
  for (const Tile& tile : tiles_) store_tile(tile, out);
}

void Passes::restore(StateReader& in) {
  const auto count = in.get<std::int64_t>();
  const int eighths = in.get<int>();
  const bool is_pass = count >= 1 && count <= frame_.settings().max_samples && eighths >= 0 &&
                       eighths < passes_per_step && (eighths == 0 || count < samples_before_doubling) &&
                       samples_after(passes_until(count)).samples == count;
  if (!is_pass) in.fail();
  if (passes_until(count) + eighths > passes_until(most_samples_) + more_eighths_) {
    throw Error(ErrorCode::invalid_argument,
                fmt::format("the checkpoint is of {} passes, which is more than the {} that are asked for",
                            passes_until(count) + eighths, passes_until(most_samples_) + more_eighths_),
                "checkpoint");
  }
  count_ = count;
  eighths_ = eighths;
  in.get_all(std::span<std::uint32_t>(measures_.samples));
  in.get_all(std::span<float>(measures_.half_widths));
  for (FirstHit& hit : measures_.first_hits) {
    for (Vec3* v : {&hit.normal, &hit.color}) {
      for (int axis = 0; axis < 3; ++axis) (*v)[axis] = in.get<double>();
    }
  }
  for (Tile& tile : tiles_) restore_tile(tile, in);
  std::erase_if(active_, [&](std::size_t index) { return tiles_[index].places.empty(); });
}

}  // namespace crt::core
