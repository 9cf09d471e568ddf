// The filter is asked here what it makes of pictures whose truth is known.
#include "core/denoise/denoise.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "core/tasks/tasks.hpp"

using namespace crt::core;

namespace {

constexpr int width = 64;
constexpr int height = 48;
constexpr double deviation = 0.1;

/// A Picture has pixels and guides of one surface that faces the camera.
struct Picture {
  std::vector<float> pixels = std::vector<float>(std::size_t{4} * width * height, 1.0F);
  std::vector<Guide> guides =
      std::vector<Guide>(std::size_t{width} * height, Guide{.albedo = {1, 1, 1},
                                                            .normal = {0, 0, -1},
                                                            .cover = 1,
                                                            .nearness = 0.25F,
                                                            .estimates = 8});

  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
  }
  float& at(int x, int y, std::size_t channel = 0) { return pixels[4 * index(x, y) + channel]; }
  Guide& guide(int x, int y) { return guides[index(x, y)]; }

  /// Sets the grey of all pixels.
  void fill(const std::function<double(int, int)>& grey) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (std::size_t channel = 0; channel < 3; ++channel)
          at(x, y, channel) = static_cast<float>(grey(x, y));
      }
    }
  }

  /// Adds noise of Gauss' distribution, of which the guides know the variance.
  void add_noise(double scale = deviation) {
    std::mt19937 numbers(7);
    std::normal_distribution<double> noise(0, scale);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
          at(x, y, channel) += static_cast<float>(noise(numbers));
          guide(x, y).variance[channel] = static_cast<float>(scale * scale);
        }
      }
    }
  }

  void filter() {
    denoise(width, height, pixels, guides, [](std::size_t count, const auto& task) {
      for (std::size_t i = 0; i < count; ++i) task(i);
    });
  }
};

/// Returns the root of the mean square of what differs from the truth in some columns.
double error_of(Picture& picture, const std::function<double(int, int)>& truth, int first = 0,
                int last = width) {
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = first; x < last; ++x) {
      const double difference = double{picture.at(x, y)} - truth(x, y);
      sum += difference * difference;
    }
  }
  return std::sqrt(sum / (height * (last - first)));
}

}  // namespace

TEST_CASE("a picture without noise stays as it is, to the bit") {
  Picture picture;
  std::mt19937 numbers(3);
  std::uniform_real_distribution<float> any(0, 2);
  for (float& value : picture.pixels) value = any(numbers);
  const std::vector<float> before = picture.pixels;
  picture.filter();
  CHECK(picture.pixels == before);
}

TEST_CASE("even light is freed of most of its noise, and alpha stays") {
  const auto truth = [](int, int) { return 0.5; };
  Picture picture;
  picture.fill(truth);
  picture.add_noise();
  CHECK(error_of(picture, truth) == doctest::Approx(deviation).epsilon(0.05));
  picture.filter();
  CHECK(error_of(picture, truth) < deviation / 8);
  CHECK(picture.at(5, 5, 3) == 1);
}

TEST_CASE("without a variance the noise is found from what neighbours differ by") {
  const auto truth = [](int x, int y) { return 0.3 + 0.005 * x + 0.002 * y; };
  Picture picture;
  picture.fill(truth);
  picture.add_noise();
  for (Guide& guide : picture.guides)
    guide = {guide.albedo, guide.normal, 1, guide.nearness, {}, 1};
  picture.filter();
  CHECK(error_of(picture, truth) < deviation / 3);
  // A slope alone is no noise, nor is a sharp shadow.
  const auto shadow = [](int x, int y) { return x + y < 50 ? 0.25 + x / 256.0 : 0.75 + x / 256.0; };
  picture.fill(shadow);
  picture.filter();
  CHECK(error_of(picture, shadow) == 0);
}

TEST_CASE("edges of light stay that are plainer than the noise") {
  const auto truth = [](int x, int y) { return 2 * x + y < 80 ? 0.2 : 0.9; };
  Picture picture;
  picture.fill(truth);
  picture.add_noise(0.05);
  picture.filter();
  CHECK(error_of(picture, truth) < 0.05 / 3);
}

TEST_CASE("light does not cross edges of surfaces, even if it differs by less than the noise") {
  constexpr int edge = 30;
  const auto truth = [](int x, int) { return x < edge ? 0.5 : 0.55; };
  const std::function<void(Guide&)> changes[] = {
      [](Guide&) {},
      [](Guide& guide) {
        guide.normal = {0, 1, 0};
      },
      [](Guide& guide) { guide.nearness = 0.1F; },
      [](Guide& guide) { guide = {.variance = guide.variance, .estimates = 8}; }};
  double bias_without = 0;
  for (const auto& change : changes) {
    Picture picture;
    picture.fill(truth);
    picture.add_noise();
    for (int y = 0; y < height; ++y) {
      for (int x = edge; x < width; ++x) change(picture.guide(x, y));
    }
    picture.filter();
    // The mean of a column beside the edge has a bias if the other side has had a share in it.
    double beside = 0;
    for (int y = 0; y < height; ++y) beside += double{picture.at(edge - 1, y)} / height;
    if (bias_without == 0) {
      bias_without = beside - 0.5;
      CHECK(bias_without > 0.015);
    } else {
      CHECK(std::abs(beside - 0.5) < 0.009);
    }
  }
}

TEST_CASE("the texture of a surface stays, and its light is smooth") {
  const auto albedo = [](int x, int y) { return (x / 3 + y / 3) % 2 == 0 ? 0.9 : 0.2; };
  const auto truth = [&](int x, int y) { return 0.8 * albedo(x, y); };
  Picture picture;
  picture.fill(truth);
  picture.add_noise(0.02);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      picture.guide(x, y).albedo.fill(static_cast<float>(albedo(x, y)));
  }
  picture.filter();
  CHECK(error_of(picture, truth) < 0.02 / 3);
}

TEST_CASE("a lone bright spot of noise does not stay") {
  Picture picture;
  picture.fill([](int, int) { return 0.5; });
  picture.add_noise(0.01);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    picture.at(20, 20, channel) = 50;
    picture.guide(20, 20).variance[channel] = 2500;
  }
  picture.filter();
  CHECK(picture.at(20, 20) < 0.6F);
  CHECK(picture.at(21, 20) < 0.6F);
}

TEST_CASE("what is no number, or not there yet, changes nothing beside it") {
  Picture picture;
  picture.fill([](int, int) { return 0.5; });
  picture.add_noise();
  picture.at(10, 10) = std::numeric_limits<float>::quiet_NaN();
  picture.at(12, 10) = std::numeric_limits<float>::infinity();
  picture.at(40, 20) = 700;
  picture.guide(40, 20).estimates = 0;
  picture.filter();
  CHECK(std::isnan(picture.at(10, 10)));
  CHECK(picture.at(40, 20) == 700);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool is_set = (y == 10 && (x == 10 || x == 12)) || (x == 40 && y == 20);
      if (!is_set) REQUIRE(std::abs(picture.at(x, y) - 0.5F) < 0.3F);
    }
  }
}

TEST_CASE("pixels depend on those within reach alone") {
  for (const float estimates : {1.0F, 8.0F}) {
    Picture one;
    one.fill([](int x, int) { return 0.01 * x; });
    one.add_noise();
    for (Guide& guide : one.guides) guide.estimates = estimates;
    Picture other = one;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (std::max(std::abs(x - 30), std::abs(y - 20)) <= denoise_reach) continue;
        other.at(x, y) += 0.5F;
        other.guide(x, y).normal = {1, 0, 0};
        other.guide(x, y).variance[1] *= 2;
      }
    }
    one.filter();
    other.filter();
    CHECK(one.at(30, 20) == other.at(30, 20));
    CHECK(one.at(50, 20) != other.at(50, 20));
  }
}

TEST_CASE("the filter has the same bytes for any order and any threads") {
  Picture one;
  one.fill([](int x, int y) { return 0.01 * x + (y > 20 ? 0.3 : 0); });
  one.add_noise();
  Picture backwards = one;
  Picture parallel = one;
  one.filter();
  denoise(width, height, backwards.pixels, backwards.guides,
          [](std::size_t count, const auto& task) {
            for (std::size_t i = count; i-- > 0;) task(i);
          });
  denoise(width, height, parallel.pixels, parallel.guides,
          [](std::size_t count, const auto& task) { run_tasks(count, 4, task); });
  CHECK(one.pixels == backwards.pixels);
  CHECK(one.pixels == parallel.pixels);
}

TEST_CASE("pictures of a few pixels can be filtered") {
  for (const auto& [columns, rows] : {std::pair{1, 1}, {1, 9}, {5, 2}}) {
    std::vector<float> pixels(static_cast<std::size_t>(4 * columns * rows), 0.5F);
    std::vector<Guide> guides(static_cast<std::size_t>(columns * rows),
                              Guide{.variance = {1, 1, 1}, .estimates = 4});
    denoise(columns, rows, pixels, guides, [](std::size_t count, const auto& task) {
      for (std::size_t i = 0; i < count; ++i) task(i);
    });
    for (const float value : pixels) CHECK(value == doctest::Approx(0.5));
  }
}
