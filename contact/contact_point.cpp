#include "contact/contact_point.hpp"

#include <cmath>

#include "core/text.hpp"

namespace arcwall {

std::string words_of(const ContactLabel& label) {
  constexpr double shown = 1e4;  // parts of the member
  const std::string place = label.member + ":" + round_trip(std::round(shown * label.fraction) / shown);
  return label.wall.empty() ? place : label.wall + " at " + place;
}

}  // namespace arcwall
