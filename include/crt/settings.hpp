#pragma once

#include <cstdint>
#include <string>

namespace crt {

/// Says what the distance D in a light's falloff / D^2 is.
enum class FalloffModel {
  path,   ///< the path from the camera over all bounces to the light (the thesis's rule)
  light,  ///< from the lit point to the light
};

/// Says how much of a light's ambient share a surface sends back.
enum class AmbientModel {
  light,    ///< all that it does not mirror, whatever its colour (the thesis's rule)
  surface,  ///< that times its colour and its opacity: what is black stays black
};

/// Says how light that is too bright for a display is brought into its range.
enum class ToneMap {
  none,    ///< it is clipped
  filmic,  ///< by a curve as that of film: highlights fade out, middle grey stays (docs/image.md)
};

/// Says what is seen along rays that are not followed any more, as recursion_depth ends them.
enum class Cutoff {
  black,       ///< nothing (as in the thesis)
  background,  ///< the background in their direction
};

/// Says how close calls of the geometry are decided: see docs/numerics.md. Both values answer the
/// same question.
enum class Precision {
  standard,  ///< t within some roundings; right at a silhouette, rounding decides the last bit
  exact,     ///< hits and their order are right, t within 0.51 ulp (tori: 1); transforms are not
             ///< rounded
};

/// Says what a pixel is the mean of.
enum class PixelFilter {
  box,              ///< its square, with equal weights
  blackman_harris,  ///< a bell around its middle, Settings::filter_width pixels wide
};

/// Says what a scene unit is. Measures are printed with it.
enum class Unit {
  m,   ///< a metre
  cm,  ///< a centimetre
  mm,  ///< a millimetre
  in,  ///< an inch
};

/// Returns how many metres a unit is.
constexpr double metres_of(Unit unit) {
  switch (unit) {
    case Unit::m:
      return 1;
    case Unit::cm:
      return 0.01;
    case Unit::mm:
      return 0.001;
    case Unit::in:
      break;
  }
  return 0.0254;
}

/// This is the one value of Settings::compat beside 0.
inline constexpr int compat_2015 = 2015;

/// Settings say how a scene is rendered: everything that is neither geometry, light nor camera.
struct Settings {
  // These texts go into the picture's file.
  std::string title{};
  std::string author{};
  std::string date{};
  std::string notes{};

  /// The size is in pixels: each in [1, 65536], together at most 2^27.
  int width = 640;
  int height = 480;
  /// Files of 8 bits store c^(1/gamma) of clamped light c. It is in [0.1, 10].
  double gamma = 2.2;
  /// Files of 8 bits, and what is shown, are brighter by so many stops: light counts 2^exposure
  /// times. Float files hold light as it is. It is in [-100, 100].
  double exposure = 0;
  /// It is applied where the exposure is, after it and before gamma.
  ToneMap tone_map = ToneMap::none;
  /// There are n x n rays a pixel, with n in [1, 64]. It has no effect with a target error or a
  /// time budget.
  int supersampling = 1;
  /// This is the number of points of the lens for each of these rays, in [1, 65536]; 1 means no
  /// lens. If it is more than 1, a target error or a time budget takes as many as samples.
  int dof_samples = 1;
  /// This is the number of samples that each of these rays takes of what lights a point, where that
  /// has a size. It is in [1, 1024].
  int light_samples = 1;
  /// Above 0, each pixel gets samples until it is this near the truth. That is half of the width of
  /// the interval that holds it in 95 of 100 cases, in what a display shows, where 1/255 is a step
  /// of 8 bits. It is in [0, 1].
  double target_error = 0;
  /// Above 0, these are the seconds that tracing may take. It stops at the end of a pass. The first
  /// pass is always completed, so that there is a picture. It is in [0, 1e6].
  double time_budget = 0;
  /// With a target error or a time budget, this is the least number of samples of a pixel, and
  /// max_samples the greatest. Both are powers of 2 in [4, 65536].
  int min_samples = 16;
  int max_samples = 1024;
  PixelFilter filter = PixelFilter::box;
  /// This is the width in pixels of filters other than the box, in [1, 16].
  double filter_width = 3;
  /// This is the number of bounces followed after the camera's ray, in [0, 256].
  int recursion_depth = 3;
  /// This is the number of diffuse bounces that light is followed over, in [0, 64]. Above 0 there
  /// is no ambient light.
  int indirect = 0;
  /// A ray whose share of the pixel is below this in every channel is not traced. It is in [0, 1].
  double min_weight = 1.0 / 1024;
  /// Above 0, light that comes by bounces counts as this bright at most. So there are no fireflies,
  /// and nothing is claimed of a picture's accuracy.
  double clamp = 0;
  /// The finished picture is freed of noise by a filter (see docs/image.md), and so are snapshots.
  /// Nothing is claimed of its accuracy then.
  bool denoise = false;
  Cutoff cutoff = Cutoff::background;
  FalloffModel falloff_model = FalloffModel::light;
  AmbientModel ambient_model = AmbientModel::surface;
  /// A scene without lights, and without surfaces that give light off, is lit from the camera, so
  /// that it shows something. With false it is black but for mirrors, glass and the background, as
  /// it is with compat_2015.
  bool head_light = true;
  /// Marks pixels in red of which a channel is brighter than 8-bit files can say, as exposed.
  bool show_clip = false;
  /// This is the seed of the random numbers. Another seed gives other noise.
  std::uint64_t seed = 0;
  Precision precision = Precision::standard;
  /// 0 is the default. With compat_2015 the picture is formed as the program of that year formed
  /// it, see docs/compat.md. That concerns the lens, panoramas, the places of the grid's samples
  /// and the levels of 8-bit files. It leaves the other settings: see settings_of_2015().
  int compat = 0;
  /// What a scene unit is. It changes neither the geometry nor the picture.
  Unit unit = Unit::m;
  /// The number of frames of an animation, t = 0 to frames - 1, in [0, 1000000]. 0 says nothing. A
  /// single picture does not depend on it.
  int frames = 0;
};

/// Returns the settings that a script with `compat -> 2015` begins with. Files store light as it is
/// (gamma 1), lights fall off and are ambient by the thesis's rules, and rays end in black.
inline Settings settings_of_2015() {
  Settings settings;
  settings.gamma = 1;
  settings.cutoff = Cutoff::black;
  settings.falloff_model = FalloffModel::path;
  settings.ambient_model = AmbientModel::light;
  settings.compat = compat_2015;
  return settings;
}

}  // namespace crt
