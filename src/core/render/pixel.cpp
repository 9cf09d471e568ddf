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

/// The sum over the lens for the place (place_x, place_y) of the picture.
Tracer::Sample trace_lens(const Frame& frame, const RandomUse& first_use, double place_x, double place_y,
                          Tracer& tracer) {
  const Settings& settings = frame.settings();
  Tracer::Sample sum{.alpha = 0};
  for (int i = 0; i < settings.dof_samples; ++i) {
    RandomUse use = first_use;
    use.sample += static_cast<std::uint32_t>(i);
    const auto [u, v] = random_pair(settings.seed, use);
    add(sum, tracer.trace(frame.camera().ray(place_x, place_y, frame.camera().lens_point(u, v))));
  }
  return sum;
}

}  // namespace

Tracer::Sample trace_pixel(const Frame& frame, int x, int y, Tracer& tracer, RenderStats& stats) {
  const int grid = frame.settings().supersampling;
  const bool lens = frame.features().lens;
  const int lens_points = lens ? frame.settings().dof_samples : 1;
  Tracer::Sample sum{.alpha = 0};
  for (int row = 0; row < grid; ++row) {
    for (int column = 0; column < grid; ++column) {
      const double place_x = x + (column + 0.5) / grid;
      const double place_y = y + (row + 0.5) / grid;
      if (!lens) {
        add(sum, tracer.trace(frame.camera().ray(place_x, place_y)));
        continue;
      }
      const RandomUse first_use = {.x = static_cast<std::uint32_t>(x),
                                   .y = static_cast<std::uint32_t>(y),
                                   .sample = static_cast<std::uint32_t>((row * grid + column) * lens_points),
                                   .dimension = lens_dimension};
      add(sum, trace_lens(frame, first_use, place_x, place_y, tracer));
      stats.lens_samples += static_cast<std::uint64_t>(lens_points);
    }
  }
  ++stats.pixels;
  const double count = static_cast<double>(grid) * grid * lens_points;
  return {sum.color / count, sum.alpha / count};
}

}  // namespace crt::core
