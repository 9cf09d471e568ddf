#include "core/render/pixel.hpp"

#include <algorithm>

#include "core/math/random.hpp"
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

/// Traces rays that belong to pixels, and adds what the i-th of them meets first to *sum_of(i), if that is
/// there.
template <class SumOf>
void trace_with_first_hits(Tracer& tracer, std::span<const CameraRay> rays, std::span<Tracer::Sample> samples,
                           const SumOf& sum_of) {
  std::array<FirstHit, packet_size> first_hits;
  tracer.trace(rays, samples, std::span(first_hits).first(rays.size()));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (FirstHit* const sum = sum_of(i)) sum->add(first_hits[i]);
  }
}

/// Gathers camera rays until a packet is full. A pixel's sum is that of its subpixels' sums over the lens, in
/// their order.
class SampleSums {
 public:
  /// The sums of first hits belong to the pixels from `first_pixel` on; there may be none.
  SampleSums(Tracer& tracer, int lens_points, const Tracer::Sample* first_pixel,
             std::span<FirstHit> first_hit_sums)
      : tracer_(tracer),
        lens_points_(lens_points),
        first_pixel_(first_pixel),
        first_hit_sums_(first_hit_sums) {}

  /// Where the next ray is to go, and then that it is there.
  CameraRay& next() { return rays_[count_]; }
  void take(Tracer::Sample& pixel) {
    pixels_[count_] = &pixel;
    if (++count_ == packet_size) trace();
  }

  void trace() {
    const std::span<const CameraRay> rays = std::span(rays_).first(count_);
    if (first_hit_sums_.empty()) {
      tracer_.trace(rays, samples_);
    } else {
      trace_with_first_hits(tracer_, rays, samples_,
                            [&](std::size_t i) { return &first_hit_sums_[index_of(*pixels_[i])]; });
    }
    for (std::size_t i = 0; i < count_; ++i) {
      add(lens_sum_, samples_[i]);
      if (++lens_point_ < lens_points_) continue;
      add(*pixels_[i], lens_sum_);
      lens_sum_ = {.alpha = 0};
      lens_point_ = 0;
    }
    count_ = 0;
  }

 private:
  std::size_t index_of(const Tracer::Sample& pixel) const {
    return static_cast<std::size_t>(&pixel - first_pixel_);
  }

  Tracer& tracer_;
  int lens_points_;
  const Tracer::Sample* first_pixel_;
  std::span<FirstHit> first_hit_sums_;
  std::size_t count_ = 0;
  std::array<CameraRay, packet_size> rays_;
  std::array<Tracer::Sample*, packet_size> pixels_{};
  std::array<Tracer::Sample, packet_size> samples_;
  Tracer::Sample lens_sum_{.alpha = 0};
  int lens_point_ = 0;
};

/// Gathers the rays of passes, pixel by pixel and step by step, and hands on each step of a pixel as a whole.
class StepSums {
 public:
  StepSums(Tracer& tracer, bool with_first_hits) : tracer_(tracer), with_first_hits_(with_first_hits) {}

  /// Where the next ray is to go, and then that it is there: of a pixel that has `count` samples before the
  /// step and gets `size` more in it.
  CameraRay& next() { return rays_[taken_]; }
  void take(const PixelPlace& pixel, std::int64_t count, std::int64_t size) {
    places_[taken_] = {&pixel, count, size};
    if (++taken_ == packet_size) trace();
  }

  void trace() {
    const std::span<const CameraRay> rays = std::span(rays_).first(taken_);
    if (with_first_hits_) {
      trace_with_first_hits(tracer_, rays, samples_,
                            [&](std::size_t i) { return places_[i].pixel->first_hits; });
    } else {
      tracer_.trace(rays, samples_);
    }
    for (std::size_t i = 0; i < taken_; ++i) {
      const Tracer::Sample& sample = samples_[i];
      sum_.add(Lanes{sample.color.x, sample.color.y, sample.color.z, sample.alpha}, sample.identity,
               sample.dropped);
      const Place& place = places_[i];
      if (sum_.count < place.size) continue;
      place.pixel->samples->add_step(place.count, sum_);
      sum_ = {};
    }
    taken_ = 0;
  }

 private:
  struct Place {
    const PixelPlace* pixel = nullptr;
    std::int64_t count = 0;
    std::int64_t size = 0;
  };

  Tracer& tracer_;
  bool with_first_hits_;
  std::size_t taken_ = 0;
  std::array<CameraRay, packet_size> rays_;
  std::array<Place, packet_size> places_;
  std::array<Tracer::Sample, packet_size> samples_;
  SampleSum sum_;
};

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
      const double place_x = x + frame.filter()((column + 0.5) / grid);
      const double place_y = y + frame.filter()((row + 0.5) / grid);
      if (!frame.features().lens) {
        camera.ray(place_x, place_y, sums.next());
        sums.take(pixel);
        continue;
      }
      for (int i = 0; i < lens_points; ++i, ++use.sample) {
        const auto [u, v] = random_pair(frame.settings().seed, use);
        camera.ray(place_x, place_y, camera.lens_point(u, v), sums.next());
        sums.take(pixel);
      }
    }
  }
}

}  // namespace

void trace_pixels(const Frame& frame, const Region& region, Tracer& tracer, std::span<Tracer::Sample> pixels,
                  std::span<FirstHit> first_hits, RenderStats& stats) {
  const bool lens = frame.features().lens;
  const int lens_points = lens ? frame.settings().dof_samples : 1;
  SampleSums sums(tracer, lens_points, pixels.data(), first_hits);
  auto pixel = pixels.begin();
  for (int y = region.y; y < region.y + region.height; ++y) {
    for (int x = region.x; x < region.x + region.width; ++x, ++pixel) {
      *pixel = {.alpha = 0};
      take_pixel(frame, x, y, lens_points, sums, *pixel);
    }
  }
  sums.trace();

  const int grid = frame.settings().supersampling;
  const auto pixel_count = static_cast<std::uint64_t>(pixel - pixels.begin());
  const double samples_per_pixel = static_cast<double>(grid) * grid * lens_points;
  for (Tracer::Sample& done : pixels.first(pixel_count)) {
    done = {done.color / samples_per_pixel, done.alpha / samples_per_pixel, done.dropped / samples_per_pixel};
  }
  for (FirstHit& hit : first_hits) hit.divide(std::int64_t{grid} * grid * lens_points);
  stats.pixels += pixel_count;
  if (lens) stats.lens_samples += pixel_count * static_cast<std::uint64_t>(samples_per_pixel);
}

void trace_passes(const Frame& frame, std::span<const PixelPlace> pixels, const SampleRange& range,
                  Tracer& tracer, RenderStats& stats) {
  const CameraRays& camera = frame.camera();
  const FilterPlaces& filter = frame.filter();
  const bool lens = frame.features().lens;
  const bool with_first_hits = std::any_of(
      pixels.begin(), pixels.end(), [](const PixelPlace& pixel) { return pixel.first_hits != nullptr; });
  StepSums sums(tracer, with_first_hits);
  for (const PixelPlace& pixel : pixels) {
    const PixelSequence sequence(frame.settings().seed, pixel.x, pixel.y);
    SequenceWalk walk(sequence, static_cast<std::uint32_t>(range.begin),
                      static_cast<std::uint32_t>(range.end), lens);
    std::int64_t size = 0;
    for (std::int64_t count = range.begin; count < range.end; count += size) {
      size = samples_of_next_step(count);
      for (std::int64_t i = count; i < count + size; ++i) {
        const SequencePoint& point = walk.next();
        const double x = pixel.x + filter(point.pixel_u);
        const double y = pixel.y + filter(point.pixel_v);
        if (lens) {
          camera.ray(x, y, camera.lens_point(point.lens_u, point.lens_v), sums.next());
        } else {
          camera.ray(x, y, sums.next());
        }
        sums.take(pixel, count, size);
      }
    }
  }
  sums.trace();
  if (lens) stats.lens_samples += pixels.size() * static_cast<std::uint64_t>(range.end - range.begin);
}

}  // namespace crt::core
