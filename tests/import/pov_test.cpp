// Scenes of POV-Ray become scripts: what expressions give, and what objects are made of.
#include <cmath>
#include <numbers>

#include "import/imported.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double pi = std::numbers::pi;

/// Returns the radius of a sphere that is given by an expression, behind some declarations.
std::string radius_of(const std::string& expression, const std::string& before = "") {
  const Imported scene = pov(before + "\nsphere { 0, " + expression + " }");
  const std::size_t begin = scene.script.find("radius -> ");
  REQUIRE(begin != std::string::npos);
  const std::size_t end = scene.script.find(' ', begin + 10);
  return scene.script.substr(begin + 10, end - begin - 10);
}

std::string messages_of(const std::string& text) {
  return said(importing::import_pov(text, "test.pov").diagnostics);
}

}  // namespace

TEST_CASE("expressions have the values that POV-Ray gives them") {
  CHECK(radius_of("1 + 2 * 3") == "7");
  CHECK(radius_of("(1 + 2) * 3 - -1") == "10");
  CHECK(radius_of("<1, 2, 3>.y") == "2");
  CHECK(radius_of("vlength(3*x + 4*y)") == "5");
  CHECK(radius_of("vdot(<1, 2, 3>, <4, 5, 6>)") == "32");
  CHECK(radius_of("vrotate(x, 90*z).y") == "1");
  CHECK(radius_of("vcross(x, y).z") == "1");
  CHECK(radius_of("max(1, 5, 3) + min(2, 4)") == "7");
  CHECK(radius_of("(2 > 1 & 3 != 4 ? 8 : 9)") == "8");
  CHECK(radius_of("pow(2, 10) / 4") == "256");
  CHECK(radius_of("select(-1, 5, 6, 7)") == "5");
  CHECK(radius_of("strlen(concat(\"ab\", str(2.5, 0, 2)))") == "6");
  CHECK(radius_of("val(\"2.5\")") == "2.5");
  CHECK(radius_of("color rgb <0.5, 0.25, 1> .blue", "") == "1");
  CHECK(radius_of("A[1][0]", "#declare A = array[2][2] { {1, 2}, {3, 4} }") == "3");
  CHECK(radius_of("dimension_size(A, 1)", "#declare A = array[7]") == "7");
}

TEST_CASE("random numbers are those of POV-Ray") {
  // `povray` has printed these with #debug.
  CHECK(radius_of("int(rand(S) * 1e9)", "#declare S = seed(0);") == "2874");
  CHECK(radius_of("int(rand(S) * 1e9)", "#declare S = seed(0); #declare A = rand(S);") ==
        "466563684");
  CHECK(radius_of("int(rand(S) * 1e9)", "#declare S = seed(-7);") == "46072868");
}

TEST_CASE("directives are followed") {
  CHECK(radius_of("S",
                  "#declare S = 0; #declare I = 0; #while (I < 5) #declare S = S + I; "
                  "#declare I = I + 1; #end") == "10");
  CHECK(radius_of("S", "#declare S = 0; #for (I, 1, 3) #declare S = S + I; #end") == "6");
  CHECK(radius_of("S",
                  "#if (0) #declare S = 1; #elseif (1) #declare S = 2; #else #declare S = 3; "
                  "#end") == "2");
  CHECK(radius_of("S", "#ifndef (S) #declare S = 4; #end #ifdef (Q) #declare S = 5; #end") == "4");
  CHECK(radius_of("S",
                  "#switch (3) #case (1) #declare S = 1; #break #range (2, 4) #declare S = 9; "
                  "#break #else #declare S = 7; #end") == "9");
  CHECK(radius_of("Twice(3) + 1", "#macro Twice(A) #local B = A * 2; B #end") == "7");
  CHECK(radius_of("S",
                  "#declare S = 0; #for (I, 1, 9) #if (I = 4) #break #end #declare S = I; "
                  "#end") == "3");
}

TEST_CASE("objects become those of scripts") {
  const Imported parts =
      pov("box { <-1, -1, -1>, 1 }\ncylinder { 0, 2*y, 1 }\ncone { 0, 1, 3*y, 0 }\n"
          "torus { 2, 0.5 }\nsuperellipsoid { <0.5, 0.5> }\n"
          "quadric { <1, 1, 1>, <0, 0, 0>, <0, 0, 0>, -4 }\n"
          "prism { linear_spline 0, 2, 5, <0, 0>, <3, 0>, <3, 1>, <0, 1>, <0, 0> }\n"
          "lathe { linear_spline 3, <0, 0>, <2, 0>, <0, 3> }\n"
          "mesh { triangle { 0, x, y } triangle { 0, y, z } triangle { 0, z, x } "
          "triangle { x, z, y } }");
  const double volumes[] = {8, 2 * pi, pi, 2 * pi * 2 * pi / 4, 0, 32 * pi / 3, 6, 4 * pi, 1.0 / 6};
  REQUIRE(parts.scene.entities.size() == 9);
  for (std::size_t i = 0; i < 9; ++i) {
    CAPTURE(i);
    if (volumes[i] == 0) continue;
    const Interval found = crt::volume(parts.scene.entities[i], {.relative_width = 1e-3});
    CHECK(found.lower <= volumes[i] * (1 + 1e-9));
    CHECK(found.upper >= volumes[i] * (1 - 1e-9));
  }
}

TEST_CASE("solids that are inverse are cut off, and differences are what is left") {
  const std::string ball = "sphere { 0, 1 }";
  CHECK(std::abs(pov("difference { box { -1, 1 } " + ball + " }").volume() - (8 - 4 * pi / 3)) <
        1e-3);
  CHECK(std::abs(pov("intersection { box { -1, 1 } sphere { 0, 1 inverse } }").volume() -
                 (8 - 4 * pi / 3)) < 1e-3);
  CHECK(std::abs(pov("merge { " + ball + " sphere { 3*x, 1 } }").volume() - 8 * pi / 3) < 1e-3);
}

TEST_CASE("transforms are applied in their order, and turns are left-handed") {
  const Imported scene = pov("box { 0, <1, 2, 3> rotate 90*z translate 5*x }");
  const BoundingBox box = tight_bounding_box(scene.scene.entities.at(0));
  CHECK(std::abs(box.lower.x - 3) < 1e-5);
  CHECK(std::abs(box.upper.y - 1) < 1e-5);
  const Imported moved =
      pov("#declare T = transform { scale 2 translate 3*y };\n"
          "box { 0, 1 transform T }\nbox { 0, 1 matrix <1, 0, 0, 0, 1, 0, 0, 0, "
          "1, 0, 0, 7> }");
  CHECK(std::abs(tight_bounding_box(moved.scene.entities.at(0)).upper.y - 5) < 1e-5);
  CHECK(std::abs(tight_bounding_box(moved.scene.entities.at(1)).upper.z - 8) < 1e-5);
}

TEST_CASE("textures become materials that are called as they were declared") {
  const Imported scene =
      pov("#declare Shiny = texture { pigment { color rgb <1, 0.5, 0> } finish { phong 0.8 "
          "reflection 0.2 } }\nsphere { 0, 1 texture { Shiny } }\nsphere { 0, 2 pigment { rgbt "
          "<1, 1, 1, 0.75> } interior { ior 1.5 } }");
  CHECK(scene.says("shiny = Material { color -> rgb(1, 0.5, 0) reflectivity -> 0.2"));
  CHECK(scene.says("transparency -> 0.75 refractiveindex -> 1.5"));
  CHECK(scene.says("<material shiny>"));
  CHECK(!pov("#declare Unused = sphere { 0, 1 pigment { rgb 0.125 } };\nsphere { 0, 2 }")
             .says("0.125"));
  CHECK(pov("#declare Gold = rgb <1, 0.5, 0>;\nsphere { 0, 1 pigment { Gold filter 0.75 } }")
            .says("Material { color -> rgb(1, 0.5, 0) transparency -> 0.75"));
}

TEST_CASE("a camera sees as much as POV-Ray's") {
  const Imported scene =
      pov("#version 3.7;\ncamera { location <0, 1, -5> look_at y angle 60 right x*2 up y }\n"
          "light_source { <-5, 9, -5>, rgb 0.5 }\nlight_source { 9*y rgb 1 spotlight point_at 0 "
          "radius 10 falloff 15 }\nsphere { 0, 1 }");
  CHECK(scene.says("width -> 800\n    height -> 400"));
  const double fov = 2 * std::atan(std::tan(30 * pi / 180) / 2) * 180 / pi;
  CHECK(std::abs(scene.scene.camera.fov * 180 / pi - fov) < 1e-3);
  CHECK(
      scene.says("SpotLight { origin -> vec3(0, 9, 0) pointing -> vec3(0, 0, 0) color -> rgb(1, "
                 "1, 1) angle -> 30 penumbra -> 5"));
  CHECK(!scene.says("gamma"));
}

TEST_CASE("declared objects have their names, and loops are unrolled") {
  const Imported scene =
      pov("#declare Ball_One = union { sphere { 0, 1 } box { 2, 3 } };\n#for (I, 0, 3)\nobject { "
          "Ball_One translate I*5*x }\n#end");
  CHECK(scene.scene.entities.size() == 4);
  CHECK(scene.says("\nballOne = "));
  CHECK(scene.says("ballOne <translate vec3(15, 0, 0), material "));
}

TEST_CASE("elements of arrays are objects and textures, and directives stand before values") {
  const Imported scene =
      pov("#declare A = array[2];\n#declare A[1] = sphere { 0, 3 };\n#declare T = array[1] { "
          "texture { pigment { rgb <1, 0, 0.5> } } };\n#declare S = #if (1) 2; #else 3; #end\n"
          "object { A[1] scale S texture { T[0] } }");
  CHECK(scene.says("Sphere { center -> vec3(0, 0, 0) radius -> 3 }"));
  CHECK(scene.says("<scale 2, material paint1>"));
  CHECK(scene.says("color -> rgb(1, 0, 0.5)"));
  CHECK(
      pov("plane { y, 0 texture { tiles { texture { pigment { rgb 1 } } tile2 texture { pigment { "
          "rgb 0 } } } } }")
          .says("Checker { colorA -> rgb(1, 1, 1) colorB -> rgb(0, 0, 0)"));
}

TEST_CASE("what is not understood is listed with its place") {
  CHECK(messages_of("sphere { 0, 1 }\nisosurface { function { x } }") ==
        "2:12: error: 'isosurface' is not understood\n");
  CHECK(messages_of("sphere { 0, 1 finish { iridescence 1 } }\nfog { distance 3 }") ==
        "1:24: warning: 'iridescence' of a finish is not understood\n"
        "2:1: warning: 'fog' is not understood\n");
  CHECK(messages_of("sphere { 0, Foo }") == "1:13: error: 'Foo' is not defined\n");
  CHECK(messages_of("#include \"nowhere.inc\"\nsphere { 0, 1 }") ==
        "1:1: error: there is no file 'nowhere.inc' beside the scene or in a folder of "
        "--include\n");
}

TEST_CASE("a scene that never ends, or is too deep, is an error") {
  CHECK(messages_of("#while (1)\n#end").find("takes over 20000000 steps") != std::string::npos);
  CHECK(messages_of("#macro A() A() #end\nA()").find("too deep") != std::string::npos);
  std::string deep = "sphere { 0, ";
  for (int i = 0; i < 10000; ++i) deep += "(";
  CHECK(messages_of(deep).find("too deep") != std::string::npos);
  deep.clear();
  for (int i = 0; i < 10000; ++i) deep += "union { ";
  CHECK(messages_of(deep).find("too deep") != std::string::npos);
  CHECK(messages_of("#declare A = array[1e9]").find("no size") != std::string::npos);
  CHECK(messages_of("sphere { 0, 1").find("error") != std::string::npos);
  CHECK(messages_of("#if (1)").find("an #end is missing") != std::string::npos);
}
