// Contours by some rule become those that enclose the same region by the even-odd rule, and do not
// cross.
//
// Contours that come near each other are cut where they meet, into runs. Beside a run the winding
// numbers do not change, so one point on each side says whether the run bounds the region. Those
// that do are joined again. At each point where contours meet, as many runs must begin as end.
// Where rounding has broken this, it is an error, so that no region is silently wrong.
//
// Where nothing meets, contours stay as they are to the bit, or are left out as a whole: those
// inside a region that is filled on both sides of them.
// Tests: tests/contours/fill_test.cpp
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "crt/primitives.hpp"

namespace crt::core {

/// A WindingRule says by its winding number whether a point is inside.
enum class WindingRule : std::uint8_t { nonzero, odd, positive };

bool is_inside(WindingRule rule, int winding);

/// Returns the contours for the even-odd rule. Each of those given must enclose an area, as
/// encloses_area() says. Throws Error (unsupported) where they touch too closely for doubles, and
/// (limit) where too many of them are near each other. `work` is that of PathOptions.
std::vector<Contour> fill_contours(std::span<const Contour> contours, WindingRule rule,
                                   const std::function<void(std::uint64_t)>& work = {});

/// Returns whether a profile takes the contour: if it has an arc, or corners that are not all on
/// one straight line.
bool encloses_area(const Contour& contour);

}  // namespace crt::core
