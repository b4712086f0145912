#include "contact/sliding/bounds/tip_presses.hpp"

#include <vector>

#include "contact/sliding/tips.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

constexpr double off_its_obstacle = -1.0;  // value where the tip does not touch and the part is pressed up to it
constexpr double round_off = 1e-9;         // of the force scale

}  // namespace

double TipPressesBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const auto contact = pressed_contact(setting, at, end());
  if (!contact) return off_its_obstacle;
  const double carried = carried_at_end(setting, at, setting.free_ends[*contact].seen_from(end()));
  const double hardly_lifts = setting.scales.slack / setting.scales.force + round_off;
  return (at.force(at.layout.points().size() + *contact) - carried) / setting.scales.force + hardly_lifts;
}

// What the last element carries changes with its nodes, with λ, and with where the points of its strand are, which
// stretch its mesh; all that by differences.
Row TipPressesBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  constexpr double step = 1e-6;  // of the length, of an angle; of λ 1, by which loads are linear
  Row row = at.no_slope();
  const auto contact = pressed_contact(setting, at, end());
  if (!contact) return row;
  row.dx[at.index.force(at.layout.points().size() + *contact).value()] = 1.0 / setting.scales.force;

  const FreeEnd tip = setting.free_ends[*contact].seen_from(end());
  const auto carried_with = [&](const auto& change, double by) {
    State there = at.state;
    change(there, by);
    return carried_at_end(setting, SlidingState(there), tip) / setting.scales.force;
  };
  const auto rate_of_carried = [&](const auto& change, double by) {
    return (carried_with(change, by) - carried_with(change, -by)) / (2.0 * by);
  };
  const auto subtract = [&](Index unknown, double by) {
    row.dx[unknown] -= rate_of_carried([unknown](State& there, double d) { there.x[unknown] += d; }, by);
  };
  const double length = setting.body.length(strand_);
  const Index last_position = tip.position(at.mesh), inner = last_ ? last_position - 1 : last_position + 1;
  for (const Index position : {last_position, inner}) {
    const NodeUnknowns unknowns = at.mesh.node_unknowns(strand_, position);
    for (std::size_t i = 0; i < 3; ++i)
      if (unknowns[i] >= 0) subtract(unknowns[i], i < 2 ? step * length : step);
  }
  for (std::size_t k = 0; k < at.layout.points().size(); ++k)
    if (at.mesh.breakpoint(static_cast<Index>(k)).first == strand_)
      subtract(at.index.coordinate(static_cast<Index>(k)), step * length);
  row.dlambda = -rate_of_carried([](State& there, double d) { there.lambda += d; }, 1.0);
  return row;
}

std::vector<Transition> TipPressesBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                     const Arrival& arrival) const {
  std::vector<StrandEnd> lifted;
  for (const TipPressesBound* bound : reached<TipPressesBound>(setting, at, arrival))
    if (bound->end().strand == strand_) lifted.push_back(bound->end());
  return peel_off_from_tips(setting, at, lifted, true);
}

}  // namespace arcwall::sliding
