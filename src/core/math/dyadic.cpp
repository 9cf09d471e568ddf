#include "core/math/dyadic.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace crt::core {

namespace {

__extension__ using Wide = unsigned __int128;

constexpr int limb_bits = 64;

/// Brings value.hi into [1/2, 1).
ScaledNumber normalized(const DoubleDouble& value, int exponent) {
  if (value.hi == 0) return {};
  int shift = 0;
  const double hi = std::frexp(value.hi, &shift);
  return {{hi, std::ldexp(value.lo, -shift)}, exponent + shift};
}

}  // namespace

DoubleDouble ScaledNumber::unscaled() const {
  return {std::ldexp(value.hi, exponent), std::ldexp(value.lo, exponent)};
}

ScaledNumber operator+(const ScaledNumber& a, const ScaledNumber& b) {
  if (a.value.hi == 0) return b;
  if (b.value.hi == 0) return a;
  const ScaledNumber& large = a.exponent >= b.exponent ? a : b;
  const ScaledNumber& small = a.exponent >= b.exponent ? b : a;
  const int shift = small.exponent - large.exponent;
  const DoubleDouble moved{std::ldexp(small.value.hi, shift), std::ldexp(small.value.lo, shift)};
  return normalized(large.value + moved, large.exponent);
}

ScaledNumber operator-(const ScaledNumber& a) {
  return {-a.value, a.exponent};
}

ScaledNumber operator/(const ScaledNumber& a, const ScaledNumber& b) {
  return normalized(a.value / b.value, a.exponent - b.exponent);
}

ScaledNumber sqrt(const ScaledNumber& a) {
  if (a.exponent % 2 == 0) return normalized(sqrt(a.value), a.exponent / 2);
  const DoubleDouble doubled{2 * a.value.hi, 2 * a.value.lo};
  return normalized(sqrt(doubled), (a.exponent - 1) / 2);
}

Dyadic::Dyadic(double value) : negative_(std::signbit(value)) {
  if (value == 0) return;
  constexpr int digits = 53;
  int exponent = 0;
  const double fraction = std::frexp(std::abs(value), &exponent);
  const auto whole = static_cast<Wide>(std::ldexp(fraction, digits));
  exponent -= digits;
  base_ = exponent >> 6;  // rounded down, so the remaining shift is not negative
  const Wide shifted = whole << (exponent - base_ * limb_bits);
  limbs_ = {static_cast<Limb>(shifted), static_cast<Limb>(shifted >> limb_bits)};
  trim();
}

void Dyadic::trim() {
  while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  std::size_t zeros = 0;
  while (zeros < limbs_.size() && limbs_[zeros] == 0) ++zeros;
  limbs_.erase(limbs_.begin(), limbs_.begin() + static_cast<std::ptrdiff_t>(zeros));
  base_ = limbs_.empty() ? 0 : base_ + static_cast<int>(zeros);
  if (limbs_.empty()) negative_ = false;
}

Dyadic::Limb Dyadic::limb_at(int place) const {
  return place < base_ || place >= top() ? 0 : limbs_[static_cast<std::size_t>(place - base_)];
}

int Dyadic::compare_sizes(const Dyadic& a, const Dyadic& b) {
  if (a.limbs_.empty() || b.limbs_.empty())
    return (b.limbs_.empty() ? 1 : 0) - (a.limbs_.empty() ? 1 : 0);
  if (a.top() != b.top()) return a.top() > b.top() ? 1 : -1;
  for (int place = a.top(); place-- > std::min(a.base_, b.base_);) {
    if (a.limb_at(place) != b.limb_at(place)) return a.limb_at(place) > b.limb_at(place) ? 1 : -1;
  }
  return 0;
}

Dyadic Dyadic::sum_of_sizes(const Dyadic& a, const Dyadic& b) {
  Dyadic result;
  result.base_ = std::min(a.base_, b.base_);
  const int top = std::max(a.top(), b.top());
  result.limbs_.reserve(static_cast<std::size_t>(top - result.base_) + 1);
  Wide carry = 0;
  for (int place = result.base_; place < top; ++place) {
    carry += static_cast<Wide>(a.limb_at(place)) + b.limb_at(place);
    result.limbs_.push_back(static_cast<Limb>(carry));
    carry >>= limb_bits;
  }
  result.limbs_.push_back(static_cast<Limb>(carry));
  return result;
}

Dyadic Dyadic::difference_of_sizes(const Dyadic& a, const Dyadic& b) {
  Dyadic result;
  result.base_ = std::min(a.base_, b.base_);
  result.limbs_.reserve(static_cast<std::size_t>(a.top() - result.base_));
  Limb borrow = 0;
  for (int place = result.base_; place < a.top(); ++place) {
    const Wide taken = static_cast<Wide>(b.limb_at(place)) + borrow;
    const Limb from = a.limb_at(place);
    result.limbs_.push_back(from - static_cast<Limb>(taken));
    borrow = from < taken ? 1 : 0;
  }
  return result;
}

Dyadic operator-(Dyadic a) {
  a.negative_ = !a.negative_ && !a.limbs_.empty();
  return a;
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
  if (a.limbs_.empty()) return b;
  if (b.limbs_.empty()) return a;
  if (a.negative_ == b.negative_) {
    Dyadic result = Dyadic::sum_of_sizes(a, b);
    result.negative_ = a.negative_;
    result.trim();
    return result;
  }
  const int order = Dyadic::compare_sizes(a, b);
  if (order == 0) return {};
  const Dyadic& large = order > 0 ? a : b;
  Dyadic result = Dyadic::difference_of_sizes(large, order > 0 ? b : a);
  result.negative_ = large.negative_;
  result.trim();
  return result;
}

Dyadic operator-(const Dyadic& a, const Dyadic& b) {
  return a + -b;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
  if (a.limbs_.empty() || b.limbs_.empty()) return {};
  Dyadic result;
  result.negative_ = a.negative_ != b.negative_;
  result.base_ = a.base_ + b.base_;
  result.limbs_.assign(a.limbs_.size() + b.limbs_.size(), 0);
  for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
    Dyadic::Limb carry = 0;
    for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
      const Wide sum = static_cast<Wide>(a.limbs_[i]) * b.limbs_[j] + result.limbs_[i + j] + carry;
      result.limbs_[i + j] = static_cast<Dyadic::Limb>(sum);
      carry = static_cast<Dyadic::Limb>(sum >> limb_bits);
    }
    result.limbs_[i + b.limbs_.size()] = carry;
  }
  result.trim();
  return result;
}

ScaledNumber Dyadic::rounded() const {
  if (limbs_.empty()) return {};
  // The three highest limbs hold more bits than a double-double. Half a limb is exactly a double.
  constexpr int half_bits = limb_bits / 2;
  constexpr int max_limbs = 3;
  const int lowest = std::max(base_, top() - max_limbs);
  DoubleDouble sum;
  for (int place = lowest; place < top(); ++place) {
    const Limb limb = limb_at(place);
    const int shift = (place - lowest) * limb_bits;
    sum = sum + DoubleDouble(std::ldexp(static_cast<double>(limb & 0xffffffffu), shift));
    sum = sum + DoubleDouble(std::ldexp(static_cast<double>(limb >> half_bits), shift + half_bits));
  }
  return normalized(negative_ ? -sum : sum, lowest * limb_bits);
}

}  // namespace crt::core
