#pragma once

namespace crt::core {

/// What a scene uses. What it does not use must cost it nothing: the ray loop asks here first.
struct Features {
  bool lights = false;
  bool ambient = false;       ///< some light has an ambient share
  bool shadows = false;       ///< some light could be hidden from something that it lights
  bool reflection = false;    ///< some material mirrors
  bool transparency = false;  ///< some material lets light through
  bool absorption = false;    ///< some transparent material absorbs
  bool patterns = false;      ///< some material's colour is a pattern
  bool bumps = false;
  bool lens = false;  ///< aperture > 0 and more than one sample of it
  bool csg = false;
};

}  // namespace crt::core
