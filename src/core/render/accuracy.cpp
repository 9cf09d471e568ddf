#include "core/render/accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "core/shading/pixel_range.hpp"
#include "core/shading/sky.hpp"

namespace crt::core {

namespace {

/// By the "rule of three", the share of a pixel that N samples may all miss is, in 95 of 100 cases,
/// below this divided by N. Samples that are distributed evenly miss less.
/// Source: Hanley and Lippman-Hand, If nothing goes wrong, is everything all right?,
/// JAMA 249(13), 1983.
constexpr double rule_of_three = 3;

void report_unseen(RenderStats& stats) {
  stats.unseen_share = std::min(1.0, rule_of_three / static_cast<double>(stats.samples_min));
}

struct Brightness {
  static constexpr double white = 1;

  static double of(const Color& color) { return std::max({white, color.r, color.g, color.b}); }

  double operator()(const SolidBackground& background) const { return of(background.color); }
  double operator()(const GradientBackground& background) const {
    return std::max(of(background.horizon), of(background.sky));
  }
  double operator()(const PanoramaBackground& background) const {
    const FloatLanes most = pixel_range(background.image->pixels()).most;
    return of({most[0], most[1], most[2]});
  }
  double operator()(const SkyBackground& background) const {
    return std::max(white, Sky(background).brightest());
  }
};

}  // namespace

void report_measures(const PixelMeasures& measures, RenderStats& stats) {
  const auto [least, most] = std::minmax_element(measures.samples.begin(), measures.samples.end());
  stats.samples_min = *least;
  stats.samples_max = *most;
  const auto pixels = static_cast<double>(measures.samples.size());
  std::uint64_t samples = 0;
  for (const std::uint32_t count : measures.samples) samples += count;
  stats.samples_mean = static_cast<double>(samples) / pixels;
  report_unseen(stats);

  double squares = 0;
  for (const float half_width : measures.half_widths)
    squares += double{half_width} * double{half_width};
  stats.half_width_rms = std::sqrt(squares / pixels);
  std::vector<float> sorted = measures.half_widths;
  constexpr double share = 0.95;
  const auto place = static_cast<std::ptrdiff_t>(std::ceil(share * pixels)) - 1;
  std::nth_element(sorted.begin(), sorted.begin() + place, sorted.end());
  stats.half_width_95 = double{sorted[static_cast<std::size_t>(place)]};
  stats.half_width_max = double{*std::max_element(sorted.begin(), sorted.end())};
}

std::uint64_t samples_of_grid(const Settings& settings, bool lens) {
  const auto side = static_cast<std::uint64_t>(settings.supersampling);
  return side * side * (lens ? static_cast<std::uint64_t>(settings.dof_samples) : std::uint64_t{1});
}

void report_grid(const Settings& settings, bool lens, RenderStats& stats) {
  stats.samples_min = stats.samples_max = samples_of_grid(settings, lens);
  stats.samples_mean = static_cast<double>(stats.samples_min);
  report_unseen(stats);
}

void forget_accuracy(RenderStats& stats) {
  stats.half_width_rms = stats.half_width_95 = stats.half_width_max = 0;
  stats.pixels_unresolved = 0;
}

double brightest_of(const Background& background) {
  return std::visit(Brightness{}, background);
}

double cutoff_mean(std::uint64_t units, double brightest, std::uint64_t pixels) {
  return brightest * (CutoffSum::unit * static_cast<double>(units)) / static_cast<double>(pixels);
}

std::uint64_t cutoff_units(double mean, double brightest, std::uint64_t pixels) {
  // The roundings are far smaller than a unit.
  return static_cast<std::uint64_t>(
      std::llround(mean * static_cast<double>(pixels) / brightest / CutoffSum::unit));
}

void report_cutoff(const CutoffSum& cutoff, const Background& background, RenderStats& stats) {
  if (cutoff.most == 0) return;
  const double brightest = brightest_of(background);
  stats.cutoff_mean = cutoff_mean(cutoff.units, brightest, stats.pixels);
  stats.cutoff_max = brightest * cutoff.most;
}

}  // namespace crt::core
