// A piece of the boundary is an arc or a chord, with a proof of how far the true boundary is from
// it.
//
// The arc goes through three points of a face's curve. Along it the face's function is a series
// (patch_series.hpp), whose range says how much the function is, at most. How much it changes
// across the chord follows from its slopes. So the curve, which like the arc is a graph over the
// chord, is as near as the quotient says. A function without a series has chords, along which its
// slopes bound it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/section/boundary_cells.hpp"

namespace crt::core {

/// An BoundaryPoint is where an arc or a chord begins.
struct BoundaryPoint {
  PlanePoint place;
  double bulge = 0;           ///< of the arc from here (crt/primitives.hpp), or 0 for a chord
  std::uint64_t surface = 0;  ///< what it is near to, or no_surface
  double deviation = 0;       ///< proved: of it from the boundary, and the other way round
};

/// An BoundaryPiece is the part of a face's curve between two points.
struct BoundaryPiece {
  PlanePoint from;
  PlanePoint to;
  std::uint32_t cell = 0;
  std::size_t face = BoundaryCell::unknown_face;
};

class PieceProver {
 public:
  /// Arcs and chords are to be proved to a deviation. Each piece is halved up to so many times.
  PieceProver(const BoundaryLooks& looks, double deviation, int most_halvings)
      : looks_(looks), deviation_(deviation), most_halvings_(most_halvings) {}

  /// Appends arcs and chords from the beginning of a piece to its end.
  void prove(const BoundaryCell& cell, const BoundaryPiece& piece,
             std::vector<BoundaryPoint>& points) const;

 private:
  struct Part;
  class Curve;

  const BoundaryLooks& looks_;
  double deviation_;
  int most_halvings_;
};

}  // namespace crt::core
