// Paths of SVG drawings become contours of profiles.
#pragma once

#include <crt/primitives.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace crt {

/// Says what is inside of contours that cross, or that lie within each other.
enum class FillRule {
  /// Inside is where contours go about a point more often in one direction than in the other. It is
  /// what SVG does if the drawing says nothing.
  nonzero,
  /// Inside is where a line to infinity crosses an odd number of pieces, as for any profile.
  even_odd,
};

/// PathOptions say how a drawing becomes contours.
struct PathOptions {
  FillRule fill = FillRule::nonzero;
  /// How far contours may be away from curves, as for append_cubic(). With 0 each curve has the
  /// default for its own size.
  double deviation = 0;
  /// Is called with how much work was done since the last call, in steps of a few nanoseconds. What
  /// it throws ends the work, and comes out.
  std::function<void(std::uint64_t)> work{};
};

/// Returns the contours of an SVG path, which is the attribute d of a path element: "M 0 0 H 2 V 1
/// z". All commands of SVG are known. As SVG has y downward, (x, y) of the path is (x, -y) here, so
/// that drawings stand upright. Each subpath becomes a closed contour. One that encloses no area is
/// left out.
///
/// Arcs of circles stay what they are. Other arcs, and Bézier curves, become arcs of circles within
/// the deviation, as append_cubic() does.
///
/// By the nonzero rule, contours that cross each other or themselves are cut where they meet, and
/// what lies within the region is left out. What is returned encloses the same region by the
/// even-odd rule, which profiles have. Places of contours near each other that are within 2^-38 of
/// the size of these are one.
///
/// Throws Error (invalid_argument) if the path does not follow the grammar, naming the place; if it
/// encloses no area; and as append_cubic() does. Throws Error (limit) if it has over 2^20 corners,
/// or too many near each other for the nonzero rule, and Error (unsupported) if contours touch so
/// closely that rounding decides what is inside by that rule.
std::vector<Contour> svg_path_contours(std::string_view path, const PathOptions& options = {});

/// Makes a profile of svg_path_contours(). Throws Error as that and make_profile() do.
std::shared_ptr<const Profile> profile_from_svg_path(std::string_view path,
                                                     const PathOptions& options = {});

}  // namespace crt
