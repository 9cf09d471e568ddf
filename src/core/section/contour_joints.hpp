// Where a line or an arc touches the one that follows, it is hard to see by points where the one
// ends and the other begins. But their common tangent says it.
#pragma once

#include <optional>
#include <vector>

#include "core/section/contour_arcs.hpp"

namespace crt::core {

/// A FittedPiece is a piece of a closed line of such.
struct FittedPiece {
  ContourPiece piece;
  bool is_sure = false;  ///< it is part of a line or a circle, and not only near one
  bool begins_at_corner = false;
};

/// A TangentJoint is where one piece touches another, with the bulges of what both have between
/// that and the ends of a gap.
struct TangentJoint {
  PlanePoint place;
  double first_bulge = 0;
  double last_bulge = 0;
  double off = 0;  ///< how far that is from what was in the gap, at most
};

/// Finds where two pieces touch, to `exact`, in a short gap between them.
std::optional<TangentJoint> joint_between(const ContourPiece& before, const ContourPiece& gap,
                                          const ContourPiece& after, double exact);

/// Moves the common ends of pieces to where the pieces touch, to `exact`, by no more than
/// `tolerance` from what they were. Returns how far something is from that.
double tidy_joints(std::vector<FittedPiece>& pieces, double exact, double tolerance);

}  // namespace crt::core
