#include <algorithm>
#include <utility>

#include "elements/foundation_law.hpp"
#include "model/monitored.hpp"

namespace arcwall {

namespace {

double moment_at(const MemberStretch& stretch, double xi) { return stretch.moment(xi); }

// What a foundation exerts per length where the axis has moved so far from its stress-free place: with its sign where
// it acts in one direction.
SectionQuantity pressure_of(const deck::Foundation& foundation) {
  FoundationLaw law(Vec2(foundation.x, foundation.z));
  if (foundation.law)
    law.add(foundation.law->direction == Dof::x ? 0 : 1, std::make_shared<const SpringLaw>(foundation.law->law()));
  const auto acts = [&](Dof direction, double stiffness) {
    return stiffness > 0.0 || (foundation.law && foundation.law->direction == direction);
  };
  const bool in_both = acts(Dof::x, foundation.x) && acts(Dof::z, foundation.z);
  return [law = std::move(law), in_both](const MemberStretch& stretch, double xi) {
    const Vec2 force = law.at(stretch.now.position(xi) - stretch.rest.position(xi)).force;
    return in_both ? force.norm() : force.sum();
  };
}

// What forces and moments contribute to the stress in an outer fibre.
struct OuterFibre {
  double by_force, by_moment;
};

OuterFibre outer_fibre(const deck::Section& section, double fraction, double unit) {
  const deck::SectionProperties at = properties(section, fraction);
  return {.by_force = 1.0 / (at.A * unit), .by_moment = 0.5 * at.height.value_or(0.0) / (at.I * unit)};
}

// The stresses N/A ± M h/2I in both outer fibres, over what a stress of 1 counts.
AlongMember stresses_in(const deck::Deck& deck, const Measured& from, const deck::Member& member, double unit) {
  const deck::Section& section = *deck::find(deck.sections, member.section);
  const OuterFibre middle = outer_fibre(section, 0.5, unit);
  const double force = from.structure.force_roundoff(), moment = force * from.structure.length_scale();
  const auto* const table = std::get_if<deck::SectionTable>(&section.shape);
  AlongMember along{.member = member.name,
                    .of = {.kinks = table != nullptr ? table->at : std::vector<double>{},
                           .negligible = middle.by_force * force + middle.by_moment * moment}};
  const auto fibre_at = [section, middle, unit, tapers = tapers(section)](const MemberStretch& at, double xi) {
    return tapers ? outer_fibre(section, std::clamp(at.from + xi * (at.to - at.from), 0.0, 1.0), unit) : middle;
  };
  if (member.theory == Theory::truss) {
    along.of.quantities.emplace_back(
        [=](const MemberStretch& at, double xi) { return middle.by_force * at.axial_force(xi); });
    return along;
  }
  for (const double side : {1.0, -1.0})
    along.of.quantities.emplace_back([=](const MemberStretch& at, double xi) {
      const OuterFibre fibre = fibre_at(at, xi);
      return fibre.by_force * at.axial_force(xi) + side * fibre.by_moment * at.moment(xi);
    });
  return along;
}

}  // namespace

std::vector<AlongMember> along_members(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor) {
  if (monitor.component == deck::Component::max_moment)
    return {{.member = monitor.member,
             .of = {.quantities = {moment_at},
                    .negligible = from.structure.force_roundoff() * from.structure.length_scale()}}};
  if (is_pressure(monitor.component)) {
    const auto& foundation = std::get<deck::Foundation>(deck::find(deck.springs, monitor.spring)->kind);
    return {{.member = foundation.member, .of = {.quantities = {pressure_of(foundation)}}}};
  }
  std::vector<AlongMember> members;
  for (const deck::Member& member : deck.members) {
    if (!monitor.member.empty() && member.name != monitor.member) continue;
    const deck::Material& material = *deck::find(deck.materials, member.material);
    const bool stress = monitor.component == deck::Component::max_stress;
    members.push_back(stresses_in(deck, from, member, stress ? 1.0 : *material.allowable));
  }
  return members;
}

std::shared_ptr<const Observable> greatest(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
                                           OfGreatest what) {
  const auto which = monitor.component == deck::Component::least_pressure ? MemberExtreme::Which::least
                                                                          : MemberExtreme::Which::greatest;
  std::vector<std::shared_ptr<const Observable>> values, shown;
  for (const AlongMember& along : along_members(deck, from, monitor)) {
    const std::size_t member = from.member_index(along.member);
    const auto elements = from.body.elements(member);
    if (!elements) return nullptr;
    const auto of = [&](MemberExtreme::What part) -> std::shared_ptr<const Observable> {
      return std::make_shared<MemberExtreme>(elements, along.of, which, part);
    };
    values.push_back(of(MemberExtreme::What::value));
    shown.push_back(what == OfGreatest::value   ? values.back()
                    : what == OfGreatest::place ? of(MemberExtreme::What::place)
                                                : std::make_shared<ConstantValue>(double(member)));
  }
  if (values.size() == 1) return shown.front();
  return std::make_shared<GreatestOfMembers>(std::move(values), std::move(shown));
}

std::shared_ptr<const Observable> mean(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor) {
  const AlongMember along = along_members(deck, from, monitor).front();
  auto elements = from.body.elements(from.member_index(along.member));
  return elements ? std::make_shared<MemberMean>(std::move(elements), along.of.quantities.front()) : nullptr;
}

}  // namespace arcwall
