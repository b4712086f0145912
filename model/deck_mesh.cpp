#include "model/deck_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "core/turns.hpp"

namespace arcwall {

namespace {

using Span = SlidingContactLayout::Span;

// --- the shape of a strand, by the nodes of the deck's mesh ---------------------------------------------------------

// How a place of a strand has moved.
struct MovedPlace {
  double s = 0.0;
  Vec2 moved = Vec2::Zero();
  double turned = 0.0;
  double angle = 0.0;         // of the axis' tangent, as far as sections stay normal to it
  Vec2 slope = Vec2::Zero();  // of `moved` by s, if the axis keeps its length
};

// Cubic between two places, by their slopes.
MovedPlace between(const MovedPlace& a, const MovedPlace& b, double s) {
  const double h = b.s - a.s, t = (s - a.s) / h, u = 1.0 - t;
  MovedPlace place{.s = s};
  place.moved =
      u * u * (1.0 + 2.0 * t) * a.moved + t * t * (3.0 - 2.0 * t) * b.moved + h * t * u * (u * a.slope - t * b.slope);
  place.turned = u * a.turned + t * b.turned;
  return place;
}

using MovedStrand = std::vector<MovedPlace>;

MovedPlace at(const MovedStrand& strand, double s) {
  const auto behind = std::lower_bound(strand.begin(), strand.end(), s,
                                       [](const MovedPlace& place, double there) { return place.s < there; });
  if (behind == strand.begin()) return strand.front();
  if (behind == strand.end()) return strand.back();
  return between(*(behind - 1), *behind, s);
}

std::vector<MovedStrand> moved_strands(const Assembly& of, const State& deck_state) {
  const Structure& structure = *of.structure;
  const SlidingStructure& sliding = *of.sliding_structure;
  std::vector<MovedStrand> strands(static_cast<std::size_t>(sliding.strands()));
  for (const MemberMesh& member : structure.members()) {
    for (std::size_t k = 0; k < member.nodes.size(); ++k) {
      const MaterialPoint point = sliding.find(member.name, member.fraction(k));
      const auto value = [&](Index dof) { return structure.value(deck_state, dof); };
      MovedPlace place{.s = point.s};
      place.moved = {value(structure.dof(member.nodes[k], Dof::x)), value(structure.dof(member.nodes[k], Dof::z))};
      if (member.rotations[k]) place.turned = value(*member.rotations[k]);
      const double angle = sliding.undeformed(point, true).angle;
      place.angle = angle + place.turned;
      place.slope = {std::cos(place.angle) - std::cos(angle), std::sin(place.angle) - std::sin(angle)};
      strands[static_cast<std::size_t>(point.strand)].push_back(place);
    }
  }
  for (MovedStrand& strand : strands) {
    std::sort(strand.begin(), strand.end(), [](const MovedPlace& a, const MovedPlace& b) { return a.s < b.s; });
    const double roundoff = 1e-12 * strand.back().s;
    const auto same = [&](const MovedPlace& a, const MovedPlace& b) { return std::abs(a.s - b.s) <= roundoff; };
    strand.erase(std::unique(strand.begin(), strand.end(), same), strand.end());
  }
  return strands;
}

// Moved so, without contact, on the mesh that contact which slides begins with.
State open_shape(const SlidingContact& sliding, const std::vector<MovedStrand>& strands, double lambda) {
  const State rest = sliding.rest();
  const SlidingMesh& mesh = mesh_of(rest);
  State open = rest;
  open.lambda = lambda;
  for (Index strand = 0; strand < static_cast<Index>(strands.size()); ++strand) {
    for (Index position = 0; position < mesh.nodes(strand); ++position) {
      const double s = mesh.coordinate(strand, position, mesh_state_of(rest).s);
      const MovedPlace place = at(strands[static_cast<std::size_t>(strand)], s);
      const NodeUnknowns unknowns = mesh.node_unknowns(strand, position);
      const std::array<double, 3> by{place.moved.x(), place.moved.y(), place.turned};
      for (std::size_t i = 0; i < unknowns.size(); ++i)
        if (unknowns[i] >= 0) open.x[unknowns[i]] = rest.x[unknowns[i]] + by[i];
    }
  }
  return open;
}

// --- contacts of nodes, as contact that slides has them -------------------------------------------------------------

// Nodes that touch one wall one after the other.
struct TouchingNodes {
  std::string wall{};
  Index strand = 0;
  std::vector<double> places{}, forces{};
};

// What nodes that touch one after the other are taken for.
enum class Reading {
  likely,   // few are a point, of more the forces inside tell
  flat,     // parts without pressure
  pressed,  // parts with pressure
};

// Whether at most one node of a strand lies between two places of nodes: an arch of two elements, none of which bends
// away, is one of the mesh.
bool are_neighbours(const MovedStrand& strand, double a, double b) {
  const double roundoff = 1e-6 * (b - a);
  const auto next = std::lower_bound(strand.begin(), strand.end(), a + roundoff,
                                     [](const MovedPlace& place, double s) { return place.s < s; });
  return strand.end() - next <= 1 || (next + 1)->s >= b - roundoff;
}

// `touching`: the gap below which a node touches, in the scale of the guards.
std::vector<TouchingNodes> touching_nodes(const Assembly& of, const State& state,
                                          const std::vector<MovedStrand>& strands, double touching) {
  const MultiplierContact& contact = *of.contact;
  const Vector guards = contact.guards(state);
  struct Node {
    std::string wall;
    MaterialPoint at;
    double force;
  };
  std::vector<Node> nodes;
  for (Index j = 0; j < contact.contact_count(); ++j) {
    const bool closed = state.active_set[static_cast<std::size_t>(j)] != 0;
    if (!closed && guards[j] > touching) continue;
    const ContactPoint point = contact.contact(state, j);
    nodes.push_back({.wall = point.label.wall,
                     .at = of.sliding_structure->find(point.label.member, point.label.fraction),
                     .force = closed ? point.force : 0.0});
  }
  std::stable_sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) {
    return std::tie(a.wall, a.at.strand, a.at.s) < std::tie(b.wall, b.at.strand, b.at.s);
  });
  std::vector<TouchingNodes> groups;
  for (const Node& node : nodes) {
    const bool goes_on =
        !groups.empty() && groups.back().wall == node.wall && groups.back().strand == node.at.strand &&
        are_neighbours(strands[static_cast<std::size_t>(node.at.strand)], groups.back().places.back(), node.at.s);
    if (!goes_on) groups.push_back({.wall = node.wall, .strand = node.at.strand});
    groups.back().places.push_back(node.at.s);
    groups.back().forces.push_back(node.force);
  }
  std::erase_if(groups, [](const TouchingNodes& group) {
    return std::all_of(group.forces.begin(), group.forces.end(), [](double force) { return force <= 0.0; });
  });
  return groups;
}

// Sum and centre of the forces of nodes first … last − 1.
std::pair<double, double> resultant(const TouchingNodes& nodes, std::size_t first, std::size_t last) {
  double sum = 0.0, moment = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    sum += nodes.forces[k];
    moment += nodes.forces[k] * nodes.places[k];
  }
  return {sum, sum > 0.0 ? moment / sum : nodes.places[first]};
}

// A part without pressure bears forces at its ends alone, each of which one or two nodes have.
GivenContact given(const TouchingNodes& nodes, Reading reading) {
  constexpr std::size_t few = 5;    // nodes, of which a part that they are hardly has one inside
  constexpr double without = 1e-3;  // of the forces, inside a part without pressure
  const std::size_t n = nodes.places.size();
  const auto [all, centre] = resultant(nodes, 0, n);
  GivenContact contact{.wall = nodes.wall, .strand = nodes.strand, .from = centre, .to = centre, .force_at_from = all};
  if (n == 1 || (n <= few && reading == Reading::likely)) return contact;
  const bool is_flat =
      reading == Reading::flat || (reading == Reading::likely && resultant(nodes, 2, n - 2).first <= without * all);
  const auto [first_half, from] = resultant(nodes, 0, n / 2);
  const auto [second_half, to] = resultant(nodes, n / 2, n);
  contact.between = is_flat ? Span::flat : Span::pressed;
  contact.from = is_flat ? from : nodes.places.front();
  contact.to = is_flat ? to : nodes.places.back();
  contact.force_at_from = is_flat ? first_half : nodes.forces.front();
  contact.force_at_to = is_flat ? second_half : nodes.forces.back();
  return contact;
}

}  // namespace

DeckMesh::DeckMesh(const Model& model)
    : model_(model), size_(model.structure().size({})), turning_sets_(model.structure().metric({}).turning_sets) {
  if (model.sliding() == nullptr) return;
  const Structure& structure = model.structure();
  readings_.resize(static_cast<std::size_t>(size_));
  const auto read = [&](Index dof, std::shared_ptr<const Observable> what) {
    if (const auto unknown = structure.unknown(dof)) readings_[static_cast<std::size_t>(*unknown)] = what;
  };
  for (std::size_t m = 0; m < structure.members().size(); ++m) {
    const MemberMesh& mesh = structure.members()[m];
    for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
      using enum MemberObservable::Component;
      read(structure.dof(mesh.nodes[k], Dof::x), model.body().motion(m, k, x));
      read(structure.dof(mesh.nodes[k], Dof::z), model.body().motion(m, k, z));
      if (mesh.rotations[k]) read(*mesh.rotations[k], model.body().motion(m, k, rotation));
    }
  }
  rest_ = values(model.sliding()->rest());  // monitors are measured from the axis without imperfection
}

bool DeckMesh::is_complete() const {
  return std::all_of(readings_.begin(), readings_.end(), [](const auto& one) { return one != nullptr; });
}

const System& DeckMesh::system() const {
  if (model_.contact() != nullptr) return *model_.contact();
  if (model_.compliant() != nullptr) return *model_.compliant();
  return model_.structure();
}

Vector DeckMesh::unknowns(const State& of_model) const {
  if (readings_.empty()) return of_model.x.head(size_);
  return values(of_model) - rest_;
}

State DeckMesh::state(const Vector& unknowns, double lambda) const {
  const ActiveSet active_set = system().open_active_set();
  State state{.x = Vector::Zero(system().size(active_set)), .lambda = lambda, .active_set = active_set};
  state.x.head(size_) = unknowns;
  return state;
}

double DeckMesh::distance(const Vector& a, const Vector& b) const {
  return length(turned_towards(b, a, turning_sets_) - b);
}

double DeckMesh::length(const Vector& change) const {
  const Vector weights = model_.structure().weights({});
  return std::sqrt((weights.array() * change.array().square()).sum());
}

Vector DeckMesh::values(const State& state) const {
  Vector values(size_);
  for (Index i = 0; i < size_; ++i) values[i] = readings_[static_cast<std::size_t>(i)]->value(state);
  return values;
}

std::vector<State> DeckMesh::in_path_formulation(const State& equilibrium) const {
  return in_moving_formulation(model_.path(), equilibrium, {1e-7, 1e-4});
}

std::vector<State> in_moving_formulation(const Assembly& of, const State& equilibrium,
                                         std::initializer_list<double> touching) {
  const Index size = of.structure->size({});
  const State deck_state{.x = equilibrium.x.head(size), .lambda = equilibrium.lambda, .active_set = {}};
  const std::vector<MovedStrand> strands = moved_strands(of, deck_state);
  const State open = open_shape(*of.sliding, strands, equilibrium.lambda);
  std::vector<State> guesses;
  std::vector<std::vector<GivenContact>> guessed;
  for (const double gap : touching) {
    const std::vector<TouchingNodes> groups = touching_nodes(of, equilibrium, strands, gap);
    for (const Reading reading : {Reading::likely, Reading::flat, Reading::pressed}) {
      std::vector<GivenContact> contacts;
      for (const TouchingNodes& nodes : groups) contacts.push_back(given(nodes, reading));
      if (std::find(guessed.begin(), guessed.end(), contacts) != guessed.end()) continue;
      guessed.push_back(contacts);
      guesses.push_back(of.with_kinks(of.sliding->with_given_contacts(open, contacts)));
    }
  }
  return guesses;
}

}  // namespace arcwall
