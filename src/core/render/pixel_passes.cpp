// Samples of pixels pass by pass.
#include <algorithm>

#include "core/render/packet_tracer.hpp"
#include "core/render/pixel.hpp"
#include "core/sampling/schedule.hpp"
#include "core/sampling/sequence.hpp"

namespace crt::core {

namespace {

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
    std::size_t count = 0;
    while (count < packet_size) {
      if (next_ == end_) {
        if (pixels_.empty()) break;
        begin_pixel();
      }
      const bool makes_group = next_ % lane_count == 0 && end_ - next_ >= lane_count;
      if (makes_group && count % lane_count == 0) {
        place_group(places, count / lane_count);
        next_ += lane_count;
        count += lane_count;
      } else {
        place_one(places, count);
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
    block_begin_ = none;
    pixels_ = pixels_.subspan(1);
    next_ = begin_;
  }

  /// As many as there are lanes.
  void place_group(RayPlaces& places, std::size_t group) {
    const std::uint32_t in_block = next_ % PixelSequence::Block::size;
    if (next_ - in_block != block_begin_) {
      block_begin_ = next_ - in_block;
      sequence_.block(block_begin_, with_lens_, block_);
    }
    const auto numbers = [&](std::size_t dimension) {
      return block_.coordinates[dimension][in_block / lane_count];
    };
    places.picture[group] = {x_ + filter_(numbers(0)), y_ + filter_(numbers(1))};
    if (with_lens_) places.lens[group] = camera_.lens_points(numbers(2), numbers(3));
  }

  void place_one(RayPlaces& places, std::size_t ray) const {
    const SequencePoint point = with_lens_ ? sequence_.point(next_) : sequence_.pixel_point(next_);
    const std::size_t group = ray / lane_count;
    const std::size_t lane = ray % lane_count;
    set_lane(places.picture[group], lane, {x_ + filter_(point.pixel_u), y_ + filter_(point.pixel_v)});
    if (with_lens_) set_lane(places.lens[group], lane, camera_.lens_point(point.lens_u, point.lens_v));
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
  static constexpr std::uint32_t none = ~0u;
  std::uint32_t block_begin_ = none;
  PixelSequence::Block block_;  ///< of this pixel, from there on
};

/// Hands on what samples of passes bring, step by step.
class PassSums {
 public:
  PassSums(std::span<const PixelPlace> pixels, const SampleRange& range)
      : pixel_(pixels.data()), is_first_range_(range.begin == 0) {
    std::size_t step = 0;
    for (std::int64_t count = range.begin; count < range.end; count += steps_[step++].size) {
      const std::int64_t size = samples_of_next_step(count);
      steps_[step] = {size, PixelSamples::place_of_step(count, size)};
    }
    steps_[step].size = none;
    missing_ = steps_[0].size;
  }

  void add(const PacketTracer::Traced& traced) {
    const PixelPlace* pixel = pixel_;
    const Step* step = &steps_[step_];
    std::int64_t missing = missing_;
    Lanes sum = sum_;
    SeenSamples seen = seen_;
    const auto sample_count = static_cast<std::int64_t>(traced.samples.size());
    for (std::int64_t done = 0; done < sample_count;) {
      const Tracer::Sample* const samples = &traced.samples[static_cast<std::size_t>(done)];
      const bool begins_pixel = step == steps_.data() && missing == step->size;
      if (begins_pixel) seen = SeenSamples(*pixel->samples, samples->identity);
      const std::int64_t count = std::min(sample_count - done, missing);
      for (std::int64_t i = 0; i < count; ++i) {
        sum += samples[i].channels;
        seen.add(samples[i].channels, samples[i].dropped, samples[i].identity);
      }
      if (!traced.first_hits.empty() && pixel->first_hits != nullptr) {
        const auto hits = traced.first_hits.subspan(static_cast<std::size_t>(done));
        for (std::int64_t i = 0; i < count; ++i) pixel->first_hits->add(hits[static_cast<std::size_t>(i)]);
      }
      done += count;
      missing -= count;
      if (missing > 0) break;
      pixel->samples->add_step(step->place, sum);
      sum = Lanes{};
      ++step;
      if (step->size == none) {
        pixel->samples->add_seen(seen, is_first_range_);
        ++pixel;
        step = steps_.data();
      }
      missing = step->size;
    }
    pixel_ = pixel;
    step_ = static_cast<std::size_t>(step - steps_.data());
    missing_ = missing;
    sum_ = sum;
    seen_ = seen;
  }

 private:
  struct Step {
    std::int64_t size = 0;
    PixelSamples::StepPlace place;
  };
  static constexpr std::int64_t none = 0;

  const PixelPlace* pixel_;  ///< whose samples come next
  bool is_first_range_;
  std::array<Step, most_steps + 1> steps_;  ///< of every pixel; none at their end
  std::size_t step_ = 0;                    ///< that comes next, or of which there is a part
  std::int64_t missing_ = 0;                ///< of its samples
  Lanes sum_{};                             ///< of the others
  SeenSamples seen_;                        ///< of this pixel
};

}  // namespace

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
