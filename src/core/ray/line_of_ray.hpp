// A ray is brought into the form that conservative tests take.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "core/ray/certain_end.hpp"
#include "core/ray/filter_line.hpp"

namespace crt::core {

inline FilterLine<double> line_of(const WorldRay& ray) {
  const Vec3& d = ray.direction;
  FilterLine<double> line;
  line.origin = {ray.origin.x, ray.origin.y, ray.origin.z};
  line.direction = {d.x, d.y, d.z};
  line.squared_length = glm::dot(d, d);
  line.inverse_squared_length = 1 / line.squared_length;
  line.inverse_length = std::sqrt(line.inverse_squared_length);
  line.inverse = {1 / d.x, 1 / d.y, 1 / d.z};
  line.begin = ray.t_min;
  line.start_error = ray.start.t_error;
  line.certain_from = farthest_start(ray);
  line.certain_to = finite_end(certain_end(ray));
  return line;
}

}  // namespace crt::core
