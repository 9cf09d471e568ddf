// Measures the accuracy of every primitive, and of trees of them, and writes docs/accuracy.md and its plot.
// usage: oracle_table RAYS PAGE PLOT [PRIMITIVE...]
// With names of primitives ("half plane"), or "trees", only those are measured, and their rows in the page
// replaced; the plot and everything else stays as it is.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "core/csg/placement.hpp"
#include "core/geometry/exact_shape.hpp"
#include "oracle/accuracy_plot.hpp"
#include "oracle/csg_measure.hpp"
#include "oracle/measure.hpp"
#include "oracle/naive.hpp"

using namespace crt::test;

namespace {

constexpr std::uint64_t most_naive_rays = 1'000'000;
/// One in so many rays is cast at a transformed primitive once more, and at trees of solids.
constexpr std::uint64_t placed_share = 10;
constexpr std::uint64_t csg_share = 10;
constexpr std::uint64_t rays_per_tree = 200;
constexpr const char* trees = "trees";

/// Nanoseconds a ray: the best of many rounds, as other work may disturb some.
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

/// The first rays of a primitive with what takes them, to be timed.
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
  Record naive = measure_all(kind, 0, std::min(rays, most_naive_rays), {naive_formulas()})[0];
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

std::string number(double value) {
  if (value == 0) return "0";
  if (value >= 1000) return fmt::format("{:.1e}", value);
  return value < 0.001 ? fmt::format("{:.1e}", value) : fmt::format("{:.3g}", value);
}

double share(std::uint64_t part, std::uint64_t whole) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::uint64_t>(1, whole));
}

std::string rows(const Measured& of) {
  std::string result;
  for (const MeasuredTier& tier : of.tiers) {
    const Record& record = tier.record;
    const Histogram& plain = record.ulps_by_kind[0];
    const std::string escalations =
        tier.name == "exact" ? number(share(record.escalations, record.rays)) : "";
    result +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {:.0f} | {} |\n", name_of_primitive(of.kind),
                    tier.name, record.rays, record.wrong, record.close_calls, number(record.largest_ratio),
                    number(plain.quantile(0.999)), number(plain.largest()), tier.nanoseconds, escalations);
  }
  return result;
}

std::string heading_by_kind() {
  std::string result = "| primitive |";
  for (std::size_t i = 0; i < ray_kinds; ++i)
    result += fmt::format(" {} |", name_of(static_cast<RayKind>(i)));
  result += "\n|---|";
  for (std::size_t i = 0; i < ray_kinds; ++i) result += "---|";
  return result + "\n";
}

std::string ulps_by_kind(const Measured& of) {
  std::string result = fmt::format("| {} |", name_of_primitive(of.kind));
  for (std::size_t i = 0; i < ray_kinds; ++i) {
    std::string cell;
    for (const MeasuredTier& tier : of.tiers) {
      if (tier.record.rays_by_kind[i] == 0) continue;
      cell += (cell.empty() ? " " : " / ") + number(tier.record.ulps_by_kind[i].quantile(0.999));
    }
    result += cell + " |";
  }
  return result + "\n";
}

std::string close_calls_by_kind(const Measured& of) {
  std::string result = fmt::format("| {} |", name_of_primitive(of.kind));
  const Record& record = of.tiers[0].record;
  for (std::size_t i = 0; i < ray_kinds; ++i) {
    if (record.rays_by_kind[i] > 0)
      result += " " + number(share(record.close_calls_by_kind[i], record.rays_by_kind[i]));
    result += " |";
  }
  return result + "\n";
}

std::string placed_row(std::size_t kind, const Record& record) {
  return fmt::format("| {} | {} | {} | {} | {} |\n", name_of_primitive(kind), record.rays, record.wrong,
                     number(record.largest_ratio), number(share(record.escalations, record.rays)));
}

std::string csg_rows(const CsgRecord& record) {
  std::string result;
  for (const auto& [name, tier] : {std::pair{"standard", record.standard}, {"exact", record.exact}}) {
    result += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", name, record.trees, record.rays,
                          record.crossings, tier.wrong, tier.close_calls,
                          tier.escalations == 0 ? "" : number(share(tier.escalations, record.rays)));
  }
  return result;
}

constexpr const char* introduction = R"(# Accuracy, measured

This page is written by `./dev oracle`: every primitive against an oracle that solves its implicit equation
along the line, in sums of a few doubles that carry a bound on their error, and where that leaves anything open in MPFR arithmetic, with
precision raised until the answer is certain (`tests/oracle`).

Sizes are 10^-9 to 10^9, the offset of the scene 10^-9 to 10^9, the distance of the ray's origin 10^-3 to 10^12 sizes. Half of the rays are
plain. A tenth each: grazing (along a tangent, moved in or out by 10^-16 to 0.1 sizes), parallel to a coordinate axis, aimed at edges
and corners, starting on the surface, and 10^-16 to 0.1 off parallel to a face or an axis. Of the rays
at cylinders and cones a tenth more is along a ruling, a straight line of the side (turned off it by 10^-16 to 0.1, shifted by as
many sizes, both or neither), and another tenth is of all these kinds; both are at solids whose height and radius, or two radii, are up to 10^6
apart.

*standard* and *exact* are the two tiers of [what the geometry promises](numerics.md). *naive* are the formulas that everyone writes
first, in plain doubles (`tests/oracle/naive.cpp`); it is measured with a million rays at most.

- **wrong**: rays that are told to be inside (or outside) of the solid at a point that is farther from its surface than
  8 u (R + |x|) and the spacing of t's doubles there; for surfaces, rays whose hit or miss differs from the true one though they meet
  the plane farther from the rim than the bound of t (below) and 8 u (R + |x|). In the exact tier: rays with any other crossings than the
  true ones.
- **close calls**: rays decided otherwise than the truth, but within that. The exact tier has none, by definition.
- **error / bound**: the largest |t - true t|, over what is promised, of all kinds of rays that were decided right. The standard tier promises
  0.5 ulp(t) + 8 u (R + |x|) / |n . d|, and the naive formulas are held against the same; the exact tier 0.51 ulp(t), of a torus 1 ulp(t).
- **ulps**: |t - true t| in units of the last place of t, for plain rays. What is above one half in the standard tier is what the place and
  the slant of the ray make unavoidable in doubles: the bound's second term. A start on the surface itself, where t is but rounding, is not counted.
- **ns**: nanoseconds a ray on one core, over all kinds of rays, each of another primitive; the best of many rounds.
- **escalations**: how often a ray asked for exact arithmetic, on average over all kinds, half of which are hard on purpose.

u is 2^-53; R the radius of a ball that holds the primitive (0 for planes); x the point relative to its centre; n . d the cosine of the slant.

)";

std::string page(const std::vector<Measured>& all, const std::vector<Record>& placed, const CsgRecord& csg) {
  std::string result = introduction;
  result +=
      "| primitive | | rays | wrong | close calls | error / bound | ulps, 99.9 % | ulps, largest | ns | "
      "escalations "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Measured& one : all) result += rows(one);
  result +=
      "\n## By kind of ray\n\nThe error in ulps that 99.9 % of the crossings stay below, standard / exact / "
      "naive:\n\n" +
      heading_by_kind();
  for (const Measured& one : all) result += ulps_by_kind(one);
  result += "\nThe share of close calls in the standard tier:\n\n" + heading_by_kind();
  for (const Measured& one : all) result += close_calls_by_kind(one);
  result +=
      "\n## By distance\n\nThe error of plain rays that 99.9 % stay below, by the distance of the origin, in "
      "sizes:\n\n![Error against distance](accuracy.svg)\n"
      "\n## Transformed primitives\n\nThe exact tier, with transforms that rotate, scale by factors up to "
      "10^8 apart, "
      "mirror and shift:\n\n| primitive | rays | wrong | error / bound | escalations "
      "|\n|---|---|---|---|---|\n";
  for (std::size_t kind = 0; kind < placed.size(); ++kind) result += placed_row(kind, placed[kind]);
  result += fmt::format(
      "\n## Trees of solids\n\nRandom unions, differences and intersections of up to 27 solids on a grid, "
      "turned, "
      "scaled and moved on it, with rays through its corners, along its edges and within its planes, against "
      "membership by exact roots. Of all faces {:.0f} % lie on a surface that another solid of the tree has "
      "too. "
      "*wrong* is as above. The exact tier has no close calls: crossings are in the order in which they are, "
      "however "
      "near to each other.\n\n| | trees | rays | crossings | wrong | close calls | escalations "
      "|\n|---|---|---|---|---|---|---|\n",
      100 * share(csg.coincident_faces, csg.faces));
  return result + csg_rows(csg);
}

bool write(const char* path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  return static_cast<bool>(file.flush());
}

/// Puts what was measured in place of a primitive's rows in a page that is there already.
bool replace_rows(const char* path, const Measured& of, const Record& placed) {
  std::ifstream file(path);
  // The page's tables in their order, by what comes before each.
  const std::array<std::pair<std::string, std::string>, 4> tables = {
      {{"# Accuracy, measured", rows(of)},
       {"## By kind of ray", ulps_by_kind(of)},
       {"The share of close calls", close_calls_by_kind(of)},
       {"## Transformed primitives", placed_row(of.kind, placed)}}};
  const std::string row_begin = fmt::format("| {} |", name_of_primitive(of.kind));
  std::size_t table = 0;
  std::size_t replaced = 0;
  std::string text;
  for (std::string line; std::getline(file, line);) {
    for (std::size_t i = 0; i < tables.size(); ++i) {
      if (line.rfind(tables[i].first, 0) == 0) table = i;
    }
    if (line.rfind(row_begin, 0) != 0) {
      text += line + "\n";
    } else if (replaced == table) {
      text += tables[table].second;
      ++replaced;
    }
  }
  return replaced == tables.size() && write(path, text);
}

/// The same for trees.
bool replace_rows(const char* path, const CsgRecord& csg) {
  std::ifstream file(path);
  bool is_last_table = false;
  int replaced = 0;
  std::string text;
  for (std::string line; std::getline(file, line);) {
    is_last_table = is_last_table || line == "## Trees of solids";
    const bool is_row = line.rfind("| standard |", 0) == 0 || line.rfind("| exact |", 0) == 0;
    if (!is_last_table || !is_row) {
      text += line + "\n";
    } else if (replaced++ == 0) {
      text += csg_rows(csg);
    }
  }
  return replaced == 2 && write(path, text);
}

std::size_t kind_of(const std::string& name) {
  std::size_t kind = 0;
  while (kind < primitive_kinds && name_of_primitive(kind) != name) ++kind;
  return kind;
}

/// Prints the rays that broke a promise; whether there were none.
bool kept(std::size_t kind, const Record& record, const char* tier, RayMaker maker) {
  for (const std::uint64_t failure : record.failures)
    fmt::print("{}: broken by ray {}: {}\n", tier, failure, description(maker(kind, failure)));
  std::fflush(stdout);
  return record.failures.empty();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: oracle_table RAYS PAGE PLOT [PRIMITIVE...]\n");
    return 2;
  }
  const std::uint64_t rays = std::strtoull(argv[1], nullptr, 10);
  const std::vector<std::string> names(argv + 4, argv + argc);
  const auto is_wanted = [&](std::string_view name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const std::string& name : names) {
    if (name == trees || kind_of(name) < primitive_kinds) continue;
    fmt::print(stderr, "there is no primitive \"{}\"\n", name);
    return 2;
  }
  std::vector<Measured> all;
  std::vector<Record> placed;
  bool good = true;
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    if (!is_wanted(name_of_primitive(kind))) continue;
    all.push_back(measured(kind, rays));
    fmt::print("{}", rows(all.back()));
    for (std::size_t tier = 0; tier < 2; ++tier)
      good = kept(kind, all.back().tiers[tier].record, all.back().tiers[tier].name.c_str(), make_ray) && good;
    placed.push_back(measure_all(kind, 0, rays / placed_share, {exact_tier()}, make_placed_ray)[0]);
    good = kept(kind, placed.back(), "exact, transformed", make_placed_ray) && good;
    if (!names.empty() && !replace_rows(argv[2], all.back(), placed.back())) {
      fmt::print(stderr, "cannot replace the rows of {} in {}\n", name_of_primitive(kind), argv[2]);
      return 1;
    }
  }
  if (!is_wanted(trees)) return good ? 0 : 1;
  const CsgRecord csg =
      measure_csg(0, std::max<std::uint64_t>(1, rays / csg_share / rays_per_tree), rays_per_tree);
  fmt::print("{}", csg_rows(csg));
  for (const std::string& failure : csg.failures) fmt::print("broken: {}\n", failure);
  const bool written = names.empty()
                           ? write(argv[2], page(all, placed, csg)) && write(argv[3], accuracy_plot(all))
                           : replace_rows(argv[2], csg);
  if (!written) {
    fmt::print(stderr, "cannot write {} or {}\n", argv[2], argv[3]);
    return 1;
  }
  return good && csg.failures.empty() ? 0 : 1;
}
