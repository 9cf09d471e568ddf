#include "oracle/field_measure.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "core/geometry/exact_shape.hpp"
#include "core/geometry/shape.hpp"
#include "geometry/random.hpp"
#include "oracle/line_polynomial.hpp"
#include "oracle/turns.hpp"

namespace crt::test {
namespace {

constexpr std::size_t max_field_failures = 20;

/// Holds the numbers that make a field one of its kind.
struct RandomField {
  RandomField(FieldKind of, Random& random) : kind(of) {
    size = random.power_of_ten(-3, 3);
    middle = random.one_in(2) ? Vec3(0) : size * random.power_of_ten(-2, 1) * random.in_cube();
    for (double& number : numbers) number = random.uniform(-1, 1);
  }

  FieldKind kind;
  double size = 1;  ///< half a side of its box
  Vec3 middle{0};
  std::array<double, 20> numbers{};
};

/// Returns the value of a field at a point: a Field, a polynomial along a line, or a number.
template <class T>
T value_at(const RandomField& field, const T& world_x, const T& world_y, const T& world_z) {
  using std::pow;
  // A power of two changes no digits, so that the field is the same function for all T.
  const double scale = std::exp2(-std::round(std::log2(field.size)));
  const T x = (world_x - T(field.middle.x)) * T(scale);
  const T y = (world_y - T(field.middle.y)) * T(scale);
  const T z = (world_z - T(field.middle.z)) * T(scale);
  const std::array<double, 20>& n = field.numbers;
  const auto number = [](double value) { return T(value); };
  switch (field.kind) {
    case FieldKind::ball:
      return pow(x, 2) + pow(y, 2) + pow(z, 2) - number(0.4 + 0.2 * n[0]);
    case FieldKind::torus: {
      const double major = 0.45 + 0.1 * n[0];
      const double minor = 0.2 + 0.15 * n[1];
      const T rho = x * x + z * z;
      return pow(rho + y * y + number(major * major - minor * minor), 2) -
             number(4 * major * major) * rho;
    }
    case FieldKind::two_balls: {
      const T near = pow(x - number(0.35), 2) + y * y + z * z;
      const T far = pow(x + number(0.35), 2) + y * y + z * z;
      return near * far - number(std::pow(0.35 + 0.1 * n[0], 4));
    }
    case FieldKind::cubic: {
      T sum = number(0.2 * n[0]);
      std::size_t next = 1;
      for (const T* a : {&x, &y, &z}) {
        sum = sum + number(n[next++]) * *a;
        for (const T* b : {&x, &y, &z}) {
          if (b < a) continue;
          sum = sum + number(n[next++]) * (*a * *b);
          for (const T* c : {&x, &y, &z}) {
            if (c >= b) sum = sum + number(n[next++]) * (*a * *b * *c);
          }
        }
      }
      return sum;
    }
    case FieldKind::heart: {
      const T u = number(1.4) * x;
      const T v = number(1.4) * y;
      const T w = number(1.4) * z;
      return pow(u * u + number(2.25) * v * v + w * w - number(1), 3) - u * u * w * w * w -
             number(0.1125) * v * v * w * w * w;
    }
    case FieldKind::cones: {
      const auto fourth = [&](const T& a) {
        const T b = number(1.25) * a;
        return number(8) * pow(b, 4) - number(8) * pow(b, 2) + number(1);
      };
      return fourth(x) + fourth(y) + fourth(z) + number(1);
    }
    case FieldKind::thin_shell:
      return pow(pow(x, 2) + pow(y, 2) + pow(z, 2) - number(0.5), 2) -
             number(std::pow(10, -6 + 4 * n[0]));
    case FieldKind::crossed_rods:
      return (x * x + y * y - number(0.15)) * (y * y + z * z - number(0.15)) *
                 (x * x + z * z - number(0.15 + 0.01 * n[0])) -
             number(n[1] > 0 ? 0 : 1e-3 * n[1]);
  }
  return number(1);
}

/// A TrueFlip is where a line enters or leaves a solid.
struct TrueFlip {
  LineRoot place;
  bool entering;
};

/// The truth about a line and where a field is at most 0 in a box.
class TrueFieldLine {
 public:
  TrueFieldLine(const RandomField& field, const Implicit& implicit, const Vec3& origin,
                const Vec3& direction) {
    const auto along = [&](int axis) {
      return LinePolynomial({mpq_class(origin[axis]), mpq_class(direction[axis])});
    };
    mpq_class from;
    mpq_class to;
    if (!meets_box(implicit, origin, direction, from, to)) return;
    const LinePolynomial f = value_at(field, along(0), along(1), along(2));
    if (f.is_zero()) {
      flips_ = {{LineRoot(from), true}, {LineRoot(to), false}};
      return;
    }
    once_ = f.without_multiples();
    for (const mpq_class& end : {from, to}) {
      if (once_.sign_at(end) == 0) once_ = once_.without_root(end);
    }
    std::vector<LineRoot> places = {LineRoot(from)};
    for (LineRoot& root : roots_between(once_, from, to)) {
      while (root.lower() == from || root.upper() == to)
        root.narrow((root.upper() - root.lower()) / 2);
      places.push_back(root);
    }
    places.emplace_back(to);
    bool inside = false;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool next_inside =
          i + 1 < places.size() && f.sign_at((places[i].upper() + places[i + 1].lower()) / 2) < 0;
      if (next_inside != inside) flips_.push_back({places[i], next_inside});
      inside = next_inside;
    }
  }
  TrueFieldLine(const TrueFieldLine&) = delete;
  TrueFieldLine& operator=(const TrueFieldLine&) = delete;

  std::vector<TrueFlip>& flips() { return flips_; }

 private:
  static bool meets_box(const Implicit& implicit, const Vec3& origin, const Vec3& direction,
                        mpq_class& from, mpq_class& to) {
    bool is_first = true;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) {
        if (origin[axis] < implicit.lower[axis] || origin[axis] > implicit.upper[axis])
          return false;
        continue;
      }
      const mpq_class start(origin[axis]);
      const mpq_class speed(direction[axis]);
      mpq_class enters = (mpq_class(implicit.lower[axis]) - start) / speed;
      mpq_class leaves = (mpq_class(implicit.upper[axis]) - start) / speed;
      if (enters > leaves) std::swap(enters, leaves);
      from = is_first ? enters : std::max(from, enters);
      to = is_first ? leaves : std::min(to, leaves);
      is_first = false;
    }
    return from < to;
  }

  LinePolynomial once_{0.0};
  std::vector<TrueFlip> flips_;
};

mpq_class place_of(const core::Crossing& crossing) {
  return mpq_class(crossing.t) + mpq_class(crossing.t_low);
}

/// Returns -1, 0 or 1 where a flip is before a crossing, within its error, or after it.
int side_of(TrueFlip& flip, const core::Crossing& crossing) {
  const mpq_class t = place_of(crossing);
  const mpq_class error(crossing.error);
  if (flip.place.compared_to(t - error) < 0) return -1;
  return flip.place.compared_to(t + error) > 0 ? 1 : 0;
}

/// Returns the error of a crossing over the bound that comes with it.
double ratio_of(TrueFlip& flip, const core::Crossing& crossing) {
  if (crossing.error == 0) return 0;  // the flip is there, by side_of()
  constexpr double share = 0x1p-8;
  flip.place.narrow(mpq_class(share * crossing.error));
  const mpq_class off = abs(place_of(crossing) - flip.place.lower());
  return std::max(0.0, mpq_class(off / mpq_class(crossing.error)).get_d() - share);
}

/// Returns whether each crossing of the field has an odd number of flips within its error. One at
/// the box may be there by the sign of the field in the middle of what is not decided.
bool enclose_odd_numbers(const core::CrossingList& found, std::vector<TrueFlip>& flips) {
  return std::all_of(found.begin(), found.end(), [&](const core::Crossing& crossing) {
    const auto count = std::count_if(flips.begin(), flips.end(),
                                     [&](TrueFlip& flip) { return side_of(flip, crossing) == 0; });
    return crossing.face == 0 ? count % 2 == 1 : count > 0 || flips.empty();
  });
}

/// Looks at what a tier reports of a ray. Returns whether it kept its promises.
bool keeps_promises(const core::CrossingList& found, std::vector<TrueFlip>& flips, double box_size,
                    FieldTierRecord& record) {
  if (!take_turns(found)) return false;
  if (found.undecided > 0) {
    ++record.undecided;
    record.others += found.size() != flips.size() ? 1 : 0;
    return enclose_odd_numbers(found, flips);
  }
  if (found.size() != flips.size()) return false;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].entering != flips[i].entering || side_of(flips[i], found[i]) != 0) return false;
    record.largest_ratio = std::max(record.largest_ratio, ratio_of(flips[i], found[i]));
    record.largest_bound = std::max(record.largest_bound, found[i].error / box_size);
  }
  return true;
}

/// Returns a point near the field: where a line from the middle leaves it, or some point.
Vec3 point_near(const RandomField& field, Random& random) {
  const auto value = [&](const Vec3& p) { return value_at<double>(field, p.x, p.y, p.z); };
  Vec3 from = field.middle + 0.3 * field.size * random.in_cube();
  Vec3 to = field.middle + field.size * random.in_cube();
  const bool begins_inside = value(from) <= 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3 half = 0.5 * (from + to);
    ((value(half) <= 0) == begins_inside ? from : to) = half;
  }
  return from;
}

/// Returns a direction about along the field at a point.
Vec3 tangent_at(const RandomField& field, const Vec3& p, Random& random) {
  Vec3 gradient(0);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 step(0);
    step[axis] = 1e-5 * field.size;
    const Vec3 after = p + step;
    const Vec3 before = p - step;
    gradient[axis] = value_at<double>(field, after.x, after.y, after.z) -
                     value_at<double>(field, before.x, before.y, before.z);
  }
  const Vec3 across = glm::cross(gradient, random.direction());
  const double length = glm::length(across);
  return length > 0 ? across / length : random.direction();
}

core::ObjectRay ray_at(const RandomField& field, Random& random) {
  const std::uint64_t kind = random.bits() % 8;
  Vec3 aim = field.middle + field.size * random.in_cube();
  Vec3 direction = random.direction();
  if (kind < 2) {
    aim = point_near(field, random);
    direction = tangent_at(field, aim, random);
    if (random.one_in(2)) direction += random.power_of_ten(-16, -2) * random.in_cube();
  } else if (kind == 2) {
    aim = field.middle;
  } else if (kind == 3) {
    direction = Vec3(0);
    direction[static_cast<int>(random.bits() % 3)] = random.one_in(2) ? 1 : -1;
  }
  const double away = kind == 4 ? random.power_of_ten(1, 8) : random.uniform(-1, 4);
  return {.origin = aim - away * field.size * direction,
          .direction = direction * random.power_of_ten(-3, 3)};
}

/// A MeasuredField is a field as both tiers have it.
struct MeasuredField {
  explicit MeasuredField(const RandomField& field)
      : implicit{.field = value_at(field, Field::x(), Field::y(), Field::z()),
                 .lower = field.middle - Vec3(field.size),
                 .upper = field.middle + Vec3(field.size)},
        standard(core::make_shape(implicit)),
        exact(core::make_exact_shape(implicit)) {}

  Implicit implicit;
  std::unique_ptr<const core::Shape> standard;
  std::unique_ptr<const core::ExactShape> exact;
};

void add_failure(std::string failure, FieldRecord& record) {
  if (record.failures.size() < max_field_failures) record.failures.push_back(std::move(failure));
}

}  // namespace

const char* name_of(FieldKind kind) {
  constexpr std::array<const char*, field_kinds> names = {
      "ball", "torus", "two balls", "cubic", "heart", "cones", "thin shell", "crossed rods"};
  return names[static_cast<std::size_t>(kind)];
}

void FieldRecord::add(const FieldRecord& other) {
  fields += other.fields;
  rays += other.rays;
  crossings += other.crossings;
  const auto add_tier = [](FieldTierRecord& to, const FieldTierRecord& from) {
    to.wrong += from.wrong;
    to.undecided += from.undecided;
    to.others += from.others;
    to.largest_ratio = std::max(to.largest_ratio, from.largest_ratio);
    to.largest_bound = std::max(to.largest_bound, from.largest_bound);
  };
  add_tier(standard, other.standard);
  add_tier(exact, other.exact);
  for (const std::string& failure : other.failures) add_failure(failure, *this);
}

FieldRecord measure_fields(FieldKind kind, std::uint64_t fields, std::uint64_t rays_each) {
  FieldRecord record;
  record.fields = fields;
  core::CrossingList found;
  for (std::uint64_t number = 0; number < fields; ++number) {
    Random random((number + 1) * field_kinds + static_cast<std::uint64_t>(kind));
    const RandomField field(kind, random);
    const MeasuredField measured(field);
    for (std::uint64_t i = 0; i < rays_each; ++i) {
      const core::ObjectRay ray = ray_at(field, random);
      TrueFieldLine truth(field, measured.implicit, ray.origin, ray.direction);
      ++record.rays;
      record.crossings += truth.flips().size();
      // A bound is in units of t.
      const double box_size = field.size / glm::length(ray.direction);
      const auto measure = [&](const char* tier, FieldTierRecord& of, const auto& ask) {
        found.clear();
        found.undecided = 0;
        const bool begins_inside = ask();
        if (!begins_inside && keeps_promises(found, truth.flips(), box_size, of)) return;
        ++of.wrong;
        add_failure(fmt::format("{}: field {}, ray {}: {}", name_of(kind), number, i, tier),
                    record);
      };
      measure("standard", record.standard,
              [&] { return measured.standard->crossings(ray, found); });
      measure("exact", record.exact, [&] {
        return measured.exact->crossings(
            {.near = ray, .world_origin = ray.origin, .world_direction = ray.direction}, found);
      });
    }
  }
  return record;
}

}  // namespace crt::test
