// These tests read OBJ files whose materials are in libraries, which a map here stands for.
#include <doctest/doctest.h>

#include <crt/image.hpp>

#include <map>

#include "mesh_texts.hpp"

using namespace crt;
using namespace crt::test;

namespace {

using Libraries = std::map<std::string, std::string>;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\n";

MeshFile decode_with(const std::string& text, const Libraries& libraries) {
  const OpenMeshPart open = [&](const std::string& name) {
    const auto found = libraries.find(name);
    if (found == libraries.end()) throw Error(ErrorCode::io, "there is no file '" + name + "'");
    const auto bytes = bytes_of(found->second);
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  };
  return decode_mesh_file(bytes_of(text), "some.obj", {}, open);
}

/// Returns the material that these lines of a library make.
Material material_of(const std::string& lines, const Libraries& others = {}) {
  Libraries libraries = others;
  libraries["a.mtl"] = "newmtl m\n" + lines;
  const MeshFile file = decode_with(square + "mtllib a.mtl\nusemtl m\nf 1 2 3\n", libraries);
  REQUIRE(file.attributes.materials.size() == 1);
  return *file.attributes.materials[0];
}

std::string fault_of(const std::string& lines) {
  try {
    material_of(lines);
    return {};
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::io);
    return error.what();
  }
}

std::string warning_of(const std::string& text, const Libraries& libraries) {
  const MeshFile file = decode_with(text, libraries);
  return file.warnings.size() == 1 ? file.warnings[0] : "";
}

std::string picture_file() {
  Image image(2, 1);
  image.set(0, 0, {1, 0, 0});
  image.set(1, 0, {0, 0, 1});
  const std::vector<std::byte> bytes = image.encode("png");
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

TEST_CASE("faces have the materials that usemtl says, wherever the library is named") {
  const std::string library = "newmtl b c\nKd 0 1 0\n\nnewmtl a\r\nKd 1 0 0\n";
  for (const std::string text :
       {"mtllib x.mtl\nf 1 2 3\nusemtl a\nf 1 2 3 4\nusemtl b c\nf 2 3 4\n",
        "f 1 2 3\nusemtl a\nf 1 2 3 4\nusemtl b c\nf 2 3 4\nmtllib x.mtl\n"}) {
    const MeshFile file = decode_with(square + text, {{"x.mtl", library}});
    const MeshAttributes& attributes = file.attributes;
    CHECK(attributes.material_of_triangle == std::vector<std::uint32_t>{no_index, 0, 0, 1});
    REQUIRE(attributes.materials.size() == 2);
    CHECK(std::get<Color>(attributes.materials[0]->color) == Color{1, 0, 0});
    CHECK(std::get<Color>(attributes.materials[1]->color) == Color{0, 1, 0});
    CHECK(file.warnings.empty());
  }
}

TEST_CASE("a material has the colour, the highlight and the transparency of its library") {
  const Material plain = material_of("");
  CHECK(std::get<Color>(plain.color) == grey(0.5));
  CHECK(plain.specular == 0);
  CHECK(plain.transparency == 0);
  const Material all = material_of(
      "Ka 1 1 1\nKd 0.1 0.2 0.3 # blue\nKs 0.3 0.6 0.9\nNs 96\nd 0.25\nNi 1.5\nillum 2\n"
      "unheard_of 1 2\n");
  CHECK(std::get<Color>(all.color) == Color{0.1, 0.2, 0.3});
  CHECK(all.specular == doctest::Approx(0.6));
  CHECK(all.shininess == 96);
  CHECK(all.transparency == 0.75);
  CHECK(all.refractive_index == 1.5);
  CHECK(std::get<Color>(material_of("Kd 0.7\n").color) == grey(0.7));
  CHECK(std::get<Color>(material_of("Kd spectral a.rfl\n").color) == grey(0.5));
  CHECK(material_of("Ks 1 1 1\n").specular == 0);  // an exponent of 0 would light all of it
  CHECK(material_of("Tr 0.75\n").transparency == 0.75);
  CHECK(material_of("Tr 1\nd 1\n").transparency == 0);
  CHECK(material_of("d -halo 0.5\n").transparency == 0);
  CHECK(material_of("Ni 0\n").refractive_index == 1);
}

TEST_CASE("a picture takes the place of the colour, with its options") {
  const Libraries files = {{"maps/a b.png", picture_file()}};
  const Material material =
      material_of("Kd 1 1 1\nmap_Kd -blendu on -s 2 3 1 -o 0.5 maps\\a b.png\n", files);
  const auto& map = std::get<ImageMap>(std::get<Pattern>(material.color));
  CHECK(map.image->width() == 2);
  CHECK(map.mapping == ImageMapping::uv);
  CHECK(map.repeat_u == 2);
  CHECK(map.repeat_v == 3);
}

TEST_CASE("what is missing is a warning, and the rest is read") {
  const std::string text = square + "mtllib none.mtl\nusemtl a\nf 1 2 3\n";
  CHECK(warning_of(text, {}) == "there is no material library 'none.mtl' to be read");
  CHECK(decode_with(text, {}).attributes.materials.empty());
  CHECK(decode(text).warnings.size() == 1);
  CHECK(warning_of(text, {{"none.mtl", "newmtl b\nKd 1 1 1\n"}}) ==
        "its libraries have no material 'a'");
  CHECK(warning_of(square + "mtllib x.mtl\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n",
                   {{"x.mtl", "newmtl b\n"}}) == "its libraries have no material 'a'");
  CHECK(warning_of(square + "mtllib x.mtl\nusemtl a\nf 1 2 3\n",
                   {{"x.mtl", "newmtl a\nmap_Kd gone.png\n"}}) == "there is no file 'gone.png'");
  const std::string broken = warning_of(square + "mtllib x.mtl\nusemtl a\nf 1 2 3\n",
                                        {{"x.mtl", "newmtl a\nmap_Kd a.png\n"}, {"a.png", "?"}});
  CHECK(broken.find("a.png") != std::string::npos);
}

TEST_CASE("names of libraries may have blanks, or stand side by side") {
  const Libraries spaced = {{"a b.mtl", "newmtl m\nKd 1 0 0\n"}};
  const Libraries two = {{"a", "newmtl m\nKd 1 0 0\n"}, {"b.mtl", "newmtl m\nKd 0 0 1\n"}};
  for (const Libraries& libraries : {spaced, two}) {
    const MeshFile file = decode_with(square + "mtllib a b.mtl\nusemtl m\nf 1 2 3\n", libraries);
    REQUIRE(file.attributes.materials.size() == 1);
    CHECK(std::get<Color>(file.attributes.materials[0]->color) == Color{1, 0, 0});
  }
}

TEST_CASE("what is wrong with a library is said with its name and line") {
  const std::string begin = "cannot read 'some.obj': in its library 'a.mtl', ";
  CHECK(fault_of("Kd 1 x 1\n") ==
        begin + "line 2: 'Kd' has 'x'; it should be a number from 0 to 1e+30");
  CHECK(fault_of("\nKd 1 nan 1\n") ==
        begin + "line 3: 'Kd' has 'nan'; it should be a number from 0 to 1e+30");
  CHECK(fault_of("d 1.5\n") == begin + "line 2: 'd' has '1.5'; it should be a number from 0 to 1");
  CHECK(fault_of("Ns -1\n") ==
        begin + "line 2: 'Ns' has '-1'; it should be a number from 0 to 1000000");
  CHECK(fault_of("Kd 1 1\n") ==
        begin + "line 2: 'Kd' has ''; it should be a number from 0 to 1e+30");
}

TEST_CASE("materials and libraries without end are refused") {
  std::string names;
  for (int i = 0; i <= 65536; ++i) names += "usemtl " + std::to_string(i) + "\n";
  CHECK(decode_error(names + square + "f 1 2 3\n", "some.obj") ==
        "line 65537: it names more than 65536 materials");
  std::string libraries;
  for (int i = 0; i <= 64; ++i) libraries += "mtllib " + std::to_string(i) + "\n";
  CHECK(decode_error(libraries + square + "f 1 2 3\n", "some.obj") ==
        "line 65: it names more than 64 material libraries");
}
