// A script to begin with, as `crt new` writes it and the studio offers it.
#pragma once

#include <string>
#include <string_view>

namespace crt::text {

/// Returns the script of a file. It says the file's name.
inline std::string first_script(std::string_view name) {
  constexpr std::string_view of_no_name = R"crt(-- A scene of CRT. Render it:  crt render @name@
-- Text behind two dashes is a comment. docs/language.md is the reference of the language.
import "crt/metals"  -- gold, copper, steel and others
import "crt/colors"  -- crimson, sky, navy and others

Settings {
    width -> 640
    height -> 480
    supersampling -> 3   -- 3 x 3 rays for each pixel make smooth edges
    recursiondepth -> 5  -- so often light is mirrored

    -- x is to the right, y up, and z away from you.
    camera -> Camera {
        position -> vec3(1.5, 2.2, -6)
        pointing -> vec3(0, 0.7, 0)
        fov -> 40
    }
    lights -> [
        PointLight { origin -> vec3(-5, 7, -5) color -> rgb(1, 0.95, 0.85) ambient -> 0.1 },
        PointLight { origin -> vec3(6, 4, -3) color -> rgb(0.25, 0.3, 0.4) }
    ]
    background -> Background { horizon -> rgb(0.9, 0.95, 1) sky -> sky }
}

-- Materials say what things are made of.
tiles = Material {
    color -> Checker { colorA -> rgb(0.7, 0.68, 0.62) colorB -> rgb(0.3, 0.32, 0.35) }
    reflectivity -> 0.1
}
paint = Material { color -> crimson specular -> 0.5 shininess -> 60 }

-- Solids are joined by +, cut from one another by -, and cut down to what they share by ^.
-- Where something was cut, the surface has the material of what cut it.
cube = Box { cornerA -> vec3(-1, -1, -1) cornerB -> vec3(1, 1, 1) material -> paint }
ball = Sphere { center -> vec3(0, 0, 0) radius -> 1.35 material -> paint }
drill = Cylinder { from -> vec3(0, -2, 0) to -> vec3(0, 2, 0) radius -> 0.6 material -> gold }
die = (cube ^ ball) - drill - drill <rotate vec3(90, 0, 0)> - drill <rotate vec3(0, 0, 90)>

-- A macro makes many things out of one: a ring of balls around the y axis.
ring = Macro (count, radius) {
    for (i in range(count)) {
        turn = 360.0 * i / count
        Sphere { center -> vec3(radius, 0.2, 0) radius -> 0.2 } <rotate vec3(0, turn, 0)>
    }
}

-- What stands in the Scene is seen.
Scene {
    Plane { normal -> vec3(0, 1, 0) position -> vec3(0, 0, 0) material -> tiles }
    die <rotate vec3(0, 30, 0), translate vec3(0, 1, 0)>
    ring(12, 2.2) <material copper>
}
)crt";
  constexpr std::string_view place = "@name@";
  std::string text(of_no_name);
  return text.replace(text.find(place), place.size(), name);
}

}  // namespace crt::text
