// Measures the accuracy of every primitive, of trees of them, of meshes and of fields, and whether
// all queries agree. It writes docs/accuracy.md and its plot. usage: oracle_table RAYS PAGE PLOT
// [PRIMITIVE...] With names of primitives ("half plane"), of kinds of meshes ("slivers", "mesh
// minus mesh"), "trees", "meshes", "fields" or "agreement" only those are measured, and their rows
// in the page replaced or added; the plot and everything else stays as it is.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "core/geometry/exact_shape.hpp"
#include "core/geometry/placement.hpp"
#include "oracle/accuracy_page.hpp"
#include "oracle/naive.hpp"

using namespace crt::test;

namespace {

constexpr std::uint64_t max_naive_rays = 1'000'000;
/// One in so many rays is cast at a transformed primitive once more, at trees and at meshes.
constexpr std::uint64_t placed_share = 10;
constexpr std::uint64_t csg_share = 10;
constexpr std::uint64_t mesh_share = 10;
constexpr std::uint64_t field_share = 10;
constexpr std::size_t max_triangles = 1'000'000;
constexpr std::uint64_t rays_per_tree = 200;
constexpr std::uint64_t rays_per_field = 200;
constexpr const char* trees = "trees";
constexpr const char* meshes = "meshes";
constexpr const char* fields = "fields";
constexpr const char* difference = "mesh minus mesh";
constexpr const char* agreement = "agreement";

/// Returns nanoseconds a ray: the best of many rounds, as other work may disturb some.
template <class Intersect>
double nanoseconds(std::size_t rays, const Intersect& intersect) {
  constexpr int rounds = 300;
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < rays; ++i) intersect(i);
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
    best = std::min(best, spent.count() / static_cast<double>(rays));
  }
  return best;
}

/// Holds the first rays of a primitive with what takes them, to be timed.
struct TimedRays {
  explicit TimedRays(std::size_t kind) {
    constexpr std::uint64_t count = 1000;
    for (std::uint64_t i = 0; i < count; ++i) {
      rays.push_back(make_ray(kind, i));
      shapes.push_back(crt::core::make_shape(rays.back().primitive));
      exact_shapes.push_back(crt::core::make_exact_shape(rays.back().primitive));
      object_rays.push_back({.origin = rays.back().origin, .direction = rays.back().direction});
    }
  }

  std::vector<TestRay> rays;
  std::vector<std::unique_ptr<const crt::core::Shape>> shapes;
  std::vector<std::unique_ptr<const crt::core::ExactShape>> exact_shapes;
  std::vector<crt::core::ObjectRay> object_rays;
};

Measured measured(std::size_t kind, std::uint64_t rays) {
  std::vector<Record> records = measure_all(kind, 0, rays, {standard_tier(), exact_tier()});
  Record naive = measure_all(kind, 0, std::min(rays, max_naive_rays), {naive_formulas()})[0];
  const TimedRays timed(kind);
  const std::size_t count = timed.rays.size();
  crt::core::CrossingList found;
  const double standard_time = nanoseconds(count, [&](std::size_t i) {
    found.clear();
    timed.shapes[i]->crossings(timed.object_rays[i], found);
  });
  const crt::core::Placement in_place;
  const double exact_time = nanoseconds(count, [&](std::size_t i) {
    found.clear();
    const TestRay& ray = timed.rays[i];
    timed.exact_shapes[i]->crossings(
        in_place.to_object_exactly(ray.origin, ray.direction, timed.object_rays[i]), found);
  });
  const double naive_time = nanoseconds(count, [&](std::size_t i) {
    found.clear();
    naive_crossings(timed.rays[i].primitive, timed.rays[i].origin, timed.rays[i].direction, found);
  });
  return {kind,
          {{"standard", std::move(records[0]), standard_time},
           {"exact", std::move(records[1]), exact_time},
           {"naive", std::move(naive), naive_time}}};
}

/// Prints the rays that broke a promise, and says whether there were none.
bool kept(std::size_t kind, const Record& record, const char* tier, RayMaker maker) {
  for (const std::uint64_t failure : record.failures)
    fmt::print("{}: broken by ray {}: {}\n", tier, failure, description(maker(kind, failure)));
  return record.failures.empty();
}

bool kept(const std::vector<std::string>& failures) {
  for (const std::string& failure : failures) fmt::print("broken: {}\n", failure);
  return failures.empty();
}

/// Measures everything, and prints results as they come.
class Measuring {
 public:
  explicit Measuring(std::uint64_t rays) : rays_(rays) {}

  MeasuredAll all;
  bool all_kept = true;

  void primitive(std::size_t kind) {
    all.primitives.push_back(
        {measured(kind, rays_),
         measure_all(kind, 0, rays_ / placed_share, {exact_tier()}, make_placed_ray)[0]});
    const MeasuredPrimitive& one = all.primitives.back();
    for (std::size_t tier = 0; tier < 2; ++tier) {
      const MeasuredTier& of = one.in_place.tiers[tier];
      note(kept(kind, of.record, of.name.c_str(), make_ray));
    }
    note(kept(kind, one.placed, "exact, transformed", make_placed_ray));
    tell(tier_rows(one.in_place));
  }

  void trees() {
    all.trees = measure_csg(0, std::max<std::uint64_t>(1, rays_ / csg_share / rays_per_tree),
                            rays_per_tree);
    note(kept(all.trees.failures));
    tell(tree_rows(all.trees));
  }

  template <class IsWanted>
  void meshes(const IsWanted& is_wanted) {
    constexpr std::uint64_t parts = mesh_kinds + 1;
    const std::uint64_t rays = rays_ / mesh_share / parts;
    for (std::size_t kind = 0; kind < mesh_kinds; ++kind) {
      const auto of = static_cast<MeshKind>(kind);
      if (is_wanted(name_of(of))) mesh_part({name_of(of), measure_meshes(of, max_triangles, rays)});
    }
    if (is_wanted(difference))
      mesh_part({difference, measure_mesh_differences(max_triangles, rays)});
  }

  void fields() {
    const std::uint64_t each = rays_ / field_share / field_kinds / rays_per_field;
    for (std::size_t kind = 0; kind < field_kinds; ++kind) {
      const auto of = static_cast<FieldKind>(kind);
      all.fields.push_back(
          {name_of(of), measure_fields(of, std::max<std::uint64_t>(1, each), rays_per_field)});
      note(kept(all.fields.back().record.failures));
      tell(field_rows(all.fields.back()));
    }
  }

  /// Asks so many rays in all, of subjects of all kinds in both tiers.
  void agreement() {
    const std::uint64_t rays = rays_ / (2 * agreement_kinds);
    for (std::size_t kind = 0; kind < agreement_kinds; ++kind) {
      all.agreement.push_back({kind, measure_agreement(kind, crt::Precision::standard, rays),
                               measure_agreement(kind, crt::Precision::exact, rays)});
      note(kept(all.agreement.back().standard.failures));
      note(kept(all.agreement.back().exact.failures));
      tell(agreement_rows(all.agreement.back()));
    }
  }

 private:
  void mesh_part(MeasuredMeshes part) {
    note(kept(part.record.failures));
    tell(mesh_rows(part));
    all.meshes.push_back(std::move(part));
  }
  void note(bool is_kept) { all_kept = all_kept && is_kept; }
  static void tell(const std::string& rows) {
    fmt::print("{}", rows);
    std::fflush(stdout);
  }

  std::uint64_t rays_;
};

std::string text_of_file(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const char* path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error(fmt::format("cannot write {}", path));
}

bool is_known(const std::string& name) {
  for (const char* known : {trees, meshes, difference, fields, agreement}) {
    if (name == known) return true;
  }
  for (std::size_t kind = 0; kind < mesh_kinds; ++kind) {
    if (name == name_of(static_cast<MeshKind>(kind))) return true;
  }
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    if (name_of_primitive(kind) == name) return true;
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4) {
    fmt::print(stderr, "usage: oracle_table RAYS PAGE PLOT [PRIMITIVE...]\n");
    return 2;
  }
  const std::vector<std::string> names(argv + 4, argv + argc);
  const auto is_wanted = [&](std::string_view name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const std::string& name : names) {
    if (is_known(name)) continue;
    fmt::print(stderr, "there is no primitive \"{}\"\n", name);
    return 2;
  }
  Measuring measuring(std::strtoull(argv[1], nullptr, 10));
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    if (is_wanted(name_of_primitive(kind))) measuring.primitive(kind);
  }
  if (is_wanted(trees)) measuring.trees();
  measuring.meshes([&](std::string_view kind) { return is_wanted(meshes) || is_wanted(kind); });
  if (is_wanted(fields)) measuring.fields();
  if (is_wanted(agreement)) measuring.agreement();
  if (names.empty()) {
    write(argv[2], accuracy_page(measuring.all));
    std::vector<Measured> measured;
    for (const MeasuredPrimitive& one : measuring.all.primitives) measured.push_back(one.in_place);
    write(argv[3], accuracy_plot(measured));
  } else {
    write(argv[2], with_rows_replaced(text_of_file(argv[2]), measuring.all));
  }
  return measuring.all_kept ? 0 : 1;
} catch (const std::runtime_error& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
