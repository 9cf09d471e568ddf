// Where a line enters and leaves a field (f <= 0) is found by proof, as far as intervals decide.
//
// A part of the line is inside or outside if its values have one sign. It has one root if its
// slopes have one sign, which Newton's iteration for intervals encloses. All other parts are
// halved. What is left are *gaps* between parts that are surely inside or outside: a root in a few
// roundings, or what could not be decided. If the line is inside on one side of a gap and outside
// on the other, it crosses there, and else it does not. So crossings alternate, whatever could not
// be decided.
//
// The work goes from near to far. Where a hard part takes all that is allowed, what comes after it
// is searched all the same, in parts that are less and less short. So a gap is no longer than a
// small share of the line, unless all of it is hard.
//
// Source: Moore, Kearfott, Cloud, Introduction to interval analysis, 2009, chapter 8 (interval
// Newton method).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/geometry/implicit/field_line.hpp"
#include "core/ray/object_ray.hpp"

namespace crt::core {

/// A FieldRoot is where a line enters or leaves a field.
struct FieldRoot {
  double x;
  double error;  ///< the crossing is surely so near
  bool is_entering;
};

/// Says how much a search may do, and when it has found enough.
struct FieldSearchLimits {
  /// After so many, only long parts are halved. At four times as many all are left as they are.
  std::uint32_t max_evaluations = 0;
  double shortest = 0;  ///< no part that is as short is halved
  /// Nothing is asked before this. What is found after it is the same without it, to the bit.
  double first = -std::numeric_limits<double>::infinity();
  /// Nothing is asked beyond the first root after this, or at all if the line is inside at once.
  double enough_after = std::numeric_limits<double>::infinity();
  bool is_enough_inside = false;
  /// A span that is no longer may be none, so that it is not enough.
  double same_place = 0;
};

class FieldSearch {
 public:
  FieldSearch(const FieldLine& line, const FieldSearchLimits& limits)
      : line_(line), limits_(limits) {}

  /// Searches a part of the line, which begins where the part before ended.
  void search(double from, double to);

  /// Says that the line is inside or outside from x on, by what is known beside the field. Where
  /// that changes there is a root.
  void know(double x, bool is_inside);

  /// Searches from a root at 0, after which the line is on that side, by identity.
  void search_from_root(double to, Side side);
  /// Searches up to a root at 0. What follows is on another side, or there is no crossing.
  void search_to_root(double from);

  /// Says that nothing follows. What nothing decided gets the sign that f has in the middle.
  void finish(double from, double to);

  /// Returns whether the line is inside before the first root, and after the last.
  bool is_inside_first() const { return first_inside_; }
  bool is_inside_last() const { return last_inside_; }
  /// Returns how far from the begin and from the end nothing was decided.
  double first_gap() const { return first_gap_; }
  double last_gap() const { return last_gap_; }
  /// Returns whether some part could not be decided.
  bool is_undecided() const { return is_undecided_; }
  bool has_enough() const { return has_enough_; }
  std::uint32_t evaluations() const { return evaluations_; }

  static constexpr std::size_t max_roots = 256;
  std::size_t count() const { return count_; }
  const FieldRoot& root(std::size_t i) const { return roots_[i]; }

 private:
  void leave_open(double from, double to, bool has_one_root);
  /// Returns the length of parts that are not halved. It grows with the work that was done.
  double shortest_part(double whole) const;
  /// Returns whether it is of no use to look at halves of a part, or too much work.
  bool is_settled(const FieldLine::Values& values, double length, double shortest) const;
  /// A Rest is what is left of a part with at most one root. It may have to be halved, and what
  /// comes after it has a known sign, or 0 where nothing comes.
  struct Rest {
    double from = 0;
    double to = 0;
    bool is_open = false;
    int sign_after = 0;
  };
  Rest narrow(double from, double to, FieldLine::Values values);
  FieldLine::Values evaluate(double from, double to) {
    ++evaluations_;
    return line_.evaluate(from, to);
  }
  struct StartPart {
    double length = 0;
    int sign = 0;  ///< of f in that part, or 0 if nothing shows it
  };
  StartPart part_beside_root(double to);

  const FieldLine& line_;
  FieldSearchLimits limits_;
  std::uint32_t evaluations_ = 0;
  bool is_known_ = false;  ///< some sign is
  bool first_inside_ = false;
  bool last_inside_ = false;
  bool is_undecided_ = false;
  bool has_enough_ = false;
  double last_enter_ = 0;
  bool is_awaited_ = false;  ///< whether the last entry is enough, once its span is long enough
  bool ignores_inside_ = false;
  // The gap after what is known, if there is one.
  bool has_gap_ = false;
  bool gap_has_one_root_ = true;
  double gap_from_ = 0;
  double gap_to_ = 0;
  double first_gap_ = 0;
  double last_gap_ = 0;
  std::size_t count_ = 0;
  std::array<FieldRoot, max_roots> roots_;
};

}  // namespace crt::core
