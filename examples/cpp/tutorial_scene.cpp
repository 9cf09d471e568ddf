// The first program of the tutorial for C++: a scene in code, and its picture, tee.png.
#include <iostream>

#include "tee.hpp"

int main() try {
  const crt::Scene scene = tee_scene();
  const crt::PreparedScene prepared = crt::prepare(scene);
  crt::render(prepared).write("tee.png");
} catch (const crt::Error& error) {
  std::cerr << "tutorial_scene: " << error.what() << '\n';
  return 1;
}
