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

/// The region and the pixels around it that are in the picture.
Region with_margin(const Region& region, int margin, const Settings& settings) {
  const int left = std::max(region.x - margin, 0);
  const int top = std::max(region.y - margin, 0);
  const int right = std::min(region.x + region.width + margin, settings.width);
  const int bottom = std::min(region.y + region.height + margin, settings.height);
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
      worked_on_(with_margin(region, reach_, frame.settings())),
      grid_(worked_on_),
      most_samples_(frame.settings().max_samples),
      by_clock_(most_passes == 0 && clock.has_budget()),
      clock_(clock),
      canvas_(canvas),
      scale_(frame.settings().gamma),
      target_(frame.settings().target_error > 0 ? frame.settings().target_error : finest_error) {
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
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    Tile& tile = tiles_[i];
    tile.region = grid_.tile(i);
    tile.samples.resize(pixel_count(tile.region));
    tile.places.resize(tile.samples.size());
    for (std::size_t k = 0; k < tile.places.size(); ++k) tile.places[k] = static_cast<std::uint8_t>(k);
    active_[i] = i;
  }
  expect_small_things();
}

void Passes::expect_small_things() {
  const std::vector<bool> pixels = small_things(frame_, worked_on_);
  if (pixels.empty()) return;
  for (Tile& tile : tiles_) {
    for (std::size_t i = 0; i < tile.places.size(); ++i) {
      const Place place = place_of(tile, i);
      if (pixels[index_in(worked_on_, place.x, place.y)]) tile.samples[i].expect_small_things();
    }
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
    Tile& tile = tiles_[active_[index]];
    for (std::size_t i = 0; i < tile.places.size(); ++i) {
      const Place place = place_of(tile, i);
      if (is_in_region(place)) take_notes(place, tile.samples[i]);
    }
  });
}

void Passes::take_notes(const Place& place, PixelSamples& samples) const {
  const int right = std::min(place.x + reach_, worked_on_.x + worked_on_.width - 1);
  const int bottom = std::min(place.y + reach_, worked_on_.y + worked_on_.height - 1);
  PixelSamples::Notes notes(samples);
  for (int y = std::max(place.y - reach_, worked_on_.y); y <= bottom; ++y) {
    for (int x = std::max(place.x - reach_, worked_on_.x); x <= right; ++x) {
      const Tile& tile = tiles_[grid_.index(x, y)];
      notes.take(tile.samples[index_in(tile.region, x, y)]);
    }
  }
  samples.keep(notes);
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
  tile.samples.resize(kept);
  tile.samples.shrink_to_fit();
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
  tile.samples.resize(count);
  tile.samples.shrink_to_fit();
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
