// These are the textbook's intersections in plain double precision, which accuracy is compared
// with.
#pragma once

#include "core/geometry/shape.hpp"
#include "crt/primitives.hpp"

namespace crt::test {

/// Works as Shape::crossings, by the formulas that everyone writes first.
bool naive_crossings(const Primitive& primitive, const Vec3& origin, const Vec3& direction,
                     core::CrossingList& out);

}  // namespace crt::test
