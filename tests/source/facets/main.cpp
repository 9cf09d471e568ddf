// This program makes a scene that no script can say: a mesh whose triangles have materials of
// either kind. It takes the place of the command: "render ... -o FILE" and "export ... -o FILE".
#include <crt/crt.hpp>
#include <crt/source_code.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

crt::Scene scene_of_facets() {
  const crt::SharedMaterial plain = crt::Material{.color = crt::Color{0.2, 0.6, 0.3}};
  const crt::SharedMaterial brass = crt::PrincipledMaterial{
      .color = crt::Color{0.9, 0.7, 0.3}, .metallic = 1, .roughness = crt::Pattern(crt::Noise{})};
  const std::vector<crt::Vec3> corners = {{-1, -1, 0}, {1, -1, 0.5}, {1, 1, 0}, {-1, 1, 0.5}};
  crt::Scene scene;
  scene.entities = {crt::triangle_mesh(
      corners, std::vector<crt::TriangleIndices>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}},
      {.materials = {plain, brass}, .material_of_triangle = {0, 1, crt::no_index}})};
  scene.settings.width = 60;
  scene.settings.height = 45;
  scene.camera = {.position = {0, 0, -3}, .pointing = {0, 0, 0}};
  scene.lights = {crt::PointLight{.origin = {1, 2, -3}}};
  return scene;
}

crt::SourceLanguage language_of(const std::filesystem::path& file) {
  if (file.extension() == ".py") return crt::SourceLanguage::python;
  return file.extension() == ".c" ? crt::SourceLanguage::c : crt::SourceLanguage::cpp;
}

}  // namespace

int main(int argc, char** argv) try {
  std::filesystem::path file;
  for (int i = 2; i + 1 < argc; ++i) {
    if (argv[i] == std::string("-o")) file = argv[i + 1];
  }
  if (argv[1] == std::string("render")) {
    render(prepare(scene_of_facets())).write(file, {.reproducible = true});
  } else {
    write_source_code(source_code(scene_of_facets(), {.language = language_of(file)}), file);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
