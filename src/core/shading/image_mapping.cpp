#include "core/shading/image_mapping.hpp"

#include <cmath>
#include <crt/elementary.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/math/direction_and_length.hpp"

namespace crt::core {

namespace {

struct Frame {
  Vec3 right;
  Vec3 up;
};

/// Returns the directions to the right and up of one who looks along a unit vector. Up is as near
/// to y as it can be. For one who looks up or down it is z.
Frame frame_of(const Vec3& direction) {
  const bool is_vertical = direction.x == 0 && direction.z == 0;
  const Vec3 upwards = is_vertical ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
  const Vec3 right = direction_and_length(glm::cross(upwards, direction)).direction;
  return {right, glm::cross(direction, right)};
}

PictureCoordinates planar(const Vec3& place, const Vec3& direction) {
  const Frame frame = frame_of(direction);
  return {glm::dot(place, frame.right), glm::dot(place, frame.up)};
}

/// Returns the angle around the axis in turns, and the height on it. Around y the middle of the
/// picture faces -z, and from outside its right is on the right.
PictureCoordinates cylindrical(const Vec3& place, const Vec3& axis) {
  const Frame frame = frame_of(axis);
  const double angle = elementary::atan2(-glm::dot(place, frame.right), -glm::dot(place, frame.up));
  return {0.5 + angle / (2 * std::numbers::pi), glm::dot(place, axis)};
}

/// Looks at a surface along the axis of space that is nearest to its normal.
PictureCoordinates cubic(const Vec3& place, const Vec3& normal) {
  const Vec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  Vec3 direction(0);
  direction[axis] = normal[axis] > 0 ? -1 : 1;
  return planar(place, direction);
}

}  // namespace

PictureCoordinates mapped(const ImageMap& map, const SurfacePoint& point) {
  const Vec3 place = (point.position - map.offset) / map.scale;
  switch (map.mapping) {
    case ImageMapping::uv:
      break;
    case ImageMapping::planar:
      return planar(place, map.direction);
    case ImageMapping::cylindrical:
      return cylindrical(place, map.direction);
    case ImageMapping::cubic:
      return cubic(place, point.normal);
  }
  return {point.u, point.v};
}

}  // namespace crt::core
