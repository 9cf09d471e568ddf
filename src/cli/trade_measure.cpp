#include "cli/trade_measure.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace crt::cli {

namespace {

/// Returns the value that `share` of them do not exceed.
double quantile(std::vector<double>& values, double share) {
  const double place = std::ceil(share * static_cast<double>(values.size())) - 1;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max(place, 0.0));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Says whether the first outcome beats the second or is its equal.
bool is_no_worse(const Outcome& a, const Outcome& b) {
  return a.seconds <= b.seconds && a.error <= b.error;
}

}  // namespace

PictureError displayed_difference(std::span<const Image> pictures,
                                  std::span<const Image> references) {
  double squares = 0;
  std::vector<double> worst_channels;
  for (std::size_t piece = 0; piece < pictures.size(); ++piece) {
    const std::span<const float> a = pictures[piece].pixels();
    const std::span<const float> b = references[piece].pixels();
    const Settings& settings = references[piece].settings();
    for (std::size_t pixel = 0; pixel < a.size(); pixel += 4) {
      double worst = 0;
      for (std::size_t i = pixel; i < pixel + 3; ++i) {
        const double steps = steps_of_8_bits * std::abs(displayed(double{a[i]}, settings) -
                                                        displayed(double{b[i]}, settings));
        squares += steps * steps;
        worst = std::max(worst, steps);
      }
      worst_channels.push_back(worst);
    }
  }
  if (worst_channels.empty()) return {};
  constexpr double nearly_all = 0.999;
  const double values = 3 * static_cast<double>(worst_channels.size());
  return {.rmse = std::sqrt(squares / values), .p999 = quantile(worst_channels, nearly_all)};
}

PictureError displayed_difference(const Image& picture, const Image& reference) {
  return displayed_difference(std::span(&picture, 1), std::span(&reference, 1));
}

Image mean_of(const Image& a, const Image& b) {
  Image mean = a;
  for (std::size_t i = 0; i < mean.pixels().size(); ++i) {
    mean.pixels()[i] = static_cast<float>((double{a.pixels()[i]} + double{b.pixels()[i]}) / 2);
  }
  return mean;
}

std::vector<Region> bands_of(int width, int height, double pixels) {
  const double rows = std::ceil(pixels / width);
  if (rows >= height) return {{0, 0, width, height}};
  const int count = static_cast<int>(std::max(std::floor(rows / least_band_height), 1.0));
  const int band_height =
      static_cast<int>(std::max(std::ceil(rows / count), double{least_band_height}));
  if (count * band_height >= height) return {{0, 0, width, height}};
  std::vector<Region> bands;
  for (int i = 0; i < count; ++i) {
    // Each band is in the middle of its share of the height.
    const double middle = (i + 0.5) * height / count;
    const int top = static_cast<int>(middle - 0.5 * band_height);
    bands.push_back({0, std::clamp(top, 0, height - band_height), width, band_height});
  }
  return bands;
}

std::vector<std::size_t> pareto_front(std::span<const Outcome> outcomes) {
  std::vector<std::size_t> order(outcomes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Outcome& one = outcomes[a];
    const Outcome& other = outcomes[b];
    return one.seconds != other.seconds ? one.seconds < other.seconds : one.error < other.error;
  });
  std::vector<std::size_t> front;
  for (const std::size_t next : order) {
    if (front.empty() || !is_no_worse(outcomes[front.back()], outcomes[next]))
      front.push_back(next);
  }
  return front;
}

std::optional<std::size_t> best_within_seconds(std::span<const Outcome> outcomes, double seconds) {
  std::optional<std::size_t> best;
  for (const std::size_t next : pareto_front(outcomes)) {
    if (outcomes[next].seconds <= seconds) best = next;
  }
  return best;
}

std::optional<std::size_t> fastest_within_error(std::span<const Outcome> outcomes, double error) {
  const std::vector<std::size_t> front = pareto_front(outcomes);
  const auto first = std::find_if(front.begin(), front.end(),
                                  [&](std::size_t next) { return outcomes[next].error <= error; });
  return first == front.end() ? std::nullopt : std::optional(*first);
}

}  // namespace crt::cli
