// The tests of the command run these scripts.
#pragma once

#include <string>

namespace crt::test {

/// This script shows a ball before the camera, in 16 x 12 pixels. It prints t and n (3), and n is
/// the ball's height.
inline const std::string ball_script = R"(n = 3
print("t is " + t)
print("n is " + n)
Settings {
  width -> 16 height -> 12
  title -> "A ball"
  camera -> Camera { position -> vec3(0, 0, -4) pointing -> vec3(0, 0, 0) }
  lights -> [ParallelLight {
    from -> vec3(0, 5, -5) pointing -> vec3(0, 0, 0) color -> rgb(1, 1, 1) }]
}
Scene {
  Sphere { center -> vec3(0, n - 3, 0) radius -> 1.0 }
}
)";

/// This ball grows with t.
inline const std::string moving_script = R"(Settings {
  width -> 4
  height -> 4
  camera -> Camera { position -> vec3(0, 0, -9) pointing -> vec3(0, 0, 0) }
  lights -> [PointLight { origin -> vec3(3, 5, -9) color -> rgb(1, 1, 1) }]
}
Scene { Sphere { center -> vec3(0, 0, 0) radius -> 1 + t } }
)";

/// This picture is done at once at t = 0, and takes minutes afterwards, so that it can be
/// interrupted.
inline const std::string endless_script = R"(side = t < 0.5 ? 4 : 8000
Settings {
  width -> side
  height -> side
  supersampling -> 64
  camera -> Camera { position -> vec3(0, 0, -4) pointing -> vec3(0, 0, 0) }
}
Scene {
  Sphere { center -> vec3(0, 0, 0) radius -> 1.0 }
}
)";

/// These rays go to and fro between mirrors. A pass takes seconds, though its pixels are few.
inline const std::string mirrors_script = R"(m = Material {
  color -> rgb(1, 1, 1)
  reflectivity -> 1.0
  diffuse -> 0.0
}
Settings {
  width -> 400
  height -> 400
  recursiondepth -> 250
  minweight -> 0.0
  camera -> Camera { position -> vec3(0.1, 0.05, 0) pointing -> vec3(0, 0, 1) }
}
Scene {
  Plane { position -> vec3(0, 0, 4) normal -> vec3(0, 0, -1) material -> m }
  Plane { position -> vec3(0, 0, -4) normal -> vec3(0, 0, 1) material -> m }
  Sphere { center -> vec3(0, 0, 2) radius -> 0.5 material -> m }
}
)";

}  // namespace crt::test
