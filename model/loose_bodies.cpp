#include "model/loose_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/algebra/bordered_solver.hpp"
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

// A node, as a deck names it.
struct NodePlace {
  deck::Place at{};
  Index node = 0;
};

std::vector<NodePlace> joints_at(const StructureOfDeck& described, const std::vector<Index>& nodes) {
  std::vector<NodePlace> joints;
  for (const auto& [name, node] : described.places.joints)
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end())
      joints.push_back({.at = {.name = name}, .node = node});
  return joints;
}

std::vector<Index> nodes_of(const std::vector<NodePlace>& places) {
  std::vector<Index> nodes;
  for (const NodePlace& place : places) nodes.push_back(place.node);
  return nodes;
}

// Springs in those directions of nodes.
LooseHolds holds_in(const std::vector<NodeDirection>& directions, const std::vector<NodePlace>& places,
                    double stiffness) {
  LooseHolds found;
  for (const NodePlace& place : places) {
    LooseHolds::Hold hold{.at = place.at};
    for (const NodeDirection& held : directions)
      if (held.node == place.node) (held.dof == Dof::x ? hold.stiffness.x : hold.stiffness.z) = stiffness;
    if (hold.stiffness != deck::Stiffness{}) found.holds.push_back(std::move(hold));
  }
  return found;
}

// The stiffness of a body against what moves places in these directions while some of them, as few as hold it, stay
// [force/length]: infinite if there are no others, 0 where nothing resists at first.
double stiffness_between(const StructureOfDeck& described, const std::vector<NodeDirection>& directions,
                         const std::vector<NodeDirection>& held) {
  StructureBuilder builder = described.builder;
  for (const NodeDirection& one : held) builder.fix(builder.dof(one.node, one.dof));
  const auto structure = builder.build();
  std::vector<Index> moved;
  for (const NodeDirection& one : directions)
    if (const auto unknown = structure->unknown(structure->dof(one.node, one.dof))) moved.push_back(*unknown);
  if (moved.empty()) return infinity;
  Linearization at_rest;
  structure->linearize({.x = Vector::Zero(structure->size({})), .lambda = 0.0}, at_rest);
  BorderedSolver solver;
  if (solver.factorize(at_rest, 0) != FactorStatus::ok) return 0.0;
  double squared = 0.0;
  for (const Index one : moved) {
    Matrix column = Vector::Unit(structure->size({}), one);
    if (!solver.solve_inner(column)) return 0.0;
    for (const Index other : moved) squared += column(other, 0) * column(other, 0);
  }
  return 1.0 / std::sqrt(squared);
}

// Springs at those places in all directions that move, which keep what is symmetric so, soft beside the softest member
// and beside the body as a whole. Where nothing resists at first, in as few directions as hold the body.
LooseHolds holds_at(const StructureOfDeck& described, const std::vector<NodePlace>& places, double softness,
                    double softest_member) {
  const auto structure = described.builder.build();
  const FreeDirections free = free_directions(*structure, nodes_of(places));
  const double body = stiffness_between(described, free.all, free.fewest);
  return body > 0.0 ? holds_in(free.all, places, softness * std::min(softest_member, body))
                    : holds_in(free.fewest, places, softness * softest_member);
}

// A joint or a node of a member, and how far it is from the walls that concern the member [length].
struct FreePlace {
  NodePlace at{};
  Vec2 place = Vec2::Zero();
  double clearance = infinity;
};

std::vector<FreePlace> free_places(const deck::Deck& deck, const StructureOfDeck& described) {
  std::vector<FreePlace> places;
  for (const deck::Member& member : deck.members) {
    const MemberMesh& mesh = described.builder.mesh(described.places.members.at(member.name));
    std::vector<std::shared_ptr<const Obstacle>> obstacles;
    for (const deck::Wall& wall : deck.walls)
      if (concerns(wall, member.name)) obstacles.push_back(obstacle_of(wall));
    const std::size_t last = mesh.nodes.size() - 1;
    for (std::size_t k = 0; k <= last; ++k) {
      FreePlace& free = places.emplace_back();
      free.at = {.at = {.name = k == 0 ? member.from : k == last ? member.to : member.name}, .node = mesh.nodes[k]};
      if (k > 0 && k < last) free.at.at.fraction = mesh.fraction(k);
      free.place = mesh.shape[k].position;
      for (const auto& obstacle : obstacles)
        free.clearance = std::min(free.clearance, obstacle->gap_slope(free.place, 0.0).value);
    }
  }
  return places;
}

// Holds at two places from which contact, which may come anywhere along members, is far: the farthest from the walls,
// and of those that are at least half as far the one that is farthest from it.
LooseHolds holds_far_from_walls(const deck::Deck& deck, double softness, double softest_member) {
  DeckProblems ignored(deck.source);
  const StructureOfDeck described = describe_structure(deck, ignored);
  const std::vector<FreePlace> places = free_places(deck, described);
  const auto& first = *std::max_element(
      places.begin(), places.end(), [](const FreePlace& a, const FreePlace& b) { return a.clearance < b.clearance; });
  const FreePlace* second = &first;
  for (const FreePlace& place : places)
    if (place.clearance >= 0.5 * first.clearance &&
        (place.place - first.place).norm() > (second->place - first.place).norm())
      second = &place;
  return holds_at(described, {first.at, second->at}, softness, softest_member);
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

LooseHolds LooseHolds::with_stiffness(double stiffest) const {
  const double times = stiffest / stiffness();
  LooseHolds scaled = *this;
  for (Hold& hold : scaled.holds) hold.stiffness = {.x = times * hold.stiffness.x, .z = times * hold.stiffness.z};
  return scaled;
}

std::vector<deck::Spring> LooseHolds::springs() const {
  std::vector<deck::Spring> springs(holds.size());
  for (std::size_t i = 0; i < holds.size(); ++i) {
    auto& spring = springs[i].kind.emplace<deck::GroundSpring>();
    spring.at = holds[i].at;
    spring.stiffness = holds[i].stiffness;
  }
  return springs;
}

double LooseHolds::stiffness() const {
  double stiffness = 0.0;
  for (const Hold& hold : holds) stiffness = std::max({stiffness, hold.stiffness.x, hold.stiffness.z});
  return stiffness;
}

std::string LooseHolds::warning(const deck::Deck& deck) const {
  std::string places;
  for (const Hold& hold : holds) {
    const bool both = hold.stiffness.x > 0.0 && hold.stiffness.z > 0.0;
    places += (places.empty() ? "" : ", ") + to_text(hold.at) + " in " +
              (both                     ? "x and z"
               : hold.stiffness.x > 0.0 ? "x"
                                        : "z");
  }
  return fmt::format(
      "the supports leave rigid-body motions free, and only contact can restrain them: stabilising springs of {:.3g} "
      "{} "
      "at {} were added",
      deck.frame.factor(-1) * stiffness(), unit_text(deck::unit::line_load, deck.units), places);
}

double softest_stiffness(const deck::Deck& deck, const Structure& structure) {
  double stiffness = infinity;
  for (std::size_t m = 0; m < deck.members.size(); ++m) {
    const deck::Member& member = deck.members[m];
    const double E = deck::find(deck.materials, member.material)->E, length = structure.members()[m].length;
    for (const double end : {0.0, 1.0}) {  // of a section that tapers
      const deck::SectionProperties section = deck::properties(*deck::find(deck.sections, member.section), end);
      stiffness =
          std::min(stiffness, member.theory == Theory::truss ? E * section.A / length
                                                             : 3.0 * E * section.I / (length * length * length));
    }
  }
  return stiffness;
}

Vec2 constant_resultant(const deck::Deck& deck) {
  deck::Deck loads = deck;
  loads.prescribed.clear();
  DeckProblems ignored(deck.source);
  const auto structure = describe_structure(loads, ignored, Mesh::coarsest).builder.build(true);
  Linearization at_rest;
  structure->linearize({.x = Vector::Zero(structure->size({})), .lambda = 0.0}, at_rest);
  Vec2 sum = Vec2::Zero();
  for (Index i = 0; i < at_rest.F_lambda.size(); ++i) {
    const Dof which = structure->meaning(i).dof;
    if (which == Dof::x) sum.x() -= at_rest.F_lambda[i];
    if (which == Dof::z) sum.y() -= at_rest.F_lambda[i];
  }
  return sum;
}

// Free ends of members are preferred: a spring in a row of members is in the way of contact that slides along them.
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
  const double softness = softness_for(deck), softest = softest_stiffness(deck, *structure);
  std::vector<Index> tips, all;
  for (const auto& [node, ends] : ends_at_nodes(*structure)) {
    all.push_back(node);
    if (ends == 1) tips.push_back(node);
  }
  const auto holds = [&](const LooseHolds& found) { return !found.empty() && hold_all(deck, found); };
  const auto at_nodes = [&](const std::vector<Index>& nodes) {
    return holds_at(described, joints_at(described, nodes), softness, softest);
  };
  if (LooseHolds found = at_nodes(tips); holds(found)) return found;
  if (tips.empty())
    if (LooseHolds found = holds_far_from_walls(deck, softness, softest); holds(found)) return found;
  if (LooseHolds found = at_nodes(all); holds(found)) return found;
  return {};
}

LooseHolds holds_until_stiffened(const deck::Deck& deck) {
  const auto constant = [](const auto& driven) { return driven.constant; };
  if (std::none_of(deck.loads.begin(), deck.loads.end(), constant) &&
      std::none_of(deck.prescribed.begin(), deck.prescribed.end(), constant))
    return {};
  DeckProblems ignored(deck.source);
  const StructureOfDeck described = describe_structure(deck, ignored, Mesh::coarsest);
  const auto structure = described.builder.build();
  std::vector<Index> joints;
  for (const auto& [name, node] : described.places.joints) joints.push_back(node);
  const double stiffness = LooseHolds::softness * softest_stiffness(deck, *structure);
  const LooseHolds found = holds_in(free_directions(*structure, joints).all, joints_at(described, joints), stiffness);
  return !found.empty() && hold_all(deck, found) ? found : LooseHolds{};
}

}  // namespace arcwall
