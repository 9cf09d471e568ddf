// Solids that are made of a profile ask which of its walls are near to a rectangle, and on which
// side of them the region is, for questions about boxes (face_functions.hpp).
#pragma once

#include "core/geometry/face_functions.hpp"
#include "core/geometry/profile/profile.hpp"

namespace crt::core {

/// Says what is known of the region in a rectangle, whose third coordinate is 0. Faces are those of
/// walls (wall_faces.hpp). What is turned about the axis x = 0 has no boundary there.
void look_at_region(const Profile& profile, bool is_turned_about_axis,
                    const PointOf<Interval>& rectangle, NearFaces& near);

/// Returns the vector along a straight piece, times a power of two that brings its largest
/// component near 1.
PointOf<Interval> way_along(const Profile::Piece& piece);

/// Returns the place of an arc's center across the axis. In solids that are turned about that the
/// axis may be in its place (ring_of()).
Interval center_across_axis(const Profile::Arc& arc, bool is_turned_about_axis);

}  // namespace crt::core
