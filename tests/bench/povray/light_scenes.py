"""Scenes of soft and of bounced light, in both languages. Surfaces are matt, and all is darker than
white, so that only the light is compared.

In POV-Ray's, Fine = 1 asks for the reference: a light of many points that is not adaptive, or a
radiosity that takes long."""

from dataclasses import dataclass

AREA_CRT = """
Settings {
  recursiondepth -> 0
  camera -> Camera { position -> vec3(0, 3.4, -8) pointing -> vec3(0, 0.6, 0) fov -> 40 }
  background -> Background { color -> rgb(0.1, 0.15, 0.25) }
  lights -> [RectangleLight {
    corner -> vec3(-4, 6, -4) edgeA -> vec3(3, 0, 0) edgeB -> vec3(0, 0, 3)
    color -> rgb(13, 13, 13) twosided -> true visible -> false
  }]
}
m = Macro (r, g, b) { return Material { color -> rgb(r, g, b) } }
Scene {
  Plane { normal -> vec3(0, 1, 0) position -> vec3(0, 0, 0) material -> m(0.7, 0.7, 0.65) }
  Sphere { center -> vec3(-1.6, 1, 0.5) radius -> 1 material -> m(0.7, 0.3, 0.2) }
  Box { cornerA -> vec3(0.2, 0, -0.4) cornerB -> vec3(1.6, 1.4, 1) material -> m(0.3, 0.5, 0.7) }
    - Sphere { center -> vec3(0.2, 1.4, -0.4) radius -> 0.9 material -> m(0.8, 0.7, 0.3) }
  Cylinder {
    from -> vec3(2.6, 0, 0.4) to -> vec3(2.6, 2.2, 0.4) radius -> 0.35 material -> m(0.4, 0.6, 0.3)
  }
  Torus {
    center -> vec3(-0.4, 0.2, -1.6) axis -> vec3(0, 1, 0) radius -> 0.6 thickness -> 0.2
    material -> m(0.6, 0.6, 0.6)
  }
  for (i in range(6)) {
    Sphere { center -> vec3(0.7 * i - 1.2, 0.25, -2.4) radius -> 0.25 material -> m(0.7, 0.6, 0.5) }
  }
}
"""

AREA_POV = """#version 3.7;
#ifndef (Fine) #declare Fine = 0; #end
global_settings { assumed_gamma 1 max_trace_level 2 ambient_light 0 }
#default { finish { ambient 0 diffuse 1 } }
camera { location <0, 3.4, -8> right x * 4 / 3 up y direction z * 1.37373871 look_at <0, 0.6, 0> }
background { rgb <0.1, 0.15, 0.25> }
light_source { <-2.5, 6, -2.5>, rgb 0.6
  #if (Fine) area_light x * 3, z * 3, 17, 17 jitter
  #else area_light x * 3, z * 3, 9, 9 adaptive 1 jitter #end
}
#macro M(R, G, B) texture { pigment { rgb <R, G, B> } } #end
plane { y, 0 M(0.7, 0.7, 0.65) }
sphere { <-1.6, 1, 0.5>, 1 M(0.7, 0.3, 0.2) }
difference {
  box { <0.2, 0, -0.4>, <1.6, 1.4, 1> M(0.3, 0.5, 0.7) }
  sphere { <0.2, 1.4, -0.4>, 0.9 M(0.8, 0.7, 0.3) }
}
cylinder { <2.6, 0, 0.4>, <2.6, 2.2, 0.4>, 0.35 M(0.4, 0.6, 0.3) }
torus { 0.6, 0.2 translate <-0.4, 0.2, -1.6> M(0.6, 0.6, 0.6) }
#for (I, 0, 5) sphere { <0.7 * I - 1.2, 0.25, -2.4>, 0.25 M(0.7, 0.6, 0.5) } #end
"""

# Places of the balls come from one rule in both languages, so that there are no tables here.
STUDIO_CRT = """
Settings {
  recursiondepth -> 0
  camera -> Camera { position -> vec3(0, 5, -9) pointing -> vec3(0, 0.4, 0) fov -> 40 }
  background -> Background { color -> rgb(0.1, 0.15, 0.25) }
  lights -> [
    RectangleLight {
      corner -> vec3(-7, 1, -4) edgeA -> vec3(0, 4, 0) edgeB -> vec3(0, 0, 5)
      color -> rgb(2.6, 2.4, 2.1) twosided -> true visible -> false
    },
    RectangleLight {
      corner -> vec3(6, 0.5, -2) edgeA -> vec3(0, 5, 0) edgeB -> vec3(0, 0, 2)
      color -> rgb(2, 2.4, 2.8) twosided -> true visible -> false
    },
    RectangleLight {
      corner -> vec3(-3, 6, -2) edgeA -> vec3(6, 0, 0) edgeB -> vec3(0, 0, 4)
      color -> rgb(0.7, 0.7, 0.7) twosided -> true visible -> false
    }
  ]
}
m = Macro (r, g, b) { return Material { color -> rgb(r, g, b) } }
Scene {
  Plane { normal -> vec3(0, 1, 0) position -> vec3(0, 0, 0) material -> m(0.7, 0.7, 0.65) }
  for (i in range(40)) {
    far = 0.62 * sqrt(i + 0.5)
    size = 0.16 + 0.03 * (i % 5)
    Sphere {
      center -> vec3(far * cos(2.4 * i), size, far * sin(2.4 * i)) radius -> size
      material -> m(0.3 + 0.1 * (i % 5), 0.7 - 0.1 * (i % 4), 0.4)
    }
  }
  for (i in range(6)) {
    Box {
      cornerA -> vec3(-0.15, 0, -0.15) cornerB -> vec3(0.15, 1.6, 0.15)
      material -> m(0.6, 0.6, 0.6)
    }
      <translate vec3(3.1 * cos(1.05 * i), 0, 2.6 * sin(1.05 * i))>
  }
}
"""

STUDIO_POV = """#version 3.7;
#ifndef (Fine) #declare Fine = 0; #end
global_settings { assumed_gamma 1 max_trace_level 2 ambient_light 0 }
#default { finish { ambient 0 diffuse 1 } }
camera { location <0, 5, -9> right x * 4 / 3 up y direction z * 1.37373871 look_at <0, 0.4, 0> }
background { rgb <0.1, 0.15, 0.25> }
#macro Soft(Place, Shade, A, B)
  light_source { Place, rgb Shade
    #if (Fine) area_light A, B, 15, 15 jitter #else area_light A, B, 9, 9 adaptive 1 jitter #end
  }
#end
Soft(<-7, 3, -1.5>, <0.18, 0.165, 0.145>, y * 4, z * 5)
Soft(<6, 3, -1>, <0.08, 0.095, 0.11>, y * 5, z * 2)
Soft(<0, 6, 0>, 0.08, x * 6, z * 4)
#macro M(R, G, B) texture { pigment { rgb <R, G, B> } } #end
plane { y, 0 M(0.7, 0.7, 0.65) }
#for (I, 0, 39)
  #declare Far = 0.62 * sqrt(I + 0.5);
  #declare Size = 0.16 + 0.03 * mod(I, 5);
  sphere { <Far * cos(2.4 * I), Size, Far * sin(2.4 * I)>, Size
    M(0.3 + 0.1 * mod(I, 5), 0.7 - 0.1 * mod(I, 4), 0.4) }
#end
#for (I, 0, 5)
  box { <-0.15, 0, -0.15>, <0.15, 1.6, 0.15> M(0.6, 0.6, 0.6)
    translate <3.1 * cos(1.05 * I), 0, 2.6 * sin(1.05 * I)> }
#end
"""

ROOM_CRT = """
Settings {
  recursiondepth -> 0
  indirect -> 4
  camera -> Camera { position -> vec3(0.3, 1.5, -1.85) pointing -> vec3(-0.1, 1.25, 0) fov -> 70 }
  background -> Background { color -> rgb(0, 0, 0) }
  lights -> [SphereLight {
    center -> vec3(0.2, 2.1, 0.2) radius -> 0.25 color -> rgb(6, 5.6, 5) visible -> false
  }]
}
m = Macro (r, g, b) { return Material { color -> rgb(r, g, b) } }
Scene {
  Box { cornerA -> vec3(-2, -0.1, -2) cornerB -> vec3(2, 0, 2) material -> m(0.5, 0.4, 0.3) }
  Box { cornerA -> vec3(-2, 2.7, -2) cornerB -> vec3(2, 2.8, 2) material -> m(0.75, 0.75, 0.72) }
  Box { cornerA -> vec3(-2.1, -1, -2) cornerB -> vec3(-2, 3, 2) material -> m(0.6, 0.2, 0.15) }
  Box { cornerA -> vec3(2, -1, -2) cornerB -> vec3(2.1, 3, 2) material -> m(0.2, 0.35, 0.55) }
  Box { cornerA -> vec3(-2, -1, 2) cornerB -> vec3(2, 3, 2.1) material -> m(0.7, 0.7, 0.66) }
  Box { cornerA -> vec3(-2, -1, -2.1) cornerB -> vec3(2, 3, -2) material -> m(0.7, 0.7, 0.66) }
  Box { cornerA -> vec3(-1.3, 0, 0.3) cornerB -> vec3(-0.5, 1.3, 1.1) material -> m(0.7, 0.7, 0.7) }
  Sphere { center -> vec3(0.7, 0.5, 0.5) radius -> 0.5 material -> m(0.7, 0.6, 0.3) }
  Sphere { center -> vec3(0, 0.3, -0.5) radius -> 0.3 material -> m(0.65, 0.65, 0.65) }
  Cylinder {
    from -> vec3(1.5, 0, -0.2) to -> vec3(1.5, 1, -0.2) radius -> 0.2 material -> m(0.3, 0.5, 0.3)
  }
}
"""

# A light of radiance L and radius r is as bright as L r^2 / d^2, and POV-Ray's as
# 2 c / (1 + (d / fade_distance)^2).
ROOM_POV = """#version 3.7;
#ifndef (Fine) #declare Fine = 0; #end
global_settings { assumed_gamma 1 max_trace_level 5 ambient_light 0
  radiosity {
    #if (Fine) pretrace_start 0.08 pretrace_end 0.01 count 800 error_bound 0.15 nearest_count 15
    #else pretrace_start 0.08 pretrace_end 0.01 count 200 error_bound 0.3 nearest_count 10 #end
    recursion_limit 4 low_error_factor 0.5 gray_threshold 0 brightness 1
  }
}
#default { finish { ambient 0 diffuse 1 } }
camera { location <0.3, 1.5, -1.85> right x * 4 / 3 up y direction z * 0.714074
  look_at <-0.1, 1.25, 0> }
light_source { <0.2, 2.1, 0.2>, rgb <6, 5.6, 5> * 0.25 * 0.25 / (2 * 0.02 * 0.02)
  fade_power 2 fade_distance 0.02 area_illumination on
  area_light x * 0.5, y * 0.5, 9, 9 adaptive 1 jitter circular orient
}
#macro M(R, G, B) texture { pigment { rgb <R, G, B> } } #end
box { <-2, -0.1, -2>, <2, 0, 2> M(0.5, 0.4, 0.3) }
box { <-2, 2.7, -2>, <2, 2.8, 2> M(0.75, 0.75, 0.72) }
box { <-2.1, -1, -2>, <-2, 3, 2> M(0.6, 0.2, 0.15) }
box { <2, -1, -2>, <2.1, 3, 2> M(0.2, 0.35, 0.55) }
box { <-2, -1, 2>, <2, 3, 2.1> M(0.7, 0.7, 0.66) }
box { <-2, -1, -2.1>, <2, 3, -2> M(0.7, 0.7, 0.66) }
box { <-1.3, 0, 0.3>, <-0.5, 1.3, 1.1> M(0.7, 0.7, 0.7) }
sphere { <0.7, 0.5, 0.5>, 0.5 M(0.7, 0.6, 0.3) }
sphere { <0, 0.3, -0.5>, 0.3 M(0.65, 0.65, 0.65) }
cylinder { <1.5, 0, -0.2>, <1.5, 1, -0.2>, 0.2 M(0.3, 0.5, 0.3) }
"""


@dataclass(frozen=True)
class LightScene:
    name: str
    about: str
    crt: str
    pov: str
    crt_reference: dict  # settings
    pov_reference: tuple[str, ...]  # antialiasing
    alike: bool  # the same light in both, so that one's reference is the other's, too


SCENES = (
    LightScene("area", "solids on a plane below a square light", AREA_CRT, AREA_POV,
               {"supersampling": 32}, ("+AM1", "+A0.0", "+R4"), False),
    LightScene("studio", "balls and posts below three large lights", STUDIO_CRT, STUDIO_POV,
               {"supersampling": 32}, ("+AM1", "+A0.0", "+R3"), False),
    LightScene("room", "a closed room with a ball of light", ROOM_CRT, ROOM_POV,
               {"supersampling": 40}, ("+AM1", "+A0.0", "+R2"), True),
)
