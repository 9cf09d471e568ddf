// These tests check the errors, parts and choices of `crt trade`.
#include "cli/trade_measure.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace crt;
using namespace crt::cli;

namespace {

/// Makes a picture that is grey all over.
Image plain(int width, int height, double level, double gamma = 1) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.set(x, y, {level, level, level, 1});
  }
  Settings settings;
  settings.gamma = gamma;
  image.set_settings(settings);
  return image;
}

using Places = std::vector<std::size_t>;

}  // namespace

TEST_CASE("a difference is measured in 8-bit steps of what a display shows") {
  const PictureError same = displayed_difference(plain(5, 4, 0.3), plain(5, 4, 0.3));
  CHECK(same.rmse == 0);
  CHECK(same.p999 == 0);
  const PictureError one = displayed_difference(plain(5, 4, 0.5 + 1.0 / 255), plain(5, 4, 0.5));
  CHECK(one.rmse == doctest::Approx(1).epsilon(1e-5));
  CHECK(one.p999 == doctest::Approx(1).epsilon(1e-5));
  // After gamma 2 a quarter shows as a half.
  CHECK(displayed_difference(plain(5, 4, 0, 2), plain(5, 4, 0.25, 2)).rmse ==
        doctest::Approx(127.5));
  // Exposure and tone map are those of the reference.
  Image exposed = plain(5, 4, 0.25);
  Settings settings = exposed.settings();
  settings.exposure = 1;
  exposed.set_settings(settings);
  CHECK(displayed_difference(plain(5, 4, 0.25 + 0.5 / 255), exposed).rmse ==
        doctest::Approx(1).epsilon(1e-4));
  settings.tone_map = ToneMap::filmic;
  exposed.set_settings(settings);
  CHECK(displayed_difference(plain(5, 4, 8), exposed).rmse ==
        doctest::Approx(255 * (1 - displayed(0.25, settings))));
  // Whiter than white counts as white, and less than nothing as black.
  CHECK(displayed_difference(plain(2, 2, 7), plain(2, 2, 1)).rmse == 0);
  CHECK(displayed_difference(plain(2, 2, -3), plain(2, 2, 0)).rmse == 0);
}

TEST_CASE(
    "one channel of one pixel counts by the share that it is, and as the worst of its pixel") {
  Image picture = plain(10, 10, 0);
  picture.set(3, 7, {0, 100.0 / 255, 0, 1});
  const PictureError error = displayed_difference(picture, plain(10, 10, 0));
  CHECK(error.rmse == doctest::Approx(100 / std::sqrt(300)).epsilon(1e-5));
  CHECK(error.p999 == doctest::Approx(100).epsilon(1e-5));
}

TEST_CASE("99.9 % leaves out one pixel of a thousand, and no more") {
  Image picture = plain(100, 20, 0);
  for (int i = 0; i < 3; ++i) picture.set(i, 0, {1, 1, 1, 1});
  CHECK(displayed_difference(picture, plain(100, 20, 0)).p999 == doctest::Approx(255));
  picture.set(2, 0, {0, 0, 0, 1});
  CHECK(displayed_difference(picture, plain(100, 20, 0)).p999 == 0);
}

TEST_CASE("pieces together have the error of the whole") {
  std::mt19937 random(5);
  const auto level = [&] { return static_cast<double>(random()) / 4294967296.0; };
  Image whole = plain(8, 6, 0);
  Image reference = plain(8, 6, 0);
  std::vector<Image> pieces = {plain(8, 2, 0), plain(8, 4, 0)};
  std::vector<Image> reference_pieces = pieces;
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      const std::size_t piece = y < 2 ? 0 : 1;
      const int row = y < 2 ? y : y - 2;
      const Color color = {level(), level(), level(), 1};
      const Color other = {level(), level(), level(), 1};
      whole.set(x, y, color);
      reference.set(x, y, other);
      pieces[piece].set(x, row, color);
      reference_pieces[piece].set(x, row, other);
    }
  }
  const PictureError together = displayed_difference(pieces, reference_pieces);
  CHECK(together.rmse == doctest::Approx(displayed_difference(whole, reference).rmse));
  CHECK(together.p999 == displayed_difference(whole, reference).p999);
}

TEST_CASE("the mean of two pictures is that of their light") {
  const Image mean = mean_of(plain(3, 2, 0.25), plain(3, 2, 0.75));
  CHECK(mean.at(2, 1) == Color{0.5, 0.5, 0.5, 1});
}

TEST_CASE(
    "bands lie in the picture, disjoint, as wide as it is, with about the pixels that were asked "
    "for") {
  for (const int width : {1, 7, 640, 1920}) {
    for (const int height : {1, 23, 24, 100, 480, 1080, 65536}) {
      for (const double pixels : {1.0, 500.0, 30000.0, 1e6, 1e12}) {
        CAPTURE(width);
        CAPTURE(height);
        CAPTURE(pixels);
        const std::vector<Region> bands = bands_of(width, height, pixels);
        REQUIRE_FALSE(bands.empty());
        int end = 0;
        double total = 0;
        for (const Region& band : bands) {
          CHECK(band.x == 0);
          CHECK(band.width == width);
          CHECK(band.y >= end);
          CHECK((band.height >= least_band_height || bands.size() == 1));
          end = band.y + band.height;
          total += double{1} * band.width * band.height;
        }
        CHECK(end <= height);
        const double all = double{1} * width * height;
        const double least_sensible = double{1} * width * least_band_height;
        CHECK(total >= std::min(pixels, all));
        CHECK(total <= std::min(all, 2 * std::max(pixels, least_sensible)));
      }
    }
  }
}

TEST_CASE("the front is what no other beats in both") {
  CHECK(pareto_front({}).empty());
  const std::vector<Outcome> outcomes = {{4, 1}, {1, 9}, {2, 9}, {2, 5}, {3, 6}, {8, 1}, {9, 0.5}};
  CHECK(pareto_front(outcomes) == Places{1, 3, 0, 6});
  const std::vector<Outcome> equal = {{1, 1}, {1, 1}};
  CHECK(pareto_front(equal) == Places{0});
}

TEST_CASE("random fronts: nothing on it is beaten, everything off it is") {
  std::mt19937 random(11);
  for (int round = 0; round < 200; ++round) {
    std::vector<Outcome> outcomes(1 + random() % 12);
    for (Outcome& outcome : outcomes) outcome = {double(random() % 6), double(random() % 6)};
    const Places front = pareto_front(outcomes);
    const auto beats = [](const Outcome& a, const Outcome& b) {
      return a.seconds <= b.seconds && a.error <= b.error &&
             (a.seconds < b.seconds || a.error < b.error);
    };
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      const bool on_front = std::find(front.begin(), front.end(), i) != front.end();
      bool beaten = false;
      bool has_earlier_equal = false;
      for (std::size_t k = 0; k < outcomes.size(); ++k) {
        beaten = beaten || beats(outcomes[k], outcomes[i]);
        has_earlier_equal =
            has_earlier_equal || (k < i && outcomes[k].seconds == outcomes[i].seconds &&
                                  outcomes[k].error == outcomes[i].error);
      }
      CHECK(on_front == (!beaten && !has_earlier_equal));
    }
    for (std::size_t k = 1; k < front.size(); ++k) {
      CHECK(outcomes[front[k - 1]].seconds < outcomes[front[k]].seconds);
    }
  }
}

TEST_CASE("a budget gets the most accurate that fits, an error the fastest that is good enough") {
  const std::vector<Outcome> outcomes = {{4, 1}, {1, 9}, {3, 6}, {2, 5}, {9, 0.5}};
  CHECK(best_within_seconds(outcomes, 3.5) == 3);
  CHECK(best_within_seconds(outcomes, 4) == 0);
  CHECK(best_within_seconds(outcomes, 100) == 4);
  CHECK_FALSE(best_within_seconds(outcomes, 0.5));
  CHECK(fastest_within_error(outcomes, 5.5) == 3);
  CHECK(fastest_within_error(outcomes, 1) == 0);
  CHECK(fastest_within_error(outcomes, 100) == 1);
  CHECK_FALSE(fastest_within_error(outcomes, 0.1));
}
