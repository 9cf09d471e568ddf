// The surface of a shape is given in pieces, from which points can be drawn.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/placement.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// A SurfacePiece is all of one face of a shape.
struct SurfacePiece {
  enum class Kind {
    sphere,         ///< about `origin`
    disc,           ///< an ellipse about `origin`, whose half axes are the edges
    parallelogram,  ///< from the corner `origin` along the edges
    triangle,       ///< likewise
    tube            ///< a cylinder's side about the axis from `origin` along edge_a
  };
  Kind kind = Kind::sphere;
  Vec3 origin{0, 0, 0};
  Vec3 edge_a{0, 0, 0};
  Vec3 edge_b{0, 0, 0};
  Vec3 normal{0, 0, 0};  ///< of flat ones: out of the solid, of unit length
  double radius = 0;     ///< of spheres and tubes
};

/// Returns a piece where a placement puts it, or nothing if a round one is not scaled evenly.
std::optional<SurfacePiece> placed_piece(const SurfacePiece& piece, const Placement& placement);

using SurfacePieces = std::vector<SurfacePiece>;

}  // namespace crt::core
