// A checkpoint keeps what is known of a picture between its passes.
#include <algorithm>
#include <functional>
#include <memory>

#include "core/render/passes.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

void Passes::store_tile(const Tile& tile, StateWriter& out) const {
  out.put(static_cast<std::uint8_t>(tile.is_ahead));
  out.put(static_cast<std::uint16_t>(tile.places.size()));
  out.put_all(std::span<const std::uint8_t>(tile.places));
  if (!has_samples(tile)) return;
  for (const PixelSamples& samples : tile.samples)
    out.put_all(std::span<const std::byte>(samples.stored()));
}

void Passes::restore_tile(Tile& tile, StateReader& in) {
  tile.is_ahead = in.get<std::uint8_t>() != 0;
  const std::size_t count = in.get<std::uint16_t>();
  // No pixel is left out before all have exchanged their statistics.
  if (count > pixel_count(tile.region) ||
      (!has_exchanged_statistics_ && count < pixel_count(tile.region)))
    in.fail();
  tile.places.resize(count);
  in.get_all(std::span<std::uint8_t>(tile.places));
  // Each pixel must be there once, in its order, and in the tile.
  const bool in_order = std::adjacent_find(tile.places.begin(), tile.places.end(),
                                           std::greater_equal<>()) == tile.places.end();
  if (!in_order) in.fail();
  for (std::size_t i = 0; i < count; ++i) {
    const Place place = place_of(tile, i);
    if (!is_in(tile.region, place.x, place.y)) in.fail();
  }
  if (!has_samples(tile)) return;
  tile.samples = store_.take(count);
  PixelSamples::Stored bytes;
  for (PixelSamples& samples : tile.samples) {
    in.get_all(std::span<std::byte>(bytes));
    std::construct_at(&samples, PixelSamples::restored(bytes));
  }
}

void Passes::store(StateWriter& out) const {
  out.put(count_);
  out.put(eighths_);
  out.put(static_cast<std::uint8_t>(has_exchanged_statistics_));
  out.put_all(std::span<const std::uint32_t>(measures_.samples));
  out.put_all(std::span<const float>(measures_.half_widths));
  for (const FirstHit& hit : measures_.first_hits) {
    for (const Vec3& v : {hit.normal, hit.color}) {
      for (int axis = 0; axis < 3; ++axis) out.put(v[axis]);
    }
    out.put(hit.cover);
    out.put(hit.nearness);
  }
  for (const Tile& tile : tiles_) store_tile(tile, out);
}

void Passes::restore(StateReader& in) {
  const auto count = in.get<std::int64_t>();
  const int eighths = in.get<int>();
  const bool is_begun = count >= 1 && count <= frame_.settings().max_samples && eighths >= 0 &&
                        eighths < passes_per_step &&
                        (eighths == 0 || count < samples_before_doubling) &&
                        samples_after(passes_until(count)).samples == count;
  if (!is_begun && !(count == 0 && eighths == 0)) in.fail();
  count_ = count;
  eighths_ = eighths;
  has_exchanged_statistics_ = in.get<std::uint8_t>() != 0;
  const int at = frame_.settings().min_samples;
  if (has_exchanged_statistics_ ? count < at : count > at) in.fail();
  in.get_all(std::span<std::uint32_t>(measures_.samples));
  in.get_all(std::span<float>(measures_.half_widths));
  for (FirstHit& hit : measures_.first_hits) {
    for (Vec3* v : {&hit.normal, &hit.color}) {
      for (int axis = 0; axis < 3; ++axis) (*v)[axis] = in.get<double>();
    }
    hit.cover = in.get<double>();
    hit.nearness = in.get<double>();
  }
  for (Tile& tile : tiles_) restore_tile(tile, in);
  std::erase_if(active_, [&](std::size_t index) { return tiles_[index].places.empty(); });
  const int most = passes_until(max_samples_) + more_eighths_;
  if (passes() > most || (passes() == most && is_within_step())) {
    throw Error(
        ErrorCode::invalid_argument,
        text::format(
            "the checkpoint is of {} passes{}, which is more than the {} that are asked for",
            passes(), is_within_step() ? " and a part of the next" : "", most),
        "checkpoint");
  }
}

}  // namespace crt::core
