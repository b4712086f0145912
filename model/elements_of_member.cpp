#include "model/elements_of_member.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall {

namespace {

constexpr double relative_move = 1e-6;  // of a rotation [rad], and of a displacement over the structure's size

}  // namespace

Vector moves_alike(const Vector& weights) {
  const double nodes = static_cast<double>(weights.size()) / 3.0;
  Vector steps = Vector::Zero(weights.size());
  for (Index i = 0; i < weights.size(); ++i)
    if (weights[i] > 0.0) steps[i] = relative_move / std::sqrt(nodes * weights[i]);
  return steps;
}

Vector moves_alike(const SlidingStructure& structure, const State& state) {
  const SlidingMesh& mesh = mesh_of(state);
  Vector steps = Vector::Zero(state.x.size());
  steps.head(mesh.unknowns()) = moves_alike(mesh.metric().weights);
  for (Index k = 0; k < mesh.breakpoints(); ++k)
    steps[state.x.size() - mesh.breakpoints() + k] = relative_move * structure.length(mesh.breakpoint(k).first);
  return steps;
}

// --- fixed nodes ----------------------------------------------------------------------------------------------------

TiedElements::TiedElements(const TiedMember& member) : member_(member) {
  for (std::size_t m = 0; m < member.member; ++m)
    first_ += static_cast<Index>(member.structure.members()[m].nodes.size()) - 1;
}

void TiedElements::add_stretches(const State& state, Index element, std::vector<MemberStretch>& to) const {
  arcwall::add_stretches(member_, static_cast<int>(element), state, to);
}

std::vector<ElementsOfMember::Step> TiedElements::steps(const State&, Index element) const {
  const Structure& structure = member_.structure;
  const Vector alike = moves_alike(structure.weights({}));
  const ShiftedIndices dofs = structure.element_dofs(first_ + element);
  std::vector<Step> steps;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto unknown = structure.unknown(dofs[i]);
    if (!unknown) continue;
    // Changes of thickness, which have no weight, are strains, and strains over a length.
    const bool by_length = structure.meaning(*unknown).dof == Dof::thickness2;
    const double strain = by_length ? relative_move / structure.length_scale() : relative_move;
    steps.push_back({.unknown = *unknown, .size = alike[*unknown] > 0.0 ? alike[*unknown] : strain});
  }
  return steps;
}

// --- a mesh that slides ---------------------------------------------------------------------------------------------

SlidingElements::SlidingElements(const SlidingStructure& structure, const std::string& member)
    : structure_(structure), parts_(structure.parts_of(member)) {}

Index SlidingElements::elements(const State& state) const {
  Index sum = 0;
  for (const SlidingStructure::MemberPart& part : parts_) sum += mesh_of(state).nodes(part.strand) - 1;
  return sum;
}

// In the order of the member, by its fractions; those of a strand's elements that belong to other members reach beyond
// its ends.
void SlidingElements::add_stretches(const State& state, Index element, std::vector<MemberStretch>& to) const {
  const SlidingMesh& mesh = mesh_of(state);
  for (const SlidingStructure::MemberPart& part : parts_) {
    const Index here = mesh.nodes(part.strand) - 1;
    if (element >= here) {
      element -= here;
      continue;
    }
    const Index position = part.is_reversed() ? here - 1 - element : element;
    const auto first = static_cast<std::ptrdiff_t>(to.size());
    add_sliding_stretches(structure_, part.strand, position, state, to);
    const double rate = (part.last_fraction - part.first_fraction) / (part.to - part.from);
    for (auto stretch = to.begin() + first; stretch != to.end(); ++stretch) {
      stretch->from = part.first_fraction + rate * (stretch->from - part.from);
      stretch->to = part.first_fraction + rate * (stretch->to - part.from);
      if (part.is_reversed()) *stretch = stretch->reversed();
    }
    if (part.is_reversed()) std::reverse(to.begin() + first, to.end());
    return;
  }
}

std::vector<ElementsOfMember::Step> SlidingElements::steps(const State& state, Index) const {
  const Vector alike = moves_alike(structure_, state);
  std::vector<Step> steps;
  for (Index i = 0; i < alike.size(); ++i)
    if (alike[i] > 0.0) steps.push_back({.unknown = i, .size = alike[i]});
  return steps;
}

}  // namespace arcwall
