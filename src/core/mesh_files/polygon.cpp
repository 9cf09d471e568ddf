#include "core/mesh_files/polygon.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// Says whether a direction points up, or straight to the right.
bool is_upper(double x, double y) {
  return y > 0 || (y == 0 && x > 0);
}

/// Returns the power of two that makes the largest distance from the first corner about 1.
int scale_exponent(std::span<const Vec3> corners) {
  double extent = 0;
  for (const Vec3& corner : corners) {
    for (int axis = 0; axis < 3; ++axis)
      extent = std::max(extent, std::abs(corner[axis] - corners[0][axis]));
  }
  return extent > 0 ? -std::ilogb(extent) : 0;
}

}  // namespace

/// Projects the corners along an axis, so that the polygon goes around anticlockwise. The axis is
/// the one nearest to the normal that M. Newell's method gives (Sutherland, Sproull, Schumacker, A
/// characterization of ten hidden-surface algorithms, 1974).
void PolygonCutter::flatten(std::span<const Vec3> corners) {
  const int exponent = scale_exponent(corners);
  const auto scaled = [&](std::size_t i) {
    Vec3 result{};
    for (int axis = 0; axis < 3; ++axis)
      result[axis] = std::ldexp(corners[i][axis] - corners[0][axis], exponent);
    return result;
  };
  Vec3 normal{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = scaled(i);
    const Vec3 b = scaled((i + 1) % corners.size());
    normal.x += (a.y - b.y) * (a.z + b.z);
    normal.y += (a.z - b.z) * (a.x + b.x);
    normal.z += (a.x - b.x) * (a.y + b.y);
  }
  int axis = 0;
  for (int other = 1; other < 3; ++other) {
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  }
  const int first = (axis + 1) % 3;
  const int second = (axis + 2) % 3;
  const double sign = normal[axis] < 0 ? -1 : 1;
  flat_.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 corner = scaled(i);
    flat_[i] = {sign * corner[first], corner[second]};
  }
}

/// Is positive if the way from a over b to c turns left.
double PolygonCutter::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const Flat& p = flat_[a];
  const Flat& q = flat_[b];
  const Flat& r = flat_[c];
  return difference_of_products(q.x - p.x, r.y - p.y, q.y - p.y, r.x - p.x);
}

/// Says whether every corner turns left, and all together turn around once.
bool PolygonCutter::is_convex() const {
  const auto count = static_cast<std::uint32_t>(flat_.size());
  int rounds = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    const std::uint32_t last = (i + 2) % count;
    if (!(turn(i, next, last) > 0)) return false;
    const bool begins_upper = is_upper(flat_[next].x - flat_[i].x, flat_[next].y - flat_[i].y);
    const bool ends_upper = is_upper(flat_[last].x - flat_[next].x, flat_[last].y - flat_[next].y);
    rounds += begins_upper && !ends_upper ? 1 : 0;
  }
  return rounds == 1;
}

bool PolygonCutter::is_ear(std::uint32_t corner) {
  const std::uint32_t before = previous_[corner];
  const std::uint32_t after = next_[corner];
  ++steps_;
  if (!(turn(before, corner, after) > 0)) return false;
  const auto is_at = [&](std::uint32_t a, std::uint32_t b) {
    return flat_[a].x == flat_[b].x && flat_[a].y == flat_[b].y;
  };
  for (std::uint32_t other = next_[after]; other != before; other = next_[other]) {
    ++steps_;
    if (turn(before, corner, other) < 0 || turn(corner, after, other) < 0 ||
        turn(after, before, other) < 0)
      continue;
    // Where a hole is joined to the border, two corners have one place.
    if (!is_at(other, before) && !is_at(other, corner) && !is_at(other, after)) return false;
  }
  return true;
}

void PolygonCutter::cut_ears() {
  const auto count = static_cast<std::uint32_t>(flat_.size());
  next_.resize(count);
  previous_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    next_[i] = (i + 1) % count;
    previous_[i] = (i + count - 1) % count;
  }
  std::uint32_t corner = 1;
  std::uint32_t left = count;
  for (std::uint32_t tried = 0; left > 3 && tried < left && steps_ <= most_steps;) {
    if (!is_ear(corner)) {
      ++tried;
      corner = next_[corner];
      continue;
    }
    add(previous_[corner], corner, next_[corner]);
    next_[previous_[corner]] = next_[corner];
    previous_[next_[corner]] = previous_[corner];
    // The next ear is one further on, so that not all share a corner.
    corner = next_[next_[corner]];
    --left;
    tried = 0;
  }
  for (; left >= 3; --left) {
    const std::uint32_t after = next_[corner];
    add(corner, after, next_[after]);
    next_[corner] = next_[after];
  }
}

std::span<const TriangleIndices> PolygonCutter::cut(std::span<const Vec3> corners) {
  triangles_.clear();
  const auto count = static_cast<std::uint32_t>(corners.size());
  if (count > 3) {
    flatten(corners);
    if (!is_convex()) {
      cut_ears();
      return triangles_;
    }
  }
  for (std::uint32_t i = 2; i < count; ++i) add(0, i - 1, i);
  return triangles_;
}

}  // namespace crt::core
