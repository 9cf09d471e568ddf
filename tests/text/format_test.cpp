// The forms of text are compared with those of the library fmt, whose notation they share.
#include "text/format.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

using crt::text::format;

TEST_CASE("forms write arguments in their order, or in that of their numbers") {
  const std::string name = "ball";
  CHECK(format("nothing") == "nothing");
  CHECK(format("") == "");
  CHECK(format("{} of {}", 2, name) == "2 of ball");
  CHECK(format("{1}{0}{1}", 'a', "bc") == "bcabc");
  CHECK(format("{{{}}} }}{{", std::string_view("in")) == "{in} }{");
  CHECK(format("{} {}", true, false) == "true false");
  CHECK(format("{}", std::string("a\0b", 3)) == std::string("a\0b", 3));
}

TEST_CASE("whole numbers have zeros before them where their width asks for it") {
  CHECK(format("{:04}|{:04}|{:02}", 7, -7, 123) == "0007|-007|123");
  CHECK(format("{:02x} {:04X} {:03o} {:d}", 10u, 0xBEEFu, 8, 65) == "0a BEEF 010 65");
  CHECK(format("{:d}", 'A') == "65");
  CHECK(format("{} {}", std::numeric_limits<std::int64_t>::min(),
               std::numeric_limits<std::uint64_t>::max()) ==
        "-9223372036854775808 18446744073709551615");
  CHECK(format("{} {}", static_cast<std::uint8_t>(200), static_cast<short>(-3)) == "200 -3");
}

TEST_CASE("what is no number is written as such") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK(format("{} {:g} {:.2f}", infinity, -infinity, infinity) == "inf -inf inf");
  CHECK(format("{}", std::numeric_limits<double>::quiet_NaN()) == "nan");
}

namespace {

template <class Real>
void check_as_fmt_does(Real value) {
  CAPTURE(value);
  REQUIRE(format("{}", value) == fmt::format("{}", value));
  REQUIRE(format("{:g}|{:.3g}|{:.17g}", value, value, value) ==
          fmt::format("{:g}|{:.3g}|{:.17g}", value, value, value));
  REQUIRE(format("{:.0f}|{:.2f}|{:f}", value, value, value) ==
          fmt::format("{:.0f}|{:.2f}|{:f}", value, value, value));
}

template <class Real, class Bits>
void check_many() {
  std::mt19937_64 random(46);
  for (int i = 0; i < 20000; ++i) {
    const auto any = std::bit_cast<Real>(static_cast<Bits>(random()));
    if (any == any) check_as_fmt_does(any);
    // Numbers as people have them: few digits, not far from 1.
    const auto few = static_cast<Real>(static_cast<int>(random() % 20001) - 10000);
    constexpr Real scales[] = {1, 8, 1000, Real(1e7), Real(1e-3), Real(1e12), Real(1e-12)};
    for (const Real scale : scales) check_as_fmt_does(few / scale);
  }
}

}  // namespace

TEST_CASE("numbers are written as the library fmt writes them") {
  for (const double value : {0.0, -0.0, 1.0, 1e15, 9999999999999998.0, 1e16, 1e-4, 9.999e-5, 5e-324,
                             std::numeric_limits<double>::max(), 123456789012345680.0}) {
    check_as_fmt_does(value);
    check_as_fmt_does(static_cast<float>(value));
  }
  check_many<double, std::uint64_t>();
  check_many<float, std::uint32_t>();
}
