#pragma once

#include <cstdint>
#include <string>

namespace crt {

/// What the distance D in a light's falloff / D^2 is.
enum class FalloffModel {
  path,   ///< the whole way from the camera over all bounces to the light (the thesis's rule)
  light,  ///< from the lit point to the light
};

/// How close a call the geometry settles: see docs/numerics.md. Both answer the same question.
enum class Precision {
  standard,  ///< t within some roundings; the last bit is left to rounding right at a silhouette
  exact,     ///< hits and their order are right, t within 0.51 ulp (tori: 1); transforms are not
             ///< rounded
};

/// What a pixel is the mean of.
enum class PixelFilter {
  box,              ///< its square, every place alike
  blackman_harris,  ///< a bell around its middle, Settings::filter_width pixels wide
};

/// What Settings::compat can be beside 0.
inline constexpr int compat_2015 = 2015;

/// How a scene is rendered; everything that is neither geometry, light nor camera.
struct Settings {
  // What the picture's file says of it.
  std::string title{};
  std::string author{};
  std::string date{};
  std::string notes{};

  /// Size in pixels: each in [1, 65536], together at most 2^27.
  int width = 640;
  int height = 480;
  /// 8- and 16-bit files store clamp(c)^(1/gamma); in [0.1, 10].
  double gamma = 1;
  /// n x n rays a pixel, in [1, 64]; of no effect with a target error or a time budget.
  int supersampling = 1;
  /// Points of the lens for each of them, in [1, 65536]; 1 means no lens. With a target error or a
  /// time budget there are as many as samples, if this is more than 1.
  int dof_samples = 1;
  /// Above 0, each pixel gets samples until it is this near the truth: half of the width of the
  /// interval that holds it in 95 of 100 cases, in what a display shows, where 1/255 is a step of 8
  /// bits. In [0, 1].
  double target_error = 0;
  /// Above 0, the seconds that tracing may take: it stops at the end of a pass, the first of which
  /// takes what it takes, so that there is a picture. In [0, 1e6].
  double time_budget = 0;
  /// With one of them: how many samples a pixel gets at least and at most; powers of 2 in [4,
  /// 65536].
  int min_samples = 16;
  int max_samples = 1024;
  PixelFilter filter = PixelFilter::box;
  /// Pixels across, of filters other than the box; in [1, 16].
  double filter_width = 3;
  /// Bounces followed after the camera's ray, in [0, 256].
  int recursion_depth = 3;
  /// A ray whose share of the pixel is below this in every channel is not traced; in [0, 1].
  double min_weight = 1.0 / 1024;
  FalloffModel falloff_model = FalloffModel::path;
  /// Marks pixels with a channel above 1 in red.
  bool show_clip = false;
  /// Of the random numbers: another seed, another noise.
  std::uint64_t seed = 0;
  Precision precision = Precision::standard;
  /// 0, or compat_2015: the picture is formed as the program of that year formed it, see
  /// docs/compat.md. That is about the lens, panoramas, the places of the grid's samples and the
  /// levels of 8-bit files.
  int compat = 0;
};

}  // namespace crt
