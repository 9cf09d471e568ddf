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

void add(Tracer::Sample& sum, const Tracer::Sample& sample) {
  sum.color += sample.color;
  sum.alpha += sample.alpha;
  sum.dropped += sample.dropped;
}

/// Camera rays that are gathered until there are enough of them to be traced together.
class GatheredRays {
 public:
  GatheredRays(const Frame& frame, Tracer& tracer)
      : camera_(frame.camera()), with_lens_(frame.features().lens), tracer_(tracer) {}

  std::size_t count() const { return count_; }
  bool is_full() const { return count_ == packet_size; }

  /// One more, through a place of the picture and, if there is a lens, through a point of that.
  void add(const PicturePlace& place, const LensPoint& lens_point) {
    places_[count_] = place;
    lens_points_[count_] = lens_point;
    ++count_;
  }

  /// Traces and forgets them. What the i-th of them meets first is added to *first_hits_of(i), if that is
  /// there; none of them is asked for if nobody is interested.
  template <class FirstHitsOf>
  std::span<const Tracer::Sample> trace(bool with_first_hits, const FirstHitsOf& first_hits_of) {
    const std::size_t count = std::exchange(count_, 0);
    const std::span<CameraRay> rays = std::span(rays_).first(count);
    const std::size_t lens_points = with_lens_ ? count : 0;
    camera_.rays(std::span(places_).first(count), std::span(lens_points_).first(lens_points), rays);
    if (with_first_hits) {
      std::array<FirstHit, packet_size> first_hits;
      tracer_.trace(rays, samples_, std::span(first_hits).first(count));
      for (std::size_t i = 0; i < count; ++i) {
        if (FirstHit* const sum = first_hits_of(i)) sum->add(first_hits[i]);
      }
    } else {
      tracer_.trace(rays, samples_);
    }
    return std::span(samples_).first(count);
  }

 private:
  const CameraRays& camera_;
  bool with_lens_;
  Tracer& tracer_;
  std::size_t count_ = 0;
  std::array<PicturePlace, packet_size> places_;
  std::array<LensPoint, packet_size> lens_points_;
  std::array<CameraRay, packet_size> rays_;
  std::array<Tracer::Sample, packet_size> samples_;
};

/// The rays of a grid. A pixel's sum is that of its subpixels' sums over the lens, in their order.
class SampleSums {
 public:
  /// The sums of first hits belong to the pixels from `first_pixel` on; there may be none.
  SampleSums(const Frame& frame, Tracer& tracer, int lens_points, const Tracer::Sample* first_pixel,
             std::span<FirstHit> first_hit_sums)
      : rays_(frame, tracer),
        lens_points_(lens_points),
        first_pixel_(first_pixel),
        first_hit_sums_(first_hit_sums) {}

  void take(const PicturePlace& place, const LensPoint& lens_point, Tracer::Sample& pixel) {
    pixels_[rays_.count()] = &pixel;
    rays_.add(place, lens_point);
    if (rays_.is_full()) trace();
  }

  void trace() {
    const std::span<const Tracer::Sample> samples = rays_.trace(
        !first_hit_sums_.empty(), [&](std::size_t i) { return &first_hit_sums_[index_of(*pixels_[i])]; });
    for (std::size_t i = 0; i < samples.size(); ++i) {
      add(lens_sum_, samples[i]);
      if (++lens_point_ < lens_points_) continue;
      add(*pixels_[i], lens_sum_);
      lens_sum_ = {.alpha = 0};
      lens_point_ = 0;
    }
  }

 private:
  std::size_t index_of(const Tracer::Sample& pixel) const {
    return static_cast<std::size_t>(&pixel - first_pixel_);
  }

  GatheredRays rays_;
  int lens_points_;
  const Tracer::Sample* first_pixel_;
  std::span<FirstHit> first_hit_sums_;
  std::array<Tracer::Sample*, packet_size> pixels_{};
  Tracer::Sample lens_sum_{.alpha = 0};
  int lens_point_ = 0;
};

/// The rays of passes, pixel by pixel and step by step. Each step of a pixel is handed on as a whole.
class StepSums {
 public:
  StepSums(const Frame& frame, Tracer& tracer, bool with_first_hits)
      : rays_(frame, tracer), with_first_hits_(with_first_hits) {}

  /// Of a pixel that has `count` samples before the step and gets `size` more in it.
  void take(const PicturePlace& place, const LensPoint& lens_point, const PixelPlace& pixel,
            std::int64_t count, std::int64_t size) {
    steps_[rays_.count()] = {&pixel, count, size};
    rays_.add(place, lens_point);
    if (rays_.is_full()) trace();
  }

  void trace() {
    const std::span<const Tracer::Sample> samples =
        rays_.trace(with_first_hits_, [&](std::size_t i) { return steps_[i].pixel->first_hits; });
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Tracer::Sample& sample = samples[i];
      sum_.add(Lanes{sample.color.x, sample.color.y, sample.color.z, sample.alpha}, sample.identity,
               sample.dropped);
      const StepOfPixel& step = steps_[i];
      if (sum_.count < step.size) continue;
      step.pixel->samples->add_step(step.count, sum_);
      sum_.count = 0;
    }
  }

 private:
  struct StepOfPixel {
    const PixelPlace* pixel = nullptr;
    std::int64_t count = 0;
    std::int64_t size = 0;
  };

  GatheredRays rays_;
  bool with_first_hits_;
  std::array<StepOfPixel, packet_size> steps_;
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

/// Takes the rays through one pixel.
void take_pixel(const Frame& frame, int x, int y, int lens_points, SampleSums& sums, Tracer::Sample& pixel) {
  const CameraRays& camera = frame.camera();
  const int grid = frame.settings().supersampling;
  RandomUse use = {.x = static_cast<std::uint32_t>(x),
                   .y = static_cast<std::uint32_t>(y),
                   .sample = 0,
                   .dimension = lens_dimension};
  for (int row = 0; row < grid; ++row) {
    for (int column = 0; column < grid; ++column) {
      const PicturePlace place = {x + frame.filter()((column + 0.5) / grid),
                                  y + frame.filter()((row + 0.5) / grid)};
      if (!frame.features().lens) {
        sums.take(place, {}, pixel);
        continue;
      }
      for (int i = 0; i < lens_points; ++i, ++use.sample) {
        const auto [u, v] = random_pair(frame.settings().seed, use);
        sums.take(place, camera.lens_point(u, v), pixel);
      }
    }
  }
}

}  // namespace

void trace_pixels(const Frame& frame, const Region& region, Tracer& tracer, std::span<Tracer::Sample> pixels,
                  std::span<FirstHit> first_hits, RenderStats& stats) {
  const bool lens = frame.features().lens;
  const int lens_points = lens ? frame.settings().dof_samples : 1;
  SampleSums sums(frame, tracer, lens_points, pixels.data(), first_hits);
  for (const TilePlace& place : tile_places) {
    if (place.x >= region.width || place.y >= region.height) continue;
    const int x = region.x + place.x;
    const int y = region.y + place.y;
    Tracer::Sample& pixel = pixels[index_in(region, x, y)];
    pixel = {.alpha = 0};
    take_pixel(frame, x, y, lens_points, sums, pixel);
  }
  sums.trace();

  const int grid = frame.settings().supersampling;
  const double samples_per_pixel = static_cast<double>(grid) * grid * lens_points;
  for (Tracer::Sample& done : pixels.first(pixel_count(region))) {
    done = {done.color / samples_per_pixel, done.alpha / samples_per_pixel, done.dropped / samples_per_pixel};
  }
  for (FirstHit& hit : first_hits) hit.divide(std::int64_t{grid} * grid * lens_points);
  stats.pixels += pixel_count(region);
  if (lens) stats.lens_samples += pixel_count(region) * static_cast<std::uint64_t>(samples_per_pixel);
}

void trace_passes(const Frame& frame, std::span<const PixelPlace> pixels, const SampleRange& range,
                  Tracer& tracer, RenderStats& stats) {
  const CameraRays& camera = frame.camera();
  const FilterPlaces& filter = frame.filter();
  const bool lens = frame.features().lens;
  const bool with_first_hits = std::any_of(
      pixels.begin(), pixels.end(), [](const PixelPlace& pixel) { return pixel.first_hits != nullptr; });
  StepSums sums(frame, tracer, with_first_hits);
  for (const PixelPlace& pixel : pixels) {
    const PixelSequence sequence(frame.settings().seed, pixel.x, pixel.y);
    SequenceWalk walk(sequence, static_cast<std::uint32_t>(range.begin),
                      static_cast<std::uint32_t>(range.end), lens);
    std::int64_t size = 0;
    for (std::int64_t count = range.begin; count < range.end; count += size) {
      size = samples_of_next_step(count);
      for (std::int64_t i = count; i < count + size; ++i) {
        const SequencePoint point = walk.next();
        const PicturePlace place = {pixel.x + filter(point.pixel_u), pixel.y + filter(point.pixel_v)};
        const LensPoint on_lens = lens ? camera.lens_point(point.lens_u, point.lens_v) : LensPoint{};
        sums.take(place, on_lens, pixel, count, size);
      }
    }
  }
  sums.trace();
  if (lens) stats.lens_samples += pixels.size() * static_cast<std::uint64_t>(range.end - range.begin);
}

}  // namespace crt::core
