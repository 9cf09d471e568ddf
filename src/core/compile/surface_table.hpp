// Faces of a scene that lie on one surface get one number.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/compile/compile.hpp"
#include "core/csg/program.hpp"
#include "core/geometry/placement.hpp"
#include "core/geometry/surface.hpp"

#include "core/tasks/workers.hpp"

namespace crt::core {

/// A CanonicalSurface is a surface in a canonical form in the world. Surfaces are equal if their
/// forms are, bit for bit. Opposite planes are the same surface, one of them turned round. So are
/// the insides and outsides of round surfaces.
struct CanonicalSurface {
  /// A Key has the kind, then up to 8 numbers of the surface, 12 of a placement that does more than
  /// move, and 6 that only quadrics have.
  using Key = std::array<std::uint64_t, 27>;

  Key key{};
  bool flipped = false;

  std::uint64_t hash() const;
};

CanonicalSurface canonical_surface(const Surface& surface, const Placement& placement);

/// Fills in the surfaces of all faces: `faces` holds those of the first leaf, then those of the
/// next, and so on. The number of a surface is that of the first face on it. Where several faces of
/// one program are on it, their `shared` is the number of the first of those. `programs` has the
/// program of each leaf, or no_program. In the exact tier surfaces whose canonical forms are equal
/// are one only if they are equal without any rounding. It takes O(n log n) on as many threads as
/// `workers` says.
std::vector<HashedSurface> number_surfaces(std::span<const Leaf> leaves,
                                           std::span<const std::uint32_t> programs,
                                           std::span<FaceSurface> faces, const Workers& workers);

/// Returns whether two faces are on one surface, as number_surfaces() finds it.
bool are_on_one_surface(const Leaf& a, std::uint32_t face_of_a, const Leaf& b,
                        std::uint32_t face_of_b);

inline constexpr std::uint32_t no_program = 0xffffffffu;

}  // namespace crt::core
