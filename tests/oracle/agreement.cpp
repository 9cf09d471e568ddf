#include "oracle/agreement.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <thread>

#include "core/geometry/shape.hpp"
#include "core/math/vector.hpp"
#include "crt/entity.hpp"
#include "crt/error.hpp"
#include "crt/scene.hpp"
#include "oracle/measure.hpp"
#include "oracle/ray_maker.hpp"

namespace crt::test {
namespace {

constexpr std::size_t max_failures = 10;
constexpr double infinity = std::numeric_limits<double>::infinity();

bool same(const Hit& a, const Hit& b) {
  return a.t == b.t && a.position == b.position && a.normal == b.normal && a.u == b.u &&
         a.v == b.v && a.entity_id == b.entity_id && a.entering == b.entering;
}
bool same(const std::optional<Hit>& a, const std::optional<Hit>& b) {
  return a.has_value() == b.has_value() && (!a || same(*a, *b));
}
bool same(const std::optional<Hit>& a, const PlainHit& b) {
  if (!a) return b.t == infinity && b.side == HitSide::none;
  return a->t == b.t && a->normal == b.normal && a->u == b.u && a->v == b.v &&
         a->entity_id == b.entity_id &&
         b.side == (a->entering ? HitSide::entering : HitSide::leaving);
}

/// Holds what a batch reports of its rays.
struct BatchAnswers {
  std::vector<std::optional<Hit>> hits;
  std::vector<PlainHit> plain;
  std::vector<double> distances;
  std::unique_ptr<bool[]> occluded;

  BatchAnswers(RayQueries& queries, std::span<const Ray> rays)
      : hits(rays.size()),
        plain(rays.size()),
        distances(rays.size()),
        occluded(new bool[rays.size()]) {
    queries.intersect(rays, hits);
    queries.intersect(rays, plain);
    queries.distances(rays, distances);
    queries.occluded(rays, std::span(occluded.get(), rays.size()));
  }
};

/// Returns what is wrong with the list of crossings by itself, or "" for nothing.
std::string fault_of(const std::vector<Hit>& crossings, const Ray& ray) {
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const Hit& hit = crossings[i];
    if (!(hit.t > ray.t_min && hit.t < ray.t_max))
      return fmt::format("crossing {} is not on the ray", i);
    if (i == 0) continue;
    if (!(hit.t >= crossings[i - 1].t)) return fmt::format("crossing {} is before the last", i);
    if (hit.entering == crossings[i - 1].entering)
      return fmt::format("crossing {} is to the same side", i);
  }
  return "";
}

/// Returns what differs between the answers about one ray.
std::string difference(RayQueries& queries, const Ray& ray, const BatchAnswers& batch,
                       std::size_t i, std::vector<Hit>& crossings) {
  queries.crossings(ray, crossings);
  if (std::string fault = fault_of(crossings, ray); !fault.empty()) return fault;
  const std::optional<Hit> nearest = queries.intersect(ray);
  const std::optional<Hit> first =
      crossings.empty() ? std::nullopt : std::optional(crossings.front());
  if (!same(nearest, first)) {
    return fmt::format("intersect {:a}, first crossing {:a}", nearest ? nearest->t : infinity,
                       first ? first->t : infinity);
  }
  if (queries.occluded(ray) != nearest.has_value()) return "occluded differs from intersect";
  if (!same(nearest, batch.hits[i])) return "intersect differs in a batch";
  if (!same(nearest, batch.plain[i])) return "intersect differs in a batch of plain hits";
  if (batch.distances[i] != batch.plain[i].t) return "distances differs from intersect";
  if (batch.occluded[i] != nearest.has_value()) return "occluded differs in a batch";
  return "";
}

/// A Digest is FNV-1a over the bits of numbers (Fowler, Noll, Vo).
class Digest {
 public:
  void add(std::uint64_t bits) {
    constexpr std::uint64_t prime = 0x100000001b3;
    for (int byte = 0; byte < 8; ++byte) value_ = (value_ ^ (bits >> (8 * byte) & 0xff)) * prime;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis) add(v[axis]);
  }
  void add(const Hit& hit) {
    add(hit.t);
    add(hit.position);
    add(hit.normal);
    add(hit.u);
    add(hit.v);
    add(std::uint64_t{hit.entity_id} << 1 | (hit.entering ? 1 : 0));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/// Returns the digest of a ray and of what it crosses, of which all other answers are parts.
std::uint64_t digest_of(const Ray& ray, const std::vector<Hit>& crossings) {
  Digest digest;
  digest.add(ray.origin);
  digest.add(ray.direction);
  digest.add(ray.t_min);
  digest.add(ray.t_max);
  for (const Hit& hit : crossings) digest.add(hit);
  return digest.value();
}

std::string text_of(const Ray& ray) {
  const auto text = [](const Vec3& v) {
    return fmt::format("{{{:a}, {:a}, {:a}}}", v.x, v.y, v.z);
  };
  return fmt::format("origin {}, direction {}, t from {:a} to {:a}", text(ray.origin),
                     text(ray.direction), ray.t_min, ray.t_max);
}

constexpr std::size_t trees = primitive_kinds;
constexpr std::size_t crowds = primitive_kinds + 1;

/// A Subject is what is asked about, and what its rays are made for.
struct Subject {
  std::vector<Entity> entities;
  std::vector<Primitive> parts;
  double size;
  Transform to_world{};
};

Primitive solid_part(Counted& random, const Vec3& at, double size) {
  while (true) {
    const auto kind = static_cast<std::size_t>(random.integer(0, primitive_kinds - 1));
    const Primitive part = make_primitive(random, kind, at, size);
    if (Entity(part).is_solid()) return part;
  }
}

Entity combined(Counted& random, const Entity& a, const Entity& b) {
  switch (random.integer(0, 2)) {
    case 0:
      return a + b;
    case 1:
      return a - b;
    default:
      return a ^ b;
  }
}

Subject make_tree(Counted& random, const Vec3& at, double size) {
  std::vector<Primitive> parts = {solid_part(random, at, size)};
  Entity entity = parts[0];
  for (int more = random.integer(1, 2); more > 0; --more) {
    const double part_size = size * random.power_of_ten(-1, 1);
    parts.push_back(solid_part(random, at + 0.5 * size * random.in_cube(), part_size));
    entity = combined(random, entity, parts.back());
  }
  return {.entities = {entity}, .parts = parts, .size = size};
}

/// Makes more objects than a flat box list takes, each in a cell of its own.
Subject make_crowd(Counted& random, const Vec3& at, double size) {
  constexpr int cells = 5;
  constexpr double max_sizes = 8;  // from its place a spindle torus reaches nearly that far
  Subject crowd{.entities = {}, .parts = {}, .size = size};
  for (int cell = 0; cell < cells * cells * cells; ++cell) {
    const Vec3 place(cell % cells, cell / cells % cells, cell / (cells * cells));
    const Vec3 middle = at + 2 * max_sizes * size * place;
    Primitive part = solid_part(random, middle, size);
    // A mesh may not have found its place.
    const bool is_elsewhere =
        (std::holds_alternative<Mesh>(part) || std::holds_alternative<Extrusion>(part)) &&
        !(glm::length(center_of(part) - middle) <= 2 * size);
    // Planes are in all cells, and so may be quadrics, and revolutions, which are about one axis.
    const bool is_wide = std::holds_alternative<Plane>(part) ||
                         std::holds_alternative<Quadric>(part) ||
                         std::holds_alternative<Revolution>(part);
    // Of two surfaces that are nearer than the rounding of a start, one alone may be behind it.
    constexpr double few_roundings = 0x1p-46;
    const core::Bounds box = core::make_shape(part)->bounds();
    const Vec3 sides = box.upper - box.lower;
    const bool is_lost =
        std::min({sides.x, sides.y, sides.z}) < few_roundings * core::largest_component(middle);
    if (is_wide || is_elsewhere || is_lost) part = Sphere{.center = middle, .radius = size};
    crowd.parts.push_back(part);
    crowd.entities.emplace_back(part);
  }
  return crowd;
}

Subject make_subject(Counted& random, std::size_t kind) {
  const double size = random.power_of_ten(-9, 9);
  const Vec3 at = random.power_of_ten(-9, 9) * random.direction();
  if (kind == crowds) return make_crowd(random, at, size);
  Subject subject{.entities = {}, .parts = {}, .size = size};
  if (kind == trees) {
    subject = make_tree(random, at, size);
  } else {
    subject.parts = {make_primitive(random, kind, at, size)};
    subject.entities = {subject.parts[0]};
  }
  if (random.integer(0, 3) == 0) {
    subject.to_world = random_transform(random);
    subject.to_world.translation = random.power_of_ten(-3, 3) * at;
    subject.entities[0] = subject.entities[0].transformed(subject.to_world);
  }
  return subject;
}

/// Scales a direction, or some of its components, to near the ends of what doubles hold.
Vec3 scaled(Counted& random, const Vec3& direction) {
  constexpr double farthest = 305;
  Vec3 result = direction * random.power_of_ten(-farthest, farthest);
  if (random.integer(0, 1) == 0) result[random.integer(0, 2)] *= random.power_of_ten(-farthest, 0);
  if (random.integer(0, 3) == 0) result[random.integer(0, 2)] *= random.power_of_ten(-20, 0);
  const bool is_usable = std::isfinite(result.x + result.y + result.z) && result != Vec3(0);
  return is_usable ? result : direction;
}

std::vector<Ray> make_rays(Counted& random, const Subject& subject, std::size_t count) {
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const auto part =
        static_cast<std::size_t>(random.integer(0, static_cast<int>(subject.parts.size()) - 1));
    TestRay made = make_ray_at(random, subject.parts[part], subject.size);
    made.to_world = subject.to_world;
    move_to_world(made);
    if (random.integer(0, 4) == 0) made.direction = scaled(random, made.direction);
    rays.push_back({.origin = made.origin, .direction = made.direction});
    if (random.integer(0, 3) == 0) rays.back().t_min = -infinity;
    try {
      validate(rays.back());
    } catch (const Error&) {
      rays.pop_back();
    }
  }
  return rays;
}

/// Adds parts of rays that begin, or end, at a crossing or next to it.
void add_parts(Counted& random, RayQueries& queries, std::vector<Ray>& rays) {
  const std::size_t count = rays.size();
  std::vector<Hit> crossings;
  for (std::size_t i = 0; i < count; ++i) {
    Ray part = rays[i];
    queries.crossings(part, crossings);
    if (crossings.empty()) continue;
    const auto which =
        static_cast<std::size_t>(random.integer(0, static_cast<int>(crossings.size()) - 1));
    const double t = crossings[which].t;
    const std::array<double, 3> places = {t, std::nextafter(t, -infinity),
                                          std::nextafter(t, infinity)};
    const double place = places[static_cast<std::size_t>(random.integer(0, 2))];
    (random.integer(0, 1) == 0 ? part.t_min : part.t_max) = place;
    rays.push_back(part);
  }
}

std::string text_of(const Subject& subject) {
  constexpr std::size_t max_parts = 3;
  if (subject.parts.size() > max_parts) return "";
  std::string text;
  for (const Primitive& part : subject.parts) {
    text += description({.primitive = part, .to_world = subject.to_world}) + "; ";
  }
  return text;
}

constexpr std::size_t rays_of_subject = 48;

void measure_subject(std::size_t kind, Precision precision, std::uint64_t number,
                     AgreementRecord& record) {
  // A size that is lost in the offset makes no subject. The next seed makes another.
  for (std::uint64_t seed = agreement_kinds + kind;; seed += agreement_kinds) {
    Counted random(seed, number);
    try {
      const Subject subject = make_subject(random, kind);
      Scene scene;
      scene.entities = subject.entities;
      scene.settings.precision = precision;
      const PreparedScene prepared = prepare(scene);
      RayQueries queries(prepared);
      std::vector<Ray> rays = make_rays(random, subject, rays_of_subject);
      add_parts(random, queries, rays);
      const std::string text =
          fmt::format("{} {}: {}", name_of_agreement(kind), number, text_of(subject));
      return compare_queries(prepared, text, rays, record);
    } catch (const Error&) {
    }
  }
}

}  // namespace

void AgreementRecord::add(const AgreementRecord& other) {
  rays += other.rays;
  hits += other.hits;
  disagreements += other.disagreements;
  digest += other.digest;
  failures.insert(failures.end(), other.failures.begin(), other.failures.end());
  if (failures.size() > max_failures) failures.resize(max_failures);
}

void compare_queries(const PreparedScene& scene, const std::string& subject,
                     std::span<const Ray> rays, AgreementRecord& record) {
  RayQueries queries(scene);
  const BatchAnswers batch(queries, rays);
  std::vector<Hit> crossings;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::string what = difference(queries, rays[i], batch, i, crossings);
    ++record.rays;
    record.digest += digest_of(rays[i], crossings);
    if (!crossings.empty()) ++record.hits;
    if (what.empty()) continue;
    ++record.disagreements;
    if (record.failures.size() >= max_failures) continue;
    record.failures.push_back(fmt::format("{}: {} {}", what, subject, text_of(rays[i])));
  }
}

std::string name_of_agreement(std::size_t kind) {
  if (kind == trees) return "trees";
  return kind == crowds ? "crowds" : std::string(name_of_primitive(kind));
}

AgreementRecord measure_agreement(std::size_t kind, Precision precision, std::uint64_t rays) {
  const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  const std::uint64_t subjects = rays / rays_of_subject + 1;
  std::vector<AgreementRecord> parts(threads);
  std::atomic<std::uint64_t> next = 0;
  const auto work = [&](AgreementRecord& record) {
    for (std::uint64_t number = next++; number < subjects; number = next++) {
      measure_subject(kind, precision, number, record);
    }
  };
  std::vector<std::thread> workers;
  for (AgreementRecord& part : parts) workers.emplace_back(work, std::ref(part));
  for (std::thread& worker : workers) worker.join();
  AgreementRecord result;
  for (const AgreementRecord& part : parts) result.add(part);
  return result;
}

}  // namespace crt::test
