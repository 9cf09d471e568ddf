// Pixels get their samples pass by pass here.
#include <algorithm>
#include <memory>

#include "core/render/packet_tracer.hpp"
#include "core/render/pixel.hpp"
#include "core/sampling/schedule.hpp"
#include "core/sampling/sequence.hpp"

namespace crt::core {

namespace {

/// PassRays are the rays of passes: the samples of a range of one pixel after the other.
class PassRays {
 public:
  PassRays(const Frame& frame, std::span<const PixelPlace> pixels, const SampleRange& range)
      : camera_(frame.camera()),
        filter_(frame.filter()),
        with_lens_(frame.features().lens),
        with_numbers_(frame.draws_numbers()),
        seed_(frame.settings().seed),
        begin_(static_cast<std::uint32_t>(range.begin)),
        end_(static_cast<std::uint32_t>(range.end)),
        pixels_(pixels),
        next_(end_),
        first_window_begin_(are_few(end_ - begin_) ? begin_ / window_size * window_size : none),
        first_window_end_(std::min(end_, begin_ / window_size * window_size + window_size)) {}

  /// Places the next rays. Returns how many, and none at the end.
  std::size_t next(RayPlaces& places) {
    std::size_t count = 0;
    while (count < packet_size) {
      if (next_ == end_) {
        if (pixel_ == pixels_.size()) break;
        begin_pixel();
      }
      const std::size_t groups =
          std::min<std::size_t>(end_ - next_, packet_size - count) / lane_count;
      if (groups > 0 && next_ % lane_count == 0 && count % lane_count == 0) {
        const std::uint32_t placed = place_groups(places, count / lane_count, groups);
        set_samples(places, count, placed);
        next_ += placed;
        count += placed;
      } else {
        place_one(places, count);
        set_samples(places, count, 1);
        ++next_;
        ++count;
      }
    }
    return count;
  }

 private:
  /// Returns whether a pixel has so few points that those of several pixels are found faster
  /// together. Single points are not kept.
  static bool are_few(std::uint32_t samples) {
    return samples >= lane_count && samples <= packet_size;
  }

  void set_samples(RayPlaces& places, std::size_t first, std::size_t count) const {
    if (!with_numbers_) return;
    const PixelPlace& pixel = pixels_[pixel_ - 1];
    places.set_samples(first, count, {pixel.x, pixel.y, next_});
  }

  void begin_pixel() {
    const PixelPlace& pixel = pixels_[pixel_];
    x_ = pixel.x;
    y_ = pixel.y;
    of_four_ = pixel_ % lane_count;
    if (of_four_ == 0) find_sequences();
    window_ = &windows_[first_window_begin_ == none ? 0 : of_four_];
    window_begin_ = first_window_begin_;
    window_end_ = first_window_end_;
    ++pixel_;
    next_ = begin_;
  }

  /// Finds the sequences of the next four pixels, and the first points of each, which is faster for
  /// many.
  void find_sequences() {
    std::array<PixelSequence::Pixel, lane_count> pixels;
    for (std::size_t i = 0; i < lane_count; ++i) {
      const PixelPlace& pixel = pixels_[std::min(pixel_ + i, pixels_.size() - 1)];
      pixels[i] = {pixel.x, pixel.y};
    }
    sequences_ = PixelSequence::of_each(seed_, pixels);
    if (first_window_begin_ == none) return;
    for (std::size_t i = 0; i < lane_count; ++i) {
      sequences_[i].points(begin_, first_window_end_, with_lens_, windows_[i]);
    }
  }

  /// Places the next rays of the pixel, up to so many groups. Returns how many rays they are.
  std::uint32_t place_groups(RayPlaces& places, std::size_t first, std::size_t groups) {
    const std::uint32_t begin = next_ % window_size;
    if (next_ - begin != window_begin_) {
      window_begin_ = next_ - begin;
      window_end_ = std::min(end_, window_begin_ + window_size);
      sequences_[of_four_].points(next_, window_end_, with_lens_, *window_);
    }
    const std::size_t count = std::min(groups, std::size_t{window_end_ - next_} / lane_count);
    const std::size_t from = begin / lane_count;
    const auto& [pixel_u, pixel_v, lens_u, lens_v] = window_->coordinates;
    for (std::size_t i = 0; i < count; ++i) {
      places.picture[first + i] = {x_ + filter_(pixel_u[from + i]),
                                   y_ + filter_(pixel_v[from + i])};
    }
    for (std::size_t i = 0; with_lens_ && i < count; ++i) {
      places.lens[first + i] = camera_.lens_points(lens_u[from + i], lens_v[from + i]);
    }
    return static_cast<std::uint32_t>(count * lane_count);
  }

  void place_one(RayPlaces& places, std::size_t ray) const {
    const PixelSequence& sequence = sequences_[of_four_];
    const SequencePoint point = with_lens_ ? sequence.point(next_) : sequence.pixel_point(next_);
    const std::size_t group = ray / lane_count;
    const std::size_t lane = ray % lane_count;
    set_lane(places.picture[group], lane,
             {x_ + filter_(point.pixel_u), y_ + filter_(point.pixel_v)});
    if (with_lens_)
      set_lane(places.lens[group], lane, camera_.lens_point(point.lens_u, point.lens_v));
  }

  const CameraRays& camera_;
  const FilterPlaces& filter_;
  bool with_lens_;
  bool with_numbers_;
  std::uint64_t seed_;
  std::uint32_t begin_;
  std::uint32_t end_;
  std::span<const PixelPlace> pixels_;
  std::size_t pixel_ = 0;  ///< the next pixel
  double x_ = 0;
  double y_ = 0;
  std::array<PixelSequence, lane_count>
      sequences_;            ///< of this pixel and its neighbours in the span
  std::size_t of_four_ = 0;  ///< which of them is this pixel's
  std::uint32_t next_;       ///< sample of the pixel
  // These are points that have been found. If they are few, they are the first ones of all these
  // pixels.
  static constexpr std::uint32_t none = ~0u;
  static constexpr std::uint32_t window_size = PixelSequence::Window::size;
  std::uint32_t first_window_begin_;  ///< `none` where they are not few
  std::uint32_t first_window_end_;
  std::uint32_t window_begin_ = none;
  std::uint32_t window_end_ = 0;
  std::array<PixelSequence::Window, lane_count> windows_;
  PixelSequence::Window* window_ = windows_.data();  ///< of this pixel
};

/// PassSums adds up samples and hands them to the pixels, step by step.
class PassSums {
 public:
  PassSums(std::span<const PixelPlace> pixels, const SampleRange& range)
      : pixels_(pixels),
        samples_per_pixel_(static_cast<std::size_t>(range.end - range.begin)),
        is_first_range_(range.begin == 0),
        pixel_(pixels.data()) {
    std::size_t step = 0;
    for (std::int64_t count = range.begin; count < range.end; count += steps_[step++].size) {
      const std::int64_t size = samples_of_next_step(count);
      steps_[step] = {size, PixelSamples::place_of_step(count, size)};
    }
    steps_[step].size = none;
    missing_ = steps_[0].size;
  }

  void add(std::span<const Sample> samples) {
    const PixelPlace* pixel = pixel_;
    const Step* step = &steps_[step_];
    std::int64_t missing = missing_;
    Lanes sum = sum_;
    SeenSamples seen = seen_;
    const Sample* const end = samples.data() + samples.size();
    for (const Sample* sample = samples.data(); sample != end;) {
      const bool begins_pixel = step == steps_.data() && missing == step->size;
      if (begins_pixel) {
        if (is_first_range_) std::construct_at(pixel->samples, blank_);
        seen = SeenSamples(*pixel->samples, sample->identity);
      }
      if (step->size == 1) {
        do {
          seen.add(sample->channels, sample->dropped, sample->identity);
          pixel->samples->add_step(step->place, sample->channels);
          ++step;
        } while (++sample != end && step->size == 1);
      } else {
        const Sample* const until = sample + std::min(end - sample, missing);
        missing -= until - sample;
        do {
          seen.add(sample->channels, sample->dropped, sample->identity);
          sum += sample->channels;
        } while (++sample != until);
        if (missing > 0) break;
        pixel->samples->add_step(step->place, sum);
        sum = Lanes{};
        ++step;
      }
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

  void add(std::span<const FirstHit> hits) {
    for (const FirstHit& hit : hits) {
      const PixelPlace& pixel = pixels_[hits_added_++ / samples_per_pixel_];
      if (pixel.first_hits != nullptr) pixel.first_hits->add(hit);
    }
  }

 private:
  struct Step {
    std::int64_t size = 0;
    PixelSamples::StepPlace place;
  };
  static constexpr std::int64_t none = 0;

  std::span<const PixelPlace> pixels_;
  std::size_t samples_per_pixel_;
  bool is_first_range_;
  const PixelSamples blank_;                ///< to be copied, which is faster than to be made
  std::array<Step, most_steps + 1> steps_;  ///< of every pixel, with `none` at their end
  // These say whose samples come next:
  const PixelPlace* pixel_;
  std::size_t step_ = 0;      ///< the next step, or the one of which there is a part
  std::int64_t missing_ = 0;  ///< the samples of the step that are still to come
  Lanes sum_{};               ///< the sum of the others
  SeenSamples seen_;          ///< of this pixel
  std::size_t hits_added_ = 0;
};

}  // namespace

void trace_passes(const Frame& frame, std::span<const PixelPlace> pixels, const SampleRange& range,
                  Tracer& tracer, RenderStats& stats) {
  const bool with_first_hits =
      std::any_of(pixels.begin(), pixels.end(),
                  [](const PixelPlace& pixel) { return pixel.first_hits != nullptr; });
  PacketTracer packets(frame, tracer, with_first_hits);
  PassRays rays(frame, pixels, range);
  PassSums sums(pixels, range);
  RayPlaces places;
  while (const std::size_t count = rays.next(places)) {
    const PacketTracer::Traced traced = packets.trace(places, count);
    sums.add(traced.samples);
    sums.add(traced.first_hits);
  }
  if (frame.features().lens) {
    stats.lens_samples += pixels.size() * static_cast<std::uint64_t>(range.end - range.begin);
  }
}

}  // namespace crt::core
