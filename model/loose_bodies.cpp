#include "model/loose_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "core/text.hpp"
#include "elements/mechanism.hpp"
#include "model/build_contact.hpp"
#include "model/build_structure.hpp"
#include "model/deck/key_list.hpp"

namespace arcwall {

namespace {

// How many members end at a node.
std::map<Index, int> ends_at_nodes(const Structure& structure) {
  std::map<Index, int> ends;
  for (const MemberMesh& mesh : structure.members()) {
    ++ends[mesh.nodes.front()];
    ++ends[mesh.nodes.back()];
  }
  return ends;
}

// Holds at those points, of the directions that are free.
LooseHolds holds_at(const StructureOfDeck& described, const Structure& structure, double stiffness,
                    const std::vector<Index>& nodes) {
  LooseHolds found;
  for (const auto& [name, node] : described.places.joints) {
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) continue;
    LooseHolds::Hold hold{.point = name};
    for (const NodeDirection& free : free_directions(structure, {node}))
      (free.freedom == Freedom::x ? hold.stiffness.x : hold.stiffness.z) = stiffness;
    if (hold.stiffness != deck::Stiffness{}) found.holds.push_back(std::move(hold));
  }
  return found;
}

// Where no load drives a body it stays to the digits by which the springs stand out of round-off.
double softness_for(const deck::Deck& deck) {
  constexpr double unloaded = 1e3;
  return deck.loads.empty() ? unloaded * LooseHolds::softness : LooseHolds::softness;
}

bool hold_all(deck::Deck deck, const LooseHolds& holds) {
  const std::vector<deck::Spring> springs = holds.springs();
  deck.springs.insert(deck.springs.end(), springs.begin(), springs.end());
  DeckProblems ignored(deck.source);
  return !find_mechanism(*describe_structure(deck, ignored, Mesh::coarsest).builder.build());
}

}  // namespace

std::vector<deck::Spring> LooseHolds::springs(double times) const {
  std::vector<deck::Spring> springs(holds.size());
  for (std::size_t i = 0; i < holds.size(); ++i) {
    auto& spring = springs[i].kind.emplace<deck::GroundSpring>();
    spring.at.name = holds[i].point;
    spring.stiffness = {.x = times * holds[i].stiffness.x, .z = times * holds[i].stiffness.z};
  }
  return springs;
}

std::string LooseHolds::warning(const deck::Units& units) const {
  std::string places;
  double stiffness = 0.0;
  for (const Hold& hold : holds) {
    const bool both = hold.stiffness.x > 0.0 && hold.stiffness.z > 0.0;
    places += (places.empty() ? "" : ", ") + hold.point + " in " +
              (both                     ? "x and z"
               : hold.stiffness.x > 0.0 ? "x"
                                        : "z");
    stiffness = std::max({stiffness, hold.stiffness.x, hold.stiffness.z});
  }
  return fmt::format(
      "no support holds the structure against moving as a whole, contact alone may: where neither contact "
      "nor a load says where it goes it is held where it is, by springs of {:.3g} {} at {}",
      stiffness, unit_text(deck::unit::line_load, units), places);
}

double softest_stiffness(const deck::Deck& deck, const Structure& structure) {
  double stiffness = infinity;
  for (std::size_t m = 0; m < deck.members.size(); ++m) {
    const deck::Member& member = deck.members[m];
    const deck::SectionProperties section = deck::properties(*deck::find(deck.sections, member.section));
    const double E = deck::find(deck.materials, member.material)->E, length = structure.members()[m].length;
    stiffness = std::min(stiffness, member.theory == Theory::truss ? E * section.A / length
                                                                   : 3.0 * E * section.I / (length * length * length));
  }
  return stiffness;
}

// Free ends of members are preferred: a spring at a joint in a row of members would be in the way of contact that
// slides along them.
LooseHolds loose_holds(const deck::Deck& deck) {
  const auto is_concerned = [&](const deck::Member& member) {
    return std::any_of(deck.walls.begin(), deck.walls.end(),
                       [&](const deck::Wall& wall) { return concerns(wall, member.name); });
  };
  if (deck.path.method == deck::PathMethod::incremental) return {};
  if (std::none_of(deck.members.begin(), deck.members.end(), is_concerned)) return {};
  DeckProblems ignored(deck.source);
  const StructureOfDeck described = describe_structure(deck, ignored, Mesh::coarsest);
  const auto structure = described.builder.build();
  const double stiffness = softness_for(deck) * softest_stiffness(deck, *structure);
  std::vector<Index> tips, all;
  for (const auto& [node, ends] : ends_at_nodes(*structure)) {
    all.push_back(node);
    if (ends == 1) tips.push_back(node);
  }
  for (const std::vector<Index>& nodes : {tips, all}) {
    LooseHolds holds = holds_at(described, *structure, stiffness, nodes);
    if (!holds.empty() && hold_all(deck, holds)) return holds;
  }
  return {};
}

}  // namespace arcwall
