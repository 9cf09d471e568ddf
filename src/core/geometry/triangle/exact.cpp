// Triangles of the exact tier decide on which side of their edges the line passes.
#include "core/geometry/exact_flat.hpp"
#include "core/geometry/triangle/triangle.hpp"

namespace crt::core {
namespace {

class ExactTriangleShape final : public ExactFlatShape {
 public:
  explicit ExactTriangleShape(const Triangle& triangle)
      : ExactFlatShape(ExactPlane::through(triangle.a, triangle.b, triangle.c)),
        corners_{triangle.a, triangle.b, triangle.c} {}

  std::size_t bytes() const override { return sizeof *this + plane().more_bytes(); }

 private:
  bool contains(const ExactRay& ray, const Meeting& meeting) const override {
    bool left = false;
    bool right = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const int side = side_of_edge(ray, meeting.t.hi, corners_[i], corners_[(i + 1) % 3]);
      left = left || side > 0;
      right = right || side < 0;
      if (left && right) return false;
    }
    return true;
  }

  /// Returns the side of an edge: the sign of (from - o) . ((to - from) x d), as in triangle.hpp.
  static int side_of_edge(const ExactRay& ray, double t, const Vec3& from, const Vec3& to) {
    const Vec3 d = scaled_to_one(ray.near.direction);
    const double span = largest_component(d) / largest_component(ray.near.direction);
    const Vec3 edge = to - from;
    const Vec3 start = -ray.near.from_center(from, t);
    const double volume = glm::dot(start, accurate_cross(edge, d));
    const double start_size = largest_component(start);
    const double open = filter_rounding * start_size + ray.point_error(from, t) +
                        start_size * span * ray.direction_error;
    constexpr double largest_sum =
        12;  // for six products, each of components of edge and d (below 2)
    if (std::abs(volume) > largest_sum * open * largest_component(edge)) return volume > 0 ? 1 : -1;
    return exact_side_of_edge(ray.exact(), from, to);
  }

  static int exact_side_of_edge(const ExactLine& line, const Vec3& from, const Vec3& to) {
    const DyadicVector start = line.weight * exactly(from) - line.origin;
    return dot(start, cross(exactly(to) - exactly(from), line.direction)).sign();
  }

  std::array<Vec3, 3> corners_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Triangle& triangle) {
  return std::make_unique<ExactTriangleShape>(triangle);
}

}  // namespace crt::core
