// Measures a drilled steel plate in millimetres: its mass, how near a pin comes to the side of its
// pocket, and its triangles. Writes plate.stl, or the file that is named.
#include <crt/crt.hpp>
#include <filesystem>
#include <iomanip>
#include <iostream>

const double density = 7.85e-3;  // of steel, in grams per cubic millimetre

/// Makes a plate, 100 x 60 x 12 mm, with four holes and a pocket that is half a ball.
crt::Entity plate() {
  crt::Entity part = crt::Box{.corner_a = {-50, 0, -30}, .corner_b = {50, 12, 30}};
  for (const double x : {-40.0, 40.0}) {
    for (const double z : {-20.0, 20.0}) {
      part = part - crt::Cylinder{.from = {x, -1, z}, .to = {x, 13, z}, .radius = 4};
    }
  }
  return part - crt::Sphere{.center = {18, 12, 0}, .radius = 10};
}

/// Prints an interval in which a number surely is.
void print(const char* name, const crt::Interval& number, const char* unit) {
  std::cout << name << " between " << number.lower << " and " << number.upper << ' ' << unit
            << '\n';
}

int main(int argc, char** argv) try {
  const std::filesystem::path file = argc > 1 ? argv[1] : "plate.stl";
  const crt::Entity part = plate();
  std::cout << std::fixed << std::setprecision(4);

  const crt::Interval volume = crt::volume(part, {.relative_width = 1e-6});
  print("mass", {density * volume.lower, density * volume.upper}, "g");

  // A pin with a round end hangs over the pocket.
  const crt::Entity pin = crt::Capsule{.from = {18, 11, 0}, .to = {18, 40, 0}, .radius = 3};
  const crt::Clearance gap = crt::clearance(part, pin, {.relative_width = 1e-3});
  print("clearance", gap.distance, "mm");

  const crt::SurfaceMesh surface = crt::tessellate(part, 0.05);
  crt::write_surface_mesh(file, surface, {.unit = crt::Unit::mm, .name = "plate"});
  std::cout << surface.triangles.size() << " triangles, within " << surface.deviation << " mm\n"
            << crt::load_mesh(file).primitive_count() << " are in the file\n";
} catch (const crt::Error& error) {
  std::cerr << "tutorial_measure: " << error.what() << '\n';
  return 1;
}
