// Elementary functions have the same bits on every machine. Those of C libraries differ in their
// last bits from one version, and one processor, to the next. So whoever computes the numbers of a
// scene by these gets the same scene, and the same picture, anywhere.
//
// Each is within 0.5001 units in the last place of the true value. So it is correctly rounded,
// unless that value is within a thousandth of a unit of the middle between two doubles. Special
// values (signed zeros, infinities, NaN) are those of the C standard, Annex F, but that NaN always
// is the same positive one.
#pragma once

namespace crt::elementary {

/// Returns the sine of x radians, for any x.
double sin(double x);
/// Returns the cosine of x radians, for any x.
double cos(double x);
/// Returns the tangent of x radians, for any x.
double tan(double x);

/// Returns the angle from -pi / 2 to pi / 2 whose sine is x, or NaN if |x| > 1.
double asin(double x);
/// Returns the angle from 0 to pi whose cosine is x, or NaN if |x| > 1.
double acos(double x);
/// Returns the angle from -pi / 2 to pi / 2 whose tangent is x.
double atan(double x);
/// Returns the angle of the point (x, y) from the x axis, from -pi to pi.
double atan2(double y, double x);

/// Returns e to the power of x.
double exp(double x);
/// Returns the natural logarithm of x, or NaN if x < 0.
double log(double x);
/// Returns the natural logarithm of 1 + x, or NaN if x < -1.
double log1p(double x);
/// Returns the logarithm of x to base 10, or NaN if x < 0.
double log10(double x);
/// Returns base to the power of exponent, or NaN if base < 0 and exponent is not whole.
double pow(double base, double exponent);

/// Returns the square root of x^2 + y^2, which does not overflow on its way.
double hypot(double x, double y);
/// Returns the square root of x^2 + y^2 + z^2, which does not overflow on its way.
double hypot(double x, double y, double z);

}  // namespace crt::elementary
