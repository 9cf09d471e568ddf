// The elementary functions are as true as their header says: they are compared with MPFR.
#include <doctest/doctest.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <crt/elementary.hpp>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "elementary/tables.hpp"

namespace {

using namespace crt;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double max_error = 0.5001;  // of a unit in the last place

using Truth = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr);
using Function = double (*)(double, double);

/// A Range has the exponents of the arguments that are asked about, or all doubles' bits.
struct Range {
  double low;
  double high;
  bool negative = true;
};

/// A Subject is a function and what is asked about it. A function of one number ignores the second.
struct Subject {
  std::string name;
  Function function;
  Truth truth;
  std::vector<Range> of_first;
  Range of_second = {0, 0};
};

constexpr Range everywhere = {-1074, 1024};
constexpr Range usual = {-30, 20};
constexpr Range up_to_one = {-60, 0};

/// Has MPFR compute with the first argument alone.
template <int (*function)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t)>
int of_one(mpfr_ptr result, mpfr_srcptr x, mpfr_srcptr /*y*/) {
  return function(result, x, MPFR_RNDN);
}
template <int (*function)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t)>
int of_two(mpfr_ptr result, mpfr_srcptr x, mpfr_srcptr y) {
  return function(result, x, y, MPFR_RNDN);
}

template <double (*function)(double)>
double one(double x, double /*y*/) {
  return function(x);
}

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> list = {
      {"sin", one<elementary::sin>, of_one<mpfr_sin>, {everywhere, usual, {-3, 2}}},
      {"cos", one<elementary::cos>, of_one<mpfr_cos>, {everywhere, usual, {-3, 2}}},
      {"tan", one<elementary::tan>, of_one<mpfr_tan>, {everywhere, usual, {-3, 2}}},
      {"asin", one<elementary::asin>, of_one<mpfr_asin>, {up_to_one, {-2, 0}}},
      {"acos", one<elementary::acos>, of_one<mpfr_acos>, {up_to_one, {-2, 0}}},
      {"atan", one<elementary::atan>, of_one<mpfr_atan>, {everywhere, usual, {-4, 4}}},
      {"atan2", elementary::atan2, of_two<mpfr_atan2>, {everywhere, usual, {-2, 2}}, usual},
      {"atan2 anywhere", elementary::atan2, of_two<mpfr_atan2>, {everywhere}, everywhere},
      {"exp", one<elementary::exp>, of_one<mpfr_exp>, {{-60, 9.5}, {-3, 9.5}}},
      {"log", one<elementary::log>, of_one<mpfr_log>, {{-1074, 1024, false}, {-1, 1, false}}},
      {"log1p", one<elementary::log1p>, of_one<mpfr_log1p>, {{-70, 1024, false}, {-60, 0}}},
      {"log10", one<elementary::log10>, of_one<mpfr_log10>, {{-1074, 1024, false}, {-1, 1, false}}},
      {"pow",
       elementary::pow,
       of_two<mpfr_pow>,
       {{-1074, 1024, false}, {-10, 10, false}, {-0.1, 0.1, false}},
       {-10, 10}},
      {"pow of a colour", elementary::pow, of_two<mpfr_pow>, {{-10, 0, false}}, {-3, 3}},
      {"hypot",
       static_cast<Function>(elementary::hypot),
       of_two<mpfr_hypot>,
       {{-1074, 1023}, usual},
       usual},
      {"hypot of the least",
       static_cast<Function>(elementary::hypot),
       of_two<mpfr_hypot>,
       {{-1074, -1010}},
       {-1074, -1010}},
  };
  return list;
}

double random_in(const Range& range, std::mt19937_64& engine) {
  const double size =
      std::exp2(std::uniform_real_distribution<double>(range.low, range.high)(engine));
  // Few bits make exact cases and ties.
  const bool is_short = engine() % 4 == 0;
  const double kept =
      is_short ? std::bit_cast<double>(std::bit_cast<std::uint64_t>(size) >> 44 << 44) : size;
  return range.negative && engine() % 2 == 0 ? -kept : kept;
}

/// An Oracle compares results with true ones of 120 bits.
class Oracle {
 public:
  Oracle() {
    for (mpfr_ptr number : {x_, y_, truth_, error_}) mpfr_init2(number, 120);
  }
  ~Oracle() {
    for (mpfr_ptr number : {x_, y_, truth_, error_}) mpfr_clear(number);
  }
  Oracle(const Oracle&) = delete;
  Oracle& operator=(const Oracle&) = delete;

  /// Returns the error in units in the last place of the true result.
  double error(const Subject& subject, double x, double y) {
    const double found = subject.function(x, y);
    mpfr_set_d(x_, x, MPFR_RNDN);
    mpfr_set_d(y_, y, MPFR_RNDN);
    subject.truth(truth_, x_, y_);
    const double nearest = mpfr_get_d(truth_, MPFR_RNDN);
    if (std::isnan(nearest) || std::isinf(nearest) || nearest == 0) {
      const bool same = std::isnan(nearest) ? std::isnan(found) : found == nearest;
      return same ? 0 : infinity;
    }
    if (!std::isfinite(found)) {
      // What is half a unit beyond the largest number is infinite.
      const double largest = std::numeric_limits<double>::max();
      return std::abs(nearest) == largest && std::signbit(nearest) == std::signbit(found)
                 ? 0.5
                 : infinity;
    }
    mpfr_sub_d(error_, truth_, found, MPFR_RNDN);
    const double size = std::abs(nearest);
    const int last_place = std::max(std::ilogb(size) - 52, -1074);
    mpfr_mul_2si(error_, error_, -last_place, MPFR_RNDN);
    return std::abs(mpfr_get_d(error_, MPFR_RNDN));
  }

 private:
  mpfr_t x_, y_, truth_, error_;
};

struct Worst {
  double error = 0;
  double x = 0;
  double y = 0;
};

Worst worst_of(const Subject& subject, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  Oracle oracle;
  Worst worst;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random_in(subject.of_first[i % subject.of_first.size()], engine);
    const double y = random_in(subject.of_second, engine);
    const double error = oracle.error(subject, x, y);
    if (!(error <= worst.error)) worst = {error, x, y};
  }
  mpfr_free_cache();
  return worst;
}

TEST_CASE("the functions are within 0.5001 units in the last place of the true values") {
  constexpr std::size_t count = 1000000;
  std::vector<Worst> found(subjects().size());
  const auto work = [&](std::size_t first) {
    for (std::size_t i = first; i < found.size(); i += 2)
      found[i] = worst_of(subjects()[i], count, i);
  };
  std::thread other(work, 1);
  work(0);
  other.join();
  for (std::size_t i = 0; i < found.size(); ++i) {
    CAPTURE(subjects()[i].name);
    CAPTURE(found[i].x);
    CAPTURE(found[i].y);
    INFO("the largest error is " << found[i].error);
    CHECK(found[i].error <= max_error);
    CHECK(found[i].error > 0.4);  // otherwise nothing was measured
  }
}

TEST_CASE("angles beside multiples of a quarter of a turn are as true, and so are huge ones") {
  Oracle oracle;
  std::vector<double> angles = {
      // This is the double that is nearest to a multiple of pi / 2 (Muller, section 11.3.2).
      0x1.6ac5b262ca1ffp+849, std::numeric_limits<double>::max(), 0x1p25, 0x1p1000, 1e22};
  for (int turns = 1; turns < 20000; ++turns) {
    const double middle = turns * 0x1.921fb54442d18p-2;
    for (const double x : {std::nextafter(middle, 0), middle, std::nextafter(middle, infinity)})
      angles.push_back(x);
  }
  for (int i = 0; i < 1024; ++i) angles.push_back(std::ldexp(0x1.921fb54442d18p0, i - 1));
  for (const double x : angles) {
    CAPTURE(x);
    for (std::size_t i = 0; i < 3; ++i) {
      REQUIRE(oracle.error(subjects()[i], x, 0) <= max_error);
      REQUIRE(oracle.error(subjects()[i], -x, 0) <= max_error);
    }
  }
}

TEST_CASE("three sides have the length of two, one of which is that of the others") {
  std::mt19937_64 engine(1);
  mpfr_t sum, side;
  mpfr_init2(sum, 300);
  mpfr_init2(side, 300);
  for (int i = 0; i < 200000; ++i) {
    const std::array<double, 3> sides = {random_in({-1074, 1022}, engine),
                                         random_in({-20, 20}, engine), random_in({-3, 3}, engine)};
    mpfr_set_zero(sum, 1);
    for (const double length : sides) {
      mpfr_set_d(side, length, MPFR_RNDN);
      mpfr_sqr(side, side, MPFR_RNDN);
      mpfr_add(sum, sum, side, MPFR_RNDN);
    }
    mpfr_sqrt(sum, sum, MPFR_RNDN);
    // 300 bits of the sum, and no result of these is as near to a tie as the function's error.
    REQUIRE(elementary::hypot(sides[0], sides[1], sides[2]) == mpfr_get_d(sum, MPFR_RNDN));
    REQUIRE(elementary::hypot(sides[2], sides[0], sides[1]) == mpfr_get_d(sum, MPFR_RNDN));
  }
  mpfr_clear(sum);
  mpfr_clear(side);
}

TEST_CASE("the tables are those that MPFR computes") {
  std::ifstream file(CRT_SOURCE_DIR "/src/core/math/elementary_tables.hpp");
  std::stringstream text;
  text << file.rdbuf();
  CHECK(text.str() == tests::elementary_tables());
}

}  // namespace
