// These tests read OBJ files as programs write them, and broken ones.
#include <doctest/doctest.h>

#include "mesh_texts.hpp"

using namespace crt;
using namespace crt::test;

namespace {

const std::string four = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

using Triangles = std::vector<TriangleIndices>;

Triangles faces(const std::string& lines) {
  return decode(four + lines).triangles;
}

}  // namespace

TEST_CASE("corners have texture coordinates and normals, and count from either end") {
  const Triangles one = {{0, 1, 2}};
  CHECK(faces("f 1 2 3") == one);
  CHECK(faces("vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n") == one);
  CHECK(faces("vn 0 0 1\nf 1//1 2//1 3//1\n") == one);
  CHECK(faces("vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n") == one);
  CHECK(faces("f -4 -3 -2\n") == one);
  CHECK(faces("vt 0 0\nvn 0 0 1\nf -4/-1/-1 -3/-1/-1 -2/-1/-1\n") == one);
  CHECK(decode("v 9 9 9\n" + four + "f -4 -3 -2\nv 8 8 8\nf -5 -4 -3\n").triangles ==
        Triangles{{1, 2, 3}, {1, 2, 3}});
}

TEST_CASE("corners keep their normals and texture coordinates where they are put together anew") {
  // The fourth position is the first once more, and the first face has a corner too many.
  const MeshFile file = decode(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\n"
      "vn 0 0 1\nvn 0 3 4\nvn 1 0 0\nvt 0.5 0.25\nvt -1\nvt 2 3 4\n"
      "f 1/1/1 2/2/2 2/3/3 3/3/3\nf 1//1 4//2 2//3\nf 2 3 4\nf 4/1 2/2 3/3\n");
  const MeshAttributes& attributes = file.attributes;
  CHECK(file.triangles == Triangles{{0, 1, 2}, {1, 2, 0}, {0, 1, 2}});
  CHECK(attributes.normals == std::vector<Vec3>{{0, 0, 1}, {0, 3, 4}, {1, 0, 0}});
  constexpr TriangleIndices none = {no_index, no_index, no_index};
  CHECK(attributes.normal_indices == Triangles{{0, 1, 2}, none, none});
  CHECK(attributes.uv == std::vector<std::array<double, 2>>{{0.5, 0.25}, {-1, 0}, {2, 3}});
  CHECK(attributes.uv_indices == Triangles{{0, 1, 2}, none, {0, 1, 2}});
  CHECK(attributes.materials.empty());
}

TEST_CASE("a file has no attributes that no face names") {
  const MeshAttributes attributes = decode(four + "vn 0 0 1\nvt 0 0\nf 1 2 3\n").attributes;
  CHECK(attributes.normals.empty());
  CHECK(attributes.normal_indices.empty());
  CHECK(attributes.uv.empty());
  CHECK(attributes.material_of_triangle.empty());
}

TEST_CASE("what is wrong with normals and texture coordinates is said with its line") {
  const std::string normal = four + "vn 0 0 1\n";
  CHECK(decode_error(normal + "f 1//1 2//2 3//1\n") ==
        "line 6: there is no normal 2: 1 is before this line");
  CHECK(decode_error(normal + "f 1//-2 2//1 3//1\n") ==
        "line 6: there is no normal -2: 1 is before this line");
  CHECK(decode_error(normal + "f 1//0 2//1 3//1\n") ==
        "line 6: there is no normal 0: they count from 1, or -1 back");
  CHECK(decode_error(four + "f 1/1 2/1 3/1\n") ==
        "line 5: there is no texture coordinate 1: 0 are before this line");
  CHECK(decode_error(four + "vn 0 nan 1\n") ==
        "line 5: a normal has 'nan'; it should be a number of at most 1e+100 in magnitude");
  CHECK(decode_error(four + "vn 0 1\n") ==
        "line 5: a normal has ''; it should be a number of at most 1e+100 in magnitude");
  CHECK(decode_error(four + "vt 1e31 0\n") ==
        "line 5: a texture coordinate has '1e31'; it should be a number of at most 1e+30 in "
        "magnitude");
  CHECK(decode_error(four + "vt inf\n") ==
        "line 5: a texture coordinate has 'inf'; it should be a number of at most 1e+30 in "
        "magnitude");
}

TEST_CASE("statements that say nothing of the shape are left alone") {
  const std::string text =
      "# Blender v2.80\n\nmtllib a b.mtl\no Cube #1\ng one two\ns off\nusemtl none\n"
      "v 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\n  v\t1  1\t0  # a corner\nvp 1 2\nvt 0 0 0\nvn 0 0 1\n"
      "l 1 2\np 1\ns 1\nf 1 2 3 # and more\n";
  CHECK(decode(text).triangles == Triangles{{0, 1, 2}});
  CHECK(decode(text).positions.size() == 3);
}

TEST_CASE("lines end in any way, may continue, and the last needs no end") {
  std::string text = "v 0 0 \\\n 0\nv 1 0 0\nv 1 1 0\nf 1 2 \\\n3";
  CHECK(decode(text).triangles == Triangles{{0, 1, 2}});
  std::string crlf;
  std::string cr;
  for (const char c : text) {
    crlf += c == '\n' ? "\r\n" : std::string(1, c);
    cr += c == '\n' ? '\r' : c;
  }
  CHECK(decode(crlf).triangles == Triangles{{0, 1, 2}});
  CHECK(decode(cr).triangles == Triangles{{0, 1, 2}});
  CHECK(decode_error(crlf + "\r\nf 1 2 9") ==
        "line 7: there is no vertex 9: 3 are before this line");
  CHECK(decode_error(cr + "\rf 1 2 9") == "line 7: there is no vertex 9: 3 are before this line");
}

TEST_CASE("numbers have signs, points and exponents as C has them") {
  const std::vector<Vec3> positions = {{0.5, -0.5, 5}, {1e10, 1e-10, 0}, {1, 2, 3}};
  CHECK(decode("v +.5 -.5 5.\nv 1E+10 1e-10 1e-400\nv 1 2 0.3e1\nf 1 2 3").positions == positions);
  CHECK(
      decode("v 0." + std::string(400, '0') + "1 1 1\nv 1 2 3\nv 2 3 3\nf 1 2 3").positions[0].x ==
      0);
  CHECK(decode("v 0." + std::string(400, '0') + "1e401 1 1\nv 1 2 3\nv 2 3 3\nf 1 2 3")
            .positions[0]
            .x == 1);
}

TEST_CASE("a polygon becomes a fan") {
  CHECK(faces("f 1 2 3 4") == Triangles{{0, 1, 2}, {0, 2, 3}});
  CHECK(faces("f 1 1 2 3") == Triangles{{0, 1, 2}});
  CHECK(decode_error(four + "f 1 1 2 2") == "each of its faces has equal corners");
}

TEST_CASE("what is wrong with an OBJ file is said with its line") {
  CHECK(decode_error(four + "f 1 2 5\n") == "line 5: there is no vertex 5: 4 are before this line");
  CHECK(decode_error(four + "f 1 2 -5\n") ==
        "line 5: there is no vertex -5: 4 are before this line");
  CHECK(decode_error("v 0 0 0\nf 1 2 3\n") ==
        "line 2: there is no vertex 2: 1 is before this line");
  CHECK(decode_error(four + "f 0 1 2\n") ==
        "line 5: there is no vertex 0: they count from 1, or -1 back");
  CHECK(decode_error(four + "f 1 2\n") ==
        "line 5: a face needs at least three corners, and here are 2");
  CHECK(decode_error(four + "f 1 2 x\n") ==
        "line 5: a corner is 'x'; it should be the number of a vertex, as in 7 or 7/1/3");
  CHECK(decode_error(four + "f 1 2 3.5\n").find("'3.5'") != std::string::npos);
  CHECK(decode_error(four + "f 1 2 99999999999999999999\n").find("a corner is") !=
        std::string::npos);
  CHECK(decode_error("v 1 2\n") == "line 1: a vertex needs three coordinates, and here are 2");
  CHECK(decode_error("v 1 nan 2\n") == "line 1: the coordinate 'nan' is not finite");
  CHECK(decode_error("v 1 -inf 2\n") == "line 1: the coordinate '-inf' is not finite");
  CHECK(decode_error("v 1 1e400 2\n") == "line 1: the coordinate '1e400' is not finite");
  CHECK(decode_error("v 1 -1e101 2\n") == "line 1: the coordinate '-1e101' is beyond 1e100");
  CHECK(decode_error("v 1 2,5 2\n") == "line 1: the coordinate '2,5' is no number");
  CHECK(decode_error("v 1 0x10 2\n") == "line 1: the coordinate '0x10' is no number");
  CHECK(decode_error("v 1 +-1 2\n") == "line 1: the coordinate '+-1' is no number");
  CHECK(decode_error("# nothing\n", "a.obj") == "it has no faces");
  CHECK(decode_error(four) == "it has no faces");
  CHECK(decode_error(four + "surf 0 1 0 1 1 2 3\n") ==
        "line 5: 'surf' makes a curve or a curved surface; CRT reads faces alone");
  CHECK(decode_error(four + "fnord\x01 1 2 3\n") ==
        "line 5: a line begins with 'fnord\\x01', which is no statement of OBJ files");
  CHECK(decode_error(four + std::string(100, 'f') + "\n") ==
        "line 5: a line begins with '" + std::string(40, 'f') +
            "...', which is no statement of OBJ files");
}
