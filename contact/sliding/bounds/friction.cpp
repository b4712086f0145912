#include "contact/sliding/bounds/friction.hpp"

#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/rubbing.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

// A slip forward has T = −μ p.
double FrictionBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  if (!at.rubs(contact_)) return 1.0;
  const double most = friction_coefficient(setting, at.layout, contact_) * at.force(contact_);
  return (most + slip_sense(beyond_) * at.state.x[*at.index.friction(contact_)]) / setting.scales.force;
}

Row FrictionBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  if (!at.rubs(contact_)) return row;
  row.dx[*at.index.force(contact_)] = friction_coefficient(setting, at.layout, contact_) / setting.scales.force;
  row.dx[*at.index.friction(contact_)] = slip_sense(beyond_) / setting.scales.force;
  return row;
}

BoundPlace FrictionBound::place(const SlidingSetting& setting, const SlidingState& at) const {
  const Touch touch = touch_of_contact(setting, at.layout, contact_);
  const double s = at.mesh.coordinate(touch.strand, touch.position, at.now.s);
  return {.at = {.strand = touch.strand, .s = s}, .obstacle = touch.obstacle};
}

namespace {

// The way over which the trapezoidal rule of (18.10) is taken, over the length of the strand: its error is of order 2.
constexpr double longest_roll = 5e-4;

bool sticks(const SlidingState& at, std::size_t point) {
  return at.rubs(point) && at.layout.points()[point].rubbing.mode == ContactMode::sticks;
}

double part_rolled(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const auto k = static_cast<Index>(point);
  const double length = longest_roll * setting.body.length(at.mesh.breakpoint(k).first);
  return (at.s(k) - at.layout.points()[point].rubbing.s) / length;
}

}  // namespace

double RollingBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const double part = part_rolled(setting, at, point_);
  return 1.0 - part * part;
}

Row RollingBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  const auto k = static_cast<Index>(point_);
  const double length = longest_roll * setting.body.length(at.mesh.breakpoint(k).first);
  row.dx[at.index.coordinate(k)] = -2.0 * part_rolled(setting, at, point_) / length;
  return row;
}

// All that stick together get new anchors: as points do that roll alike.
std::vector<Transition> RollingBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                  const Arrival& arrival) const {
  std::vector<SlidingContactLayout::Rubbing> anew;
  for (std::size_t k = 0; k < at.layout.points().size(); ++k)
    anew.push_back(sticks(at, k) ? anchored_anew(setting, at, k) : at.layout.points()[k].rubbing);
  return {remeshed(setting, at, arrival.forward, [&anew](LayoutEdit& edit, const SlidingState&) {
    for (std::size_t k = 0; k < anew.size(); ++k) edit.points[k].rubbing = anew[k];
  })};
}

}  // namespace arcwall::sliding
