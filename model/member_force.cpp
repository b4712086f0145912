#include "model/member_force.hpp"

#include <algorithm>
#include <cmath>

#include "model/elements_of_member.hpp"

namespace arcwall {

double MemberForce::value(const State& state) const {
  const ShapePoint at = place(state);
  return what_ == What::axial_force ? at.axial_force : at.moment;
}

DifferencedObservable::Differences MemberForce::differences_at(const State& state) const {
  return {.steps = steps(state), .value = [this](const State& moved) { return value(moved); }};
}

ShapePoint TiedMemberForce::place(const State& state) const {
  const int elements = member_.elements();
  const int before = std::clamp(static_cast<int>(std::lround(fraction_ * elements)) - 1, 0, elements - 1);
  std::vector<MemberStretch> stretches;
  add_stretches(member_, before, state, stretches);
  return (fraction_ > stretches.front().from ? stretches.back() : stretches.front()).at(fraction_);
}

Vector TiedMemberForce::steps(const State& state) const {
  Vector steps = Vector::Zero(state.x.size());
  const Vector weights = member_.structure.weights({});
  steps.head(weights.size()) = moves_alike(weights);
  return steps;
}

SlidingMemberForce::SlidingMemberForce(const SlidingStructure& structure, const std::string& member, double fraction,
                                       What what)
    : MemberForce(what), structure_(structure) {
  constexpr double same = 1e-12;
  for (const SlidingStructure::MemberPart& part : structure.parts_of(member)) {
    const double t = (fraction - part.first_fraction) / (part.last_fraction - part.first_fraction);
    at_ = {.strand = part.strand, .s = part.from + std::clamp(t, 0.0, 1.0) * (part.to - part.from)};
    is_reversed_ = part.is_reversed();
    begin_ = is_reversed_ ? part.to : part.from;
    if (fraction <= part.greatest_fraction() + same) break;
  }
}

// In the element that ends there as the member travels; at the member's beginning, in its first.
ShapePoint SlidingMemberForce::place(const State& state) const {
  const SlidingMesh& mesh = mesh_of(state);
  const Vector s = state.x.tail(mesh.breakpoints());
  const double same = 1e-12 * structure_.length(at_.strand);
  const auto node = [&](Index position) { return mesh.coordinate(at_.strand, position, s); };
  if (is_reversed_) {
    Index position = mesh.nodes(at_.strand) - 2;
    while (position > 0 && (node(position) > at_.s + same || node(position) >= begin_ - same)) --position;
    return place_in(position, state);
  }
  Index position = 0;
  const auto end = [&] { return node(position + 1); };
  while (position + 2 < mesh.nodes(at_.strand) && (end() < at_.s - same || end() <= begin_ + same)) ++position;
  return place_in(position, state);
}

// Before a point load that acts there, as the member travels.
ShapePoint SlidingMemberForce::place_in(Index element, const State& state) const {
  std::vector<MemberStretch> stretches;
  add_sliding_stretches(structure_, at_.strand, element, state, stretches);
  if (is_reversed_) {
    const auto ends_there = [&](const MemberStretch& stretch) { return stretch.from <= at_.s; };
    const auto found = std::find_if(stretches.rbegin(), stretches.rend(), ends_there);
    return (found != stretches.rend() ? *found : stretches.front()).reversed().at(at_.s);
  }
  const auto ends_there = [&](const MemberStretch& stretch) { return stretch.to >= at_.s; };
  const auto found = std::find_if(stretches.begin(), stretches.end(), ends_there);
  return (found != stretches.end() ? *found : stretches.back()).at(at_.s);
}

Vector SlidingMemberForce::steps(const State& state) const { return moves_alike(structure_, state); }

}  // namespace arcwall
