// The runs of an arrangement that bound the region, and how they are joined to contours.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/contours/arrangement.hpp"
#include "core/contours/biarcs.hpp"
#include "core/contours/fill.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

[[noreturn]] void refuse_touching() {
  throw Error(
      ErrorCode::unsupported,
      "contours touch so closely that rounding decides what is inside: use the even-odd rule, "
      "or draw them as several");
}

}  // namespace

bool is_inside(WindingRule rule, int winding) {
  switch (rule) {
    case WindingRule::nonzero:
      return winding != 0;
    case WindingRule::odd:
      return winding % 2 != 0;
    case WindingRule::positive:
      break;
  }
  return winding > 0;
}

bool Arrangement::is_boundary(Run& run, const WindingIndex& index) const {
  const Part& longest =
      *std::max_element(run.parts.begin(), run.parts.end(), [](const Part& a, const Part& b) {
        return glm::length(a.to - a.from) < glm::length(b.to - b.from);
      });
  const PlanePiece piece(longest.from, longest.to, longest.bulge);
  run.middle = piece.middle();
  const double distance = tolerance_ / 16;
  const Vec2 right = distance * piece.normal_at(run.middle);
  const bool in_left = is_inside(rule_, index.winding_of(run.middle - right));
  const bool in_right = is_inside(rule_, index.winding_of(run.middle + right));
  if (in_left == in_right) return false;
  if (in_right) {
    std::reverse(run.parts.begin(), run.parts.end());
    for (Part& part : run.parts) {
      std::swap(part.from, part.to);
      std::swap(part.begin, part.end);
      part.bulge = -part.bulge;
    }
  }
  run.begin = run.parts.front().begin;
  run.end = run.parts.back().end;
  return true;
}

std::vector<Arrangement::Run> Arrangement::boundary_runs(const WindingIndex& index,
                                                         std::vector<Contour>& whole) const {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < contours_.size(); ++i) {
    std::vector<Part> parts = parts_of(i);
    if (parts.empty()) refuse_touching();  // all of it is at one place
    const auto begins = [](const Part& part) { return part.begin != none; };
    const auto first = std::find_if(parts.begin(), parts.end(), begins);
    if (first == parts.end()) {
      Run run{.parts = std::move(parts)};
      if (is_boundary(run, index)) whole.push_back(*contours_[i]);
      continue;
    }
    std::rotate(parts.begin(), first, parts.end());
    for (auto part = parts.begin(); part != parts.end();) {
      const auto end = std::find_if(part + 1, parts.end(), begins);
      Run run{.parts = {part, end}};
      if (is_boundary(run, index)) runs.push_back(std::move(run));
      part = end;
    }
  }
  return runs;
}

void Arrangement::append_boundary(std::vector<Contour>& result) const {
  const WindingIndex index(pieces_, budget_);
  std::vector<Run> runs = boundary_runs(index, result);
  const auto key = [](const Run& run) { return std::tie(run.begin, run.end); };
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const Run& a, const Run& b) { return key(a) < key(b); });
  // Of runs on each other one is enough.
  const double same = 64 * tolerance_;
  std::vector<Run> different;
  for (Run& run : runs) {
    bool is_new = true;
    for (auto other = different.rbegin(); other != different.rend() && key(*other) == key(run);
         ++other) {
      budget_.spend(1);
      is_new = is_new && glm::length(other->middle - run.middle) > same;
    }
    if (is_new) different.push_back(std::move(run));
  }
  join(different, result);
}

ProfilePoint Arrangement::corner_of(const Part& part, double bulge) const {
  const std::uint32_t corner = part.begin == none ? none : meetings_[part.begin].corner;
  const auto at = [&](std::uint32_t piece) {
    return ProfilePoint{.x = begins_[piece].x, .y = begins_[piece].y, .bulge = bulge};
  };
  if (corner != none) return at(corner);
  for (const std::uint32_t piece : {part.piece, next(part.piece)}) {
    if (part.begin == none && part.from == pieces_[piece].from()) return at(piece);
  }
  return {
      .x = origin_.x + unit_ * part.from.x, .y = origin_.y + unit_ * part.from.y, .bulge = bulge};
}

void Arrangement::join(std::vector<Run>& runs, std::vector<Contour>& result) const {
  std::vector<int> balance(meetings_.size(), 0);
  for (const Run& run : runs) {
    ++balance[run.begin];
    --balance[run.end];
  }
  if (std::any_of(balance.begin(), balance.end(), [](int value) { return value != 0; })) {
    refuse_touching();
  }
  // The runs are sorted by where they begin.
  std::vector<std::size_t> nexts(meetings_.size());
  for (std::size_t i = runs.size(); i-- > 0;) nexts[runs[i].begin] = i;
  for (Run& start : runs) {
    if (start.is_used) continue;
    Contour contour;
    double bulge = 0;
    const auto add = [&](Run& run) {
      run.is_used = true;
      ++nexts[run.begin];
      for (const Part& part : run.parts) {
        contour.push_back(corner_of(part, bulge));
        bulge = bulge_with_circle(part.bulge, glm::length(part.to - part.from), least_rise_);
      }
      return run.end;
    };
    // As many runs begin at each meeting as end, so this comes back to the start.
    for (std::uint32_t at = add(start); at != start.begin;) at = add(runs[nexts[at]]);
    contour.front().bulge = bulge;
    if (encloses_area(contour)) result.push_back(std::move(contour));
  }
}

}  // namespace crt::core
