#include "core/math/dyadic_transform.hpp"

namespace crt::core {
namespace {

DyadicVector exactly(const PreciseVec3& v) {
  DyadicVector result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = Dyadic(v[i].hi) + Dyadic(v[i].lo);
  return result;
}

}  // namespace

DyadicTransform exactly(const Transform& transform) {
  return {{exactly(transform.row_x), exactly(transform.row_y), exactly(transform.row_z)},
          exactly(transform.translation)};
}

DyadicTransform exactly(const PreciseTransform& transform) {
  const auto& [x, y, z] = transform.rows;
  return {{exactly(x), exactly(y), exactly(z)}, exactly(transform.translation)};
}

DyadicTransform compose(const DyadicTransform& second, const DyadicTransform& first) {
  DyadicTransform result;
  for (std::size_t i = 0; i < 3; ++i) {
    const DyadicVector& row = second.rows[i];
    result.rows[i] = row[0] * first.rows[0] + row[1] * first.rows[1] + row[2] * first.rows[2];
    result.translation[i] = dot(row, first.translation) + second.translation[i];
  }
  return result;
}

DyadicInverse::DyadicInverse(const DyadicTransform& map) {
  // The columns of the inverse times the determinant are cross products of the rows.
  const auto& [x, y, z] = map.rows;
  const std::array<DyadicVector, 3> columns{cross(y, z), cross(z, x), cross(x, y)};
  weight = dot(x, columns[0]);
  const bool mirrored = weight.sign() < 0;
  if (mirrored) weight = -weight;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) rows[i][k] = mirrored ? -columns[k][i] : columns[k][i];
  }
}

}  // namespace crt::core
