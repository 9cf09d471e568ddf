// The oracle of fields against closed forms, and polynomial fields in both tiers against the
// oracle.
#include <doctest/doctest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "oracle/field_measure.hpp"
#include "oracle/line_polynomial.hpp"

using namespace crt::test;

namespace {

// This takes some 4 s of one core in all. A build that is slow by intent gets a part.
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr std::uint64_t fields = 12;
#else
constexpr std::uint64_t fields = 2;
#endif
constexpr std::uint64_t rays_each = 60;

/// Returns the product of t - root for some roots.
LinePolynomial with_roots(const std::vector<mpq_class>& roots) {
  LinePolynomial result(1);
  for (const mpq_class& root : roots) result = result * LinePolynomial({-root, 1});
  return result;
}

void check(const FieldTierRecord& tier, const FieldRecord& record) {
  CHECK(tier.wrong == 0);
  CHECK(tier.largest_ratio <= 1);
  CHECK(tier.largest_ratio > 0.01);
  CHECK(tier.undecided < record.rays / 4);
  CHECK(tier.others <= tier.undecided);
}

}  // namespace

TEST_CASE("the oracle of fields finds roots in fractions, whatever their multiplicity") {
  const LinePolynomial once =
      with_roots({1, 1, mpq_class(1, 3), mpq_class(1, 3), mpq_class(1, 3), -7}).without_multiples();
  std::vector<LineRoot> roots = roots_between(once, -100, 100);
  REQUIRE(roots.size() == 3);
  const mpq_class little(mpz_class(1), mpz_class(1) << 200);
  const std::vector<mpq_class> truth = {-7, mpq_class(1, 3), 1};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    CHECK(roots[i].compared_to(truth[i] - little) > 0);
    CHECK(roots[i].compared_to(truth[i] + little) < 0);
    CHECK(roots[i].compared_to(truth[i]) == 0);
  }
  CHECK(roots_between(once, 2, 3).empty());
  CHECK(once.without_root(1).sign_at(2) > 0);
  CHECK(roots_between(once.without_root(1), -100, 100).size() == 2);
  SUBCASE("roots that are no fractions, and places between which there is none") {
    const LinePolynomial t({0, 1});
    const LinePolynomial square = t * t - LinePolynomial(2);
    std::vector<LineRoot> both = roots_between(square, -2, 2);
    REQUIRE(both.size() == 2);
    both[1].narrow(little);
    const mpq_class lower = both[1].lower();
    const mpq_class upper = both[1].upper();
    const bool is_narrow = upper - lower <= little;
    CHECK(is_narrow);
    const bool is_about_the_root = lower * lower < 2 && upper * upper > 2;
    CHECK(is_about_the_root);
    CHECK(both[0].compared_to(both[1].lower()) < 0);
    CHECK(roots_between(square + LinePolynomial(3), -2, 2).empty());
  }
}

TEST_CASE("polynomial fields cross lines where these do in fractions, or say that they are open") {
  for (std::size_t kind = 0; kind < field_kinds; ++kind) {
    const auto of = static_cast<FieldKind>(kind);
    CAPTURE(name_of(of));
    const FieldRecord record = measure_fields(of, fields, rays_each);
    std::string failures;
    for (const std::string& failure : record.failures) failures += failure + "\n";
    INFO(failures);
    CHECK(record.crossings > record.rays / 5);
    check(record.standard, record);
    check(record.exact, record);
  }
}
