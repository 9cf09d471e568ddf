// Every primitive against the oracle, over 18 orders of size and 15 of distance.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include "oracle/measure.hpp"

using namespace crt::test;

namespace {

/// Rays of each primitive: TIMES on two cores in all. Tori cost ten times what the others do.
constexpr std::uint64_t rays = 200'000;
constexpr std::uint64_t torus_rays = 50'000;

void check(std::size_t kind, std::uint64_t count, const std::vector<Contestant>& tiers, RayMaker maker) {
  const std::string name(name_of_primitive(kind));
  CAPTURE(name);
  const std::vector<Record> records = measure_all(kind, 0, count, tiers, maker);
  for (std::size_t i = 0; i < tiers.size(); ++i) {
    const std::string tier = tiers[i].name;
    CAPTURE(tier);
    const Record& record = records[i];
    CHECK(record.hits > count / 3);
    for (const std::uint64_t number : record.failures) {
      FAIL_CHECK(fmt::format("ray {}: {}", number, description(maker(kind, number))));
    }
    CHECK(record.wrong == 0);
    CHECK(record.largest_ratio <= 1);
    if (tiers[i].promise == Promise::standard) CHECK(record.largest_claim <= 1);
  }
}

}  // namespace

TEST_CASE("every primitive keeps its bounds, and decides right but for close calls") {
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    std::vector<Contestant> tiers = {standard_tier()};
    if (has_exact_tier(kind)) tiers.push_back(exact_tier());
    check(kind, name_of_primitive(kind) == "torus" ? torus_rays : rays, tiers, make_ray);
  }
}

TEST_CASE("the exact tier is right about transformed primitives") {
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    if (has_exact_tier(kind)) check(kind, torus_rays, {exact_tier()}, make_placed_ray);
  }
}
