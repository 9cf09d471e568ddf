// What encloses a solid where a placement puts it: the part of any line in it, surely.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/geometry/placement.hpp"
#include "core/ray/enclosure.hpp"

namespace crt::core {

class Shape;

/// A FaceStarts says which lines start on the surfaces of a solid's faces, by identity.
template <class Real>
struct FaceStarts {
  static constexpr std::size_t max_faces = 6;
  std::array<MaskOf<Real>, max_faces> on{};
};

/// A PlacedSolid is a solid as conservative tests see it: in the world, by doubles. All is for one
/// line, or for lines side by side.
class PlacedSolid {
 public:
  PlacedSolid() = default;
  PlacedSolid(const PlacedSolid&) = delete;
  PlacedSolid& operator=(const PlacedSolid&) = delete;
  virtual ~PlacedSolid() = default;

  /// Encloses the part of lines in the solid: with all that an exact test of either tier makes of
  /// the ends, and with its bounds on their errors. Returns false if none of the lines that are
  /// asked for comes near it; the enclosure then means nothing. `starts` is null, or for solids
  /// that have flat_faces().
  virtual bool enclose(const FilterLine<double>& line, bool asked, const FaceStarts<double>* starts,
                       Enclosure<double>& part) const = 0;
  virtual bool enclose(const FilterLine<Lanes>& lines, const LaneMask& asked,
                       const FaceStarts<Lanes>* starts, Enclosure<Lanes>& part) const = 0;

  /// Returns which lines surely come into the solid where they start: on a face, by identity, and
  /// to its inner side. All that is open then is where they leave.
  virtual bool starts_inwards(std::uint32_t face, const FilterLine<double>& line) const = 0;
  virtual LaneMask starts_inwards(std::uint32_t face, const FilterLine<Lanes>& lines) const = 0;

  /// Returns which lines leave the solid for good. They start on it and go outwards.
  virtual bool leaves_for_good(const FilterLine<double>& line) const = 0;
  virtual LaneMask leaves_for_good(const FilterLine<Lanes>& lines) const = 0;

  /// Returns whether the surface of an unbounded solid surely passes by a box.
  virtual bool passes_by(const Bounds& box) const = 0;

  /// Returns how many faces it has, if all are flat and it is convex; else 0.
  virtual std::uint32_t flat_faces() const = 0;

  /// Returns the bytes of memory it takes.
  virtual std::size_t bytes() const = 0;
};

// PlacedSolidOf calls these for what a Solid says of itself, by functions of those names.

template <class Solid, class Real>
[[gnu::always_inline]] inline bool enclose_lines(const Solid& solid, const FilterLine<Real>& line,
                                                 const MaskOf<Real>& asked,
                                                 const FaceStarts<Real>* starts,
                                                 Enclosure<Real>& part) {
  if constexpr (requires { enclose(solid, line, asked, starts, part); }) {
    return enclose(solid, line, asked, starts, part);
  } else {
    return enclose(solid, line, asked, part);
  }
}
template <class Solid, class Real>
MaskOf<Real> lines_into(const Solid& solid, std::uint32_t face, const FilterLine<Real>& line) {
  if constexpr (requires { starts_inwards(solid, face, line); })
    return starts_inwards(solid, face, line);
  return MaskOf<Real>{};
}
template <class Solid, class Real>
MaskOf<Real> lines_away(const Solid& solid, const FilterLine<Real>& line) {
  if constexpr (requires { leaves_for_good(solid, line); }) return leaves_for_good(solid, line);
  return MaskOf<Real>{};
}

/// A PlacedSolidOf is made of a Solid with `bool enclose(solid, line, asked, part)`. Such a Solid
/// may also have a function for each other question, and flat_faces.
template <class Solid>
class PlacedSolidOf final : public PlacedSolid {
 public:
  explicit PlacedSolidOf(const Solid& solid) : solid_(solid) {}

  bool enclose(const FilterLine<double>& line, bool asked, const FaceStarts<double>* starts,
               Enclosure<double>& part) const override {
    return enclose_lines(solid_, line, asked, starts, part);
  }
  bool enclose(const FilterLine<Lanes>& lines, const LaneMask& asked,
               const FaceStarts<Lanes>* starts, Enclosure<Lanes>& part) const override {
    return enclose_lines(solid_, lines, asked, starts, part);
  }
  bool starts_inwards(std::uint32_t face, const FilterLine<double>& line) const override {
    return lines_into(solid_, face, line);
  }
  LaneMask starts_inwards(std::uint32_t face, const FilterLine<Lanes>& lines) const override {
    return lines_into(solid_, face, lines);
  }
  bool leaves_for_good(const FilterLine<double>& line) const override {
    return lines_away(solid_, line);
  }
  LaneMask leaves_for_good(const FilterLine<Lanes>& lines) const override {
    return lines_away(solid_, lines);
  }
  bool passes_by(const Bounds& box) const override {
    if constexpr (requires { solid_.passes_by(box); }) return solid_.passes_by(box);
    return false;
  }
  std::uint32_t flat_faces() const override {
    if constexpr (requires { Solid::flat_faces; }) return Solid::flat_faces;
    return 0;
  }
  std::size_t bytes() const override { return sizeof *this; }

 private:
  Solid solid_;
};

/// Returns a solid where a placement puts it, or null if that cannot be said in doubles. Each has
/// placed(), which asks this of a placement.
template <class Solid>
std::unique_ptr<const PlacedSolid> place(const Solid& solid, const Placement& placement) {
  const std::optional<Solid> placed = solid.placed(placement);
  if (!placed) return nullptr;
  return std::make_unique<const PlacedSolidOf<Solid>>(*placed);
}

/// Encloses the part of lines in a box that a placement puts around a shape. That is all that is
/// known of the shape. The bounds on the errors of its crossings may reach beyond the box.
std::unique_ptr<const PlacedSolid> place_box(const Shape& shape, const Placement& placement);

/// Encloses a convex shape of the standard tier by its own crossings, of lines that come into that
/// box. The shape and the placement must outlive it.
std::unique_ptr<const PlacedSolid> place_by_crossings(const Shape& shape,
                                                      const Placement& placement);

}  // namespace crt::core
