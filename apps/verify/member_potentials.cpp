#include "apps/verify/line_energy.hpp"
#include "apps/verify/potential_rooms.hpp"

namespace arcwall::verify {

namespace {

// What a potential of an element is by: its unknowns, and its degrees of freedom, which are returned.
Vector values_on_element(const Structure& structure, Index e, const State& state, const Rates& rates,
                         Potential& potential) {
  const auto dofs = structure.element_dofs(e);
  Vector u(static_cast<Index>(dofs.size()));
  potential.rates = Vector::Zero(u.size());
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto local = static_cast<Index>(i);
    u[local] = structure.value(state, dofs[i]);
    potential.rates[local] = rate_of(rates, dofs[i]);
    potential.unknowns.push_back(structure.unknown(dofs[i]).value_or(-1));
  }
  return u;
}

// An element between two nodes of a member, with what is along it.
class FixedElement {
 public:
  FixedElement(const PlainMembers& members, std::size_t m, std::size_t k, double lambda, const Vec2& origin)
      : members_(members), m_(m), k_(k), lambda_(lambda), origin_(origin) {}

  LocalEnergy energy(const Vector& u) const {
    switch (member().in_deck().theory) {
      case Theory::truss:
        return of_bar(u);
      case Theory::euler_bernoulli:
      case Theory::elastica:
        return of_slender_beam(u);
      case Theory::reissner:
      case Theory::essenburg:
        return of_interpolated_beam(u);
    }
    return LocalEnergy(u.size());
  }

 private:
  const PlainMember& member() const { return members_[m_]; }
  double first() const { return double(k_) / member().in_deck().elements; }
  double last() const { return double(k_ + 1) / member().in_deck().elements; }
  FreeDeformation free() const { return member().free(lambda_); }
  AlongElement along() const {
    const double L = member().length();
    return {.member = member(), .from = first() * L, .to = last() * L, .lambda = lambda_};
  }

  LocalEnergy of_bar(const Vector& u) const {
    const Vec2 chord = members_.stretches(m_)[k_].chord;
    LocalEnergy sum = bar_energy(chord, member().stiffness(0.5).EA, member().in_deck().strain, free().strain, u);
    if (!along().is_bare()) sum += line_energy(along(), chord, u);
    return sum;
  }
  LocalEnergy of_slender_beam(const Vector& u) const {
    const SlenderElement element{.stretch = members_.stretches(m_)[k_],
                                 .angle = member().axis_angle(),
                                 .section = member().section_between(first(), last()),
                                 .free = free()};
    const EndsMotion motion{.first = u.head<2>(), .second = u.segment<2>(3), .turn1 = u[2], .turn2 = u[5]};
    LocalEnergy sum = slender_energy(element, motion);
    if (!along().is_bare()) sum += line_energy(along(), element.stretch, motion, member().place(first()) - origin_);
    return sum;
  }
  LocalEnergy of_interpolated_beam(const Vector& u) const {
    const NodesAlong& nodes = members_.nodes(m_)[k_];
    LocalEnergy sum =
        member().in_deck().theory == Theory::reissner
            ? reissner_energy(nodes, member().section_between(first(), last()), free(), u)
            : essenburg_energy(nodes.places, members_.directors(m_)[k_], member().essenburg_material(), u);
    if (!along().is_bare()) sum += line_energy(along(), nodes, u, member().place(first()) - origin_);
    return sum;
  }

  const PlainMembers& members_;
  std::size_t m_, k_;
  double lambda_;
  Vec2 origin_;
};

}  // namespace

std::vector<Potential> fixed_potentials(const Model& model, const PlainMembers& members, const State& state) {
  const Structure& structure = model.structure();
  const Rates rates = rates_of_supports(structure);
  const Vec2 origin = origin_of_areas(structure);
  std::vector<Potential> all;
  for (std::size_t m = 0; m < structure.members().size(); ++m)
    for (std::size_t k = 0; k + 1 < structure.members()[m].nodes.size(); ++k) {
      Potential potential;
      const Vector u = values_on_element(structure, static_cast<Index>(all.size()), state, rates, potential);
      static_cast<LocalEnergy&>(potential) = FixedElement(members, m, k, state.lambda, origin).energy(u);
      all.push_back(std::move(potential));
    }
  return all;
}

void add_compliant_walls(const Model& model, const State& state, std::vector<Potential>& to) {
  const Structure& structure = model.structure();
  const Rates rates = rates_of_supports(structure);
  for (const Structure::ElementLoad& load : structure.element_loads()) {
    if (!load.wall || !load.acts_on(state)) continue;
    Potential potential;
    const Vector u = values_on_element(structure, load.element, state, rates, potential);
    potential.gradient = Vector(u.size());
    Matrix K(u.size(), u.size());
    potential.energy =
        load.potential->evaluate_at(u.data(), state.lambda, potential.gradient.data(), K.data(), nullptr);
    potential.stiffness = K.selfadjointView<Eigen::Lower>();
    to.push_back(std::move(potential));
  }
  const CompliantContact* const contact = model.compliant();
  if (contact == nullptr || contact->elastic_friction() == nullptr) return;
  for (CompliantFriction::OnElement& on : contact->elastic_friction()->on_elements(state)) {
    Potential potential;
    values_on_element(structure, on.element, state, rates, potential);
    potential.energy = on.energy;
    potential.gradient = std::move(on.gradient);
    potential.stiffness = std::move(on.stiffness);
    to.push_back(std::move(potential));
  }
}

}  // namespace arcwall::verify
