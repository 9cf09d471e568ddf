#include "oracle/mesh_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "oracle/line_oracle.hpp"
#include "oracle/number_vec.hpp"

namespace crt::test {
namespace {

using WholeNumbers = NumberVec<mpz_class>;

constexpr int no_exponent = std::numeric_limits<int>::max();
constexpr double never_matters = 0x1p-960;  ///< more than what underflows

/// Returns the exponent of the last bit of the numbers, which are multiples of that power of two.
int last_exponent(const Vec3& v) {
  constexpr int digits = 53;
  int result = no_exponent;
  for (int axis = 0; axis < 3; ++axis) {
    if (v[axis] == 0) continue;
    int exponent = 0;
    std::frexp(v[axis], &exponent);
    result = std::min(result, exponent - digits);
  }
  return result;
}

/// Returns the numbers divided by a power of two that they are multiples of.
WholeNumbers whole(const Vec3& v, int exponent) {
  constexpr int digits = 53;
  WholeNumbers result;
  for (int axis = 0; axis < 3; ++axis) {
    int own = 0;
    const double fraction = std::frexp(v[axis], &own);
    if (fraction == 0) continue;
    mpz_class& number = result[static_cast<std::size_t>(axis)];
    number = std::ldexp(fraction, digits);
    number <<= static_cast<unsigned>(own - digits - exponent);
  }
  return result;
}

int first_sign(const WholeNumbers& v) {
  for (const mpz_class& number : v) {
    if (sgn(number) != 0) return sgn(number);
  }
  return 0;
}

double largest_of(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}
double length_of(const Vec3& v) {
  return std::hypot(v.x, v.y, v.z);
}
mpq_class times_power(mpq_class q, int exponent) {
  if (exponent >= 0) {
    q <<= static_cast<unsigned>(exponent);
  } else {
    q >>= static_cast<unsigned>(-exponent);
  }
  return q;
}

/// Returns where a line is inside of what two solids make. is_inside(first, second) says of a place
/// in or out of each whether that is.
template <class IsInside>
TrueMeshLine combined(const TrueMeshLine& one, const TrueMeshLine& other,
                      const IsInside& is_inside) {
  TrueMeshLine result;
  result.touches_edges = one.touches_edges || other.touches_edges;
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < one.places.size() || k < other.places.size()) {
    const bool first =
        k == other.places.size() || (i < one.places.size() && one.places[i].t <= other.places[k].t);
    const bool second =
        i == one.places.size() || (k < other.places.size() && other.places[k].t <= one.places[i].t);
    MeshPlace place = first ? one.places[i] : other.places[k];
    if (first && second) place.bound = std::max(place.bound, other.places[k].bound);
    i += first ? 1 : 0;
    k += second ? 1 : 0;
    place.inside_after = is_inside(one.inside_before(i), other.inside_before(k));
    result.places.push_back(std::move(place));
  }
  return result;
}

}  // namespace

/// A Line is in doubles, and without any rounding in units of powers of two.
struct MeshOracle::Line {
  Vec3 origin{0};           ///< in doubles
  double origin_error = 0;  ///< of each of its components
  Vec3 direction{0};        ///< its largest component in [1, 2)
  WholeNumbers whole_origin;
  WholeNumbers whole_direction;
  int exponent = 0;            ///< of whole_origin
  int direction_exponent = 0;  ///< of whole_direction
  double direction_scale = 1;  ///< of direction, which is so many times the one given

  void set_direction(const Vec3& given) {
    direction_scale = std::ldexp(1.0, -std::ilogb(largest_of(given)));
    direction = direction_scale * given;
    direction_exponent = last_exponent(given);
    whole_direction = whole(given, direction_exponent);
  }

  WholeNumbers to(const Vec3& corner) const { return whole(corner, exponent) - whole_origin; }

  /// Returns the sign of direction . ((a - origin) x (b - origin)), or 0 where doubles leave it
  /// open. Six products make it up, each below 2 m^2 for the largest component m of the offsets.
  /// Each has 7 roundings at most, and an error of the origin changes two of its factors.
  int near_side(const Vec3& a, const Vec3& b) const {
    const Vec3 to_a = a - origin;
    const Vec3 to_b = b - origin;
    const double size = std::max(largest_of(to_a), largest_of(to_b));
    const double volume = glm::dot(direction, glm::cross(to_a, to_b));
    const double open = 96 * unit_of_rounding * size * size +
                        32 * origin_error * (size + origin_error) + never_matters;
    return volume > open ? 1 : (volume < -open ? -1 : 0);
  }
  mpz_class volume(const Vec3& a, const Vec3& b) const {
    return dot(whole_direction, cross(to(a), to(b)));
  }
  int side(const Vec3& a, const Vec3& b) const {
    const int near = near_side(a, b);
    return near != 0 ? near : sgn(volume(a, b));
  }
  /// Returns the side if the origin is moved by an infinitely small amount.
  int moved_side(const Vec3& a, const Vec3& b) const {
    if (const int sign = side(a, b)) return sign;
    return first_sign(cross(whole_direction, to(b) - to(a)));
  }
};

std::vector<const MeshPlace*> TrueMeshLine::flips() const {
  std::vector<const MeshPlace*> result;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].inside_after != inside_before(i)) result.push_back(&places[i]);
  }
  return result;
}

TrueMeshLine difference_of(const TrueMeshLine& from, const TrueMeshLine& taken) {
  return combined(from, taken, [](bool first, bool second) { return first && !second; });
}

TrueMeshLine union_of(const TrueMeshLine& one, const TrueMeshLine& other) {
  return combined(one, other, [](bool first, bool second) { return first || second; });
}

MeshOracle::MeshOracle(const TriangleList& mesh) {
  exponent_ = no_exponent;
  for (const Vec3& position : mesh.positions)
    exponent_ = std::min(exponent_, last_exponent(position));
  if (exponent_ == no_exponent) exponent_ = 0;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  lower_ = Vec3(infinity);
  upper_ = Vec3(-infinity);
  for (const auto& [i, j, k] : mesh.triangles) {
    const Corners corners = {mesh.positions[i], mesh.positions[j], mesh.positions[k]};
    const WholeNumbers a = whole(corners[0], exponent_);
    const WholeNumbers normal =
        cross(whole(corners[1], exponent_) - a, whole(corners[2], exponent_) - a);
    if (first_sign(normal) == 0) continue;
    faces_.push_back(corners);
    for (const Vec3& corner : corners) {
      for (int axis = 0; axis < 3; ++axis) {
        lower_[axis] = std::min(lower_[axis], corner[axis]);
        upper_[axis] = std::max(upper_[axis], corner[axis]);
      }
    }
  }
  order_.resize(faces_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  build(0, static_cast<std::uint32_t>(order_.size()));
}

void MeshOracle::build(std::uint32_t begin, std::uint32_t end) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 lower(infinity);
  Vec3 upper(-infinity);
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Vec3& corner : faces_[order_[i]]) {
      for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], corner[axis]);
        upper[axis] = std::max(upper[axis], corner[axis]);
      }
    }
  }
  const std::size_t number = nodes_.size();
  nodes_.push_back({0.5 * lower + 0.5 * upper, 0.5 * upper - 0.5 * lower, begin, end, 0});
  constexpr std::uint32_t max_in_leaf = 4;
  if (end - begin <= max_in_leaf) return;
  const Vec3 extent = upper - lower;
  const int axis = extent.x >= std::max(extent.y, extent.z) ? 0 : (extent.y >= extent.z ? 1 : 2);
  const auto key = [&](std::uint32_t face) {
    const Corners& corners = faces_[face];
    return corners[0][axis] + corners[1][axis] + corners[2][axis];
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t one, std::uint32_t other) {
    return std::make_pair(key(one), one) < std::make_pair(key(other), other);
  });
  build(begin, middle);
  nodes_[number].beyond = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

MeshOracle::Line MeshOracle::line_of(const Vec3& origin, const Vec3& direction) const {
  Line line;
  line.origin = origin;
  line.exponent = std::min(exponent_, last_exponent(origin));
  line.whole_origin = whole(origin, line.exponent);
  line.set_direction(direction);
  return line;
}

/// Uses each face that a line may meet, and some others.
///
/// A line meets a box with that middle and half its size if each component of d x (middle - o) is
/// not larger than what half the size makes of it. Half the size takes up all roundings.
template <class Use>
void MeshOracle::for_each_near(const Line& line, const Use& use) const {
  const Vec3& d = line.direction;
  std::vector<std::uint32_t> open = {0};
  while (!open.empty()) {
    const std::uint32_t number = open.back();
    const Node& node = nodes_[number];
    open.pop_back();
    Vec3 half;
    for (int axis = 0; axis < 3; ++axis) {
      half[axis] = node.half[axis] + line.origin_error + never_matters +
                   16 * unit_of_rounding *
                       (std::abs(node.middle[axis]) + std::abs(line.origin[axis]) +
                        node.half[axis] + line.origin_error);
    }
    const Vec3 across = glm::cross(d, node.middle - line.origin);
    const auto misses = [&](int axis) {
      const int j = (axis + 1) % 3;
      const int k = (axis + 2) % 3;
      return std::abs(across[axis]) > std::abs(d[j]) * half[k] + std::abs(d[k]) * half[j];
    };
    if (misses(0) || misses(1) || misses(2)) continue;
    if (node.beyond != 0) {
      open.push_back(node.beyond);
      open.push_back(number + 1);
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const Corners& corners = faces_[order_[i]];
      const std::array<int, 3> sides = {line.near_side(corners[0], corners[1]),
                                        line.near_side(corners[1], corners[2]),
                                        line.near_side(corners[2], corners[0])};
      const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
      if (*least < 0 && *most > 0) continue;
      use(order_[i]);
    }
  }
}

/// A Meeting is where a line meets the plane of a triangle: at height / rate, but for a power of 2.
struct MeshOracle::Meeting {
  WholeNumbers normal;
  mpz_class height;  ///< of the plane above the line's origin
  mpz_class rate;

  Meeting(const Corners& corners, const Line& line) {
    const WholeNumbers a = line.to(corners[0]);
    normal = cross(line.to(corners[1]) - a, line.to(corners[2]) - a);
    height = dot(normal, a);
    rate = dot(normal, line.whole_direction);
  }

  mpq_class t(const Line& line) const {
    mpq_class quotient(height, rate);
    quotient.canonicalize();
    return times_power(std::move(quotient), line.exponent - line.direction_exponent);
  }
};

namespace {

/// Returns a fraction strictly between two, of few digits: a multiple of a power of two.
mpq_class between(const mpq_class& low, const mpq_class& high) {
  const mpq_class middle = (low + high) / 2;
  const mpq_class width = high - low;
  // 2^shift is more than 4 / width.
  const long bits = static_cast<long>(mpz_sizeinbase(width.get_den_mpz_t(), 2)) -
                    static_cast<long>(mpz_sizeinbase(width.get_num_mpz_t(), 2));
  const int shift = static_cast<int>(bits) + 4;
  const mpq_class scaled = times_power(middle, shift);
  mpz_class floor;
  mpz_fdiv_q(floor.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
  return times_power(mpq_class(floor), -shift);
}

}  // namespace

/// Asks for the point at t of a line, which is a multiple of a power of two.
bool MeshOracle::is_inside(const mpq_class& t, const Line& on) const {
  const int t_exponent = 1 - static_cast<int>(mpz_sizeinbase(t.get_den_mpz_t(), 2));
  Line other;
  other.exponent = std::min(on.exponent, on.direction_exponent + t_exponent);
  const mpz_class factor = times_power(t, on.direction_exponent - other.exponent).get_num();
  std::uint64_t seed = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_class& place = other.whole_origin[i];
    place = on.whole_origin[i];
    place <<= static_cast<unsigned>(on.exponent - other.exponent);
    place += factor * on.whole_direction[i];
    seed = 3 * seed + mpz_get_ui(place.get_mpz_t());
    const int axis = static_cast<int>(i);
    other.origin[axis] = times_power(mpq_class(place), other.exponent).get_d();
  }
  other.origin_error = 2 * unit_of_rounding * largest_of(other.origin);
  Random random(seed);
  for (;;) {
    other.set_direction(random_direction(random));
    bool inside = false;
    bool is_parallel = false;
    for_each_near(other, [&](std::uint32_t face) {
      const auto& [a, b, c] = faces_[face];
      const std::array<int, 3> sides = {other.moved_side(a, b), other.moved_side(b, c),
                                        other.moved_side(c, a)};
      const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
      is_parallel = is_parallel || sides[0] * sides[1] * sides[2] == 0;
      if (*least != *most) return;
      const Meeting plane(faces_[face], other);
      const int side = sgn(plane.height) != 0 ? sgn(plane.height) : -first_sign(plane.normal);
      if (side == sgn(plane.rate)) inside = !inside;
    });
    if (!is_parallel) return inside;
  }
}

/// Returns a direction of few digits. The proportions of the mesh make the way out of it short.
Vec3 MeshOracle::random_direction(Random& random) const {
  constexpr std::uint64_t steps = 1u << 20u;
  constexpr int flattest = 60;
  const Vec3 extent = upper_ - lower_;
  const int least = std::ilogb(largest_of(extent)) - flattest;
  Vec3 direction;
  for (int axis = 0; axis < 3; ++axis) {
    const int exponent = extent[axis] > 0 ? std::max(std::ilogb(extent[axis]), least) : least;
    const double digits = 1 + static_cast<double>(random.bits() % steps);
    direction[axis] = std::ldexp(random.one_in(2) ? digits : -digits, exponent);
  }
  return direction;
}

/// Returns the bound of MeshPlace for one triangle.
double MeshOracle::bound_of(const Corners& corners, const Line& line, const Meeting& meeting,
                            const mpq_class& t) const {
  mpq_class squared(dot(meeting.normal, meeting.normal), meeting.rate * meeting.rate);
  squared.canonicalize();
  const double slowness = std::sqrt(times_power(squared, -2 * line.direction_exponent).get_d());
  const Vec3 middle = 0.5 * lower_ + 0.5 * upper_;
  Vec3 place;
  double least = 0;
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    const mpq_class step = times_power(t * line.whole_direction[i], line.direction_exponent);
    const mpq_class at = times_power(mpq_class(line.whole_origin[i]), line.exponent) + step;
    place[axis] = at.get_d() - middle[axis];
    const double ahead = glm::dot(corners[i] - corners[0], line.direction);
    least = std::min(least, ahead);
    most = std::max(most, ahead);
  }
  const double size = length_of(0.5 * upper_ - 0.5 * lower_);
  const double length =
      (most - least) / glm::dot(line.direction, line.direction) * line.direction_scale;
  const double along_line = 8 * unit_of_rounding * (size + length_of(place)) * slowness;
  return ulp(t.get_d()) / 2 + std::min(along_line, length);
}

TrueMeshLine MeshOracle::along(const Vec3& origin, const Vec3& direction) const {
  const Line line = line_of(origin, direction);
  TrueMeshLine result;
  for_each_near(line, [&](std::uint32_t face) {
    const Corners& corners = faces_[face];
    const auto& [a, b, c] = corners;
    const std::array<int, 3> sides = {line.side(a, b), line.side(b, c), line.side(c, a)};
    const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
    if (*least < 0 && *most > 0) return;
    const bool touches = *least * *most == 0;
    result.touches_edges = result.touches_edges || touches;
    if (*least == 0 && *most == 0) return;
    const Meeting meeting(corners, line);
    const mpq_class t = meeting.t(line);
    result.places.push_back({t, false, bound_of(corners, line, meeting, t)});
  });
  std::vector<MeshPlace>& places = result.places;
  std::sort(places.begin(), places.end(),
            [](const MeshPlace& one, const MeshPlace& other) { return one.t < other.t; });
  bool inside = false;
  std::size_t kept = 0;
  for (std::size_t begin = 0; begin < places.size();) {
    std::size_t end = begin;
    double bound = 0;
    for (; end < places.size() && places[end].t == places[begin].t; ++end) {
      bound = std::max(bound, places[end].bound);
      inside = !inside;
    }
    if (kept != begin) places[kept].t = places[begin].t;
    places[kept].bound = bound;
    places[kept].inside_after = inside;
    ++kept;
    begin = end;
  }
  places.resize(kept);
  if (!result.touches_edges) return result;
  for (std::size_t i = 0; i < kept; ++i) {
    places[i].inside_after = i + 1 < kept && is_inside(between(places[i].t, places[i + 1].t), line);
  }
  return result;
}

std::optional<mpq_class> MeshOracle::meeting(std::uint32_t face, const Vec3& origin,
                                             const Vec3& direction) const {
  const Line line = line_of(origin, direction);
  const Meeting meeting(faces_[face], line);
  if (sgn(meeting.rate) == 0) return std::nullopt;
  return meeting.t(line);
}

}  // namespace crt::test
