#include "core/math/transform_chain.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

namespace crt::core {
namespace {

/// An ExactSum finds out whether a sum of products is exact in the operators of double-double.
class ExactSum {
 public:
  void add(const DoubleDouble& a, const DoubleDouble& b) {
    if (a.hi == 0 || b.hi == 0) return;
    if (is_one(a)) return add(b);  // up to its sign
    if (is_one(b)) return add(a);
    // This is far from where the low part would underflow.
    constexpr double smallest = 0x1p-900;
    const DoubleDouble product = two_product(a.hi, b.hi);
    is_exact_ = is_exact_ && a.lo == 0 && b.lo == 0 && std::abs(product.hi) > smallest;
    add(product);
  }
  void add(const DoubleDouble& term) {
    if (term.hi == 0) return;
    ++terms_;
    has_low_ = has_low_ || term.lo != 0;
  }

  bool is_exact() const { return is_exact_ && (terms_ < 2 || (terms_ == 2 && !has_low_)); }

 private:
  static bool is_one(const DoubleDouble& a) { return std::abs(a.hi) == 1 && a.lo == 0; }

  bool is_exact_ = true;
  bool has_low_ = false;
  int terms_ = 0;
};

/// Returns whether a quick test shows that the product is exact. It does so for a translation, a
/// rotation and a scaling, once each.
bool is_exact(const PreciseTransform& second, const PreciseTransform& first) {
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      ExactSum sum;
      for (std::size_t k = 0; k < 3; ++k) {
        sum.add(second.rows[row][k], column < 3 ? first.rows[k][column] : first.translation[k]);
      }
      if (column == 3) sum.add(second.translation[row]);
      if (!sum.is_exact()) return false;
    }
  }
  return true;
}

/// Counts the binary digits from the highest of a map's numbers to the lowest. The map's fourth
/// row, which is (0, 0, 0, 1), is among them.
class Digits {
 public:
  void add(std::span<const DoubleDouble> numbers) {
    for (const DoubleDouble& number : numbers) {
      add(number.hi);
      add(number.lo);
    }
  }
  int count() const { return highest_ - lowest_ + 1; }

 private:
  void add(double number) {
    if (number == 0) return;
    constexpr int digits = 53;
    int exponent = 0;
    const double fraction = std::frexp(std::abs(number), &exponent);
    const auto whole = static_cast<std::uint64_t>(std::ldexp(fraction, digits));
    highest_ = std::max(highest_, exponent - 1);
    lowest_ = std::min(lowest_, exponent - digits + std::countr_zero(whole));
  }

  int highest_ = 0;
  int lowest_ = 0;
};

/// Returns a bound on the binary digits of a map's numbers. It is 16 at least, so that products of
/// thousands of simple maps come to an end.
int bits_of(const TransformChain& chain) {
  if (!chain.is_product()) return chain.bits;
  Digits digits;
  for (const PreciseVec3& row : chain.product.rows) digits.add(row);
  digits.add(chain.product.translation);
  constexpr int fewest = 16;
  return std::max(digits.count(), fewest);
}

bool has_low_part(const PreciseVec3& v) {
  return v[0].lo != 0 || v[1].lo != 0 || v[2].lo != 0;
}

}  // namespace

bool TransformChain::is_plain() const {
  return is_product() && !has_low_part(product.translation) &&
         std::none_of(product.rows.begin(), product.rows.end(), has_low_part);
}

TransformChain compose(const TransformChain& second, const TransformChain& first) {
  TransformChain result;
  result.product = compose(second.product, first.product);
  if (second.is_product() && first.is_product() && is_exact(second.product, first.product))
    return result;
  const int bits = bits_of(second) + bits_of(first);
  if (bits > max_chain_bits) return result;
  result.second = &second;
  result.first = &first;
  result.bits = bits;
  return result;
}

DyadicTransform exact_product(const TransformChain& chain) {
  if (chain.is_product()) return exactly(chain.product);
  return compose(exact_product(*chain.second), exact_product(*chain.first));
}

}  // namespace crt::core
