// These tests read files that are made to harm, and files that are broken at random.
#include <doctest/doctest.h>

#include <random>

#include "mesh_texts.hpp"

using namespace crt;
using namespace crt::test;

namespace {

const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

/// Returns a good file of each format.
std::vector<std::string> good_files() {
  const std::string object =
      "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" "
      "z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" "
      "v3=\"2\"/></triangles></mesh></object>";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string binary_ply =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\n" + xyz +
      "element face 1\nproperty list uchar ushort vertex_index\nend_header\n" +
      repeated(packed(1.0f), 9) + std::string("\3\0\0\0\1\0\2", 7);
  return {"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf -1 -2 -3\n",
          "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 1\nvn 0 0 1\nmtllib a\nf 1 2 3\nusemtl a\n"
          "f 1/1/1 2/1/1 3/-1/-1\nusemtl b\nf 1//1 2//1 3//1\n",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\n" + xyz +
              "property float ny\nproperty float nz\nproperty float s\nproperty float t\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
              repeated("0 1 2 3 4 5 6 7\n", 3) + "3 0 1 2\n",
          "OFF\n4 1 0\n" + square + "4 0 1 2 3\n",
          "ply\nformat ascii 1.0\nelement vertex 4\n" + xyz +
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + square +
              "4 0 1 2 3\n",
          binary_ply,
          "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
          "endloop\nendfacet\nendsolid a\n",
          std::string(80, ' ') + packed(std::uint32_t{1}) + repeated(packed(1.0f), 12) + "xx",
          three_mf(model(object, "<item objectid=\"1\"/>"))};
}

/// Reads a file that may be broken. It is read or refused, and nothing else happens.
void read_or_refuse(const std::string& file) {
  try {
    const OpenMeshPart open = [](const std::string&) {
      const auto library = bytes_of("newmtl a\nKd 1 0 0\nmap_Kd b\nnewmtl b\nNs 3\nd .5\n");
      return std::vector<std::byte>(library.begin(), library.end());
    };
    const MeshFile mesh = decode_mesh_file(bytes_of(file), "some.name", {}, open);
    for (const TriangleIndices& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) REQUIRE(corner < mesh.positions.size());
    }
    for (const double distance : {0.0, 0.75}) {
      try {
        load_mesh(mesh, "it", {.weld = distance / 4, .stitch = distance});
      } catch (const Error& error) {
        CHECK(error.argument() == "triangles");  // none has an area
      }
    }
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::io);
  }
}

}  // namespace

TEST_CASE("files that are cut off or changed at random are read or refused") {
  std::mt19937 random(11);
  for (const std::string& file : good_files()) {
    for (std::size_t size = 0; size < file.size(); ++size) read_or_refuse(file.substr(0, size));
    for (int i = 0; i < 3000; ++i) {
      std::string changed = file;
      for (int change = 0; change < 1 + i % 4; ++change) {
        const std::size_t place = random() % changed.size();
        const std::string_view bytes("\0\xff 09-.\n/eE", 11);
        if (random() % 4 == 0) {
          changed.insert(place, 1, bytes[random() % bytes.size()]);
        } else if (random() % 4 == 0) {
          changed.erase(place, 1 + random() % 8);
        } else {
          changed[place] =
              random() % 2 == 0 ? bytes[random() % bytes.size()] : static_cast<char>(random());
        }
        if (changed.empty()) changed = file;
      }
      read_or_refuse(changed);
    }
  }
}

TEST_CASE("lines and words of 100 MB are no harm") {
  constexpr std::size_t long_size = 100'000'000;
  const std::string nines(long_size, '9');
  CHECK(decode_error("v 0 0 " + nines) ==
        "line 1: the coordinate '" + std::string(40, '9') + "...' is not finite");
  CHECK(decode_error("OFF\n" + nines + " 1 0\n").size() < 200);
  CHECK(decode_error("ply\nelement " + nines + " x\n").size() < 200);
  CHECK(decode_error("solid\nfacet normal 0 0 0 " + nines).size() < 200);
  const std::string blanks(long_size, ' ');
  CHECK(decode_error("v 0 0" + blanks + "0\nf 1 1" + blanks + "1\n") ==
        "each of its faces has equal corners");
  CHECK(decode_error("f" + repeated(" 1", long_size / 2)) ==
        "line 1: there is no vertex 1: 0 are before this line");
}

TEST_CASE("a face may have very many corners at one place") {
  CHECK(decode_error("v 0 0 0\nf" + repeated(" 1", 10'000'000)) ==
        "each of its faces has equal corners");
}
