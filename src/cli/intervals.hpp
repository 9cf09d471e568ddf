// Numbers that are known to lie in intervals: what is computed of them, and how they are written.
#pragma once

#include <crt/measure.hpp>
#include <string>

namespace crt::cli {

// What these return surely holds the result.
Interval sum_of(const Interval& a, const Interval& b);
Interval product_of(const Interval& a, const Interval& b);
/// The divisor is above 0.
Interval quotient_of(const Interval& a, const Interval& divisor);

/// Returns a number with as many digits as its interval tells: the last one may be off by one. It
/// is "0" if it may be, and "?" without an upper end.
std::string number_text(const Interval& number);

/// Returns "between 1.99999 and 2.00001", rounded away from each other, with two digits more.
std::string bounds_text(const Interval& number);

/// Returns an end of a range to the place of the digit that `width` has, and two more, rounded up
/// or down.
std::string end_text(double end, double width, bool up);

}  // namespace crt::cli
