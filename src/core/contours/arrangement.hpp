// An arrangement is contours that are near each other, cut where they meet: see fill.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/contours/fill.hpp"
#include "core/contours/winding.hpp"
#include "core/geometry/plane_piece.hpp"
#include "crt/primitives.hpp"

namespace crt::core {

class Arrangement {
 public:
  Arrangement(std::span<const Contour* const> contours, WindingRule rule, Budget& budget);

  /// Appends the contours that bound the region by the rule.
  void append_boundary(std::vector<Contour>& result) const;

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  /// A Meeting is where pieces meet. Those that are close together are one.
  struct Meeting {
    Vec2 place{0, 0};
    std::uint32_t first = 0;      ///< the one that stands for all that are close together
    std::uint32_t corner = none;  ///< a piece that begins here
  };
  /// A Cut is a meeting within a piece.
  struct Cut {
    std::uint32_t piece = 0;
    double order = 0;
    std::uint32_t meeting = 0;
  };
  /// A Part is what is left of a piece between cuts.
  struct Part {
    Vec2 from{0, 0};
    Vec2 to{0, 0};
    double bulge = 0;
    std::uint32_t begin = none;  ///< the meeting where it begins
    std::uint32_t end = none;
    std::uint32_t piece = 0;
  };
  /// A Run is parts that follow one another without a meeting between them, with the region to the
  /// left.
  struct Run {
    std::vector<Part> parts;
    std::uint32_t begin = none;
    std::uint32_t end = none;
    Vec2 middle{0, 0};  ///< a point of it
    bool is_used = false;
  };

  std::uint32_t next(std::uint32_t piece) const;
  void find_meetings();
  void meet(std::uint32_t a, std::uint32_t b);
  void add_meeting(const Vec2& place, std::uint32_t a, std::uint32_t b);
  void add_to(std::uint32_t piece, std::uint32_t meeting);
  void mark_corner(std::uint32_t piece, std::uint32_t meeting);
  void join_close_meetings();
  std::uint32_t first_of(std::uint32_t meeting);
  void unite(std::uint32_t a, std::uint32_t b);

  std::vector<Part> parts_of(std::size_t contour) const;
  /// Returns whether it bounds the region. If so, it is turned to have that on its left.
  bool is_boundary(Run& run, const WindingIndex& index) const;
  std::vector<Run> boundary_runs(const WindingIndex& index, std::vector<Contour>& whole) const;
  void join(std::vector<Run>& runs, std::vector<Contour>& result) const;
  ProfilePoint corner_of(const Part& part, double bulge) const;

  std::span<const Contour* const> contours_;
  WindingRule rule_;
  Budget& budget_;
  Vec2 origin_{0, 0};
  double unit_ = 1;
  double tolerance_ = 0;
  double least_rise_ = 0;
  std::vector<PlanePiece> pieces_;
  std::vector<ProfilePoint> begins_;    ///< of the pieces, as they were given
  std::vector<std::uint32_t> contour_;  ///< of each piece
  std::vector<std::uint32_t> first_;    ///< the first piece of each contour, and the end
  std::vector<std::uint32_t> corners_;  ///< the meeting where a piece begins, or none
  std::vector<Meeting> meetings_;
  std::vector<Cut> cuts_;
};

}  // namespace crt::core
