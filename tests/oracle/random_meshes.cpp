#include "oracle/random_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "core/math/vector.hpp"

namespace crt::test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A WavyField is a smooth function of space that is positive far from 0.
class WavyField {
 public:
  explicit WavyField(Random& random) {
    for (Wave& wave : waves_) {
      wave = {.along = random.uniform(1, 5) * random.in_cube(), .phase = random.uniform(0, 6)};
    }
  }

  double operator()(const Vec3& p) const {
    double value = 2 * (p.x * p.x + p.y * p.y + p.z * p.z) - 1;
    for (const Wave& wave : waves_) {
      const double angle = wave.along.x * p.x + wave.along.y * p.y + wave.along.z * p.z;
      value += 0.3 * std::sin(angle + wave.phase);
    }
    return value;
  }

 private:
  struct Wave {
    Vec3 along{0};
    double phase = 0;
  };
  std::array<Wave, 4> waves_;
};

/// A March goes through the cells of a grid of n^3 in [-1, 1]^3. Each is divided into six
/// tetrahedra about its diagonal, in which the field is taken as linear.
class March {
 public:
  March(const WavyField& field, int n) : field_(field), n_(n) {
    for (int z = 0; z < n_; ++z) {
      fill(z, below_);
      fill(z + 1, above_);
      for (int y = 0; y < n_; ++y) {
        for (int x = 0; x < n_; ++x) add_cell({x, y, z});
      }
    }
  }

  TriangleList list;

 private:
  using GridPoint = std::array<int, 3>;
  struct Corner {
    GridPoint point;
    double value;
  };

  Vec3 place(const GridPoint& p) const { return 2.0 / n_ * Vec3(p[0], p[1], p[2]) - Vec3(1.0); }
  std::size_t index(const GridPoint& p) const {
    return static_cast<std::size_t>((p[2] * (n_ + 1) + p[1]) * (n_ + 1) + p[0]);
  }
  void fill(int z, std::vector<double>& values) const {
    values.clear();
    for (int y = 0; y <= n_; ++y) {
      for (int x = 0; x <= n_; ++x) {
        const auto is_end = [&](int i) { return i == 0 || i == n_; };
        const double value = field_(place({x, y, z}));
        values.push_back(is_end(x) || is_end(y) || is_end(z) ? std::max(value, 0.1) : value);
      }
    }
  }
  double value(const GridPoint& p, int z) const {
    const auto& values = p[2] == z ? below_ : above_;
    return values[static_cast<std::size_t>(p[1] * (n_ + 1) + p[0])];
  }

  void add_cell(const GridPoint& lowest) {
    constexpr std::array<GridPoint, 6> orders = {GridPoint{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                                 {0, 2, 1},          {2, 1, 0}, {1, 0, 2}};
    for (std::size_t i = 0; i < orders.size(); ++i) {
      std::array<Corner, 4> tetrahedron;
      GridPoint point = lowest;
      for (std::size_t corner = 0; corner < 4; ++corner) {
        if (corner > 0) ++point[static_cast<std::size_t>(orders[i][corner - 1])];
        tetrahedron[corner] = {point, value(point, lowest[2])};
      }
      add_tetrahedron(tetrahedron, i < 3);
    }
  }

  void add_tetrahedron(const std::array<Corner, 4>& corners, bool is_even) {
    std::array<std::size_t, 4> order = {0, 1, 2, 3};  // those inside first
    const auto inside = std::stable_partition(order.begin(), order.end(),
                                              [&](std::size_t i) { return corners[i].value < 0; }) -
                        order.begin();
    bool turned = !is_even;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) turned = turned != (order[k] < order[i]);
    }
    const auto edge = [&](std::size_t i, std::size_t k) {
      return edge_point(corners[order[i]], corners[order[k]]);
    };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      list.triangles.push_back(turned ? TriangleIndices{a, c, b} : TriangleIndices{a, b, c});
    };
    if (inside == 1) add(edge(0, 1), edge(0, 2), edge(0, 3));
    if (inside == 2) {
      add(edge(0, 2), edge(0, 3), edge(1, 3));
      add(edge(0, 2), edge(1, 3), edge(1, 2));
    }
    if (inside == 3) add(edge(0, 3), edge(1, 3), edge(2, 3));
  }

  /// Returns where the field is 0 between two corners: one corner of the mesh for each edge.
  std::uint32_t edge_point(const Corner& one, const Corner& other) {
    const bool swapped = index(other.point) < index(one.point);
    const Corner& a = swapped ? other : one;
    const Corner& b = swapped ? one : other;
    std::uint64_t kind = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      kind = 2 * kind + (a.point[axis] != b.point[axis] ? 1 : 0);
    const auto [entry, added] = points_.try_emplace(
        8 * index(a.point) + kind, static_cast<std::uint32_t>(list.positions.size()));
    if (added) {
      const double share = a.value / (a.value - b.value);
      list.positions.push_back(place(a.point) + share * (place(b.point) - place(a.point)));
    }
    return entry->second;
  }

  const WavyField& field_;
  int n_;
  std::vector<double> below_;
  std::vector<double> above_;
  std::unordered_map<std::uint64_t, std::uint32_t> points_;
};

TriangleList marched_mesh(Random& random, std::size_t triangles) {
  constexpr double per_square = 8;  // so many triangles for each n^2, about
  constexpr int least = 3;
  const double n = std::sqrt(static_cast<double>(triangles) / per_square);
  for (;;) {
    const WavyField field(random);
    TriangleList list = March(field, std::max(least, static_cast<int>(n))).list;
    if (!list.triangles.empty()) return list;
  }
}

int ball_parts(std::size_t triangles) {
  constexpr double per_square = 8;
  return std::max(1, static_cast<int>(std::sqrt(static_cast<double>(triangles) / per_square)));
}

/// Returns two fans of needles from the ends of an axis to a ring.
TriangleList fans(Random& random, std::size_t triangles) {
  TriangleList list;
  const auto count = static_cast<std::uint32_t>(std::max<std::size_t>(3, triangles / 2));
  const double noise = random.one_in(2) ? 0 : random.power_of_ten(-16, -1);
  const double height = random.power_of_ten(-6, 1);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * 3.14159265358979 * i / count;
    const double radius = 1 + random.uniform(-noise, noise);
    list.positions.emplace_back(radius * std::cos(angle), random.uniform(-noise, noise) * height,
                                radius * std::sin(angle));
  }
  list.positions.emplace_back(0, height, 0);
  list.positions.emplace_back(0, -height, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    list.triangles.push_back({i, count, next});
    list.triangles.push_back({i, next, count + 1});
  }
  return list;
}

/// Divides each triangle of a ball by a point close to one of its edges.
TriangleList needles(Random& random, std::size_t triangles) {
  constexpr double closest = -15;
  const TriangleList ball = ball_mesh(random, ball_parts(triangles / 3), 0.01);
  TriangleList list;
  list.positions = ball.positions;
  for (const auto& [a, b, c] : ball.triangles) {
    const double along = random.uniform(0.1, 0.9);
    const double beside = random.power_of_ten(closest, -1);
    const Vec3 from = ball.positions[a];
    const auto middle = static_cast<std::uint32_t>(list.positions.size());
    list.positions.push_back(from + along * (ball.positions[b] - from) +
                             beside * (ball.positions[c] - from));
    list.triangles.push_back({a, b, middle});
    list.triangles.push_back({b, c, middle});
    list.triangles.push_back({c, a, middle});
  }
  return list;
}

TriangleList sliver_mesh(Random& random, std::size_t triangles) {
  constexpr std::size_t max_in_fans = 2000;  // a line through the end of an axis meets half
  switch (random.bits() % 3) {
    case 0: {
      Vec3 scale(1.0);
      scale[static_cast<int>(random.bits() % 3)] = random.power_of_ten(-6, 6);
      return ball_mesh(random, ball_parts(triangles), 0.01, scale);
    }
    case 1:
      if (triangles <= max_in_fans) return fans(random, triangles);
      [[fallthrough]];
    default:
      return needles(random, triangles);
  }
}

Vec3 rounded_to_eighths(const Vec3& v) {
  constexpr double parts = 8;
  return Vec3(std::round(parts * v.x), std::round(parts * v.y), std::round(parts * v.z)) / parts;
}

int voxels_across(std::size_t triangles) {
  constexpr double per_cube = 3;
  return std::max(1, static_cast<int>(std::cbrt(static_cast<double>(triangles) / per_cube)));
}

TriangleList snapped_mesh(Random& random, std::size_t triangles) {
  TriangleList list;
  if (random.one_in(2)) {
    list = Voxels(random, voxels_across(triangles)).mesh();
    for (Vec3& position : list.positions) position /= 8;
    return list;
  }
  // The coarser the grid against the triangles, the more of them coincide or lose their area.
  const int parts = ball_parts(triangles);
  const double radius = parts * random.uniform(0.05, 0.5);
  list = ball_mesh(random, parts, 0.1, Vec3(std::max(radius, 0.3)));
  for (Vec3& position : list.positions) position = rounded_to_eighths(position);
  return list;
}

struct Extent {
  Vec3 lower = Vec3(infinite);
  Vec3 upper = Vec3(-infinite);

  explicit Extent(const TriangleList& mesh) {
    for (const Vec3& position : mesh.positions) {
      for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], position[axis]);
        upper[axis] = std::max(upper[axis], position[axis]);
      }
    }
  }
};

}  // namespace

const char* name_of(MeshKind kind) {
  constexpr std::array<const char*, mesh_kinds> names = {"marching tetrahedra", "subdivided",
                                                         "slivers", "snapped to a grid"};
  return names[static_cast<std::size_t>(kind)];
}

TriangleList make_mesh(MeshKind kind, Random& random, std::size_t triangles) {
  if (kind == MeshKind::snapped) return snapped_mesh(random, triangles);
  TriangleList list;
  if (kind == MeshKind::marched) list = marched_mesh(random, triangles);
  if (kind == MeshKind::subdivided)
    list = ball_mesh(random, ball_parts(triangles), random.one_in(4) ? 0 : 0.1);
  if (kind == MeshKind::slivers) list = sliver_mesh(random, triangles);
  if (random.one_in(2)) return list;
  const double scale = random.power_of_ten(-9, 9);
  const Vec3 offset = random.power_of_ten(-2, 2) * random.in_cube();
  for (Vec3& position : list.positions) position = scale * (position + offset);
  return list;
}

Ray line_at(const TriangleList& mesh, Random& random) {
  // To look at some corners does for the size of the mesh.
  const auto any_position = [&] { return mesh.positions[random.bits() % mesh.positions.size()]; };
  const Vec3 p = any_position();
  const Vec3 q = any_position();
  const TriangleIndices& triangle = mesh.triangles[random.bits() % mesh.triangles.size()];
  const Vec3 a = mesh.positions[triangle[0]];
  const Vec3 b = mesh.positions[triangle[1]];
  const Vec3 c = mesh.positions[triangle[2]];
  const auto whole = [&] { return static_cast<double>(random.bits() % 5) - 2; };
  const auto axis = [&] { return static_cast<int>(random.bits() % 3); };
  Vec3 aim = a;
  Vec3 direction = (q - p) * random.in_cube();
  if (random.one_in(2)) {
    aim = p + Vec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)) * (q - p);
    direction += 0.1 * std::abs(q.x - p.x + q.y - p.y) * random.in_cube();
  } else {
    switch (random.bits() % 8) {
      case 0:  // at a corner
        break;
      case 1:  // at an edge
        aim = 0.5 * (a + b);
        break;
      case 2:  // along an edge
        direction = b - a;
        break;
      case 3:  // from one corner to another
        direction = p - a;
        break;
      case 4:  // into the plane of a triangle
        direction = whole() * (b - a) + random.uniform(-1, 1) * (c - a);
        if (random.one_in(2)) aim = a + random.uniform(-1, 2) * (b - a);
        break;
      case 5:  // along an axis, through a corner
        direction = Vec3(0.0);
        direction[axis()] = random.one_in(2) ? 1 : -1;
        break;
      case 6:  // along an axis, by the coordinates of two corners
        direction = Vec3(0.0);
        direction[axis()] = random.power_of_ten(-3, 3);
        aim[axis()] = p[axis()];
        break;
      default:  // across an axis, by whole numbers
        direction = {whole(), whole(), whole()};
        direction[axis()] = 0;
        break;
    }
  }
  if (core::largest_component(direction) == 0) direction[axis()] = 1;
  if (random.one_in(16)) direction *= random.power_of_ten(-100, 100);
  // The size of the mesh, in lengths of the direction.
  const double size = core::largest_component(q - p) / core::largest_component(direction);
  const double sizes = size > 0 ? size : 1;
  const double power = std::exp2(std::ceil(std::log2(sizes)));
  double back = 0;
  switch (random.bits() % 8) {
    case 0:
      back = 1e9 * power;
      break;
    case 1:
    case 2:
      break;
    case 3:
    case 4:
      back = power;
      break;
    default:
      back = random.uniform(-1, 4) * sizes;
      break;
  }
  return {.origin = aim - back * direction, .direction = direction, .t_min = -infinite};
}

MeshPair coincident_meshes(Random& random, std::size_t triangles) {
  MeshPair pair;
  if (random.one_in(2)) {
    const int across = voxels_across(triangles);
    pair.first = Voxels(random, across).mesh();
    pair.second = random.one_in(2) ? pair.first : Voxels(random, across).mesh();
    const int most = std::max(1, across / 2);
    const auto shift = [&] {
      return static_cast<double>(random.bits() % static_cast<unsigned>(most + 1));
    };
    for (int axis = 0; axis < 3; ++axis) pair.moved[axis] = shift();
    for (Vec3& position : pair.second.positions) position += pair.moved;
    return pair;
  }
  pair.first = ball_mesh(random, ball_parts(triangles), random.one_in(2) ? 0 : 0.1);
  pair.second = pair.first;
  const double limit = random.uniform(0.2, 0.8);
  for (Vec3& position : pair.second.positions) {
    if (position.x > limit) position *= random.uniform(0.7, 1.3);
  }
  return pair;
}

}  // namespace crt::test
