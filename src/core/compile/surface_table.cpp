#include "core/compile/surface_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/geometry/canonical_plane.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

/// Returns the number without -0, so that equal numbers have equal bits.
double positive_zero(double value) {
  return value == 0 ? 0.0 : value;
}

CanonicalPlane canonical_plane(const Surface& plane, const Placement& placement) {
  const PreciseVec3 normal{plane.direction.x, plane.direction.y, plane.direction.z};
  const PreciseVec3 position{plane.position.x, plane.position.y, plane.position.z};
  PreciseVec3 world_normal;
  DoubleDouble world_offset;
  placement.plane_to_world(normal, dot(normal, position), world_normal, world_offset);
  return CanonicalPlane::of(world_normal, world_offset);
}

/// A key begins with the words of the surface. Those of a placement come next, and are filled if it
/// does more than move. Those that only quadrics have come last.
constexpr std::size_t words_of_surface = 9;
constexpr std::size_t sizes_of_most = 2;
constexpr std::size_t words_before_more_sizes = words_of_surface + 12;

/// Returns the surface in the world, without rounding.
ExactSurface in_world(const ExactSurface& surface, const Placement& placement) {
  if (placement.is_identity()) return surface;
  ExactSurface result = surface;
  const DyadicTransform map = placement.exactly();
  if (!surface.is_plane) {
    if (placement.is_translation()) {
      for (DyadicVector& point : result.points) point = point + map.translation;
    } else {
      const auto& [x, y, z] = map.rows;
      result.points.insert(result.points.end(), {x, y, z, map.translation});
    }
    return result;
  }
  // With the inverse as rows / weight, the plane n . p = c becomes
  // (n rows) . q = weight c + (n rows) . translation.
  const DyadicInverse inverse(map);
  const DyadicVector normal = surface.numbers[0] * inverse.rows[0] +
                              surface.numbers[1] * inverse.rows[1] +
                              surface.numbers[2] * inverse.rows[2];
  const auto& [x, y, z] = normal;
  result.numbers = {x, y, z, inverse.weight * surface.numbers[3] + dot(normal, map.translation)};
  return result;
}

int compared(const Dyadic& a, const Dyadic& b) {
  return (a - b).sign();
}

/// Compares the equations of planes, of which only the ratios of numbers count.
int compared_planes(std::span<const Dyadic> a, std::span<const Dyadic> b) {
  std::size_t pivot = 0;
  while (a[pivot].sign() == 0 && b[pivot].sign() == 0) ++pivot;
  if (a[pivot].sign() == 0 || b[pivot].sign() == 0) return a[pivot].sign() == 0 ? 1 : -1;
  const int sign = a[pivot].sign() * b[pivot].sign();
  for (std::size_t i = pivot + 1; i < a.size(); ++i) {
    const int order = compared(a[i] * b[pivot], b[i] * a[pivot]);
    if (order != 0) return sign * order;
  }
  return 0;
}

/// Orders surfaces of equal keys, so that equal surfaces compare equal.
int compared(const ExactSurface& a, const ExactSurface& b) {
  if (a.is_plane) return compared_planes(a.numbers, b.numbers);
  for (std::size_t i = 0; i < a.numbers.size(); ++i) {
    if (const int order = compared(a.numbers[i], b.numbers[i])) return order;
  }
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (const int order = compared(a.points[i][axis], b.points[i][axis])) return order;
    }
  }
  return 0;
}

/// A HashedFace is a face among all, with a hash that equal surfaces have in common.
struct HashedFace {
  std::uint64_t hash;
  std::uint32_t face;
  std::uint32_t leaf;
};

class Numbering {
 public:
  Numbering(std::span<const Leaf> leaves, std::span<const std::uint32_t> programs,
            std::span<FaceSurface> faces, const Workers& workers)
      : leaves_(leaves),
        programs_(programs),
        faces_(faces),
        workers_(workers),
        hashed_(faces.size()) {}

  std::vector<HashedSurface> run() {
    for_ranges(leaves_.size(), items_for_a_thread, workers_,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t leaf = begin; leaf < end; ++leaf)
                   hash_faces(static_cast<std::uint32_t>(leaf));
               });
    sort_in_parallel(std::span(hashed_), workers_, [](const HashedFace& a, const HashedFace& b) {
      return std::tie(a.hash, a.face) < std::tie(b.hash, b.face);
    });
    // A range has the runs of equal hashes that begin in it.
    for_ranges(
        hashed_.size(), items_for_a_thread, workers_, [&](std::size_t begin, std::size_t end) {
          while (begin > 0 && begin < end && hashed_[begin].hash == hashed_[begin - 1].hash)
            ++begin;
          while (begin < end) {
            const std::size_t first = begin;
            while (begin < hashed_.size() && hashed_[begin].hash == hashed_[first].hash) ++begin;
            number_equal_hashes(std::span<const HashedFace>(hashed_).subspan(first, begin - first));
          }
        });
    std::vector<HashedSurface> surfaces;
    surfaces.reserve(hashed_.size());
    constexpr int half = 32;
    for (const HashedFace& face : hashed_)
      surfaces.push_back({static_cast<std::uint32_t>(face.hash >> half), face.face});
    return surfaces;
  }

 private:
  CanonicalSurface surface_of(std::uint32_t leaf_index, std::uint32_t face) const {
    const Leaf& leaf = leaves_[leaf_index];
    return canonical_surface(leaf.shape->surface(leaf.face_at(face - leaf.first_face)),
                             *leaf.placement);
  }

  void hash_faces(std::uint32_t leaf) {
    for (std::uint32_t i = 0; i < leaves_[leaf].face_count; ++i) {
      const std::uint32_t face = leaves_[leaf].first_face + i;
      const CanonicalSurface surface = surface_of(leaf, face);
      faces_[face] = {.surface = face, .flipped = surface.flipped};
      hashed_[face] = {surface.hash(), face, leaf};
    }
  }

  /// Equal hashes are nearly always those of equal surfaces, but only their keys prove it.
  void number_equal_hashes(std::span<const HashedFace> faces) {
    if (faces.size() == 1) return;
    const auto key_of = [&](const HashedFace& hashed) {
      workers_.poll_at(hashed.face);
      return surface_of(hashed.leaf, hashed.face).key;
    };
    const CanonicalSurface::Key first_key = key_of(faces[0]);
    if (std::all_of(faces.begin(), faces.end(),
                    [&](const HashedFace& face) { return key_of(face) == first_key; })) {
      number_equal_keys(faces);
      return;
    }
    std::vector<std::pair<CanonicalSurface::Key, HashedFace>> keyed;
    for (const HashedFace& face : faces) keyed.emplace_back(key_of(face), face);
    std::sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) {
      return std::tie(a.first, a.second.face) < std::tie(b.first, b.second.face);
    });
    std::vector<HashedFace> equal;
    for (std::size_t i = 0; i < keyed.size(); ++i) {
      equal.push_back(keyed[i].second);
      if (i + 1 < keyed.size() && keyed[i + 1].first == keyed[i].first) continue;
      number_equal_keys(equal);
      equal.clear();
    }
  }

  /// In the exact tier surfaces with equal keys need not be equal.
  void number_equal_keys(std::span<const HashedFace> faces) {
    if (faces.size() == 1) return;
    if (!leaves_[faces[0].leaf].exact) {
      number_equal(faces);
      return;
    }
    std::vector<std::pair<ExactSurface, HashedFace>> surfaces;
    surfaces.reserve(faces.size());
    for (const HashedFace& face : faces) {
      const Leaf& leaf = leaves_[face.leaf];
      surfaces.emplace_back(
          in_world(leaf.exact->surface(leaf.face_at(face.face - leaf.first_face)), *leaf.placement),
          face);
    }
    const auto is_before = [](const auto& a, const auto& b) {
      return compared(a.first, b.first) < 0;
    };
    std::stable_sort(surfaces.begin(), surfaces.end(), is_before);
    std::vector<HashedFace> equal;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      equal.push_back(surfaces[i].second);
      if (i + 1 < surfaces.size() && !is_before(surfaces[i], surfaces[i + 1])) continue;
      number_equal(equal);
      equal.clear();
    }
  }

  /// Numbers faces on one surface, in ascending order. Those of one program follow one another.
  void number_equal(std::span<const HashedFace> faces) {
    const auto program_of = [&](const HashedFace& face) { return programs_[face.leaf]; };
    std::size_t begin = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      faces_[faces[i].face].surface = faces[0].face;
      const std::uint32_t program = program_of(faces[i]);
      if (program != program_of(faces[begin])) begin = i;
      const bool next_is_of_it = i + 1 < faces.size() && program_of(faces[i + 1]) == program;
      if (program != no_program && (i > begin || next_is_of_it)) {
        faces_[faces[i].face].shared = faces[begin].face;
      }
    }
  }

  std::span<const Leaf> leaves_;
  std::span<const std::uint32_t> programs_;
  std::span<FaceSurface> faces_;
  Workers workers_;
  std::vector<HashedFace> hashed_;
};

}  // namespace

CanonicalSurface canonical_surface(const Surface& surface, const Placement& placement) {
  CanonicalSurface result;
  const auto set = [&](std::size_t word, double number) {
    result.key[word] = std::bit_cast<std::uint64_t>(positive_zero(number));
  };
  result.key[0] = static_cast<std::uint64_t>(surface.kind);
  if (surface.kind == SurfaceKind::plane) {
    const CanonicalPlane plane = canonical_plane(surface, placement);
    for (std::size_t i = 0; i < plane.numbers.size(); ++i) set(i + 1, plane.numbers[i]);
    result.flipped = plane.flipped;
    return result;
  }
  result.flipped = surface.is_hollow;
  const Transform& map = placement.to_world();
  Vec3 position = surface.position;
  if (placement.is_translation()) {
    position += map.translation;
  } else {
    const Vec3 rows[] = {map.row_x, map.row_y, map.row_z, map.translation};
    for (std::size_t i = 0; i < 12; ++i)
      set(words_of_surface + i, rows[i / 3][static_cast<int>(i % 3)]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    set(static_cast<std::size_t>(axis) + 1, position[axis]);
    set(static_cast<std::size_t>(axis) + 4, surface.direction[axis]);
  }
  set(7, surface.sizes[0]);
  set(8, surface.sizes[1]);
  for (std::size_t i = sizes_of_most; i < surface.sizes.size(); ++i)
    set(words_before_more_sizes + i - sizes_of_most, surface.sizes[i]);
  return result;
}

std::uint64_t CanonicalSurface::hash() const {
  // This is FNV-1a over 64-bit words, mixed once more as words differ mostly in their high bits.
  // Most placements leave their words 0, as do all but quadrics.
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto mix = [&](std::uint64_t word) {
    hash = (hash ^ word) * 0x100000001b3u;
    hash ^= hash >> 32;
  };
  for (std::size_t i = 0; i < words_of_surface; ++i) mix(key[i]);
  for (std::size_t i = words_of_surface; i < key.size(); ++i) {
    if (key[i] != 0) mix(key[i] + i);
  }
  return hash;
}

std::vector<HashedSurface> number_surfaces(std::span<const Leaf> leaves,
                                           std::span<const std::uint32_t> programs,
                                           std::span<FaceSurface> faces, const Workers& workers) {
  return Numbering(leaves, programs, faces, workers).run();
}

bool are_on_one_surface(const Leaf& a, std::uint32_t face_of_a, const Leaf& b,
                        std::uint32_t face_of_b) {
  const auto key_of = [](const Leaf& leaf, std::uint32_t face) {
    return canonical_surface(leaf.shape->surface(face), *leaf.placement).key;
  };
  if (key_of(a, face_of_a) != key_of(b, face_of_b)) return false;
  if (a.exact == nullptr) return true;
  return compared(in_world(a.exact->surface(face_of_a), *a.placement),
                  in_world(b.exact->surface(face_of_b), *b.placement)) == 0;
}

}  // namespace crt::core
