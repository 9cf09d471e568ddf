#include "core/accel/space_order.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

constexpr int bits_per_axis = 20;

/// Returns the lowest bits of x, each with two zeros before it.
std::uint64_t with_gaps(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffu;
  x = (x | x << 16) & 0x001f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  x = (x | x << 2) & 0x1249249249249249u;
  return x;
}

/// A Curve finds where on the curve of Morton the middle of a box is, which has the digits of its
/// coordinates by turns. Source: Morton, A computer oriented geodetic data base, IBM 1966.
class Curve {
 public:
  explicit Curve(const Bounds& total) {
    double extent = 0;
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = total.lower[axis] / 2;
      extent = std::max(extent, total.upper[axis] / 2 - low_[axis]);
    }
    if (extent > 0) steps_ = steps / extent;
  }

  std::uint64_t place(const Bounds& box) const {
    std::uint64_t place = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double half = (box.lower[axis] / 4 + box.upper[axis] / 4) - low_[axis];
      const double step = std::clamp(half * steps_, 0.0, steps - 1);
      place |= with_gaps(static_cast<std::uint64_t>(step)) << axis;
    }
    return place;
  }

 private:
  static constexpr double steps = 1 << bits_per_axis;

  Vec3 low_{0, 0, 0};  // halves, which do not overflow
  double steps_ = 0;
};

struct Place {
  std::uint64_t place;
  std::uint32_t object;
};

}  // namespace

void sort_along_curve(const CompiledScene& scene, const Bounds& total,
                      std::span<std::uint32_t> objects, const Workers& workers) {
  const Curve curve(total);
  std::vector<Place> places(objects.size());
  for_ranges(objects.size(), items_for_a_thread, workers, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      places[i] = {curve.place(scene.objects[objects[i]].bounds), objects[i]};
    }
  });
  sort_in_parallel(std::span(places), workers, [](const Place& a, const Place& b) {
    return std::tie(a.place, a.object) < std::tie(b.place, b.object);
  });
  for (std::size_t i = 0; i < places.size(); ++i) objects[i] = places[i].object;
}

}  // namespace crt::core
