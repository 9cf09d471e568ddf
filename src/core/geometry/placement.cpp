#include "core/geometry/placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/math/vector.hpp"

namespace crt::core {

namespace {

const Vec3& row(const Transform& transform, int index) {
  if (index == 0) return transform.row_x;
  return index == 1 ? transform.row_y : transform.row_z;
}

}  // namespace

Bounds moved_bounds(const Transform& transform, const Bounds& box) {
  if (box.empty()) return box;
  Bounds result;
  for (int axis = 0; axis < 3; ++axis) {
    // This is interval arithmetic by rows (Arvo, Transforming axis-aligned bounding boxes, Graphics
    // Gems 1990). `size` bounds the rounding of the sums.
    double lower = transform.translation[axis];
    double upper = lower;
    double size = std::abs(lower);
    for (int index = 0; index < 3; ++index) {
      const double factor = row(transform, axis)[index];
      if (factor == 0) continue;
      const double first = factor * box.lower[index];
      const double second = factor * box.upper[index];
      lower += std::min(first, second);
      upper += std::max(first, second);
      size += std::max(std::isfinite(first) ? std::abs(first) : 0,
                       std::isfinite(second) ? std::abs(second) : 0);
    }
    const double slack = size * (8 * std::numeric_limits<double>::epsilon());
    result.lower[axis] = std::nextafter(lower - slack, -infinity);
    result.upper[axis] = std::nextafter(upper + slack, infinity);
  }
  return result;
}

Placement::Placement(const PreciseTransform& to_world) : to_world_(to_world.rounded()) {
  const Transform unmoved{.translation = to_world_.translation};
  if (to_world_ == Transform{}) return;
  kind_ = to_world_ == unmoved ? Kind::translation : Kind::affine;
  take_inverse(inverse(PreciseTransform(to_world_)));
  if (kind_ == Kind::affine) vector_error_ = inverse_error();
}

namespace {

DoubleDouble nearest(const Dyadic& number) {
  return number.rounded().unscaled();
}

}  // namespace

Placement::Placement(const TransformChain& to_world) {
  if (to_world.is_plain()) {
    *this = Placement(to_world.product);
    return;
  }
  const DyadicTransform map = exact_product(to_world);
  PreciseTransform precise;
  PreciseTransform back;
  const DyadicInverse inverse(map);
  const ScaledNumber weight = inverse.weight.rounded();
  const DyadicVector moved = inverse * map.translation;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      precise.rows[i][k] = nearest(map.rows[i][k]);
      back.rows[i][k] = (inverse.rows[i][k].rounded() / weight).unscaled();
    }
    precise.translation[i] = nearest(map.translation[i]);
    back.translation[i] = -(moved[i].rounded() / weight).unscaled();
  }
  // Even a map that only moves is affine here, as doubles do not hold by how much it moves.
  kind_ = Kind::affine;
  to_world_ = precise.rounded();
  take_inverse(back);
  // Each number of the inverse is off by its last bit, and there are the roundings of a product
  // with a vector.
  vector_error_ = 4 * precise_roundoff * inverse_size();
  const auto low = [](const PreciseVec3& v) { return Vec3(v[0].lo, v[1].lo, v[2].lo); };
  more_ =
      std::make_shared<const More>(More{.chain = &to_world,
                                        .low = {low(precise.rows[0]), low(precise.rows[1]),
                                                low(precise.rows[2]), low(precise.translation)}});
}

DyadicTransform Placement::exactly() const {
  return more_ ? exact_product(*more_->chain) : core::exactly(to_world_);
}

bool Placement::has_map_of(const Placement& other) const {
  if (this == &other) return true;
  if (to_world_ != other.to_world_ || is_more_than_doubles() != other.is_more_than_doubles())
    return false;
  if (!more_) return true;
  const DyadicTransform one = exactly();
  const DyadicTransform another = other.exactly();
  const auto are_equal = [](const DyadicVector& a, const DyadicVector& b) {
    const auto& [x, y, z] = a - b;
    return x.sign() == 0 && y.sign() == 0 && z.sign() == 0;
  };
  return are_equal(one.translation, another.translation) &&
         std::ranges::equal(one.rows, another.rows, are_equal);
}

void Placement::take_inverse(const PreciseTransform& inverse) {
  to_object_ = inverse;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto set = [&](DoubleDoubleLanes& column, const DoubleDouble& entry) {
      column.hi[i] = entry.hi;
      column.lo[i] = entry.lo;
    };
    for (std::size_t column = 0; column < 3; ++column)
      set(columns_[column], to_object_.rows[i][column]);
    set(columns_[3], to_object_.translation[i]);
  }
}

/// Returns the largest sum of absolute values in a row.
double Placement::inverse_size() const {
  double result = 0;
  for (const PreciseVec3& row : to_object_.rows) {
    result = std::max(result, std::abs(row[0].hi) + std::abs(row[1].hi) + std::abs(row[2].hi));
  }
  return result;
}

/// Returns a bound on the relative error of a vector taken to object space. With B the computed
/// inverse of A, A^-1 - B = A^-1 (I - A B). That is at most |B| e / (1 - e), where e bounds
/// |I - A B| and the rounding of computing it. All norms are the largest sum of absolute values in
/// a row.
double Placement::inverse_error() const {
  const PreciseTransform forth(to_world_);
  double residual = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double row_residual = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      DoubleDouble sum = i == j ? -1.0 : 0.0;
      double size = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        const DoubleDouble product = forth.rows[i][k] * to_object_.rows[k][j];
        sum = sum + product;
        size += std::abs(product.hi);
      }
      row_residual += std::abs(sum.hi) + precise_roundoff * size;
    }
    residual = std::max(residual, row_residual);
  }
  constexpr double largest_residual =
      0.5;  // beyond it nothing is known, and every answer is found exactly
  if (!(residual < largest_residual)) return std::numeric_limits<double>::infinity();
  // The roundings of the product with the vector itself are added.
  return inverse_size() * (2 * residual + precise_roundoff);
}

namespace {

void split_in_two(const DoubleDoubleLanes& lanes, Vec3& high, Vec3& low) {
  high = {lanes.hi[0], lanes.hi[1], lanes.hi[2]};
  low = {lanes.lo[0], lanes.lo[1], lanes.lo[2]};
}

}  // namespace

DoubleDoubleLanes Placement::turned_by_rows(const Vec3& v) const {
  return columns_[0] * v.x + columns_[1] * v.y + columns_[2] * v.z;
}

void Placement::move_to_object(ObjectRay& ray) const {
  if (kind_ == Kind::affine) {
    split_in_two(turned_by_rows(ray.origin) + columns_[3], ray.origin, ray.origin_low);
    split_in_two(turned_by_rows(ray.direction), ray.direction, ray.direction_low);
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const DoubleDouble moved = two_sum(ray.origin[axis], -to_world_.translation[axis]);
    ray.origin[axis] = moved.hi;
    ray.origin_low[axis] = moved.lo;
  }
}

namespace {

/// Sets the three components of a vector in double-double, each to component(axis).
template <class Component>
void set(VectorLanes& high, VectorLanes& low, const Component& component) {
  const auto set_axis = [&](Lanes& hi, Lanes& lo, int axis) {
    const DoubleDoubleLanes number = component(axis);
    hi = number.hi;
    lo = number.lo;
  };
  set_axis(high.x, low.x, 0);
  set_axis(high.y, low.y, 1);
  set_axis(high.z, low.z, 2);
}

/// Returns whether all points are one, as the origins of a camera's rays without a lens are.
bool is_one_point(const VectorLanes& v) {
  return all(v.x == lanes_of(v.x[0]) && v.y == lanes_of(v.y[0]) && v.z == lanes_of(v.z[0]));
}

}  // namespace

ObjectRayLanes Placement::to_object(const RayLanes& rays) const {
  const VectorLanes& o = rays.origin;
  if (kind_ == Kind::identity) return {o, {}, rays.direction, {}};
  ObjectRayLanes result;
  if (kind_ == Kind::translation) {
    const Vec3& moved = to_world_.translation;
    result.direction = rays.direction;
    set(result.origin, result.origin_low,
        [&](int axis) { return two_sum(o[axis], lanes_of(-moved[axis])); });
    return result;
  }
  const auto turned = [&](const VectorLanes& v, int axis) {
    const PreciseVec3& row = to_object_.rows[static_cast<std::size_t>(axis)];
    return lanes_of(row[0]) * v.x + lanes_of(row[1]) * v.y + lanes_of(row[2]) * v.z;
  };
  set(result.direction, result.direction_low,
      [&](int axis) { return turned(rays.direction, axis); });
  if (is_one_point(o)) {
    const DoubleDoubleLanes one = turned_by_rows(o.lane(0)) + columns_[3];
    set(result.origin, result.origin_low, [&](int axis) {
      const auto i = static_cast<std::size_t>(axis);
      return DoubleDoubleLanes{lanes_of(one.hi[i]), lanes_of(one.lo[i])};
    });
    return result;
  }
  set(result.origin, result.origin_low, [&](int axis) {
    return turned(o, axis) + lanes_of(to_object_.translation[static_cast<std::size_t>(axis)]);
  });
  return result;
}

ExactRay Placement::to_object_exactly(const Vec3& origin, const Vec3& direction,
                                      const ObjectRay& ray) const {
  ExactRay exact{.near = ray, .world_origin = origin, .world_direction = direction};
  if (kind_ == Kind::identity) return exact;
  exact.to_world = &to_world_;
  if (more_) exact.chain = more_->chain;
  if (kind_ == Kind::affine) {
    exact.origin_error =
        vector_error_ * (largest_component(origin) + largest_component(to_world_.translation));
    exact.direction_error = vector_error_ * largest_component(direction);
  }
  return exact;
}

Vec3 Placement::point_to_object(const Vec3& world) const {
  const ObjectRay ray = to_object(world, Vec3(0));
  return ray.origin + ray.origin_low;
}

template <class Vector>
Vector Placement::point_to_world(const Vector& object) const {
  using Real = RealOf<Vector>;
  const Vec3& moved = to_world_.translation;
  if (kind_ == Kind::identity) return object;
  if (kind_ == Kind::translation) return object + broadcast<Real>(moved);
  if (more_) {
    const Transform& low = more_->low;
    const auto precise = [&](const Vec3& m, double translation, const Vec3& m_low,
                             double translation_low) {
      using Precise = decltype(two_product(object.x, object.x));
      const Precise sum = two_product(broadcast<Real>(m.x), object.x) +
                          two_product(broadcast<Real>(m.y), object.y) +
                          two_product(broadcast<Real>(m.z), object.z) +
                          Precise{broadcast<Real>(translation)};
      const Real more = m_low.x * object.x + m_low.y * object.y + m_low.z * object.z +
                        broadcast<Real>(translation_low);
      return sum.hi + (sum.lo + more);
    };
    return {precise(to_world_.row_x, moved.x, low.row_x, low.translation.x),
            precise(to_world_.row_y, moved.y, low.row_y, low.translation.y),
            precise(to_world_.row_z, moved.z, low.row_z, low.translation.z)};
  }
  const auto component = [&](const Vec3& m, double translation) {
    using Precise = decltype(two_product(object.x, object.x));
    return (two_product(broadcast<Real>(m.x), object.x) +
            two_product(broadcast<Real>(m.y), object.y) +
            two_product(broadcast<Real>(m.z), object.z) + Precise{broadcast<Real>(translation)})
        .value();
  };
  return {component(to_world_.row_x, moved.x), component(to_world_.row_y, moved.y),
          component(to_world_.row_z, moved.z)};
}
template Vec3 Placement::point_to_world(const Vec3&) const;
template VectorLanes Placement::point_to_world(const VectorLanes&) const;

Vec3 Placement::direction_to_world(const Vec3& object) const {
  return {glm::dot(to_world_.row_x, object), glm::dot(to_world_.row_y, object),
          glm::dot(to_world_.row_z, object)};
}

double Placement::even_scale() const {
  const std::array<Vec3, 3> rows = {to_world_.row_x, to_world_.row_y, to_world_.row_z};
  const double square = glm::dot(rows[0], rows[0]);
  constexpr double rounding = 0x1p-40;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      const double wanted = i == k ? square : 0;
      if (!(std::abs(glm::dot(rows[i], rows[k]) - wanted) <= rounding * square)) return 0;
    }
  }
  return std::sqrt(square);
}

std::optional<Vec3> Placement::exactly_to_world(const Vec3& object) const {
  if (kind_ == Kind::affine) return std::nullopt;
  Vec3 world;
  for (int axis = 0; axis < 3; ++axis) {
    const DoubleDouble place = two_sum(object[axis], to_world_.translation[axis]);
    if (place.lo != 0) return std::nullopt;
    world[axis] = place.hi;
  }
  return world;
}

template <class Vector>
Vector Placement::covector_to_world(const Vector& object) const {
  if (kind_ != Kind::affine) return object;
  const auto component = [&](std::size_t index) {
    return to_object_.rows[0][index].hi * object.x + to_object_.rows[1][index].hi * object.y +
           to_object_.rows[2][index].hi * object.z;
  };
  return {component(0), component(1), component(2)};
}
template Vec3 Placement::covector_to_world(const Vec3&) const;
template VectorLanes Placement::covector_to_world(const VectorLanes&) const;

template <class Vector>
Vector Placement::normal_to_world(const Vector& object) const {
  return kind_ == Kind::affine ? unit_vector(covector_to_world(object)) : object;
}
template Vec3 Placement::normal_to_world(const Vec3&) const;
template VectorLanes Placement::normal_to_world(const VectorLanes&) const;

void Placement::plane_to_world(const PreciseVec3& normal, const DoubleDouble& offset,
                               PreciseVec3& world_normal, DoubleDouble& world_offset) const {
  // With (A, a) the map to object space, n . (A p + a) = offset  <=>  (n A) . p = offset - n . a.
  if (kind_ == Kind::identity) {
    world_normal = normal;
    world_offset = offset;
    return;
  }
  world_offset = offset;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    world_normal[axis] = normal[0] * to_object_.rows[0][axis] +
                         normal[1] * to_object_.rows[1][axis] +
                         normal[2] * to_object_.rows[2][axis];
    world_offset = world_offset - normal[axis] * to_object_.translation[axis];
  }
}

}  // namespace crt::core
