#pragma once

#include <string>

namespace arcwall {

/// `%.{digits}g` without −0.
std::string shown_number(double value, int digits);

/// A number of which ± `half_width` is left uncertain, in at most `digits` digits and none that is not sure: what is
/// uncertain is at most half a unit of the last one. Where it is more than 1e-6 of the number it is said, to one digit
/// and upwards, so that the number lies within what is said: `1.04 ± 0.03`, `(1.04 ± 0.03)e+12`, `0 ± 2e-13`.
std::string shown_uncertain(double value, double half_width, int digits);

/// Whether shown_uncertain() says what is uncertain.
bool is_marked_uncertain(double value, double half_width);

}  // namespace arcwall
