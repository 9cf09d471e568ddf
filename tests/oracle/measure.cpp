#include "oracle/measure.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <thread>

#include "core/geometry/exact_shape.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "core/geometry/placement.hpp"
#include "core/queries/input_rays.hpp"
#include "oracle/naive.hpp"
#include "oracle/number_vec.hpp"

namespace crt::test {
namespace {

using core::Crossing;
using core::CrossingList;

constexpr double u = unit_of_rounding;
/// The measurement itself may be off by this factor.
constexpr double tolerance = 1 + 0x1p-20;
constexpr std::size_t max_failures = 20;

Question question_of(const TestRay& ray) {
  return {ray.primitive, ray.origin, ray.direction, ray.to_world};
}

double error_of(double t, const TrueCrossing& crossing) {
  return std::abs((crossing.t - Ball<4>(t)).value());
}

/// Returns the distance of the doubles around it.
double spacing_at(const Ball<4>& t) {
  const double size = std::abs(t.value());
  const bool below = t.part(1) != 0 && (t.part(1) < 0) == (t.value() > 0);
  return below ? size - std::nextafter(size, 0) : test::ulp(size);
}

double bound_of(const TrueCrossing& crossing, const TestRay& ray, Promise promise) {
  const double last_place = spacing_at(crossing.t);
  if (promise == Promise::exact)
    return (std::holds_alternative<Torus>(ray.primitive) ? 1 : 0.51) * last_place;
  return last_place / 2 + 8 * u * crossing.reach / crossing.approach;
}

bool is_inside_at(double t, bool inside_before, const std::vector<double>& flips) {
  const auto passed =
      std::count_if(flips.begin(), flips.end(), [&](double flip) { return flip < t; });
  return (passed % 2 == 1) != inside_before;
}

/// Says whether found and true membership differ somewhere beyond the bound.
bool differs_beyond_bound(const TestRay& ray, bool found_before, const std::vector<double>& found,
                          bool true_before, const std::vector<double>& expected) {
  std::vector<double> places = found;
  places.insert(places.end(), expected.begin(), expected.end());
  std::sort(places.begin(), places.end());
  const double speed = glm::length(ray.direction);
  const double size = size_of(ray.primitive);
  const auto wrong_at = [&](double t) {
    const bool inside = is_inside_at(t, found_before, found);
    if (inside == is_inside_at(t, true_before, expected)) return false;
    const double outside = true_distance(question_of(ray), t);
    const double from_center =
        glm::length(ray.origin - center_of(ray.primitive) + t * ray.direction);
    // `from_center` is rounded on the way there, and the spacing of t covers that.
    const double allowed = 8 * u * (size + from_center) + ulp(t) * speed;
    return (inside ? outside : -outside) > allowed;
  };
  if (places.empty()) return wrong_at(0);
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    for (const double share : {0.25, 0.5, 0.75}) {
      if (wrong_at(places[i] + share * (places[i + 1] - places[i]))) return true;
    }
  }
  const double step = (size + 1) / speed;
  return wrong_at(places.front() - step) || wrong_at(places.back() + step);
}

bool surface_differs_beyond_bound(const TestRay& ray, const CrossingList& found) {
  const double t = found.empty() ? 0 : found[0].t;
  const double beyond = true_distance(question_of(ray), t);
  const TrueLine meeting = true_plane_crossings(question_of(ray));
  if (meeting.crossings.empty()) return !found.empty();
  const TrueCrossing& crossing = meeting.crossings[0];
  const double across = 8 * u * (size_of(ray.primitive) + crossing.reach);
  const double allowed = across * (1 + glm::length(ray.direction) / crossing.approach);
  return (found.empty() ? -beyond : beyond) > allowed;
}

void account(const Crossing& found, const TrueCrossing& crossing, const TestRay& ray,
             Promise promise, Record& record) {
  const double error = error_of(found.t, crossing);
  const double true_t = crossing.t.value();
  // Where a ray starts on a surface t is nothing but rounding, and has no last place of its own.
  constexpr double start = 0x1p-40;
  if (std::abs(true_t) * glm::length(ray.direction) > start * crossing.reach) {
    const double ulps = error / spacing_at(crossing.t);
    record.ulps_by_kind[static_cast<std::size_t>(ray.kind)].add(ulps);
    if (ray.kind == RayKind::plain)
      record.ulps_by_decade[static_cast<std::size_t>(ray.decade - lowest_decade)].add(ulps);
  }
  record.largest_ratio = std::max(record.largest_ratio, error / bound_of(crossing, ray, promise));
  if (promise == Promise::standard && error > 0 && !crossing.at_edge)
    record.largest_claim = std::max(record.largest_claim, error / found.error);
  constexpr double accuracy = 0x1p-10;
  if (promise == Promise::exact && crossing.t.radius() <= accuracy * found.error) {
    const double rest = std::abs((crossing.t - Ball<4>(found.t) - Ball<4>(found.t_low)).value());
    if (rest > 0) record.largest_claim = std::max(record.largest_claim, rest / found.error);
  }
}

/// Asks a shape as a query does, with the direction scaled to near length 1, and scales the results
/// back.
template <class Ask>
bool ask_as_query(const TestRay& ray, CrossingList& out, const Ask& ask) {
  core::WorldRay world;
  core::follow({.origin = ray.origin, .direction = ray.scale * ray.direction}, {}, world);
  const bool inside_before = ask(world.origin, world.direction);
  const double factor =
      core::largest_component(world.direction) / core::largest_component(ray.direction);
  for (Crossing& crossing : out) {
    crossing.t *= factor;
    crossing.t_low *= factor;
    crossing.error *= factor;
  }
  return inside_before;
}

}  // namespace

Contestant standard_tier() {
  return {.name = "standard",
          .promise = Promise::standard,
          .crossings = [](const TestRay& ray, CrossingList& out, std::uint64_t&) {
            return ask_as_query(ray, out, [&](const Vec3& origin, const Vec3& direction) {
              const core::ObjectRay object_ray{.origin = origin, .direction = direction};
              return core::make_shape(ray.primitive)->crossings(object_ray, out);
            });
          }};
}

Contestant exact_tier() {
  return {.name = "exact",
          .promise = Promise::exact,
          .crossings = [](const TestRay& ray, CrossingList& out, std::uint64_t& escalations) {
            return ask_as_query(ray, out, [&](const Vec3& origin, const Vec3& direction) {
              const core::Placement placement{core::PreciseTransform(ray.to_world)};
              const core::ObjectRay object_ray = placement.to_object(origin, direction);
              core::ExactRay exact = placement.to_object_exactly(origin, direction, object_ray);
              exact.escalations = &escalations;
              return core::make_exact_shape(ray.primitive)->crossings(exact, out);
            });
          }};
}

Contestant naive_formulas() {
  return {.name = "naive", .crossings = [](const TestRay& ray, CrossingList& out, std::uint64_t&) {
            return naive_crossings(ray.primitive, ray.origin, ray.direction, out);
          }};
}

void Histogram::add(double value) {
  ++count_;
  largest_ = std::max(largest_, value);
  const double place = (std::log2(value) - lowest_exponent) * bins_per_octave;
  const double last = static_cast<double>(bins_.size() - 1);
  ++bins_[static_cast<std::size_t>(value > 0 ? std::clamp(std::ceil(place), 0.0, last) : 0.0)];
}

void Histogram::add(const Histogram& other) {
  count_ += other.count_;
  largest_ = std::max(largest_, other.largest_);
  for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
}

double Histogram::quantile(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t passed = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    passed += bins_[i];
    if (passed >= wanted)
      return std::min(largest_,
                      std::exp2(lowest_exponent + static_cast<double>(i) / bins_per_octave));
  }
  return largest_;
}

void Record::add(const Record& other) {
  rays += other.rays;
  hits += other.hits;
  close_calls += other.close_calls;
  wrong += other.wrong;
  escalations += other.escalations;
  largest_ratio = std::max(largest_ratio, other.largest_ratio);
  largest_claim = std::max(largest_claim, other.largest_claim);
  for (std::size_t i = 0; i < ray_kinds; ++i) {
    rays_by_kind[i] += other.rays_by_kind[i];
    close_calls_by_kind[i] += other.close_calls_by_kind[i];
    ulps_by_kind[i].add(other.ulps_by_kind[i]);
  }
  for (std::size_t i = 0; i < ulps_by_decade.size(); ++i)
    ulps_by_decade[i].add(other.ulps_by_decade[i]);
  failures.insert(failures.end(), other.failures.begin(), other.failures.end());
  std::sort(failures.begin(), failures.end());
  if (failures.size() > max_failures) failures.resize(max_failures);
}

Truth truth_of(const TestRay& ray, FirstTry first) {
  // Doubles cannot represent the products of components that are so far apart.
  const bool is_extreme = ray.kind == RayKind::extreme_length;
  return {ray, true_crossings(question_of(ray), is_extreme ? FirstTry::mpfr : first)};
}

bool measure(const Truth& truth, const Contestant& contestant, std::uint64_t number,
             Record& record) {
  const TestRay& ray = truth.ray;
  const std::vector<TrueCrossing>& expected = truth.line.crossings;
  CrossingList found;
  const bool found_before = contestant.crossings(ray, found, record.escalations);
  ++record.rays;
  ++record.rays_by_kind[static_cast<std::size_t>(ray.kind)];
  if (!expected.empty()) ++record.hits;
  bool kept = true;
  const bool same =
      found_before == truth.line.inside_before && found.size() == expected.size() &&
      std::equal(found.begin(), found.end(), expected.begin(),
                 [](const auto& a, const auto& b) { return a.entering == b.entering; });
  if (same) {
    const double ratio_before = record.largest_ratio;
    const double claim_before = record.largest_claim;
    record.largest_ratio = record.largest_claim = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      account(found[i], expected[i], ray, contestant.promise, record);
    kept = record.largest_ratio <= tolerance && record.largest_claim <= tolerance;
    record.largest_ratio = std::max(record.largest_ratio, ratio_before);
    record.largest_claim = std::max(record.largest_claim, claim_before);
  } else {
    std::vector<double> found_t;
    std::vector<double> expected_t;
    for (const Crossing& crossing : found) found_t.push_back(crossing.t);
    for (const TrueCrossing& crossing : expected) expected_t.push_back(crossing.t.value());
    const bool is_solid = core::is_solid(ray.primitive);
    const bool wrong = contestant.promise == Promise::exact ||
                       (is_solid ? differs_beyond_bound(ray, found_before, found_t,
                                                        truth.line.inside_before, expected_t)
                                 : surface_differs_beyond_bound(ray, found));
    ++(wrong ? record.wrong : record.close_calls);
    if (!wrong) ++record.close_calls_by_kind[static_cast<std::size_t>(ray.kind)];
    kept = !wrong;
  }
  if (!kept && record.failures.size() < max_failures) record.failures.push_back(number);
  return kept;
}

std::vector<Record> measure_all(std::size_t primitive_kind, std::uint64_t first, std::uint64_t last,
                                const std::vector<Contestant>& contestants, RayMaker maker) {
  constexpr std::uint64_t batch = 256;
  const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::vector<Record>> parts(threads, std::vector<Record>(contestants.size()));
  std::atomic<std::uint64_t> next = first;
  const auto work = [&](std::vector<Record>& records) {
    while (true) {
      const std::uint64_t begin = next.fetch_add(batch);
      if (begin >= last) break;
      for (std::uint64_t number = begin; number < std::min(begin + batch, last); ++number) {
        // Now and then more bits check what the exact tier claims of t_low.
        constexpr std::uint64_t finer = 16;
        const FirstTry first_try =
            number % finer == 0 ? FirstTry::three_doubles : FirstTry::two_doubles;
        const Truth truth = truth_of(maker(primitive_kind, number), first_try);
        for (std::size_t i = 0; i < contestants.size(); ++i)
          measure(truth, contestants[i], number, records[i]);
      }
    }
    mpfr_free_cache();
  };
  std::vector<std::thread> workers;
  for (std::vector<Record>& records : parts) workers.emplace_back(work, std::ref(records));
  for (std::thread& worker : workers) worker.join();
  std::vector<Record> result(contestants.size());
  for (const std::vector<Record>& records : parts) {
    for (std::size_t i = 0; i < result.size(); ++i) result[i].add(records[i]);
  }
  return result;
}

std::string description(const TestRay& ray) {
  const auto text = [](const Vec3& v) {
    return fmt::format("{{{:a}, {:a}, {:a}}}", v.x, v.y, v.z);
  };
  const auto primitive = [&]<class P>(const P& p) -> std::string {
    if constexpr (std::is_same_v<P, Sphere>)
      return fmt::format("sphere {} {:a}", text(p.center), p.radius);
    else if constexpr (std::is_same_v<P, Box>)
      return fmt::format("box {} {}", text(p.corner_a), text(p.corner_b));
    else if constexpr (std::is_same_v<P, RoundedBox>)
      return fmt::format("rounded box {} {} {:a}", text(p.corner_a), text(p.corner_b), p.radius);
    else if constexpr (std::is_same_v<P, Plane>)
      return fmt::format("plane {} {}", text(p.normal), text(p.position));
    else if constexpr (std::is_same_v<P, HalfPlane>)
      return fmt::format("half plane {} {} {}", text(p.normal), text(p.position),
                         text(p.direction));
    else if constexpr (std::is_same_v<P, Cylinder>)
      return fmt::format("cylinder {} {} {:a}", text(p.from), text(p.to), p.radius);
    else if constexpr (std::is_same_v<P, Cone>)
      return fmt::format("cone {} {} {:a} {:a}", text(p.from), text(p.to), p.radius, p.radius2);
    else if constexpr (std::is_same_v<P, Capsule>)
      return fmt::format("capsule {} {} {:a}", text(p.from), text(p.to), p.radius);
    else if constexpr (std::is_same_v<P, Torus>)
      return fmt::format("torus {} {} {:a} {:a}", text(p.center), text(p.axis), p.radius,
                         p.thickness);
    else if constexpr (std::is_same_v<P, Disc>)
      return fmt::format("disc {} {} {:a}", text(p.center), text(p.normal), p.radius);
    else if constexpr (std::is_same_v<P, Extrusion>) {
      const ArchedTriangle profile(*p.profile);
      const auto& [a, b, c] = profile.corners;
      return fmt::format("extrusion {} {} {} bulge {:a} from {:a} to {:a}", text(a), text(b),
                         text(c), p.profile->contours()[0][0].bulge, p.from, p.to);
    } else if constexpr (std::is_same_v<P, Revolution>) {
      const ArchedTriangle profile(*p.profile);
      const auto& [a, b, c] = profile.corners;
      return fmt::format("revolution {} {} {} bulge {:a} angle {:a}", text(a), text(b), text(c),
                         p.profile->contours()[0][0].bulge, p.angle);
    } else if constexpr (std::is_same_v<P, HeightField>) {
      const CornerField corners(p);
      const auto& [a, b, c, d] = corners.tops;
      return fmt::format("height field {} {} tops {:a} {:a} {:a} {:a}", text(corners.lower),
                         text(corners.upper), a.y, b.y, c.y, d.y);
    } else if constexpr (std::is_same_v<P, Quadric>)
      return fmt::format("quadric {} {} {} {:a}", text(p.squares), text(p.products), text(p.linear),
                         p.constant);
    else if constexpr (WithoutOracle<P>)
      has_no_oracle();
    else if constexpr (std::is_same_v<P, Mesh>)
      return fmt::format("mesh of {} triangles", p.triangles->size());
    else
      return fmt::format("triangle {} {} {}", text(p.a), text(p.b), text(p.c));
  };
  const std::string placed =
      ray.to_world == Transform{}
          ? ""
          : fmt::format(", rows {} {} {} translation {}", text(ray.to_world.row_x),
                        text(ray.to_world.row_y), text(ray.to_world.row_z),
                        text(ray.to_world.translation));
  return fmt::format("{} ({}, 10^{} sizes away): origin {}, direction {}{}{}",
                     std::visit(primitive, ray.primitive), name_of(ray.kind), ray.decade,
                     text(ray.origin), text(ray.direction), placed,
                     ray.scale == 1 ? "" : fmt::format(", stretched {:a}", ray.scale));
}

}  // namespace crt::test
