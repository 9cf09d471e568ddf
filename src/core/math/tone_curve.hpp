// A ToneCurve brightens linear light by the exposure and brings what is too bright for a display
// into its range, before gamma. It is that of a picture's settings, one channel at a time.
//
// The filmic curve is K. Narkowicz's fit to the display transform of the Academy Color Encoding
// System (ACES Filmic Tone Mapping Curve, 2016; in the public domain): x (a x + b) / (x (c x + d) +
// e), which rises everywhere. Here x is scaled so that middle grey, 0.18, stays what it is. Light
// is white from 10 on, which is 5.8 stops above that.
//
// Each channel has the curve for itself. So bright saturated colours turn pale, as on film. And an
// interval of a channel's light becomes one of what is shown, which claims of accuracy need.
#pragma once

#include "core/math/lanes.hpp"
#include "core/math/power.hpp"
#include "crt/settings.hpp"

namespace crt::core {

class ToneCurve {
 public:
  /// Leaves light as it is.
  ToneCurve() = default;
  explicit ToneCurve(const Settings& settings)
      : factor_(settings.exposure == 0 ? 1 : exponential2<double>(settings.exposure)),
        map_(settings.tone_map) {}

  bool is_identity() const { return factor_ == 1 && is_linear(); }
  /// Says whether what is shown is proportional to the light.
  bool is_linear() const { return map_ == ToneMap::none; }

  /// Returns what is shown of light, not clamped yet: above 1 is what a display clips. With a tone
  /// map, what is negative or NaN is 0.
  template <class Real>
  Real operator()(const Real& light) const {
    const Real exposed = light * factor_;
    return is_linear() ? exposed : filmic(exposed);
  }

 private:
  template <class Real>
  static Real filmic(const Real& light) {
    constexpr double scale_to_keep_grey = 0.7231708051011695;
    constexpr double white_beyond_doubt = 0x1p20;  // its square is far from infinity
    const Real x =
        select(light > 0.0,
               min(Real(light * scale_to_keep_grey), broadcast<Real>(white_beyond_doubt)), Real{});
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  }

  double factor_ = 1;
  ToneMap map_ = ToneMap::none;
};

}  // namespace crt::core
