#include "elementary/tables.hpp"

#include <fmt/format.h>
#include <mpfr.h>

#include <cmath>

namespace crt::tests {

namespace {

/// A Number has 2000 bits, more than any table asks for.
class Number {
 public:
  Number() { mpfr_init2(value_, 2000); }
  ~Number() { mpfr_clear(value_); }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;

  mpfr_ptr get() { return value_; }

  /// Takes the nearest double away and returns it.
  double take() {
    const double nearest = mpfr_get_d(value_, MPFR_RNDN);
    mpfr_sub_d(value_, value_, nearest, MPFR_RNDN);
    return nearest;
  }

  /// Returns the number as a sum of two doubles, as text.
  std::string two_doubles() {
    const double hi = take();
    const double lo = take();
    return fmt::format("{}, {}", text(hi), text(lo));
  }

  static std::string text(double x) {
    if (x == 0) return "0.0";
    return x < 0 ? fmt::format("-{:a}", -x) : fmt::format("{:a}", x);
  }

 private:
  mpfr_t value_;
};

std::string begin(const char* comment, const char* type, const char* name, int count) {
  return fmt::format("\n{}\ninline constexpr std::array<{}, {}> {} = {{{{\n", comment, type, count,
                     name);
}

std::string powers() {
  std::string result = begin("/// These are 2^(i / 64).", "DoubleDouble", "powers_of_two", 64);
  for (int i = 0; i < 64; ++i) {
    Number x;
    mpfr_set_d(x.get(), i / 64.0, MPFR_RNDN);
    mpfr_exp2(x.get(), x.get(), MPFR_RNDN);
    result += fmt::format("    {{{}}},\n", x.two_doubles());
  }
  return result + "}};\n";
}

std::string logarithms() {
  std::string result = begin(
      "/// These are inverses of (90 + i) / 128 to 9 bits behind the point, and minus their "
      "natural\n"
      "/// logarithms.",
      "LogarithmStep", "logarithm_steps", 92);
  for (int i = 90; i < 182; ++i) {
    const double inverse = std::floor(512 * 128.0 / i + 0.5) / 512;
    Number x;
    mpfr_set_d(x.get(), inverse, MPFR_RNDN);
    mpfr_log(x.get(), x.get(), MPFR_RNDN);
    mpfr_neg(x.get(), x.get(), MPFR_RNDN);
    result += fmt::format("    {{{}, {{{}}}}},\n", Number::text(inverse), x.two_doubles());
  }
  return result + "}};\n";
}

std::string waves() {
  std::string result =
      begin("/// These are the sine and the cosine of i / 64.", "WaveStep", "wave_steps", 52);
  for (int i = 0; i < 52; ++i) {
    Number sine;
    Number cosine;
    mpfr_set_d(sine.get(), i / 64.0, MPFR_RNDN);
    mpfr_sin_cos(sine.get(), cosine.get(), sine.get(), MPFR_RNDN);
    const std::string of_sine = sine.two_doubles();
    result += fmt::format("    {{{{{}}},\n     {{{}}}}},\n", of_sine, cosine.two_doubles());
  }
  return result + "}};\n";
}

std::string angles() {
  std::string result = begin("/// These are the angles whose tangents are i / 64.", "DoubleDouble",
                             "angles_of_tangents", 65);
  for (int i = 0; i < 65; ++i) {
    Number x;
    mpfr_set_d(x.get(), i / 64.0, MPFR_RNDN);
    mpfr_atan(x.get(), x.get(), MPFR_RNDN);
    result += fmt::format("    {{{}}},\n", x.two_doubles());
  }
  return result + "}};\n";
}

std::string bits_of_two_over_pi() {
  std::string result =
      begin("/// These are the bits of 2 / pi behind the point, after a word of zeros.",
            "std::uint64_t", "two_over_pi", 22);
  Number x;
  mpfr_const_pi(x.get(), MPFR_RNDN);
  mpfr_ui_div(x.get(), 2, x.get(), MPFR_RNDN);
  result += "    0,\n";
  for (int i = 1; i < 22; ++i) {
    Number whole;
    mpfr_mul_2ui(x.get(), x.get(), 64, MPFR_RNDN);
    mpfr_floor(whole.get(), x.get());
    mpfr_sub(x.get(), x.get(), whole.get(), MPFR_RNDN);
    result += fmt::format("    0x{:016x},\n", mpfr_get_ui(whole.get(), MPFR_RNDD));
  }
  return result + "}};\n";
}

std::string constants() {
  std::string result;
  Number pi;
  mpfr_const_pi(pi.get(), MPFR_RNDN);
  mpfr_div_ui(pi.get(), pi.get(), 2, MPFR_RNDN);
  result += "\n/// These three add up to pi / 2.\n";
  for (const char* name : {"half_pi", "half_pi_rest", "half_pi_last"})
    result += fmt::format("inline constexpr double {} = {};\n", name, Number::text(pi.take()));

  Number ln2;
  mpfr_const_log2(ln2.get(), MPFR_RNDN);
  result += fmt::format("\n/// This is ln 2.\ninline constexpr DoubleDouble ln_2{{{}}};\n",
                        ln2.two_doubles());
  Number step;
  mpfr_const_log2(step.get(), MPFR_RNDN);
  mpfr_div_ui(step.get(), step.get(), 64, MPFR_RNDN);
  result += fmt::format("/// This is ln 2 / 64.\ninline constexpr DoubleDouble ln_step{{{}}};\n",
                        step.two_doubles());
  Number ln10;
  mpfr_set_ui(ln10.get(), 10, MPFR_RNDN);
  mpfr_log(ln10.get(), ln10.get(), MPFR_RNDN);
  mpfr_ui_div(ln10.get(), 1, ln10.get(), MPFR_RNDN);
  result += fmt::format("/// This is 1 / ln 10.\ninline constexpr DoubleDouble per_ln_10{{{}}};\n",
                        ln10.two_doubles());
  return result;
}

}  // namespace

std::string elementary_tables() {
  return "// The numbers that core/math/elementary.cpp begins with, as MPFR has them:\n"
         "// tests/elementary/make_tables.cpp prints this file, and a test compares it.\n"
         "// clang-format off\n"
         "#pragma once\n\n#include <array>\n#include <cstdint>\n\n"
         "#include \"core/math/double_double.hpp\"\n\n"
         "namespace crt::core::elementary_tables {\n\n"
         "struct LogarithmStep {\n  double inverse;\n  DoubleDouble logarithm;\n};\n\n"
         "struct WaveStep {\n  DoubleDouble sine;\n  DoubleDouble cosine;\n};\n" +
         constants() + powers() + logarithms() + waves() + angles() + bits_of_two_over_pi() +
         "\n}  // namespace crt::core::elementary_tables\n";
}

}  // namespace crt::tests
