// These tests check what is known of a pixel from its samples.
#include "core/sampling/pixel_samples.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/sampling/schedule.hpp"
#include "core/sampling/sequence.hpp"
#include "crt/image.hpp"

using namespace crt::core;

namespace {

struct OneSample {
  Lanes values;
  std::uint64_t identity = 1;
  double dropped = 0;
};

/// Gives a pixel that has `count` samples the sum of its next step of them. What they show goes
/// into `seen`.
template <class SampleAt>
void add_sum(PixelSamples& pixel, std::int64_t count, const SampleAt& sample_at,
             SeenSamples& seen) {
  const std::int64_t size = samples_of_next_step(count);
  Lanes sum{};
  for (std::int64_t i = count; i < count + size; ++i) {
    const OneSample sample = sample_at(i);
    sum += sample.values;
    seen.add(sample.values, sample.dropped, sample.identity);
  }
  pixel.add_step(PixelSamples::place_of_step(count, size), sum);
}

/// Gives a pixel its next step, and returns what they show.
template <class SampleAt>
void add_step(PixelSamples& pixel, std::int64_t count, const SampleAt& sample_at) {
  SeenSamples seen(pixel, sample_at(count).identity);
  add_sum(pixel, count, sample_at, seen);
  pixel.add_seen(seen, count == 0);
}

/// Takes a neighbour's samples into the pixel's neighbour statistics.
void take_note(PixelSamples& pixel, const PixelSamples& neighbour) {
  PixelSamples::Statistics statistics = pixel.statistics();
  statistics.take(neighbour.statistics());
  pixel.keep(statistics);
}

/// Gives a pixel its first `end` samples of a grey function.
template <class Function>
PixelSamples sampled(const PixelSequence& sequence, std::int64_t end, const Function& function) {
  PixelSamples pixel;
  std::int64_t count = 0;
  while (count < end) {
    add_step(pixel, count, [&](std::int64_t i) {
      const double value = function(sequence.point(static_cast<std::uint32_t>(i)));
      return OneSample{lanes_of(value, value, value, 1), value > 0.5 ? 1u : 2u, 0.25};
    });
    count += samples_of_next_step(count);
  }
  return pixel;
}

const DisplayScale linear(1);

double half_width(const PixelSamples& pixel, std::int64_t count) {
  return linear.half_widths({pixel.interval(SampleCount(count))})[0];
}

}  // namespace

TEST_CASE("a pixel of one colour has that mean to the last bit, and no width") {
  PixelSamples pixel;
  std::int64_t count = 0;
  for (int pass = 0; pass < 40; ++pass) {
    add_step(pixel, count, [](std::int64_t) { return OneSample{lanes_of(0.1, 0.2, 1.0 / 3, 1)}; });
    count += samples_of_next_step(count);
    const auto mean = pixel.mean(SampleCount(count));
    CHECK(static_cast<float>(mean[0]) == 0.1f);
    CHECK(static_cast<float>(mean[1]) == 0.2f);
    CHECK(static_cast<float>(mean[2]) == static_cast<float>(1.0 / 3));
    CHECK(mean[3] == 1);
    CHECK(half_width(pixel, count) < (count == 1 ? 1.1 : 1e-6));
  }
}

TEST_CASE("the mean is that of all samples, whatever the pass") {
  const PixelSequence sequence(3, 1, 4);
  const auto wave = [](const SequencePoint& p) {
    return 0.5 + 0.5 * std::sin(7 * p.pixel_u + 3 * p.pixel_v);
  };
  for (const std::int64_t count : {1, 5, 8, 9, 16, 18, 30, 64, 72, 1024}) {
    double sum = 0;
    for (std::int64_t i = 0; i < count; ++i)
      sum += wave(sequence.point(static_cast<std::uint32_t>(i)));
    const PixelSamples pixel = sampled(sequence, count, wave);
    CHECK(double{pixel.mean(SampleCount(count))[1]} ==
          doctest::Approx(sum / static_cast<double>(count)).epsilon(1e-6));
    CHECK(pixel.dropped(count) == doctest::Approx(0.25));
  }
}

TEST_CASE("an edge in the pixel or beside it keeps a width of two samples of its contrast") {
  const PixelSequence sequence(3, 1, 4);
  // The sequence gets halves right with every pass, and its blocks agree.
  const auto halves = [](const SequencePoint& p) { return p.pixel_u < 0.5 ? 0.2 : 0.8; };
  const auto plain = [](const SequencePoint&) { return 0.2; };
  PixelSamples pixel = sampled(sequence, 64, halves);
  CHECK(half_width(pixel, 64) == doctest::Approx(2 * 0.6 / 64));

  PixelSamples quiet = sampled(sequence, 16, plain);
  CHECK(half_width(quiet, 16) < 1e-6);
  take_note(quiet, quiet);
  CHECK(half_width(quiet, 16) < 1e-6);
  // What it has not seen itself may reach in by half as much.
  take_note(quiet, sampled(sequence, 16, halves));
  CHECK(half_width(quiet, 16) == doctest::Approx(0.6 / 16));
}

TEST_CASE(
    "what neighbours show counts more where a pixel shows several things itself or is out of "
    "focus") {
  const auto of_thing = [](double value, std::uint64_t identity) {
    return [=](std::int64_t) { return OneSample{lanes_of(value, value, value, 1), identity}; };
  };
  PixelSamples neighbour;
  add_step(neighbour, 0, of_thing(0.9, 1));
  const auto width_of = [&](std::uint64_t last_identity, bool with_lens) -> double {
    PixelSamples pixel;
    for (std::int64_t i = 0; i < 8; ++i)
      add_step(pixel, i, of_thing(0.5, i == 7 ? last_identity : 1));
    take_note(pixel, neighbour);
    return linear.half_widths({pixel.interval(SampleCount(8, with_lens))})[0];
  };
  CHECK(width_of(1, false) == doctest::Approx(0.4 / 8));
  CHECK(width_of(2, false) == doctest::Approx(2 * 0.4 / 8));
  CHECK(width_of(1, true) == doctest::Approx(2 * 0.4 / 8));
}

TEST_CASE("a pixel with a sample that is no number claims nothing") {
  PixelSamples pixel;
  for (std::int64_t i = 0; i < 8; ++i) {
    const double value = i == 3 ? std::numeric_limits<double>::quiet_NaN() : 0.5;
    add_step(pixel, i, [&](std::int64_t) { return OneSample{lanes_of(value, value, value, 1)}; });
  }
  CHECK(half_width(pixel, 8) == 1);
}

TEST_CASE("things that look alike keep a width where they meet") {
  const auto one = [](std::int64_t) { return OneSample{lanes_of(0.5, 0.5, 0.5, 1), 1}; };
  const auto other = [](std::int64_t) { return OneSample{lanes_of(0.5, 0.5, 0.5, 1), 2}; };
  PixelSamples pixel;
  for (std::int64_t i = 0; i < 8; ++i) add_step(pixel, i, one);
  CHECK(half_width(pixel, 8) == 0);
  PixelSamples mixed = pixel;
  add_step(mixed, 8, other);
  CHECK(half_width(mixed, 9) > 0.01);
  PixelSamples neighbour;
  for (std::int64_t i = 0; i < 8; ++i) add_step(neighbour, i, other);
  take_note(pixel, neighbour);
  CHECK(half_width(pixel, 8) > 0.01);
}

TEST_CASE("what a display clips has no width, and dark colours at a high gamma have more") {
  const DisplayScale scale(2.2);
  const auto of_channel = [](std::size_t channel, double mean, double half_width) {
    MeanInterval interval;
    interval.mean[channel] = mean;
    interval.half_width[channel] = half_width;
    return interval;
  };
  const Lanes widths = linear.half_widths({of_channel(0, 5, 1), of_channel(1, 0.5, 0.1),
                                           of_channel(2, 0.95, 0.1), of_channel(3, 1, 0.25)});
  CHECK(widths[0] == 0);
  CHECK(widths[1] == doctest::Approx(0.1));
  CHECK(widths[2] == doctest::Approx(0.1));
  CHECK(widths[3] == 0.25);
  const Lanes of_gamma = scale.half_widths({of_channel(0, 0.01, 0.01), of_channel(3, 0.01, 0.01)});
  CHECK(of_gamma[0] == doctest::Approx(std::pow(0.01, 1 / 2.2)));  // down to 0
  CHECK(of_gamma[1] == doctest::Approx(0.01));                     // alpha has no gamma
  CHECK(of_gamma[2] == 0);
}

TEST_CASE(
    "a width on a display is that of the worst channel, whatever pixels are looked at beside it") {
  const MeanInterval dark{.mean = lanes_of(0.01, 0.5, 0.2, 1),
                          .half_width = lanes_of(0.01, 0.01, 0.3, 0)};
  const MeanInterval bright{.mean = lanes_of(2, 0.9, 0.7, 1),
                            .half_width = lanes_of(0.5, 0.2, 0.01, 0),
                            .least_shown = 0.2};
  const MeanInterval none{};
  const MeanInterval known{.least_shown = 0.5};
  for (const double gamma : {0.5, 1.0, 2.2}) {
    const DisplayScale scale(gamma);
    const auto alone = [&](const MeanInterval& interval) -> double {
      return scale.half_widths({interval})[0];
    };
    const Lanes together = scale.half_widths({dark, none, bright, known});
    CHECK(together[0] == alone(dark));
    CHECK(together[1] == 0);
    CHECK(together[2] == alone(bright));
    CHECK(together[3] == 0.5);
    const auto shown = [&](double value) {
      return std::pow(std::clamp(value, 0.0, 1.0), 1 / gamma);
    };
    const double blue = std::max(shown(0.5) - shown(0.2), shown(0.2) - shown(0));
    const double red = std::max(shown(0.02) - shown(0.01), shown(0.01) - shown(0));
    CHECK(alone(dark) == doctest::Approx(std::max(red, blue)).epsilon(1e-6));
  }
}

TEST_CASE("with any exposure and tone map a width is the farthest that the interval shows") {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> exponents(-9, 4);
  std::uniform_real_distribution<double> shares(0, 1.5);
  for (const crt::ToneMap map : {crt::ToneMap::none, crt::ToneMap::filmic}) {
    for (const double exposure : {-3.0, 0.0, 2.5}) {
      for (const double gamma : {0.5, 1.0, 2.2}) {
        crt::Settings settings;
        settings.tone_map = map;
        settings.exposure = exposure;
        settings.gamma = gamma;
        const DisplayScale scale(gamma, ToneCurve(settings));
        for (int i = 0; i < 200; ++i) {
          const double mean = std::exp2(exponents(engine));
          const double half = mean * shares(engine);
          const MeanInterval interval{.mean = lanes_of(0, mean, 0, 1),
                                      .half_width = lanes_of(0, half, 0, 0)};
          double farthest = 0;
          for (int k = -64; k <= 64; ++k) {
            const double there = crt::displayed(mean + half * k / 64, settings);
            farthest = std::max(farthest, std::abs(there - crt::displayed(mean, settings)));
          }
          CHECK(double{scale.half_widths({interval})[0]} ==
                doctest::Approx(farthest).epsilon(1e-7));
        }
        // Alpha is no light.
        MeanInterval alpha;
        alpha.mean = lanes_of(0, 0, 0, 0.5);
        alpha.half_width = lanes_of(0, 0, 0, 0.25);
        CHECK(double{scale.half_widths({alpha})[0]} == 0.25);
      }
    }
  }
}

TEST_CASE("values beyond all bounds do no harm") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const double last : {0.0, none}) {
    PixelSamples pixel;
    for (std::int64_t i = 0; i < 8; ++i) {
      add_step(pixel, i, [&](std::int64_t) { return OneSample{lanes_of(1e300, -1e300, last, 1)}; });
    }
    CHECK(std::isfinite(double{pixel.mean(SampleCount(8))[0]}));
    CHECK(half_width(pixel, 8) >= 0);
    CHECK(half_width(pixel, 8) <= 1);
  }
}

TEST_CASE(
    "at the stopping point the truth lies within the half-width in 95 of 100 pixels with an edge") {
  constexpr int pixels = 3000;
  for (const double target : {8.0 / 255, 2.0 / 255}) {
    int within = 0;
    for (int i = 0; i < pixels; ++i) {
      const PixelSequence sequence(11, i, 2);
      const double angle = 0.001 * i;
      const double x = std::cos(angle);
      const double y = std::sin(angle);
      const double level = 0.4 * std::sin(0.7 * i);
      const auto edge = [&](const SequencePoint& p) {
        return x * (p.pixel_u - 0.5) + y * (p.pixel_v - 0.5) < level ? 1.0 : 0.0;
      };
      std::int64_t count = 16;
      PixelSamples pixel = sampled(sequence, count, edge);
      while (half_width(pixel, count) > target && count < 1024)
        pixel = sampled(sequence, count *= 2, edge);
      constexpr int grid = 200;
      double truth = 0;
      for (int k = 0; k < grid * grid; ++k)
        truth += edge({.pixel_u = (k % grid + 0.5) / grid, .pixel_v = (k / grid + 0.5) / grid});
      truth /= grid * grid;
      if (std::abs(pixel.mean(SampleCount(count))[0] - truth) <= half_width(pixel, count) + 0.0002)
        ++within;
    }
    CHECK(within >= 0.95 * pixels);
  }
}

TEST_CASE("what steps show may be added together") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto sample_at = [&](std::int64_t i) {
    const double value = i % 5 == 3 ? none : std::sin(static_cast<double>(7 * i));
    return OneSample{lanes_of(value, -value, 0.1 * value, 1), static_cast<std::uint64_t>(i > 11),
                     0.1 * static_cast<double>(i)};
  };
  for (const std::int64_t end : {8, 16, 32, 64}) {
    PixelSamples separate;
    PixelSamples together;
    SeenSamples seen(together, sample_at(0).identity);
    for (std::int64_t count = 0; count < end; count += samples_of_next_step(count)) {
      add_step(separate, count, sample_at);
      add_sum(together, count, sample_at, seen);
    }
    together.add_seen(seen, true);
    CHECK(separate.stored() == together.stored());
  }
}
