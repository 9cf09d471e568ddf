#include "core/math/precise_transform.hpp"

namespace crt::core {

namespace {

PreciseVec3 column(const PreciseTransform& transform, std::size_t index) {
  return {transform.rows[0][index], transform.rows[1][index], transform.rows[2][index]};
}

PreciseVec3 precise(const Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

PreciseTransform::PreciseTransform(const Transform& transform)
    : rows{precise(transform.row_x), precise(transform.row_y), precise(transform.row_z)},
      translation(precise(transform.translation)) {}

Transform PreciseTransform::rounded() const {
  return {core::rounded(rows[0]), core::rounded(rows[1]), core::rounded(rows[2]),
          core::rounded(translation)};
}

PreciseTransform compose(const PreciseTransform& second, const PreciseTransform& first) {
  PreciseTransform result;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t index = 0; index < 3; ++index) {
      result.rows[row][index] = dot(second.rows[row], column(first, index));
    }
    result.translation[row] = dot(second.rows[row], first.translation) + second.translation[row];
  }
  return result;
}

DoubleDouble determinant(const PreciseTransform& transform) {
  return dot(transform.rows[0], cross(transform.rows[1], transform.rows[2]));
}

PreciseTransform inverse(const PreciseTransform& transform) {
  const DoubleDouble det = determinant(transform);
  const auto& [x, y, z] = transform.rows;
  // The columns of the inverse are the cross products of the rows over the determinant.
  const std::array<PreciseVec3, 3> columns{cross(y, z), cross(z, x), cross(x, y)};
  PreciseTransform result;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t index = 0; index < 3; ++index)
      result.rows[row][index] = columns[index][row] / det;
  }
  for (std::size_t row = 0; row < 3; ++row)
    result.translation[row] = -dot(result.rows[row], transform.translation);
  return result;
}

}  // namespace crt::core
