// This is somebody else's program that has crt::core alone in it. It writes a picture, and asks for
// what is left out. usage: program picture.png
#include <crt/crt.hpp>
#include <iostream>
#include <string>

namespace {

/// Does what must fail with an error that names the option.
template <class Work>
void expect_left_out(const std::string& option, const Work& work) {
  try {
    work();
  } catch (const crt::Error& error) {
    const bool names_it = std::string(error.what()).find(option) != std::string::npos;
    if (error.code() == crt::ErrorCode::unsupported && names_it) return;
    throw;
  }
  throw crt::Error(crt::ErrorCode::internal, option + " is not left out");
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  crt::Scene scene;
  scene.entities = {crt::Sphere{.center = {0, 0, 2}, .radius = 1}};
  scene.lights = {crt::PointLight{.origin = {0, 3, 0}}};
  scene.settings = {.width = 400, .height = 300};
  const crt::PreparedScene prepared = crt::prepare(scene);

  const auto hit = crt::intersect(prepared, {.origin = {0, 0, -5}});
  if (!hit || hit->t != 6) {
    std::cerr << "the sphere was not hit at t = 6\n";
    return 1;
  }
  const crt::Image image = crt::render(prepared);
  image.write(argv[1], {.reproducible = true});

  expect_left_out("CRT_WITH_IMAGES", [&] { image.write("picture.jpg"); });
  expect_left_out("CRT_WITH_IMAGES", [&] { crt::Image::read(argv[1]); });
  expect_left_out("CRT_WITH_FONTS", [] { crt::standard_font(); });
  expect_left_out("CRT_WITH_MESH_FILES", [&] { crt::load_mesh(argv[1]); });
} catch (const crt::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
