#include "core/scene/surface_table.hpp"

#include <bit>
#include <cmath>

namespace crt::core {

namespace {

/// Equal numbers have equal bits: there is no -0.
double positive_zero(double value) {
  return value == 0 ? 0.0 : value;
}

struct CanonicalPlane {
  std::array<double, 4> numbers{};  ///< normal and offset
  bool flipped = false;
};

/// The plane's equation in the world, divided by the normal's largest component: exact to about 100
/// bits before it is rounded, so that planes that are equal but described differently agree.
CanonicalPlane canonical_plane(const Surface& plane, const Placement& placement) {
  const PreciseVec3 normal{plane.direction.x, plane.direction.y, plane.direction.z};
  const DoubleDouble offset = normal[0] * DoubleDouble(plane.position.x) +
                              normal[1] * DoubleDouble(plane.position.y) +
                              normal[2] * DoubleDouble(plane.position.z);
  PreciseVec3 world_normal;
  DoubleDouble world_offset;
  placement.plane_to_world(normal, offset, world_normal, world_offset);
  std::size_t largest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::abs(world_normal[axis].hi) > std::abs(world_normal[largest].hi)) largest = axis;
  }
  const DoubleDouble divisor = world_normal[largest];
  CanonicalPlane result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.numbers[axis] = positive_zero((world_normal[axis] / divisor).value());
  }
  result.numbers[3] = positive_zero((world_offset / divisor).value());
  result.flipped = divisor.hi < 0;
  return result;
}

}  // namespace

FaceSurface SurfaceTable::find(const Surface& surface, const Placement& placement) {
  Key key{};
  key[0] = static_cast<double>(surface.kind);
  if (surface.kind == SurfaceKind::plane) {
    const CanonicalPlane plane = canonical_plane(surface, placement);
    for (std::size_t i = 0; i < plane.numbers.size(); ++i) key[i + 1] = plane.numbers[i];
    return {.surface = number(key), .flipped = plane.flipped};
  }
  const Transform& map = placement.to_world();
  Vec3 position = surface.position;
  if (placement.is_translation()) {
    position += map.translation;
  } else {
    const Vec3 rows[] = {map.row_x, map.row_y, map.row_z, map.translation};
    for (std::size_t i = 0; i < 12; ++i) key[9 + i] = positive_zero(rows[i / 3][static_cast<int>(i % 3)]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    key[static_cast<std::size_t>(axis) + 1] = positive_zero(position[axis]);
    key[static_cast<std::size_t>(axis) + 4] = positive_zero(surface.direction[axis]);
  }
  key[7] = surface.sizes[0];
  key[8] = surface.sizes[1];
  return {.surface = number(key), .flipped = false};
}

std::uint32_t SurfaceTable::number(const Key& key) {
  return numbers_.try_emplace(key, static_cast<std::uint32_t>(numbers_.size())).first->second;
}

std::size_t SurfaceTable::KeyHash::operator()(const Key& key) const {
  // FNV-1a over 64-bit words, mixed once more as words differ mostly in their high bits.
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const double value : key) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

}  // namespace crt::core
