// Corners of a mesh are taken away while it stays near enough to the surface. A corner is moved
// onto one beside it, along a sharp edge if it lies on one. Source: Hoppe, DeRose, Duchamp,
// McDonald, Stuetzle, Mesh optimization, 1993 (edge collapses, and which of them keep a manifold).
#pragma once

#include <vector>

#include "core/tessellate/deviation_proof.hpp"
#include "core/tessellate/dual_mesh.hpp"

namespace crt::core {

/// Returns the mesh with fewer triangles. All that differ are proved to be near the surface. A
/// corner that is `kept` stays.
DualMesh simplified(const DualMesh& mesh, const SurfaceProof& proof, const std::vector<char>& kept,
                    MeasureClock& clock);

}  // namespace crt::core
