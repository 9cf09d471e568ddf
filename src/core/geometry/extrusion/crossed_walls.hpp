// The walls that a line crosses, and the ends between them, become the crossings of an extrusion in
// both tiers.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/geometry/profile/plane_line.hpp"
#include "core/geometry/profile/profile.hpp"
#include "core/geometry/profile/wall_faces.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

/// An EndMeeting is where a line meets the plane of an end.
struct EndMeeting {
  int side = 0;         ///< the sign of n . d
  bool found = false;   ///< false if the line is parallel, or so nearly that t has no finite value
  bool behind = false;  ///< for parallel lines: whether they are behind the plane
  Crossing crossing;
};

/// An EndSpan is the part of a line between the ends of an extrusion.
struct EndSpan {
  Crossing enter{.t = -std::numeric_limits<double>::infinity(), .face = invalid_index};
  Crossing leave{.t = std::numeric_limits<double>::infinity(), .face = invalid_index};
  bool is_empty = false;
};

/// An ExtrusionTier is what the tiers do differently.
class ExtrusionTier {
 public:
  ExtrusionTier() = default;
  ExtrusionTier(const ExtrusionTier&) = delete;
  ExtrusionTier& operator=(const ExtrusionTier&) = delete;
  virtual ~ExtrusionTier() = default;

  virtual EndMeeting meet_end(std::uint32_t end) const = 0;
  /// Finds t and its error, where the line meets the plane of a piece. Returns false if t is beyond
  /// all doubles.
  virtual bool meet(std::uint32_t piece, Crossing& crossing) const = 0;
  /// Finds where the line crosses the circle of an arc, which it is known to do. Beyond the span
  /// between the ends it matters little.
  virtual std::array<Crossing, 2> meet_circle(std::uint32_t arc, const EndSpan& ends) const = 0;
  /// Finds where a line that starts on the circle of an arc meets it again.
  virtual Crossing meet_circle_again(std::uint32_t arc) const = 0;
  /// Gives a crossing its t, which is known to about 100 bits, and the error of that.
  virtual void place(const DoubleDouble& t, Crossing& crossing) const = 0;
  /// Returns the sign of the first t less the second, and 0 if they are equal.
  virtual int order(const Crossing& first, const Crossing& second) const = 0;
};

/// Appends the crossings of a line with an extrusion, as Shape::crossings does. `shortest` is the
/// length in t of the shortest part of a line.
void append_crossings(const Profile& profile, PlaneLine& line, const ExtrusionTier& tier,
                      double shortest, CrossingList& out);

}  // namespace crt::core
