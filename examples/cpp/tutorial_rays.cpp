// The second program of the tutorial for C++: it asks rays how thick the walls of the tee are.
#include <cstddef>
#include <iomanip>
#include <iostream>
#include <vector>

#include "tee.hpp"

/// Prints the pieces of a ray that are inside of the part. The part is one entity, and the ray must
/// begin and end outside of it. So crossings come in pairs.
void print_walls(const char* name, const crt::PreparedScene& part, const crt::Ray& ray) {
  const std::vector<crt::Hit> hits = crt::crossings(part, ray);
  std::cout << name << ':';
  for (std::size_t i = 0; i + 1 < hits.size(); i += 2) {
    std::cout << "  " << hits[i + 1].t - hits[i].t;
  }
  std::cout << '\n';
}

int main() try {
  crt::Scene scene;
  scene.entities = {tee()};
  const crt::PreparedScene part = crt::prepare(scene);
  std::cout << std::fixed << std::setprecision(3);

  // The nearest surface, from the front.
  const auto hit = crt::intersect(part, {.origin = {1.4, 0, -5}, .direction = {0, 0, 1}});
  if (hit) std::cout << "the pipe begins at z = " << hit->position.z << '\n';

  // All of them: a direction of length 1 makes t a length.
  print_walls("walls of the run", part, {.origin = {1.4, 0, -5}, .direction = {0, 0, 1}});
  print_walls("walls of the branch", part, {.origin = {0, 1.2, -5}, .direction = {0, 0, 1}});
  print_walls("down the branch", part, {.origin = {0, 5, 0}, .direction = {0, -1, 0}});
  print_walls("in a bolt's hole", part,
              {.origin = {5, 1.25, 0}, .direction = {-1, 0, 0}, .t_max = 4});
} catch (const crt::Error& error) {
  std::cerr << "tutorial_rays: " << error.what() << '\n';
  return 1;
}
