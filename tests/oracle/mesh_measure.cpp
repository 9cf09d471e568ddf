#include "oracle/mesh_measure.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/geometry/exact_shape.hpp"
#include "core/geometry/shape.hpp"
#include "crt/mesh.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/scene.hpp"
#include "crt/transform.hpp"
#include "oracle/line_oracle.hpp"
#include "oracle/mesh_oracle.hpp"
#include "oracle/turns.hpp"

namespace crt::test {
namespace {

constexpr std::size_t max_mesh_failures = 20;
constexpr double last_place_share = 0.51;

mpq_class distance(const mpq_class& a, const mpq_class& b) {
  return abs(a - b);
}

/// Returns |t - truth| in units of 0.51 times the distance of the doubles around the truth.
double exact_ratio(double t, const mpq_class& truth) {
  const mpq_class error = mpq_class(t) - truth;
  if (sgn(error) == 0) return 0;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double next = std::nextafter(t, sgn(error) > 0 ? -infinity : infinity);
  return std::abs(error.get_d()) / (last_place_share * std::abs(next - t));
}

using Flips = std::vector<const MeshPlace*>;

/// Returns whether the crossings are those that there are. `ratio` becomes the largest error.
bool are_exact(const core::CrossingList& found, const Flips& truth, double& ratio) {
  if (found.size() != truth.size()) return false;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const core::Crossing& crossing = found[i];
    if (crossing.entering != truth[i]->inside_after || !std::isfinite(crossing.t)) return false;
    const double off = exact_ratio(crossing.t, truth[i]->t);
    ratio = std::max(ratio, off);
    if (off > 1) return false;
  }
  return true;
}

/// Returns whether the sums of both parts of t are as near to the truth as the crossings say.
bool sums_keep_bounds(const core::CrossingList& found, const Flips& truth) {
  return std::equal(found.begin(), found.end(), truth.begin(), truth.end(),
                    [](const core::Crossing& crossing, const MeshPlace* place) {
                      const mpq_class sum = mpq_class(crossing.t) + mpq_class(crossing.t_low);
                      return distance(sum, place->t) <= mpq_class(crossing.error);
                    });
}

/// Returns whether rounding may decide what is inside between a place and the next: whether any
/// place, these two among them, is nearer to both than so many times the bounds.
bool is_open(const std::vector<MeshPlace>& places, std::size_t from, int times) {
  const MeshPlace& begin = places[from];
  const MeshPlace& end = places[from + 1];
  return std::any_of(places.begin(), places.end(), [&](const MeshPlace& place) {
    const auto is_near = [&](const MeshPlace& other) {
      return distance(place.t, other.t) <= times * (mpq_class(place.bound) + other.bound);
    };
    return is_near(begin) && is_near(end);
  });
}

/// Returns whether crossings that take turns can be assigned to places, in order, so that each is
/// within the bounds of its place. What is inside between two places must be true, except where
/// is_open() by so many times the bounds. If that is 0, each place has one crossing at most.
bool can_be_assigned(const core::CrossingList& found, const TrueMeshLine& truth, int near) {
  const std::vector<MeshPlace>& places = truth.places;
  std::vector<bool> reached(found.size() + 1, false);  // so many crossings are assigned
  reached[0] = true;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const mpq_class bound(places[i].bound);
    std::vector<bool> next = reached;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const bool from = near > 0 ? next[k] : reached[k];
      if (!from || next[k + 1]) continue;
      next[k + 1] = distance(mpq_class(found[k].t), places[i].t) <= bound + found[k].error;
    }
    const bool is_near = near > 0 && i + 1 < places.size() && is_open(places, i, near);
    for (std::size_t k = 0; k < next.size() && !is_near; ++k)
      next[k] = next[k] && (k % 2 == 1) == places[i].inside_after;
    reached = next;
  }
  return reached.back();
}

enum class Answer { right, close_call, wrong };

/// Two crossings of one mesh may be in the wrong order if they are nearer than their bounds.
constexpr int near_in_mesh = 1;
/// Two of a tree count as one if their bounds overlap about what was found, which itself is off.
constexpr int near_in_tree = 2;

Answer judged(const core::CrossingList& found, const TrueMeshLine& truth, int near) {
  if (!take_turns(found)) return Answer::wrong;
  if (can_be_assigned(found, truth, 0)) return Answer::right;
  return can_be_assigned(found, truth, near) ? Answer::close_call : Answer::wrong;
}

void count(Answer answer, MeshTierRecord& record) {
  record.close_calls += answer == Answer::close_call ? 1 : 0;
  record.wrong += answer == Answer::wrong ? 1 : 0;
}

PreparedScene mesh_scene(const Entity& entity, Precision precision) {
  Scene scene;
  scene.entities = {entity};
  scene.settings.precision = precision;
  return prepare(scene);
}

/// Returns the crossings of a scene. It says no errors.
core::CrossingList crossings_of(const PreparedScene& scene, const Ray& ray) {
  core::CrossingList result;
  for (const Hit& hit : crossings(scene, ray))
    result.push_back({.t = hit.t, .entering = hit.entering});
  return result;
}

/// Returns whether a scene answers all queries as its only shape does. What is less than
/// `start_reach` (in units of length) ahead of t_min may count as behind.
bool answers_alike(const PreparedScene& scene, const Ray& line, const core::CrossingList& shape,
                   double start_reach) {
  const core::CrossingList all = crossings_of(scene, line);
  if (!std::equal(
          all.begin(), all.end(), shape.begin(), shape.end(),
          [](const auto& a, const auto& b) { return a.t == b.t && a.entering == b.entering; }))
    return false;
  Ray ray = line;
  for (const double t_min : {line.t_min, 0.0}) {
    ray.t_min = t_min;
    const std::optional<Hit> hit = intersect(scene, ray);
    if (occluded(scene, ray) != hit.has_value()) return false;
    const double length = core::largest_component(line.direction);
    const double reach = start_reach / length + (start_reach > 0 ? 0x1p-24 * std::abs(t_min) : 0);
    // One that is less than twice its error ahead may count as behind, too.
    const auto surely = std::find_if(shape.begin(), shape.end(), [&](const auto& crossing) {
      return crossing.t - 2 * crossing.error > t_min + reach;
    });
    const auto found = std::find_if(shape.begin(), shape.end(), [&](const auto& crossing) {
      return hit && crossing.t == hit->t && crossing.entering == hit->entering;
    });
    if (surely < found || (hit && found == shape.end()) || (hit && !(hit->t > t_min))) return false;
  }
  return true;
}

/// A MeasuredMesh is a mesh in both tiers, as shapes and in scenes.
class MeasuredMesh {
 public:
  explicit MeasuredMesh(const TriangleList& mesh)
      : oracle_(mesh),
        primitive_{Mesh{.triangles = mesh_triangles(mesh.positions, mesh.triangles)}},
        standard_(core::make_shape(primitive_)),
        exact_(core::make_exact_shape(primitive_)),
        standard_scene_(mesh_scene(Mesh(std::get<Mesh>(primitive_)), Precision::standard)),
        exact_scene_(mesh_scene(Mesh(std::get<Mesh>(primitive_)), Precision::exact)) {}

  bool is_solid() const { return standard_->is_solid(); }

  /// Returns which tier is wrong, or nothing.
  std::string measure(const Ray& line, bool in_scenes, MeshRecord& record) {
    const TrueMeshLine truth = oracle_.along(line.origin, line.direction);
    const Flips flips = truth.flips();
    ++record.rays;
    record.touching += truth.touches_edges ? 1 : 0;
    record.crossings += flips.size();
    const core::ObjectRay ray{.origin = line.origin, .direction = line.direction};
    std::string wrong;
    found_.clear();
    Answer answer =
        standard_->crossings(ray, found_) ? Answer::wrong : judged(found_, truth, near_in_mesh);
    if (!keeps_bounds(line, record.standard)) answer = Answer::wrong;
    // A ray may start on the mesh, which nobody knows (crt/query.hpp).
    const double start_reach =
        0x1p-24 * (2 * standard_->bounds().farthest() + core::largest_component(line.origin));
    if (in_scenes && !answers_alike(standard_scene_, line, found_, start_reach))
      answer = Answer::wrong;
    count(answer, record.standard);
    if (answer == Answer::wrong) wrong += " standard";
    found_.clear();
    const core::ExactRay exact_ray{
        .near = ray, .world_origin = line.origin, .world_direction = line.direction};
    bool exact = !exact_->crossings(exact_ray, found_) &&
                 are_exact(found_, flips, record.exact.largest_ratio) &&
                 sums_keep_bounds(found_, flips);
    for (core::Crossing& crossing : found_) crossing.error = 0;
    if (in_scenes) exact = exact && answers_alike(exact_scene_, line, found_, 0);
    record.exact.wrong += exact ? 0 : 1;
    if (!exact) wrong += " exact";
    return wrong;
  }

 private:
  /// Returns whether each t is as near to where the line meets its triangle's plane as it says.
  bool keeps_bounds(const Ray& line, MeshTierRecord& record) const {
    double ratio = 0;
    for (const core::Crossing& crossing : found_) {
      const std::optional<mpq_class> truth =
          oracle_.meeting(crossing.face, line.origin, line.direction);
      if (!truth || !std::isfinite(crossing.t)) return false;
      const mpq_class error = distance(mpq_class(crossing.t), *truth);
      if (sgn(error) == 0) continue;
      if (crossing.error == 0) return false;
      ratio = std::max(ratio, mpq_class(error / mpq_class(crossing.error)).get_d());
    }
    record.largest_ratio = std::max(record.largest_ratio, ratio);
    return ratio <= 1;
  }

  MeshOracle oracle_;
  Primitive primitive_;
  std::unique_ptr<const core::Shape> standard_;
  std::unique_ptr<const core::ExactShape> exact_;
  PreparedScene standard_scene_;
  PreparedScene exact_scene_;
  core::CrossingList found_;
};

/// Returns the numbers that are equal for triangles of one plane: four whole ones without a common
/// factor, the first that is not 0 being positive.
using PlaneNumbers = std::array<mpz_class, 4>;
PlaneNumbers plane_of(const TriangleList& mesh, const TriangleIndices& triangle) {
  std::array<std::array<mpq_class, 3>, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      corners[i][axis] = mesh.positions[triangle[i]][static_cast<int>(axis)];
  }
  const auto& [a, b, c] = corners;
  std::array<mpq_class, 4> numbers;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    numbers[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
    numbers[3] += numbers[i] * a[i];
  }
  mpz_class multiple = 1;
  for (const mpq_class& number : numbers) multiple = lcm(multiple, number.get_den());
  PlaneNumbers result;
  mpz_class divisor = 0;
  int sign = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = mpq_class(numbers[i] * multiple).get_num();
    divisor = gcd(divisor, result[i]);
    if (sign == 0) sign = sgn(result[i]);
  }
  if (sign == 0) return result;
  divisor *= sign;
  for (mpz_class& number : result) number /= divisor;
  return result;
}

void count_coincident(const TriangleList& mesh, const TriangleList& other, MeshRecord& record) {
  std::set<PlaneNumbers> planes;
  for (const TriangleIndices& triangle : other.triangles) planes.insert(plane_of(other, triangle));
  record.faces += mesh.triangles.size();
  for (const TriangleIndices& triangle : mesh.triangles)
    record.coincident_faces += planes.count(plane_of(mesh, triangle));
}

/// Returns the second of a pair as one that a transform puts in its place.
Entity placed_second(const MeshPair& pair) {
  TriangleList list = pair.second;
  for (Vec3& position : list.positions) position -= pair.moved;
  return list.entity().transformed(translate(pair.moved));
}

/// Gives each ray its own numbers, so that it can be repeated alone.
Random random_for(std::uint64_t number, std::uint64_t ray) {
  constexpr std::uint64_t rays_apart = 1u << 30u;
  return Random(number * rays_apart + ray);
}

void add_failure(std::string failure, MeshRecord& record) {
  if (record.failures.size() < max_mesh_failures) record.failures.push_back(std::move(failure));
}

/// Measures many meshes of each size, the more the smaller they are.
template <class Measure>
MeshRecord measure_sizes(std::size_t max_triangles, std::uint64_t rays, const Measure& measure) {
  constexpr std::uint64_t least_rays = 500;
  std::uint64_t sizes = 0;
  for (std::size_t size = 100; size <= max_triangles; size *= 10) ++sizes;
  MeshRecord record;
  for (std::size_t size = 100; size <= max_triangles; size *= 10) {
    const std::uint64_t share = rays / sizes;
    const std::uint64_t each = std::max<std::uint64_t>(least_rays, 2 * size);
    const std::uint64_t meshes = std::max<std::uint64_t>(1, share / each);
    for (std::uint64_t i = 0; i < meshes; ++i) record.add(measure(size, size + i, share / meshes));
  }
  return record;
}

}  // namespace

void MeshRecord::add_mesh(const TriangleList& mesh) {
  ++meshes;
  const std::uint64_t triangles = mesh.triangles.size();
  least_triangles = std::min(least_triangles, triangles);
  max_triangles = std::max(max_triangles, triangles);
}

void MeshRecord::add(const MeshRecord& other) {
  meshes += other.meshes;
  least_triangles = std::min(least_triangles, other.least_triangles);
  max_triangles = std::max(max_triangles, other.max_triangles);
  rays += other.rays;
  touching += other.touching;
  crossings += other.crossings;
  faces += other.faces;
  coincident_faces += other.coincident_faces;
  const auto add_tier = [](MeshTierRecord& to, const MeshTierRecord& from) {
    to.wrong += from.wrong;
    to.close_calls += from.close_calls;
    to.largest_ratio = std::max(to.largest_ratio, from.largest_ratio);
  };
  add_tier(standard, other.standard);
  add_tier(exact, other.exact);
  for (const std::string& failure : other.failures) add_failure(failure, *this);
}

MeshRecord measure_mesh(MeshKind kind, std::size_t triangles, std::uint64_t number,
                        std::uint64_t rays) {
  Random random(number);
  const TriangleList list = make_mesh(kind, random, triangles);
  MeshRecord record;
  record.add_mesh(list);
  MeasuredMesh mesh(list);
  if (!mesh.is_solid())
    add_failure(fmt::format("{}: mesh {} is open", name_of(kind), number), record);
  for (std::uint64_t i = 0; i < rays && mesh.is_solid(); ++i) {
    Random own = random_for(number, i);
    const std::string wrong = mesh.measure(line_at(list, own), i % 10 == 0, record);
    if (wrong.empty()) continue;
    add_failure(fmt::format("{}: mesh {} of {} triangles, ray {}:{}", name_of(kind), number,
                            triangles, i, wrong),
                record);
  }
  return record;
}

namespace {

/// Measures an entity made of a pair of meshes. combine(first, second) says what it is.
template <class Combine>
MeshRecord measure_pair(const MeshPair& pair, const Entity& entity, const std::string& name,
                        const Combine& combine, std::uint64_t number, std::uint64_t rays) {
  MeshRecord record;
  record.add_mesh(pair.first);
  count_coincident(pair.first, pair.second, record);
  count_coincident(pair.second, pair.first, record);
  const MeshOracle first(pair.first);
  const MeshOracle second(pair.second);
  const PreparedScene standard = mesh_scene(entity, Precision::standard);
  const PreparedScene exact = mesh_scene(entity, Precision::exact);
  for (std::uint64_t i = 0; i < rays; ++i) {
    Random own = random_for(number, i);
    const Ray line = line_at(own.one_in(2) ? pair.first : pair.second, own);
    const TrueMeshLine truth = combine(first.along(line.origin, line.direction),
                                       second.along(line.origin, line.direction));
    const Flips flips = truth.flips();
    ++record.rays;
    record.touching += truth.touches_edges ? 1 : 0;
    record.crossings += flips.size();
    const Answer answer = judged(crossings_of(standard, line), truth, near_in_tree);
    count(answer, record.standard);
    const bool is_exact = are_exact(crossings_of(exact, line), flips, record.exact.largest_ratio);
    record.exact.wrong += is_exact ? 0 : 1;
    if (is_exact && answer != Answer::wrong) continue;
    const char* const tiers =
        is_exact ? "standard" : (answer == Answer::wrong ? "both tiers" : "exact");
    add_failure(fmt::format("{} {} of {} triangles, ray {}: {}", name, number,
                            pair.first.triangles.size(), i, tiers),
                record);
  }
  return record;
}

}  // namespace

MeshRecord measure_mesh_difference(std::size_t triangles, std::uint64_t number,
                                   std::uint64_t rays) {
  Random random(number);
  const MeshPair pair = coincident_meshes(random, triangles);
  const bool by_transform = number % 2 == 0;
  const Entity difference =
      pair.first.entity() - (by_transform ? placed_second(pair) : pair.second.entity());
  return measure_pair(pair, difference, "difference", difference_of, number, rays);
}

MeshRecord measure_mesh_union(std::size_t triangles, std::uint64_t number, std::uint64_t rays) {
  Random random(number);
  const MeshPair pair = coincident_meshes(random, triangles);
  TriangleList both = pair.first;
  const auto first = static_cast<std::uint32_t>(both.positions.size());
  both.positions.insert(both.positions.end(), pair.second.positions.begin(),
                        pair.second.positions.end());
  for (const auto& [a, b, c] : pair.second.triangles)
    both.triangles.push_back({first + a, first + b, first + c});
  const Entity entity =
      triangle_mesh(both.positions, both.triangles, {}, {.fill = FillRule::nonzero});
  return measure_pair(pair, entity, "union", union_of, number, rays);
}

MeshRecord measure_meshes(MeshKind kind, std::size_t max_triangles, std::uint64_t rays) {
  return measure_sizes(max_triangles, rays,
                       [&](std::size_t triangles, std::uint64_t number, std::uint64_t count) {
                         return measure_mesh(kind, triangles, number, count);
                       });
}

MeshRecord measure_mesh_differences(std::size_t max_triangles, std::uint64_t rays) {
  return measure_sizes(max_triangles, rays, measure_mesh_difference);
}

MeshRecord measure_mesh_unions(std::size_t max_triangles, std::uint64_t rays) {
  return measure_sizes(max_triangles, rays, measure_mesh_union);
}

}  // namespace crt::test
