// A Field is a function f(x, y, z), as an expression that never changes:
//   const Field x = Field::x(), y = Field::y(), z = Field::z();
//   const Field tube = pow(sqrt(x * x + y * y) - 1, 2) + z * z - 0.1;
#pragma once

#include <memory>
#include <string_view>

namespace crt {

class Profile;

namespace core {
struct FieldNode;
}  // namespace core

/// A Field is a function of a point. Copies share what they are made of, so they cost nothing.
///
/// Numbers are taken as they are, and nothing is rounded until it is evaluated. Where a part of a
/// field has no value, such as log(x) or sqrt(x) at x < 0, 1 / x at 0 and atan2(0, 0), the whole
/// field has none. At most 1024 operations are within one another, and a field that a solid is made
/// of has at most 4096, those that are equal counted once. Making a deeper one throws Error
/// (invalid_argument), and so does a number that is not finite.
class Field {
 public:
  /// Makes a field that is the same everywhere.
  Field(double constant = 0);  // NOLINT(google-explicit-constructor): numbers are fields

  /// These are the coordinates.
  static Field x();
  static Field y();  ///< as x()
  static Field z();  ///< as x()

  /// Returns what it is made of, which only the library knows.
  const core::FieldNode& node() const { return *node_; }

 private:
  friend struct core::FieldNode;
  explicit Field(std::shared_ptr<const core::FieldNode> node) : node_(std::move(node)) {}

  std::shared_ptr<const core::FieldNode> node_;
};

/// Returns -a.
Field operator-(const Field& a);
/// Returns a + b.
Field operator+(const Field& a, const Field& b);
/// Returns a - b.
Field operator-(const Field& a, const Field& b);
/// Returns a times b.
Field operator*(const Field& a, const Field& b);
/// Returns a / b, which b = 0 has not.
Field operator/(const Field& a, const Field& b);
/// Returns a to the power of a number. If that is not whole, a negative a has none. 0 has one for
/// exponents above 0. To the power of 0 it is 1.
Field pow(const Field& a, double exponent);
/// Returns exp(exponent * log(a)), which is defined for a > 0.
Field pow(const Field& a, const Field& exponent);
/// Returns the square root, which a < 0 has not.
Field sqrt(const Field& a);
/// Returns |a|.
Field abs(const Field& a);
/// Returns the smaller of both.
Field min(const Field& a, const Field& b);
/// Returns the larger of both.
Field max(const Field& a, const Field& b);
/// Returns the sine of an angle in radians.
Field sin(const Field& a);
/// Returns the cosine of an angle in radians.
Field cos(const Field& a);
/// Returns the tangent of an angle in radians.
Field tan(const Field& a);
/// Returns the angle with that sine, from -pi / 2 to pi / 2.
Field asin(const Field& a);
/// Returns the angle with that cosine, from 0 to pi.
Field acos(const Field& a);
/// Returns the angle with that tangent, from -pi / 2 to pi / 2.
Field atan(const Field& a);
/// Returns the angle of (x, y) from the x axis, from -pi to pi.
Field atan2(const Field& y, const Field& x);
/// Returns e to the power of a.
Field exp(const Field& a);
/// Returns the natural logarithm, which a <= 0 has not.
Field log(const Field& a);
/// Returns the largest whole number up to a.
Field floor(const Field& a);
/// Returns the least whole number from a on.
Field ceil(const Field& a);
/// Returns the nearest whole number. Halves go away from 0.
Field round(const Field& a);

/// Returns how far (x, y) is from the boundary of a profile (make_profile() in crt/primitives.hpp),
/// below 0 inside: what is at most 0.1, say, is the profile with a margin all around it. Evaluating
/// it takes time that grows with the profile's pieces. Throws Error (invalid_argument) if contours
/// cross or touch one another or themselves, or if there are over 4096 pieces.
Field profile_distance(const std::shared_ptr<const Profile>& profile, const Field& x,
                       const Field& y);

/// Reads a field from an expression of the CRT language, in which x, y and z are the coordinates:
/// "x ** 2 + y ** 2 + z ** 2 - 1". It sees the language's functions and constants, and `t` is 0.
/// Throws Error (script) with what is wrong and where.
Field parse_field(std::string_view text);

}  // namespace crt
