#include "core/geometry/surface_piece.hpp"

namespace crt::core {

std::optional<SurfacePiece> placed_piece(const SurfacePiece& piece, const Placement& placement) {
  const bool is_round = piece.radius > 0;
  const double scale = is_round ? placement.even_scale() : 1;
  if (scale == 0) return std::nullopt;
  return SurfacePiece{.kind = piece.kind,
                      .origin = placement.point_to_world(piece.origin),
                      .edge_a = placement.direction_to_world(piece.edge_a),
                      .edge_b = placement.direction_to_world(piece.edge_b),
                      .normal = is_round ? Vec3(0) : placement.normal_to_world(piece.normal),
                      .radius = scale * piece.radius};
}

}  // namespace crt::core
