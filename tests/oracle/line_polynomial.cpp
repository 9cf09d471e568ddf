#include "oracle/line_polynomial.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace crt::test {

LinePolynomial::LinePolynomial(double constant) : coefficients_{mpq_class(constant)} {
  trim();
}

LinePolynomial::LinePolynomial(std::vector<mpq_class> coefficients)
    : coefficients_(std::move(coefficients)) {
  trim();
}

void LinePolynomial::trim() {
  while (!coefficients_.empty() && sgn(coefficients_.back()) == 0) coefficients_.pop_back();
}

LinePolynomial LinePolynomial::operator+(const LinePolynomial& other) const {
  std::vector<mpq_class> sum = coefficients_;
  sum.resize(std::max(sum.size(), other.coefficients_.size()));
  for (std::size_t i = 0; i < other.coefficients_.size(); ++i) sum[i] += other.coefficients_[i];
  return LinePolynomial(std::move(sum));
}

LinePolynomial LinePolynomial::operator-(const LinePolynomial& other) const {
  return *this + other * LinePolynomial(-1);
}

LinePolynomial LinePolynomial::operator*(const LinePolynomial& other) const {
  if (is_zero() || other.is_zero()) return LinePolynomial(0);
  std::vector<mpq_class> product(coefficients_.size() + other.coefficients_.size() - 1);
  for (std::size_t i = 0; i < coefficients_.size(); ++i) {
    for (std::size_t k = 0; k < other.coefficients_.size(); ++k)
      product[i + k] += coefficients_[i] * other.coefficients_[k];
  }
  return LinePolynomial(std::move(product));
}

int LinePolynomial::sign_at(const mpq_class& t) const {
  mpq_class value = 0;
  for (auto it = coefficients_.rbegin(); it != coefficients_.rend(); ++it) value = value * t + *it;
  return sgn(value);
}

LinePolynomial LinePolynomial::derivative() const {
  std::vector<mpq_class> result;
  for (std::size_t i = 1; i < coefficients_.size(); ++i)
    result.push_back(coefficients_[i] * static_cast<unsigned long>(i));
  return LinePolynomial(std::move(result));
}

void LinePolynomial::make_whole() {
  mpz_class multiple = 1;
  for (const mpq_class& c : coefficients_) multiple = lcm(multiple, c.get_den());
  mpz_class divisor = 0;
  for (mpq_class& c : coefficients_) {
    c *= multiple;
    divisor = gcd(divisor, c.get_num());
  }
  for (mpq_class& c : coefficients_) c /= divisor;
}

struct LinePolynomial::Division {
  LinePolynomial quotient;
  LinePolynomial rest;
};

LinePolynomial::Division LinePolynomial::divided(const LinePolynomial& a, const LinePolynomial& b) {
  std::vector<mpq_class> rest = a.coefficients_;
  const std::vector<mpq_class>& by = b.coefficients_;
  if (rest.size() < by.size()) return {LinePolynomial(0), a};
  std::vector<mpq_class> quotient(rest.size() - by.size() + 1);
  for (std::size_t i = quotient.size(); i-- > 0;) {
    quotient[i] = rest[i + by.size() - 1] / by.back();
    for (std::size_t k = 0; k < by.size(); ++k) rest[i + k] -= quotient[i] * by[k];
  }
  return {LinePolynomial(std::move(quotient)), LinePolynomial(std::move(rest))};
}

LinePolynomial LinePolynomial::without_multiples() const {
  LinePolynomial a = *this;
  LinePolynomial b = derivative();
  while (!b.is_zero()) {
    LinePolynomial rest = divided(a, b).rest;
    rest.make_whole();
    a = std::exchange(b, std::move(rest));
  }
  // `a` is the greatest common divisor now. Of its two signs the positive one is taken.
  if (sgn(a.coefficients_.back()) < 0) a = a * LinePolynomial(-1);
  LinePolynomial result = divided(*this, a).quotient;
  result.make_whole();
  return result;
}

LinePolynomial LinePolynomial::without_root(const mpq_class& t) const {
  return divided(*this, LinePolynomial({-t, 1})).quotient;
}

/// A SturmChain counts the roots of a polynomial that has each once.
class SturmChain {
 public:
  explicit SturmChain(const LinePolynomial& of) : chain_{of, of.derivative()} {
    while (true) {
      LinePolynomial rest = LinePolynomial::divided(chain_[chain_.size() - 2], chain_.back()).rest *
                            LinePolynomial(-1);
      if (rest.is_zero()) break;
      rest.make_whole();
      chain_.push_back(std::move(rest));
    }
  }

  /// Returns how many signs change along the chain. From one place to another this falls by the
  /// number of roots between.
  int changes_at(const mpq_class& t) const {
    int changes = 0;
    int before = 0;
    for (const LinePolynomial& polynomial : chain_) {
      const int sign = polynomial.sign_at(t);
      if (sign != 0 && before != 0 && sign != before) ++changes;
      if (sign != 0) before = sign;
    }
    return changes;
  }

  const LinePolynomial& of() const { return chain_[0]; }

 private:
  std::vector<LinePolynomial> chain_;
};

namespace {

/// Returns a fraction between two where the polynomial is not 0.
mpq_class free_place_between(const LinePolynomial& of, const mpq_class& from, const mpq_class& to) {
  // One of so many places is none of its roots, as there are fewer of these.
  for (unsigned long parts = 2;; ++parts) {
    mpq_class place = from + (to - from) / parts;
    if (of.sign_at(place) != 0) return place;
  }
}

void isolate(const SturmChain& chain, const LinePolynomial& of, const mpq_class& from,
             int changes_from, const mpq_class& to, int changes_to, std::vector<LineRoot>& out) {
  const int count = changes_from - changes_to;
  if (count == 0) return;
  if (count == 1) {
    out.emplace_back(&of, from, to);
    return;
  }
  const mpq_class middle = free_place_between(of, from, to);
  const int changes = chain.changes_at(middle);
  isolate(chain, of, from, changes_from, middle, changes, out);
  isolate(chain, of, middle, changes, to, changes_to, out);
}

}  // namespace

int LineRoot::compared_to(const mpq_class& t) {
  if (lower_ == upper_) return cmp(lower_, t);
  if (t <= lower_) return 1;
  if (t >= upper_) return -1;
  const int sign = of_->sign_at(t);
  if (sign == 0) {
    lower_ = upper_ = t;
    return 0;
  }
  const bool is_above = sign == of_->sign_at(lower_);
  (is_above ? lower_ : upper_) = t;
  return is_above ? 1 : -1;
}

void LineRoot::narrow(const mpq_class& width) {
  while (upper_ - lower_ > width) halve();
}

std::vector<LineRoot> roots_between(const LinePolynomial& of, const mpq_class& from,
                                    const mpq_class& to) {
  std::vector<LineRoot> result;
  const SturmChain chain(of);
  isolate(chain, of, from, chain.changes_at(from), to, chain.changes_at(to), result);
  return result;
}

}  // namespace crt::test
