#include "oracle/accuracy_page.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace crt::test {
namespace {

std::string number(double value) {
  if (value == 0) return "0";
  if (value >= 1000) return fmt::format("{:.1e}", value);
  return value < 0.001 ? fmt::format("{:.1e}", value) : fmt::format("{:.3g}", value);
}

double share(std::uint64_t part, std::uint64_t whole) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::uint64_t>(1, whole));
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
  return fmt::format("| {} | {} | {} | {} | {} |\n", name_of_primitive(kind), record.rays,
                     record.wrong, number(record.largest_ratio),
                     number(share(record.escalations, record.rays)));
}

constexpr const char* introduction = R"(# Accuracy, measured

This page shows how far CRT's intersections are from the true ones. It is for readers who want the
evidence behind [what the geometry promises](numerics.md). `./dev oracle` writes it.

The oracle (`tests/oracle`) solves the implicit equation of each primitive along the line. It works
in sums of a few doubles that carry a bound on their error. Where that leaves anything open, it goes
on in MPFR arithmetic and raises the precision until the answer is certain.

Three methods are compared. *standard* and *exact* are CRT's two tiers. *naive* are the textbook
formulas in plain doubles (`tests/oracle/naive.cpp`), measured with a million rays at most.

## The rays

Sizes and the offset of the scene are 10^-9 to 10^9. The origin of a ray is 10^-3 to 10^12 sizes
away. Half of the rays are plain. A tenth of all rays is of each of these kinds:

- *grazing*: along a tangent, moved in or out by 10^-16 to 0.1 sizes;
- *axis-parallel*: parallel to a coordinate axis;
- *edges, corners*: aimed at these;
- *on the surface*: starting there;
- *nearly parallel*: 10^-16 to 0.1 off parallel to a face or an axis.

Cylinders, cones and capsules get another tenth *along a ruling*, a straight line of the side. It is
turned off by 10^-16 to 0.1, shifted by as many sizes, both or neither. One more tenth at them is of
all these kinds. In both tenths height and radius, or two radii, are up to 10^6 apart.

One ray in ten, of whatever kind, has an *extreme direction* and is counted as that. Its length is
2^-850 to 2^850, or its components are up to 10^280 apart.

## The columns

- **wrong**: rays reported inside (or outside) the solid at a point that is clearly on the other
  side. The point is then farther from the surface than 8 u (R + |x|) and the spacing of t's
  doubles there. For surfaces: rays whose hit or miss differs from the true one, though they meet
  the plane farther from the edge than the bound of t (below) and 8 u (R + |x|). In the exact
  tier: rays with any other crossings than the true ones.
- **close calls**: rays decided otherwise than the truth, but within that. The exact tier has
  none, by definition.
- **error / bound**: the largest |t - true t| over what is promised, of all kinds of rays that
  were decided right. The standard tier promises 0.5 ulp(t) + 8 u (R + |x|) / |n . d|, and the
  naive formulas are held against the same. The exact tier promises 0.51 ulp(t), of a torus
  1 ulp(t).
- **ulps**: |t - true t| in units of the last place of t, for plain rays: what 99.9 % stay below,
  and the largest (max). What is above one half in the standard tier is the bound's second term: the
  position and the slant of the ray make it unavoidable in doubles. A start on the surface itself,
  where t is nothing but rounding, is not counted.
- **ns**: nanoseconds per ray on one core, over all kinds of rays, each at another primitive; the
  best of many rounds.
- **fallbacks**: exact fallbacks per ray, on average over all kinds, half of which are hard on
  purpose. The statistics call them `escalations`.

u is 2^-53. R is the radius of a sphere that holds the primitive (0 for planes), x the point
relative to its centre, and n . d the cosine of the slant.

## By primitive

)";

constexpr const char* tiers_table = R"(
| primitive | tier | rays | wrong | close calls | error / bound | 99.9 % | max | ns | fallbacks |
|---|---|---|---|---|---|---|---|---|---|
)";

constexpr const char* by_kind = R"(
## By kind of ray

This table has the error in ulps that 99.9 % of the crossings stay below, as
standard / exact / naive:

)";

constexpr const char* close_calls = R"(
This table has the share of close calls in the standard tier:

)";

constexpr const char* by_distance = R"(
## By distance

The plot shows the error that 99.9 % of the plain rays stay below, against the distance of their
origin in sizes:

![Error against distance](accuracy.svg)
)";

constexpr const char* placed_table = R"(
## Transformed primitives

The exact tier was measured with transforms that rotate, mirror, shift and scale by factors up to
10^8 apart:

| primitive | rays | wrong | error / bound | fallbacks |
|---|---|---|---|---|
)";

constexpr const char* trees_table = R"(
## Trees of solids

The trees are random unions, differences and intersections of up to 27 solids on a grid, turned,
scaled and moved on it. Rays go through its corners, along its edges and within its planes. They are
compared with membership by exact roots. About {:.0f} % of all faces lie on a surface that another
solid of the tree has too.

*wrong* is as above. The exact tier has no close calls: it reports crossings in their true order,
however near to each other they are.

| tier | trees | rays | crossings | wrong | close calls | fallbacks |
|---|---|---|---|---|---|---|
)";

constexpr const char* meshes_table = R"(
## Meshes

The meshes are closed, of 100 to 10^6 triangles, as many rays at each size:

- *marching tetrahedra* of a smooth field, and a *subdivided* ball, mostly with noise;
- *slivers*: fans of needles, needles beside edges, balls stretched by up to 10^6;
- *snapped to a grid*: voxels, and balls whose corners are rounded to eighths, so that many facets
  coincide, pass through one another or lose their area;
- *mesh minus mesh*: voxels less the same or others of the same grid, and a ball less the same with
  some corners displaced. Most of their facets lie in a plane of the other mesh. A transform puts
  every other of the meshes that are taken away in its place.

Half of the rays are random. The others are aimed at corners and edges, run along edges, into planes
of facets or along axes. One in eight starts 10^9 sizes away. They are compared with fractions
(GMP): where a line meets triangles, and between two such places whether a point is inside, by the
parity of another line from there. One ray in ten at a mesh is also asked of a scene.

*wrong* is a ray of which crossings are not an even number that enter and leave by turns, or which
is inside (or outside) where it is not. For that a place may be off by its bound, and in a
difference two that overlap by their bounds count as one. Such rays are *close calls*. In the exact
tier any other crossings than the true ones are wrong. *error / bound* is that of t over what comes
with each crossing, and over 0.51 ulp in the exact tier.

| mesh | tier | meshes | rays | crossings | wrong | close calls | error / bound |
|---|---|---|---|---|---|---|---|
)";

constexpr const char* fields_table = R"(
## Fields

These are implicit solids of polynomial fields, with random numbers:

- a *ball*, a *torus*, *two balls* that may be one piece, a *cubic* with all its coefficients;
- a *heart* of degree six with a cusp, *cones* that meet in points, a *thin shell*, *crossed rods*
  of degree six that pass through one another.

Along a line such a field is a polynomial. Its coefficients are fractions (GMP), and Sturm's theorem
separates its roots. A quarter of the rays is tangent to the field, or within 10^-16 to 10^-2 of
that; a quarter is parallel to an axis or aimed at the middle; one in eight starts up to 10^8 sizes
away.

*undecided* are rays of which the library says that it could not decide all. *others* are those
among them that truly have more or fewer crossings, such as a lens that a ray grazes within the
rounding of the field. All other rays must have the true crossings, each within its error. A ray is
*wrong* if it has not, or if a crossing of the field has no odd number of true ones within its
error. *error / bound* is the largest of an error over what comes with the crossing, and *bound* the
largest of these over half a side of the field's box, where all was decided.

| field | tier | fields | rays | crossings | wrong | undecided | others | error / bound | bound |
|---|---|---|---|---|---|---|---|---|---|
)";

constexpr const char* agreement_table = R"(
## Do all queries agree?

Each ray is asked for its nearest hit, its distance, whether it is blocked, and all its crossings;
alone and in a batch of others. A *disagreement* is a ray of which two answers, as they are
promised, cannot both be true.

Subjects are every primitive, trees of two or three solids, and crowds of solids. They have the
sizes and offsets above, and a quarter of them is transformed. Rays are of all kinds. One in five
has a direction whose length or components are near the ends of what doubles hold. Parts of rays
begin or end at a crossing, or a double beside it.

| subject | tier | rays | with hits | disagreements |
|---|---|---|---|---|
)";

/// Replaces those rows of a table (that comes after `heading`) which begin like the new rows. If
/// there are none, the new rows come last.
class RowReplacement {
 public:
  RowReplacement(std::string heading, std::string rows)
      : heading_(std::move(heading)),
        rows_(std::move(rows)),
        begin_(rows_.substr(0, rows_.find('|', 2) + 1)) {}

  void apply(std::string& page) const {
    const std::size_t table = page.find("\n" + heading_);
    if (table == std::string::npos)
      throw std::runtime_error(fmt::format("the page has no table \"{}\"", heading_));
    const std::size_t header = page.find("\n|", table);
    const std::size_t end_of_table = std::min(page.find("\n\n", header), page.size() - 1) + 1;
    std::size_t first = page.find("\n" + begin_, header) + 1;
    if (first == 0 || first > end_of_table) first = end_of_table;
    std::size_t end = first;
    while (page.compare(end, begin_.size(), begin_) == 0) end = page.find('\n', end) + 1;
    page.replace(first, end - first, rows_);
  }

 private:
  std::string heading_;
  std::string rows_;
  std::string begin_;
};

/// Returns the first line of a part of the page that has one.
std::string heading_of(std::string_view part) {
  const std::size_t begin = part.find_first_not_of('\n');
  return std::string(part.substr(begin, part.find('\n', begin) - begin));
}

}  // namespace

std::string tier_rows(const Measured& of) {
  std::string result;
  for (const MeasuredTier& tier : of.tiers) {
    const Record& record = tier.record;
    const Histogram& plain = record.ulps_by_kind[0];
    const std::string escalations =
        tier.name == "exact" ? number(share(record.escalations, record.rays)) : "";
    result += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {:.0f} | {} |\n", name_of_primitive(of.kind),
        tier.name, record.rays, record.wrong, record.close_calls, number(record.largest_ratio),
        number(plain.quantile(0.999)), number(plain.largest()), tier.nanoseconds, escalations);
  }
  return result;
}

std::string tree_rows(const CsgRecord& record) {
  std::string result;
  for (const auto& [name, tier] :
       {std::pair{"standard", record.standard}, {"exact", record.exact}}) {
    result +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", name, record.trees, record.rays,
                    record.crossings, tier.wrong, tier.close_calls,
                    tier.escalations == 0 ? "" : number(share(tier.escalations, record.rays)));
  }
  return result;
}

std::string mesh_rows(const MeasuredMeshes& of) {
  std::string result;
  const MeshRecord& record = of.record;
  for (const auto& [name, tier] : {std::pair{"standard", record.standard}, {"exact", record.exact}})
    result +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", of.name, name, record.meshes,
                    record.rays, record.crossings, tier.wrong, tier.close_calls,
                    tier.largest_ratio == 0 ? "" : number(tier.largest_ratio));
  return result;
}

std::string field_rows(const MeasuredFields& of) {
  std::string result;
  const FieldRecord& record = of.record;
  for (const auto& [name, tier] : {std::pair{"standard", record.standard}, {"exact", record.exact}})
    result += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", of.name, name,
                          record.fields, record.rays, record.crossings, tier.wrong, tier.undecided,
                          tier.others, number(tier.largest_ratio), number(tier.largest_bound));
  return result;
}

std::string agreement_rows(const MeasuredAgreement& of) {
  std::string result;
  for (const auto& [name, record] : {std::pair{"standard", &of.standard}, {"exact", &of.exact}}) {
    result += fmt::format("| {} | {} | {} | {} | {} |\n", name_of_agreement(of.kind), name,
                          record->rays, record->hits, record->disagreements);
  }
  return result;
}

std::string accuracy_page(const MeasuredAll& all) {
  std::string page = introduction;
  const auto add_table = [&](std::string_view before, const auto& items, const auto& rows_of) {
    page += before;
    for (const auto& item : items) page += rows_of(item);
  };
  add_table(std::string_view(tiers_table).substr(1), all.primitives,
            [](const MeasuredPrimitive& one) { return tier_rows(one.in_place); });
  add_table(by_kind + heading_by_kind(), all.primitives,
            [](const MeasuredPrimitive& one) { return ulps_by_kind(one.in_place); });
  add_table(close_calls + heading_by_kind(), all.primitives,
            [](const MeasuredPrimitive& one) { return close_calls_by_kind(one.in_place); });
  page += by_distance;
  add_table(placed_table, all.primitives,
            [](const MeasuredPrimitive& one) { return placed_row(one.in_place.kind, one.placed); });
  page += fmt::format(trees_table, 100 * share(all.trees.coincident_faces, all.trees.faces));
  page += tree_rows(all.trees);
  add_table(meshes_table, all.meshes, mesh_rows);
  add_table(fields_table, all.fields, field_rows);
  add_table(agreement_table, all.agreement, agreement_rows);
  return page;
}

std::string with_rows_replaced(const std::string& page, const MeasuredAll& some) {
  std::vector<RowReplacement> replacements;
  for (const MeasuredPrimitive& one : some.primitives) {
    replacements.emplace_back("| primitive | tier | rays", tier_rows(one.in_place));
    replacements.emplace_back(heading_of(by_kind), ulps_by_kind(one.in_place));
    replacements.emplace_back(heading_of(close_calls), close_calls_by_kind(one.in_place));
    replacements.emplace_back(heading_of(placed_table), placed_row(one.in_place.kind, one.placed));
  }
  if (some.trees.trees > 0) {
    std::istringstream rows(tree_rows(some.trees));
    for (std::string row; std::getline(rows, row);) {
      replacements.emplace_back(heading_of(trees_table), row + "\n");
    }
  }
  for (const MeasuredMeshes& one : some.meshes)
    replacements.emplace_back(heading_of(meshes_table), mesh_rows(one));
  for (const MeasuredFields& one : some.fields)
    replacements.emplace_back(heading_of(fields_table), field_rows(one));
  for (const MeasuredAgreement& one : some.agreement) {
    replacements.emplace_back(heading_of(agreement_table), agreement_rows(one));
  }
  std::string result = page;
  for (const RowReplacement& replacement : replacements) replacement.apply(result);
  return result;
}

}  // namespace crt::test
