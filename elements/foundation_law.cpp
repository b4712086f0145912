#include "elements/foundation_law.hpp"

#include <algorithm>

namespace arcwall {

void FoundationLaw::add_laws(const Vec2& u, Response& out) const {
  for (const Part& part : laws_) {
    const SpringLaw::Response of_law = part.law->at(u[part.direction]);
    out.energy += of_law.energy;
    out.force[part.direction] += of_law.force;
    out.stiffness[part.direction] += of_law.stiffness;
  }
}

bool operator==(const FoundationLaw& a, const FoundationLaw& b) {
  const auto same = [](const FoundationLaw::Part& one, const FoundationLaw::Part& other) {
    return one.direction == other.direction && *one.law == *other.law;
  };
  return a.stiffness_ == b.stiffness_ &&
         std::equal(a.laws_.begin(), a.laws_.end(), b.laws_.begin(), b.laws_.end(), same);
}

}  // namespace arcwall
