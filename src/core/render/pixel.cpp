#include "core/render/pixel.hpp"

#include "core/math/random.hpp"

namespace crt::core {

namespace {

/// What random numbers are drawn for.
constexpr std::uint32_t lens_dimension = 0;

void add(Tracer::Sample& sum, const Tracer::Sample& sample) {
  sum.color += sample.color;
  sum.alpha += sample.alpha;
}

/// Gathers camera rays until a packet is full. A pixel's sum is that of its subpixels' sums over the lens, in
/// their order.
class SampleSums {
 public:
  SampleSums(Tracer& tracer, int lens_points) : tracer_(tracer), lens_points_(lens_points) {}

  /// Where the next ray is to go, and then that it is there.
  CameraRay& next() { return rays_[count_]; }
  void take(Tracer::Sample& pixel) {
    pixels_[count_] = &pixel;
    if (++count_ == packet_size) trace();
  }

  void trace() {
    tracer_.trace(std::span(rays_.data(), count_), samples_);
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
  Tracer& tracer_;
  int lens_points_;
  std::size_t count_ = 0;
  std::array<CameraRay, packet_size> rays_;
  std::array<Tracer::Sample*, packet_size> pixels_{};
  std::array<Tracer::Sample, packet_size> samples_;
  Tracer::Sample lens_sum_{.alpha = 0};
  int lens_point_ = 0;
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
      const double place_x = x + (column + 0.5) / grid;
      const double place_y = y + (row + 0.5) / grid;
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
                  RenderStats& stats) {
  const bool lens = frame.features().lens;
  const int lens_points = lens ? frame.settings().dof_samples : 1;
  SampleSums sums(tracer, lens_points);
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
    done = {done.color / samples_per_pixel, done.alpha / samples_per_pixel};
  }
  stats.pixels += pixel_count;
  if (lens) stats.lens_samples += pixel_count * static_cast<std::uint64_t>(samples_per_pixel);
}

}  // namespace crt::core
