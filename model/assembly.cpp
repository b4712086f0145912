#include "model/assembly.hpp"

#include <algorithm>
#include <utility>

#include "model/build_compliant_walls.hpp"
#include "model/build_contact.hpp"

namespace arcwall {

void Assembly::add_contact(std::vector<Candidate> candidates, const ContactScales& scales, double stiffness_of_holds) {
  if (deck->walls.empty()) return;
  if (deck->contact.is_compliant()) {
    const auto mesh_of = [&](Index m) -> const MemberMesh& {
      return structure->members()[static_cast<std::size_t>(m)];
    };
    std::vector<CompliantContact::Wall> walls;
    for (CompliantWallOfMember& wall : compliant_walls(*deck, mesh_of)) walls.push_back(std::move(wall.contact));
    compliant = std::make_unique<CompliantContact>(*structure, std::move(walls), structure->length_scale());
    return;
  }
  const ContactLaw law{.method = deck->contact.method, .stiffness = deck->contact.penalty.value_or(0.0)};
  contact = std::make_unique<MultiplierContact>(system(), std::move(candidates), scales, law);
  if (!sliding_structure) return;
  ContactScales of_body = scales;
  of_body.slack = stiffness_of_holds * LooseHolds::farthest * structure->length_scale();
  sliding = std::make_unique<SlidingContact>(*sliding_structure, sliding_obstacles(*deck, *sliding_structure), of_body,
                                             deck->path.equilibrium_family);
}

void Assembly::add_body() {
  std::vector<Theory> theories;
  for (const deck::Member& member : deck->members) theories.push_back(member.theory);
  body = sliding_structure ? body_of(*structure, *sliding_structure)
                           : body_of(*structure, std::move(theories), increments.get());
  const auto& springs = structure->nodal_terms().law_springs();
  const auto has_kinks = [](const NodalTerms::LawSpring& spring) { return !spring.law->kinks().empty(); };
  if (increments || std::none_of(springs.begin(), springs.end(), has_kinks)) return;
  std::vector<KinkedSprings::Spring> with_kinks;
  for (const NodalTerms::LawSpring& spring : springs)
    with_kinks.push_back({.law = spring.law,
                          .first = spring.first ? body->motion(*spring.first) : nullptr,
                          .second = body->motion(spring.second)});
  kinked = std::make_unique<KinkedSprings>(system(), with_kinks);
}

const System& Assembly::system() const {
  if (kinked) return *kinked;
  if (sliding) return *sliding;
  if (contact) return *contact;
  if (compliant) return *compliant;
  if (increments) return *increments;
  return *structure;
}

const ContactQuery* Assembly::contacts() const {
  if (sliding) return sliding.get();
  if (compliant) return compliant.get();
  return contact.get();
}

State Assembly::start(double toward) const {
  if (sliding) return with_kinks(sliding->start(toward));
  State state{.x = {}, .lambda = 0.0, .active_set = {}};
  if (contact) state.active_set = contact->open_active_set();
  state.x = Vector::Zero(contact ? contact->size(state.active_set) : structure->size({}));
  if (compliant) state.active_set = compliant->touched_at(state);
  return with_kinks(std::move(state));
}

}  // namespace arcwall
