// These functions measure for `crt trade`: how far a picture is from another as a viewer sees them,
// which part of a picture stands for the whole, and which of several settings are worth their time.
#pragma once

#include <crt/image.hpp>
#include <crt/render.hpp>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace crt::cli {

inline constexpr double steps_of_8_bits = 255;

/// A PictureError is in steps of an 8-bit picture, but not rounded to whole ones.
struct PictureError {
  double rmse = 0;  ///< root of the mean square over all pixels and red, green and blue
  double p999 = 0;  ///< 99.9 % of the pixels have no channel that is farther off
};

/// Returns how far two pictures of one size differ, as displays show them: after the exposure, tone
/// map and gamma of the reference, clamped to 0..1, in front of black.
PictureError displayed_difference(const Image& picture, const Image& reference);

/// Returns how far two pictures in several pieces differ.
PictureError displayed_difference(std::span<const Image> pictures,
                                  std::span<const Image> references);

/// Returns the mean of two pictures of one size, in linear light.
Image mean_of(const Image& a, const Image& b);

/// Returns parts of a picture that are as wide as it is and spread evenly from top to bottom.
/// Together they have about as many pixels as asked for. The result is the whole picture if that
/// has no more. None is lower than least_band_height, as adaptive rendering pays for a margin
/// around each.
std::vector<Region> bands_of(int width, int height, double pixels);
inline constexpr int least_band_height = 16;

/// An Outcome is what a setting costs, and what it gives.
struct Outcome {
  double seconds = 0;
  double error = 0;
};

/// Returns the places of those that no other beats in both, the fastest first. Among equal ones it
/// takes the first.
std::vector<std::size_t> pareto_front(std::span<const Outcome> outcomes);

/// Returns the most accurate one that takes no longer.
std::optional<std::size_t> best_within_seconds(std::span<const Outcome> outcomes, double seconds);

/// Returns the fastest one with no larger error.
std::optional<std::size_t> fastest_within_error(std::span<const Outcome> outcomes, double error);

}  // namespace crt::cli
