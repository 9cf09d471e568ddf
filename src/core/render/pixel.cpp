#include "core/render/pixel.hpp"

#include <algorithm>
#include <utility>

#include "core/math/random.hpp"
#include "core/render/tiles.hpp"
#include "core/sampling/schedule.hpp"
#include "core/sampling/sequence.hpp"

namespace crt::core {

namespace {

/// What random numbers are drawn for.
constexpr std::uint32_t lens_dimension = 0;

/// As PixelSamples and PixelMean have them.
Lanes channels_of(const Tracer::Sample& sample) {
  return Lanes{sample.color.x, sample.color.y, sample.color.z, sample.alpha};
}

void add(const PixelMean& sample, PixelMean& sum) {
  sum.channels += sample.channels;
  sum.dropped += sample.dropped;
}
void add(const Tracer::Sample& sample, PixelMean& sum) {
  add({channels_of(sample), sample.dropped}, sum);
}

/// Camera rays that are gathered until there are enough of them to be traced together.
class GatheredRays {
 public:
  GatheredRays(const Frame& frame, Tracer& tracer, bool with_first_hits)
      : camera_(frame.camera()),
        with_lens_(frame.features().lens),
        with_first_hits_(with_first_hits),
        tracer_(tracer) {}

  std::size_t count() const { return count_; }
  bool is_full() const { return count_ == packet_size; }

  /// One more, through a place of the picture and, if there is a lens, through a point of that.
  void add(const PicturePlace& place, const LensPoint& lens_point) {
    places_[count_] = place;
    if (with_lens_) lens_points_[count_] = lens_point;
    ++count_;
  }

  struct Traced {
    std::span<const Tracer::Sample> samples;
    std::span<const FirstHit> first_hits;  ///< none if nobody asks for them
  };
  /// Traces and forgets them.
  Traced trace() {
    const std::size_t count = std::exchange(count_, 0);
    const std::span<CameraRay> rays = std::span(rays_).first(count);
    const std::size_t lens_points = with_lens_ ? count : 0;
    camera_.rays(std::span(places_).first(count), std::span(lens_points_).first(lens_points), rays);
    const std::span<FirstHit> first_hits = std::span(first_hits_).first(with_first_hits_ ? count : 0);
    tracer_.trace(rays, samples_, first_hits);
    return {std::span(samples_).first(count), first_hits};
  }

 private:
  const CameraRays& camera_;
  bool with_lens_;
  bool with_first_hits_;
  Tracer& tracer_;
  std::size_t count_ = 0;
  std::array<PicturePlace, packet_size> places_;
  std::array<LensPoint, packet_size> lens_points_;
  std::array<CameraRay, packet_size> rays_;
  std::array<Tracer::Sample, packet_size> samples_;
  std::array<FirstHit, packet_size> first_hits_;
};

/// The rays of a grid. A pixel's sum is that of its subpixels' sums over the lens, in their order.
class GridSums {
 public:
  /// Of first hits there may be no sums.
  GridSums(const Frame& frame, Tracer& tracer, int lens_points, std::span<PixelMean> sums,
           std::span<FirstHit> first_hit_sums)
      : rays_(frame, tracer, !first_hit_sums.empty()),
        lens_points_(lens_points),
        sums_(sums),
        first_hit_sums_(first_hit_sums) {}

  void take(const PicturePlace& place, const LensPoint& lens_point, std::size_t pixel) {
    pixels_[rays_.count()] = pixel;
    rays_.add(place, lens_point);
    if (rays_.is_full()) trace();
  }

  void trace() {
    const auto [samples, first_hits] = rays_.trace();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      PixelMean& pixel = sums_[pixels_[i]];
      if (lens_points_ == 1) {
        add(samples[i], pixel);
        continue;
      }
      add(samples[i], lens_sum_);
      if (++lens_point_ < lens_points_) continue;
      add(lens_sum_, pixel);
      lens_sum_ = PixelMean{};
      lens_point_ = 0;
    }
    for (std::size_t i = 0; i < first_hits.size(); ++i) first_hit_sums_[pixels_[i]].add(first_hits[i]);
  }

 private:
  GatheredRays rays_;
  int lens_points_;
  std::span<PixelMean> sums_;
  std::span<FirstHit> first_hit_sums_;
  std::array<std::size_t, packet_size> pixels_{};
  PixelMean lens_sum_{};
  int lens_point_ = 0;
};

/// The rays of passes: of one pixel after the other the samples of a range. Each step of a pixel is handed on
/// as a whole.
class StepSums {
 public:
  StepSums(const Frame& frame, Tracer& tracer, std::span<const PixelPlace> pixels, const SampleRange& range,
           bool with_first_hits)
      : rays_(frame, tracer, with_first_hits), pixel_(pixels.data()), range_(range) {}

  void take(const PicturePlace& place, const LensPoint& lens_point) {
    rays_.add(place, lens_point);
    if (rays_.is_full()) trace();
  }

  void trace() {
    const auto [samples, first_hits] = rays_.trace();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Tracer::Sample& sample = samples[i];
      if (!first_hits.empty() && pixel_->first_hits != nullptr) pixel_->first_hits->add(first_hits[i]);
      sum_.add(channels_of(sample), sample.identity, sample.dropped);
      if (sum_.count == size_) end_step();
    }
  }

 private:
  void end_step() {
    pixel_->samples->add_step(count_, sum_);
    sum_.count = 0;
    count_ += size_;
    if (count_ == range_.end) {
      ++pixel_;
      count_ = range_.begin;
    }
    size_ = samples_of_next_step(count_);
  }

  GatheredRays rays_;
  const PixelPlace* pixel_;  ///< whose samples come next
  SampleRange range_;
  std::int64_t count_ = range_.begin;                       ///< of its samples before this step
  std::int64_t size_ = samples_of_next_step(range_.begin);  ///< of the step
  SampleSum sum_;
};

/// The places of a tile along Morton's curve, which goes through a square quarter by quarter: packets of
/// rays through pixels that follow each other keep together.
struct TilePlace {
  int x = 0;
  int y = 0;
};
constexpr auto tile_places = [] {
  std::array<TilePlace, std::size_t{Tiles::side} * Tiles::side> places;
  for (unsigned i = 0; i < places.size(); ++i) {
    for (unsigned bit = 0; i >> 2 * bit != 0; ++bit) {
      places[i].x |= static_cast<int>((i >> 2 * bit & 1u) << bit);
      places[i].y |= static_cast<int>((i >> (2 * bit + 1) & 1u) << bit);
    }
  }
  return places;
}();

/// Takes the rays through one pixel and points of the lens.
void take_pixel_with_lens(const Frame& frame, int x, int y, std::size_t pixel, GridSums& sums) {
  RandomUse use = {.x = static_cast<std::uint32_t>(x),
                   .y = static_cast<std::uint32_t>(y),
                   .sample = 0,
                   .dimension = lens_dimension};
  for (const PicturePlace& subpixel : frame.subpixels()) {
    for (int i = 0; i < frame.settings().dof_samples; ++i, ++use.sample) {
      const auto [u, v] = random_pair(frame.settings().seed, use);
      sums.take({x + subpixel.x, y + subpixel.y}, frame.camera().lens_point(u, v), pixel);
    }
  }
}

}  // namespace

void trace_pixels(const Frame& frame, const Region& region, Tracer& tracer, std::span<PixelMean> pixels,
                  std::span<FirstHit> first_hits, RenderStats& stats) {
  const bool lens = frame.features().lens;
  const int lens_points = lens ? frame.settings().dof_samples : 1;
  const std::span<const PicturePlace> subpixels = frame.subpixels();
  std::fill(pixels.begin(), pixels.end(), PixelMean{});
  GridSums sums(frame, tracer, lens_points, pixels, first_hits);
  for (const TilePlace& place : tile_places) {
    if (place.x >= region.width || place.y >= region.height) continue;
    const int x = region.x + place.x;
    const int y = region.y + place.y;
    const std::size_t pixel = index_in(region, x, y);
    if (lens) {
      take_pixel_with_lens(frame, x, y, pixel, sums);
      continue;
    }
    for (const PicturePlace& subpixel : subpixels) sums.take({x + subpixel.x, y + subpixel.y}, {}, pixel);
  }
  sums.trace();

  const std::uint64_t samples_per_pixel = subpixels.size() * static_cast<std::uint64_t>(lens_points);
  if (samples_per_pixel > 1) {
    const auto divisor = static_cast<double>(samples_per_pixel);
    for (PixelMean& pixel : pixels) pixel = {pixel.channels / divisor, pixel.dropped / divisor};
    for (FirstHit& hit : first_hits) hit.divide(static_cast<std::int64_t>(samples_per_pixel));
  }
  stats.pixels += pixels.size();
  if (lens) stats.lens_samples += pixels.size() * samples_per_pixel;
}

void trace_passes(const Frame& frame, std::span<const PixelPlace> pixels, const SampleRange& range,
                  Tracer& tracer, RenderStats& stats) {
  const CameraRays& camera = frame.camera();
  const FilterPlaces& filter = frame.filter();
  const bool lens = frame.features().lens;
  const bool with_first_hits = std::any_of(
      pixels.begin(), pixels.end(), [](const PixelPlace& pixel) { return pixel.first_hits != nullptr; });
  StepSums sums(frame, tracer, pixels, range, with_first_hits);
  for (const PixelPlace& pixel : pixels) {
    const PixelSequence sequence(frame.settings().seed, pixel.x, pixel.y);
    for_each_point(
        sequence, static_cast<std::uint32_t>(range.begin), static_cast<std::uint32_t>(range.end), lens,
        [&](const SequencePoint& point) {
          const PicturePlace place = {pixel.x + filter(point.pixel_u), pixel.y + filter(point.pixel_v)};
          sums.take(place, lens ? camera.lens_point(point.lens_u, point.lens_v) : LensPoint{});
        });
  }
  sums.trace();
  if (lens) stats.lens_samples += pixels.size() * static_cast<std::uint64_t>(range.end - range.begin);
}

}  // namespace crt::core
