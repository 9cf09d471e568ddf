#include "core/render/pixel.hpp"

#include <algorithm>

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

/// Places of the picture, and of the lens if there is one, that camera rays go through together.
struct RayPlaces {
  std::array<PicturePlace, packet_size> picture;
  std::array<LensPoint, packet_size> lens;
};

/// Traces rays by packets.
class PacketTracer {
 public:
  PacketTracer(const Frame& frame, Tracer& tracer, bool with_first_hits)
      : camera_(frame.camera()),
        with_lens_(frame.features().lens),
        with_first_hits_(with_first_hits),
        tracer_(tracer) {}

  struct Traced {
    std::span<const Tracer::Sample> samples;
    std::span<const FirstHit> first_hits;  ///< none if nobody asks for them
  };
  /// The first rays, so many.
  Traced trace(const RayPlaces& places, std::size_t count) {
    const std::size_t lens_points = with_lens_ ? count : 0;
    camera_.rays(std::span(places.picture).first(count), std::span(places.lens).first(lens_points), rays_);
    const std::span<Tracer::Sample> samples = std::span(samples_).first(count);
    const std::span<FirstHit> first_hits = std::span(first_hits_).first(with_first_hits_ ? count : 0);
    tracer_.trace(rays_, samples, first_hits);
    return {samples, first_hits};
  }

 private:
  const CameraRays& camera_;
  bool with_lens_;
  bool with_first_hits_;
  Tracer& tracer_;
  std::array<RayLanes, RayPacket::group_count> rays_;
  std::array<Tracer::Sample, packet_size> samples_;
  std::array<FirstHit, packet_size> first_hits_;
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

/// The rays of a grid through a tile: of one pixel after the other, for each of its subpixels those through
/// points of the lens.
class GridRays {
 public:
  /// By ray of a packet, its pixel's place in the tile.
  using Pixels = std::array<std::uint32_t, packet_size>;

  GridRays(const Frame& frame, const Region& region, int lens_points)
      : frame_(frame),
        region_(region),
        lens_points_(static_cast<std::uint32_t>(lens_points)),
        rays_per_pixel_(static_cast<std::uint32_t>(frame.subpixels().size()) * lens_points_) {}

  /// The next of them. Returns how many; at the end none.
  template <bool with_lens>
  std::size_t next(RayPlaces& places, Pixels& pixels) {
    std::size_t count = 0;
    for (; place_ < tile_places.size(); ++place_, ray_ = 0) {
      const TilePlace& place = tile_places[place_];
      if (place.x >= region_.width || place.y >= region_.height) continue;
      const int x = region_.x + place.x;
      const int y = region_.y + place.y;
      const auto pixel = static_cast<std::uint32_t>(place.y * region_.width + place.x);
      for (; ray_ < rays_per_pixel_; ++ray_, ++count) {
        if (count == packet_size) return count;
        const PicturePlace& subpixel = frame_.subpixels()[with_lens ? ray_ / lens_points_ : ray_];
        places.picture[count] = {x + subpixel.x, y + subpixel.y};
        if constexpr (with_lens) places.lens[count] = lens_point(x, y);
        pixels[count] = pixel;
      }
    }
    return count;
  }

 private:
  /// Of the next ray.
  LensPoint lens_point(int x, int y) {
    const std::size_t place = ray_ % lens_points_of_rays_.size();
    if (place == 0) {
      const auto [u, v] = random_pairs(frame_.settings().seed, {.x = static_cast<std::uint32_t>(x),
                                                                .y = static_cast<std::uint32_t>(y),
                                                                .sample = ray_,
                                                                .dimension = lens_dimension});
      lens_points_of_rays_ = frame_.camera().lens_points(u, v);
    }
    return lens_points_of_rays_[place];
  }

  const Frame& frame_;
  Region region_;
  std::uint32_t lens_points_;  ///< 1 without a lens
  std::uint32_t rays_per_pixel_;
  // Which comes next:
  std::size_t place_ = 0;
  std::uint32_t ray_ = 0;  ///< of its pixel
  /// Of this ray and the others of four.
  std::array<LensPoint, lane_count> lens_points_of_rays_;
};

/// A pixel's sum is that of its subpixels' sums over the lens, in their order.
class GridSums {
 public:
  /// Of first hits there may be no sums.
  GridSums(int lens_points, std::span<PixelMean> sums, std::span<FirstHit> first_hit_sums)
      : lens_points_(lens_points), sums_(sums), first_hit_sums_(first_hit_sums) {}

  void add(const PacketTracer::Traced& traced, const GridRays::Pixels& pixels) {
    for (std::size_t i = 0; i < traced.samples.size(); ++i) {
      const Tracer::Sample& sample = traced.samples[i];
      PixelMean& pixel = sums_[pixels[i]];
      PixelMean& sum = lens_points_ == 1 ? pixel : lens_sum_;
      sum.channels += channels_of(sample);
      sum.dropped += sample.dropped;
      if (lens_points_ == 1 || ++lens_point_ < lens_points_) continue;
      pixel.channels += lens_sum_.channels;
      pixel.dropped += lens_sum_.dropped;
      lens_sum_ = PixelMean{};
      lens_point_ = 0;
    }
    for (std::size_t i = 0; i < traced.first_hits.size(); ++i) {
      first_hit_sums_[pixels[i]].add(traced.first_hits[i]);
    }
  }

 private:
  int lens_points_;
  std::span<PixelMean> sums_;
  std::span<FirstHit> first_hit_sums_;
  PixelMean lens_sum_{};
  int lens_point_ = 0;
};

/// The rays of passes: of one pixel after the other the samples of a range.
class PassRays {
 public:
  PassRays(const Frame& frame, std::span<const PixelPlace> pixels, const SampleRange& range)
      : camera_(frame.camera()),
        filter_(frame.filter()),
        with_lens_(frame.features().lens),
        seed_(frame.settings().seed),
        begin_(static_cast<std::uint32_t>(range.begin)),
        end_(static_cast<std::uint32_t>(range.end)),
        pixels_(pixels),
        next_(end_) {}

  /// The next of them. Returns how many; at the end none.
  std::size_t next(RayPlaces& places) {
    constexpr std::size_t points_at_once = sequence_detail::points_at_once;
    std::size_t count = 0;
    while (count < packet_size) {
      if (next_ == end_) {
        if (pixels_.empty()) break;
        begin_pixel();
      }
      if (next_ % points_at_once == 0 && end_ - next_ >= points_at_once &&
          packet_size - count >= points_at_once) {
        sequence_.block(next_, with_lens_, block_);
        place(block_, places, count);
        next_ += points_at_once;
        count += points_at_once;
      } else {
        place(with_lens_ ? sequence_.point(next_) : sequence_.pixel_point(next_), places, count);
        ++next_;
        ++count;
      }
    }
    return count;
  }

 private:
  void begin_pixel() {
    const PixelPlace& pixel = pixels_.front();
    x_ = pixel.x;
    y_ = pixel.y;
    sequence_ = PixelSequence(seed_, pixel.x, pixel.y);
    pixels_ = pixels_.subspan(1);
    next_ = begin_;
  }

  void place(const PixelSequence::Block& block, RayPlaces& places, std::size_t ray) const {
    const auto& [pixel_u, pixel_v, lens_u, lens_v] = block.coordinates;
    for (std::size_t i = 0; i < pixel_u.size(); ++i) {
      places.picture[ray + i] = {x_ + filter_(pixel_u[i]), y_ + filter_(pixel_v[i])};
    }
    if (!with_lens_) return;
    const auto lanes_from = [](const auto& numbers, std::size_t i) {
      return Lanes{numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]};
    };
    for (std::size_t i = 0; i < lens_u.size(); i += lane_count) {
      const auto points = camera_.lens_points(lanes_from(lens_u, i), lanes_from(lens_v, i));
      std::copy(points.begin(), points.end(), &places.lens[ray + i]);
    }
  }

  void place(const SequencePoint& point, RayPlaces& places, std::size_t ray) const {
    places.picture[ray] = {x_ + filter_(point.pixel_u), y_ + filter_(point.pixel_v)};
    if (with_lens_) places.lens[ray] = camera_.lens_point(point.lens_u, point.lens_v);
  }

  const CameraRays& camera_;
  const FilterPlaces& filter_;
  bool with_lens_;
  std::uint64_t seed_;
  std::uint32_t begin_;
  std::uint32_t end_;
  std::span<const PixelPlace> pixels_;  ///< that come after this one
  double x_ = 0;
  double y_ = 0;
  PixelSequence sequence_{0, 0, 0};
  std::uint32_t next_;  ///< sample of the pixel
  PixelSequence::Block block_;
};

/// Hands on what samples of passes bring, step by step.
class PassSums {
 public:
  PassSums(std::span<const PixelPlace> pixels, const SampleRange& range)
      : pixel_(pixels.data()), range_(range) {}

  void add(const PacketTracer::Traced& traced) {
    StepSum step = step_;
    SeenSamples seen = seen_;
    for (std::size_t done = 0; done < traced.samples.size();) {
      if (count_ == range_.begin && step.count == 0) seen = SeenSamples(traced.samples[done].identity);
      const auto missing = static_cast<std::size_t>(step_size_ - step.count);
      const std::size_t count = std::min(traced.samples.size() - done, missing);
      for (const Tracer::Sample& sample : traced.samples.subspan(done, count)) {
        const Lanes channels = channels_of(sample);
        step.add(channels, sample.dropped);
        seen.add(channels, sample.identity);
      }
      if (!traced.first_hits.empty() && pixel_->first_hits != nullptr) {
        for (const FirstHit& hit : traced.first_hits.subspan(done, count)) pixel_->first_hits->add(hit);
      }
      done += count;
      if (step.count < step_size_) break;
      pixel_->samples->add_step(count_, step);
      step = {};
      count_ += step_size_;
      if (count_ == range_.end) {
        pixel_->samples->add_seen(seen, range_.begin == 0);
        ++pixel_;
        count_ = range_.begin;
      }
      step_size_ = samples_of_next_step(count_);
    }
    step_ = step;
    seen_ = seen;
  }

 private:
  const PixelPlace* pixel_;  ///< whose samples come next
  SampleRange range_;
  std::int64_t count_ = range_.begin;  ///< of its samples before this step
  std::int64_t step_size_ = samples_of_next_step(range_.begin);
  StepSum step_;      ///< what there is of it
  SeenSamples seen_;  ///< of this pixel
};

}  // namespace

void trace_pixels(const Frame& frame, const Region& region, Tracer& tracer, std::span<PixelMean> pixels,
                  std::span<FirstHit> first_hits, RenderStats& stats) {
  const bool lens = frame.features().lens;
  const int lens_points = lens ? frame.settings().dof_samples : 1;
  std::fill(pixels.begin(), pixels.end(), PixelMean{});
  PacketTracer packets(frame, tracer, !first_hits.empty());
  GridRays rays(frame, region, lens_points);
  GridSums sums(lens_points, pixels, first_hits);
  RayPlaces places;
  GridRays::Pixels of_pixels;
  const auto next = [&] {
    return lens ? rays.next<true>(places, of_pixels) : rays.next<false>(places, of_pixels);
  };
  while (const std::size_t count = next()) sums.add(packets.trace(places, count), of_pixels);

  const std::uint64_t samples_per_pixel = frame.subpixels().size() * static_cast<std::uint64_t>(lens_points);
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
  const bool with_first_hits = std::any_of(
      pixels.begin(), pixels.end(), [](const PixelPlace& pixel) { return pixel.first_hits != nullptr; });
  PacketTracer packets(frame, tracer, with_first_hits);
  PassRays rays(frame, pixels, range);
  PassSums sums(pixels, range);
  RayPlaces places;
  while (const std::size_t count = rays.next(places)) sums.add(packets.trace(places, count));
  if (frame.features().lens) {
    stats.lens_samples += pixels.size() * static_cast<std::uint64_t>(range.end - range.begin);
  }
}

}  // namespace crt::core
