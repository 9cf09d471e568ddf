// Packets go through the tree with the rays of a mask alone. Embree has packets of eight rays on
// some processors, and takes them apart on others.
#include "core/accel/embree_tree.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

using namespace crt;
using namespace crt::core;

namespace {

constexpr std::array<RayMask, 8> masks = {0x1, 0x8, 0x10, 0x8000, 0x0110, 0x5a5a, 0xff00, 0xffff};
constexpr std::uint32_t sphere_count = 12;
constexpr double radius = 1;

/// Spheres are in a row along the x axis, and so are their boxes.
struct Row {
  std::vector<Bounds> boxes;
  Bounds total;

  Row() {
    for (std::uint32_t i = 0; i < sphere_count; ++i) {
      const Vec3 center(4.0 * i, 0, 0);
      Bounds box;
      box.include(center - Vec3(radius));
      box.include(center + Vec3(radius));
      boxes.push_back(box);
      total.include(box);
    }
  }
};

/// Returns rays along the row, through the middles of all. Every other ray that is not in the mask
/// holds no numbers.
RayBatch rays_along(RayMask mask) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  RayBatch batch;
  for (std::size_t i = 0; i < packet_size; ++i) {
    const bool is_ray = (mask >> i & 1u) != 0 || i % 2 == 0;
    const double height = 0.02 * static_cast<double>(i);
    WorldRay ray{.origin = Vec3(-5, height, 0), .direction = Vec3(1, 0, 0)};
    if (!is_ray) ray.origin = ray.direction = Vec3(none);
    batch.set(i, ray);
  }
  return batch;
}

}  // namespace

TEST_CASE("boxes are visited with all rays of a packet's mask and with no others") {
  const Row row;
  const EmbreeTree tree(row.boxes, row.total, row.total.farthest());
  const PacketStarts starts;
  for (const RayMask mask : masks) {
    const RayBatch batch = rays_along(mask);
    const RayPacket packet(batch, starts, mask);
    std::array<RayMask, sphere_count> visited{};
    tree.traverse(packet, mask, [&](std::uint32_t box, RayMask rays) {
      visited.at(box) |= rays;
      return RayMask{0};
    });
    for (const RayMask rays : visited) CHECK(rays == mask);
  }
}
