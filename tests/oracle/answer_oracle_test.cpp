// The oracle of the exact tier accepts the truth, and nothing else.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <limits>

#include "oracle/measure.hpp"

using namespace crt::test;
using crt::core::CrossingList;

namespace {

/// Says whether an answer that is made of the truth is accepted.
template <class Change>
bool accepts(const Truth& truth, const Change& change) {
  Contestant contestant{.name = "changed", .promise = Promise::exact, .crossings = {}};
  contestant.crossings = [&](const TestRay&, CrossingList& out, std::uint64_t&) {
    bool before = truth.line.inside_before;
    for (const TrueCrossing& crossing : truth.line.crossings) {
      out.push_back({.t = crossing.t.value(),
                     .error = std::numeric_limits<double>::infinity(),
                     .entering = crossing.entering});
    }
    change(out, before);
    return before;
  };
  Record record;
  return measure(truth, contestant, 0, record);
}

}  // namespace

TEST_CASE("of all answers the oracle accepts the rounded truth only") {
  constexpr std::uint64_t rays = 10'000;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  int hits = 0;
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    for (std::uint64_t number = 0; number < rays; ++number) {
      const Truth truth =
          truth_of(number % 2 == 0 ? make_ray(kind, number) : make_placed_ray(kind, number));
      CAPTURE(kind);
      CAPTURE(number);
      CHECK(accepts(truth, [](CrossingList&, bool&) {}));
      CHECK_FALSE(accepts(truth, [](CrossingList&, bool& before) { before = !before; }));
      CHECK_FALSE(accepts(truth, [](CrossingList& out, bool&) { out.push_back({.t = 1}); }));
      if (truth.line.crossings.empty()) continue;
      ++hits;
      const std::size_t last = truth.line.crossings.size() - 1;
      CHECK_FALSE(accepts(truth, [](CrossingList& out, bool&) { out.clear(); }));
      CHECK_FALSE(accepts(truth, [](CrossingList& out, bool&) { out.pop_back(); }));
      CHECK_FALSE(accepts(
          truth, [&](CrossingList& out, bool&) { out[last].entering = !out[last].entering; }));
      // The change is away from the truth, as a value halfway between two doubles has two
      // neighbours that are as near. Next to a power of two doubles are closer on one side.
      const Ball<4>& t = truth.line.crossings[last].t;
      if (t.value() == 0 || std::exp2(std::logb(t.value())) == std::abs(t.value())) continue;
      const double away = t.part(1) > 0 ? -infinity : infinity;
      const int places = name_of_primitive(kind) == "torus" ? 2 : 1;
      CHECK_FALSE(accepts(truth, [&](CrossingList& out, bool&) {
        for (int i = 0; i < places; ++i) out[last].t = std::nextafter(out[last].t, away);
      }));
    }
  }
  CHECK(hits > 30'000);
}
