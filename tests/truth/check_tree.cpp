#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "crt/prepared_scene.hpp"
#include "crt/primitives.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "crt/section.hpp"
#include "truth/check_truth.hpp"
#include "truth/random_solids.hpp"

namespace crt::truth {
namespace {

/// A Mean has an estimate and its standard error.
struct Mean {
  double value = 0;
  double error = 0;

  static Mean of(const std::vector<double>& values) {
    const double count = static_cast<double>(values.size());
    Mean mean;
    for (const double value : values) mean.value += value / count;
    double squares = 0;
    for (const double value : values) squares += (value - mean.value) * (value - mean.value);
    mean.error = std::sqrt(squares / (count * (count - 1)));
    return mean;
  }
};

/// Lines sees a solid along random lines.
class Lines {
 public:
  Lines(const Entity& entity, const BoundingBox& box, Random& random)
      : queries_(prepare(scene_of(entity))), box_(box), random_(random) {}

  /// Estimates the volume by chords in cells of a grid across each axis, some times.
  Mean volume(int times, int side) {
    std::vector<double> sums;
    for (int i = 0; i < times; ++i) sums.push_back(chords(i % 3, side));
    return Mean::of(sums);
  }

  /// Estimates the area by Crofton's formula: how often lines of all directions cross the surface.
  Mean area(int times, int lines) {
    const Vec3 middle = 0.5 * (box_.lower + box_.upper);
    const double radius = 0.5001 * glm::length(box_.upper - box_.lower);
    std::vector<double> sums;
    for (int i = 0; i < times; ++i) {
      double crossings = 0;
      for (int line = 0; line < lines; ++line) {
        const Vec3 way = evenly_random_direction();
        Vec3 aside = evenly_random_direction();
        aside -= glm::dot(aside, way) * way;
        const double distance = radius * std::sqrt(random_.uniform(0, 1));
        const Vec3 from = middle + distance * glm::normalize(aside) - 2 * radius * way;
        queries_.crossings({.origin = from, .direction = way}, hits_);
        crossings += static_cast<double>(hits_.size());
      }
      sums.push_back(2 * std::numbers::pi * radius * radius * crossings / lines);
    }
    return Mean::of(sums);
  }

  /// Returns points inside, some of them nearly on the surface.
  const std::vector<Vec3>& inside() const { return inside_; }

 private:
  static Scene scene_of(const Entity& entity) {
    Scene scene;
    scene.entities = {entity};
    return scene;
  }
  Vec3 evenly_random_direction() {
    while (true) {
      const Vec3 v = random_.in_cube();
      const double squared = glm::dot(v, v);
      if (squared > 0.01 && squared <= 1) return v / std::sqrt(squared);
    }
  }

  double chords(int axis, int side) {
    const Vec3 size = box_.upper - box_.lower;
    const int other = (axis + 1) % 3;
    const int third = (axis + 2) % 3;
    double sum = 0;
    for (int i = 0; i < side; ++i) {
      for (int k = 0; k < side; ++k) {
        Vec3 from(0);
        Vec3 way(0);
        way[axis] = 1;
        from[axis] = box_.lower[axis] - size[axis];
        from[other] = box_.lower[other] + size[other] * (i + random_.uniform(0, 1)) / side;
        from[third] = box_.lower[third] + size[third] * (k + random_.uniform(0, 1)) / side;
        sum += chord(from, way);
      }
    }
    return sum * size[other] * size[third] / (side * side);
  }

  double chord(const Vec3& from, const Vec3& way) {
    queries_.crossings({.origin = from, .direction = way}, hits_);
    double sum = 0;
    double entered = 0;
    for (const Hit& hit : hits_) {
      if (hit.entering) entered = hit.t;
      if (hit.entering) continue;
      sum += hit.t - entered;
      constexpr std::size_t most_inside = 200;
      if (hit.t - entered < 1e-6 * glm::length(box_.upper - box_.lower)) continue;
      if (inside_.size() >= most_inside) continue;
      for (const double share : {0.5, 1e-5, 1 - 1e-5})
        inside_.push_back(from + (entered + share * (hit.t - entered)) * way);
    }
    return sum;
  }

  RayQueries queries_;
  BoundingBox box_;
  Random& random_;
  std::vector<Hit> hits_;
  std::vector<Vec3> inside_;
};

/// Asks about a tree and its pieces.
class TreeCheck {
 public:
  TreeCheck(std::uint64_t number, Account& account)
      : account_(account),
        tree_(random_solid(number, Leaves::all)),
        random_(1000003 * number + 41) {
    if (random_.one_in(2)) tree_.own = random_even_map(random_, factor_);
    entity_ = tree_.entity();
  }

  void run() {
    box_ = tight_bounding_box(entity_, options(1e-3, 1e-1));
    if (!(box_.lower.x <= box_.upper.x)) {
      account_.count("empty");
      check_empty();
      return;
    }
    volume_ = volume_of(entity_);
    volume_again();
    if (random_.one_in(2)) in_parts();
    by_lines();
    if (random_.one_in(4)) cut();
    if (random_.one_in(4)) area_elsewhere();
  }

 private:
  /// What is known when the time is over must be true, too.
  MeasureOptions options(double least, double most) {
    return {.relative_width = std::exp(random_.uniform(std::log(least), std::log(most))),
            .seconds = random_.power_of_ten(-3.5, -1.3),
            .threads = 1};
  }
  Interval volume_of(const Entity& entity) { return volume(entity, options(1e-4, 0.5)); }
  double size() const { return glm::length(box_.upper - box_.lower); }
  /// Returns how much rounding leaves open of a sum of volumes.
  double rounding() const {
    return 1e-12 * std::max(volume_.upper, size() * size() * size() * 1e-3);
  }

  void check_empty() {
    const Interval nothing = volume_of(entity_);
    check_holds(account_, "volumes of nothing", nothing, 0, 0);
  }

  /// Compares with another width, and with another place, by the determinant.
  void volume_again() {
    check_meet(account_, "volumes", volume_, volume_of(entity_), 0);
    const Transform map = random_map(random_);
    const double determinant = std::abs(determinant_of(map));
    const Interval elsewhere = volume_of(entity_.transformed(map));
    check_meet(account_, "volumes in two places", volume_,
               {elsewhere.lower / determinant, elsewhere.upper / determinant}, rounding());
  }

  /// The volume of what two parts have is known from those of what they have in common, and alone.
  void in_parts() {
    const SolidTree& whole = tree_.parts[0];
    if (whole.kind == SolidTree::Kind::leaf) return;
    // Half-spaces have a volume in a room alone.
    const Entity room = tree_.parts[1].entity();
    const auto placed = [&](const Entity& part) {
      const Entity in_room = (whole.own == Transform{} ? part : part.transformed(whole.own)) ^ room;
      return tree_.own == Transform{} ? in_room : in_room.transformed(tree_.own);
    };
    const Entity a = placed(whole.parts[0].entity());
    const Entity b = placed(whole.parts[1].entity());
    const Interval both = volume_of(a + b);
    const Interval common = volume_of(a ^ b);
    const Interval of_a = volume_of(a);
    const Interval of_b = volume_of(b);
    const Interval rest = volume_of(a - b);
    check_meet(account_, "volumes of both", both,
               {of_a.lower + of_b.lower - common.upper, of_a.upper + of_b.upper - common.lower},
               rounding() + 1e-12 * (of_a.upper + of_b.upper));
    check_meet(account_, "volumes of differences", rest,
               {of_a.lower - common.upper, of_a.upper - common.lower},
               rounding() + 1e-12 * of_a.upper);
  }

  /// Lines give an estimate. What seems to be off is asked again with more of them.
  void by_lines() {
    constexpr double errors = 10;
    Lines lines(entity_, box_, random_);
    const auto is_off = [&](const Interval& answer, const Mean& mean, double least) {
      const double off = errors * mean.error + least;
      return mean.value + off < answer.lower || mean.value - off > answer.upper;
    };
    const auto compare = [&](const char* what, const Interval& answer, double least,
                             const auto& estimate) {
      account_.count(what);
      for (int more = 1; more <= 16; more *= 4) {
        const Mean mean = estimate(more);
        if (!is_off(answer, mean, least / more)) return;
        if (more == 16)
          account_.fail(fmt::format("{}: {:.12g} +- {:.2g}, not in {}", what, mean.value,
                                    mean.error, text_of(answer)));
      }
    };
    const double cube = std::pow(size(), 3);
    compare("volumes by chords", volume_, 1e-3 * cube,
            [&](int more) { return lines.volume(9, 10 * more); });
    if (random_.one_in(2)) {
      area_ = surface_area(entity_, options(1e-2, 0.5));
      compare("areas by crossings", area_, 1e-2 * size() * size(),
              [&](int more) { return lines.area(8, 60 * more * more); });
    }
    check_inside(lines.inside());
  }

  /// No point that is inside is out of the box, nor said to be outside.
  void check_inside(const std::vector<Vec3>& points) {
    std::vector<PointSide> sides(points.size());
    contains(entity_, points, sides, 1);
    account_.count("points by rays", points.size());
    account_.count("boxes");
    const BoundingBox fine = tight_bounding_box(entity_, options(1e-6, 1e-3));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3& p = points[i];
      const auto text = [&] { return fmt::format("({:.17g}, {:.17g}, {:.17g})", p.x, p.y, p.z); };
      if (sides[i] == PointSide::outside) account_.fail(text() + " is inside");
      for (const BoundingBox& box : {box_, fine}) {
        if (glm::any(glm::lessThan(p, box.lower)) || glm::any(glm::greaterThan(p, box.upper)))
          account_.fail(text() + " is out of the box");
      }
    }
  }

  /// What a plane cuts a solid into has its volume together, and its area with twice the section.
  void cut() {
    const Vec3 normal = random_.direction() + 0.01 * random_.in_cube();
    const Vec3 at = 0.5 * (box_.lower + box_.upper) + 0.2 * size() * random_.in_cube();
    const Entity below = Plane{.normal = normal, .position = at};
    const Entity one = entity_ ^ below;
    const Entity other = entity_ - below;
    const Interval a = volume_of(one);
    const Interval b = volume_of(other);
    check_meet(account_, "volumes of halves", volume_, {a.lower + b.lower, a.upper + b.upper},
               rounding());
    const double offset = glm::dot(normal, at) / glm::length(normal);
    const Section cut = section(entity_, normal, offset, 1e-2 * size(), options(1e-4, 0.1));
    const auto area_of = [&](const Entity& part) { return surface_area(part, options(1e-2, 0.3)); };
    const Interval whole = area_of(entity_);
    const Interval of_one = area_of(one);
    const Interval of_other = area_of(other);
    check_meet(account_, "areas of halves",
               {whole.lower + 2 * cut.area.lower, whole.upper + 2 * cut.area.upper},
               {of_one.lower + of_other.lower, of_one.upper + of_other.upper},
               1e-9 * size() * size());
  }

  void area_elsewhere() {
    double factor = 1;
    const Transform map = random_even_map(random_, factor);
    const Interval here = surface_area(entity_, options(1e-3, 0.3));
    const Interval there = surface_area(entity_.transformed(map), options(1e-3, 0.3));
    check_meet(account_, "areas in two places", here,
               {there.lower / (factor * factor), there.upper / (factor * factor)},
               1e-12 * size() * size());
  }

  Account& account_;
  SolidTree tree_;
  Random random_;
  double factor_ = 1;
  Entity entity_ = Sphere{};
  BoundingBox box_;
  Interval volume_;
  Interval area_;
};

}  // namespace

void check_tree(std::uint64_t number, Account& account) {
  TreeCheck(number, account).run();
}

}  // namespace crt::truth
