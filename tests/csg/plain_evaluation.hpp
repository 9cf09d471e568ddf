// CSG is evaluated along a ray in the plainest way. Every leaf is asked, all crossings are sorted,
// and the tree is evaluated anew at each place. The library's evaluation must agree with it, to the
// bit.
#pragma once

#include <vector>

#include "core/compile/compile.hpp"
#include "core/csg/evaluate.hpp"

namespace crt::test {

struct PlainEvaluation {
  bool starts_inside = false;
  std::vector<core::CsgHit> hits;
};
PlainEvaluation evaluate_plainly(const core::CompiledScene& scene, const core::CsgProgram& program,
                                 const core::WorldRay& ray);

}  // namespace crt::test
