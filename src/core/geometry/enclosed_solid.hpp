// What encloses a primitive along lines, by one formula a kind. This is the list of all kinds.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <variant>

#include "core/geometry/box/enclose.hpp"
#include "core/geometry/frustum/enclose.hpp"
#include "core/geometry/plane/enclose.hpp"
#include "core/geometry/sphere/enclose.hpp"
#include "core/ray/enclosure.hpp"

namespace crt::core {

/// A NoEnclosure stands for a primitive that has no such formula.
struct NoEnclosure {};

/// An EnclosedSolid is what encloses a primitive.
using EnclosedSolid =
    std::variant<NoEnclosure, EnclosedSphere, EnclosedBox, EnclosedFrustum, EnclosedPlane>;

/// These are what each kind offers, for one line and for lines side by side.
///
/// The line cuts one span at most out of the solid. enclose() says where it begins and ends, as
/// Enclosure has it: with all that an exact test of either tier makes of these ends, and with its
/// bounds on their errors. goes_into() is of lines that start on a face, by identity and to its
/// inner side. It returns whether they surely come into the solid there, so that all that is open
/// is where they leave.
template <class Solid, class Real>
concept EnclosesLines = requires(const Solid& solid, const FilterLine<Real>& line,
                                 const MaskOf<Real>& asked, Enclosure<Real>& part) {
  { enclose(solid, line, asked, part) } -> std::same_as<bool>;
  { goes_into(solid, std::uint32_t{}, line) } -> std::same_as<MaskOf<Real>>;
};

template <class... Solids>
constexpr bool all_enclose_lines(std::variant<NoEnclosure, Solids...>*) {
  return ((EnclosesLines<Solids, double> && EnclosesLines<Solids, Lanes>)&&...);
}
static_assert(all_enclose_lines(static_cast<EnclosedSolid*>(nullptr)),
              "a kind of enclosed solid lacks enclose() or goes_into()");

/// Returns what encloses a solid that a placement puts into the world. There is none if that cannot
/// be said in doubles. Each kind has placed(), which asks this of a placement: exactly_to_world(),
/// even_scale(), point_to_world(), direction_to_world().
template <class Placement>
EnclosedSolid placed(const EnclosedSolid& solid, const Placement& placement) {
  return std::visit(
      [&]<class Solid>(const Solid& one) -> EnclosedSolid {
        if constexpr (!std::same_as<Solid, NoEnclosure>) {
          if (const std::optional<Solid> moved = one.placed(placement)) return *moved;
        }
        return NoEnclosure{};
      },
      solid);
}

}  // namespace crt::core
