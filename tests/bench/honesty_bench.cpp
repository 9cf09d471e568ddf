// Compares claimed half-widths with achieved errors in one class of pixels, of parts of several
// scenes. Writes JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <crt/script.hpp>
#include <exception>
#include <iostream>
#include <map>
#include <stdexcept>

#include "binomial.hpp"
#include "honesty.hpp"

namespace crt::bench {

namespace {

constexpr const char* usage =
    "usage: bench_honesty CLASS SEEDS SAMPLES (SCENE.crt WIDTH HEIGHT GAMMA FIRST LAST X Y W "
    "H)...\n"
    "CLASS is flat, edge, sub-pixel, defocused or special: FIRST to LAST are then the ids of what "
    "is meant.\n"
    "SAMPLES, a power of 2, are those that the truth is made of, twice.";
constexpr std::size_t arguments_of_part = 10;
constexpr double steps_of_8_bits = 255;
/// This much may come from the truth's own error and from rounding.
constexpr double tolerance = 0.1 / steps_of_8_bits;
constexpr double targets[] = {8, 4, 2};
/// Claims that differ by a factor of less than 2^(1/2) share a bin.
constexpr double bins_of_doubling = 2;

using Arguments = std::vector<std::string>;

PixelClass class_named(const std::string& name) {
  const std::map<std::string, PixelClass> classes = {{"flat", PixelClass::flat},
                                                     {"edge", PixelClass::edge},
                                                     {"sub-pixel", PixelClass::sub_pixel},
                                                     {"defocused", PixelClass::defocused},
                                                     {"special", PixelClass::special}};
  const auto found = classes.find(name);
  if (found == classes.end())
    throw std::invalid_argument(fmt::format("no class {}\n{}", name, usage));
  return found->second;
}

/// Returns the pixels of the class in the part of a scene that ten arguments give.
TruePixels pixels_of_part(const Arguments& part, PixelClass wanted, int samples) {
  ScriptOptions options;
  options.limits.steps = 1'000'000'000;
  options.settings = {{"width", part[1]}, {"height", part[2]}, {"gamma", part[3]}};
  const ScriptResult result = run_script_file(part[0], options);
  if (!result.scene) throw std::runtime_error(part[0] + " is no scene");
  const EntityRange interest{static_cast<std::uint32_t>(std::stoul(part[4])),
                             static_cast<std::uint32_t>(std::stoul(part[5]))};
  const Region region{std::stoi(part[6]), std::stoi(part[7]), std::stoi(part[8]),
                      std::stoi(part[9])};
  std::vector<bool> chosen;
  for (const PixelClass one : classes_of(*result.scene, region, interest))
    chosen.push_back(one == wanted);
  return true_pixels(*result.scene, region, std::move(chosen), samples);
}

/// A Bin holds errors of pixels that claim about the same.
struct Bin {
  std::vector<double> errors;
  double claims = 0;  ///< sum
};
using Bins = std::map<int, Bin>;

void add_to_bins(const std::vector<Trial>& trials, Bins& bins) {
  for (const Trial& trial : trials) {
    if (trial.claimed <= 0) continue;
    const double place = bins_of_doubling * std::log2(trial.claimed * steps_of_8_bits);
    Bin& bin = bins[static_cast<int>(std::lround(place))];
    bin.errors.push_back(trial.error);
    bin.claims += trial.claimed;
  }
}

std::string text_of_bin(Bin& bin) {
  const auto count = static_cast<double>(bin.errors.size());
  double squares = 0;
  for (const double error : bin.errors) squares += error * error;
  std::sort(bin.errors.begin(), bin.errors.end());
  const double within_95 = bin.errors[static_cast<std::size_t>(std::ceil(0.95 * count)) - 1];
  return fmt::format(R"({{"count": {}, "claimed": {}, "rms": {}, "within_95": {}}})",
                     bin.errors.size(), bin.claims / count * steps_of_8_bits,
                     std::sqrt(squares / count) * steps_of_8_bits, within_95 * steps_of_8_bits);
}

/// Successes counts how often each pixel was as near the truth as it claimed.
struct Successes {
  std::int64_t trials = 0;
  std::int64_t within = 0;
  double claims = 0;       ///< sum
  double worst_pixel = 1;  ///< the share of its seeds
  std::int64_t pixels = 0;

  void add(const std::vector<Trial>& part, int seeds) {
    std::map<std::size_t, int> of_pixels;
    for (const Trial& trial : part) {
      const bool is_within = trial.error <= trial.claimed + tolerance;
      of_pixels[trial.pixel] += is_within ? 1 : 0;
      within += is_within ? 1 : 0;
      claims += trial.claimed;
    }
    trials += static_cast<std::int64_t>(part.size());
    pixels += static_cast<std::int64_t>(of_pixels.size());
    for (const auto& [pixel, count] : of_pixels) {
      worst_pixel = std::min(worst_pixel, static_cast<double>(count) / seeds);
    }
  }

  std::string text(double steps) const {
    return fmt::format(
        R"({{"steps": {}, "pixels": {}, "trials": {}, "within": {}, "low": {}, "claimed": {}, )"
        R"("worst_pixel": {}}})",
        steps, pixels, trials, within, test::clopper_pearson_low(within, trials),
        claims / static_cast<double>(std::max<std::int64_t>(trials, 1)) * steps_of_8_bits,
        worst_pixel);
  }
};

std::string measured(const Arguments& arguments) {
  if (arguments.size() < 3 + arguments_of_part || (arguments.size() - 3) % arguments_of_part != 0) {
    throw std::invalid_argument(usage);
  }
  const PixelClass wanted = class_named(arguments[0]);
  const int seeds = std::stoi(arguments[1]);
  const int samples = std::stoi(arguments[2]);
  std::vector<TruePixels> parts;
  double uncertainty = 0;
  for (auto part = arguments.begin() + 3; part != arguments.end(); part += arguments_of_part) {
    parts.push_back(pixels_of_part(Arguments(part, part + arguments_of_part), wanted, samples));
    uncertainty = std::max(uncertainty, parts.back().uncertainty);
  }
  std::vector<std::string> rows;
  Bins bins;
  for (const double steps : targets) {
    Successes successes;
    for (const TruePixels& pixels : parts) {
      const std::vector<Trial> trials = trials_of(pixels, steps / steps_of_8_bits, seeds);
      successes.add(trials, seeds);
      add_to_bins(trials, bins);
    }
    rows.push_back(successes.text(steps));
    std::cerr << fmt::format("{}: {}\n", arguments[0], rows.back());
  }
  std::vector<std::string> bin_texts;
  for (auto& [place, bin] : bins) bin_texts.push_back(text_of_bin(bin));
  return fmt::format(
      R"({{"seeds": {}, "samples": {}, "uncertainty": {}, "targets": [{}], "bins": [{}]}})", seeds,
      2 * samples, uncertainty * steps_of_8_bits, fmt::join(rows, ", "),
      fmt::join(bin_texts, ", "));
}

}  // namespace

}  // namespace crt::bench

int main(int argc, char** argv) try {
  std::cout << crt::bench::measured({argv + 1, argv + argc}) << '\n';
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
