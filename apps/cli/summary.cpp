#include "apps/cli/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "apps/output/load_text.hpp"
#include "apps/output/text_table.hpp"
#include "model/deck/words.hpp"

namespace arcwall {

namespace {

// Two columns: what is spoken of, said once, and what is said of it.
class Lines {
 public:
  void add(const std::string& subject, const std::string& text) {
    rows_.push_back({subject == last_ ? "" : subject, text});
    last_ = subject;
  }
  std::string text(const std::string& file) const { return text_table({{"deck"}, {file}}, rows_); }

 private:
  std::string last_;
  std::vector<std::vector<std::string>> rows_;
};

// The candidates of a wall, and its least gap in the stress-free state with its place.
struct FirstGap {
  Index candidates = 0;
  double gap = infinity;
  ContactLabel at{};
};

// By the names of the walls: at nodes, or of compliant walls anywhere along members.
std::unordered_map<std::string, FirstGap> first_gaps(const Model& model, const State& at_rest) {
  std::unordered_map<std::string, FirstGap> gaps;
  const auto look_at = [&](const std::string& wall, double gap, const auto& label) {
    FirstGap& first = gaps[wall];
    ++first.candidates;
    if (gap >= first.gap) return;
    first.gap = gap;
    first.at = label();
  };
  if (const MultiplierContact* const contact = model.contact())
    for (Index j = 0; j < contact->contact_count(); ++j) {
      const Candidate& candidate = contact->candidate(j);
      look_at(candidate.label().wall, candidate.gap(at_rest), [&] { return candidate.label(); });
    }
  if (const CompliantContact* const contact = model.compliant())
    for (Index j = 0; j < contact->contact_count(); ++j)
      look_at(contact->wall(j).name, contact->nearest(at_rest, j).gap,
              [&] { return contact->contact(at_rest, j).label; });
  return gaps;
}

// With contact at nodes, the number of candidates too.
std::string text_of(const FirstGap& first, const Model& model) {
  std::string text;
  if (model.compliant() != nullptr) text = "compliant, ";
  if (model.contact() != nullptr && model.sliding() == nullptr) text = fmt::format("{} candidates, ", first.candidates);
  if (!std::isfinite(first.gap)) return text + "no member faces it";
  const double gap = model.frame().factor() * first.gap + 0.0;  // no −0
  return text + "smallest initial gap " + with_unit(fmt::format("{:.6g}", gap), model.whole_deck().units.length) +
         fmt::format(" at {}:{:.4g}", first.at.member, first.at.fraction);
}

std::string where_it_is(const deck::Wall& wall) {
  struct Words {
    const deck::Wall& wall;
    std::string operator()(const deck::HalfPlaneOutline&) const { return "half-plane"; }
    std::string operator()(const deck::CircleOutline& o) const { return text("circle", true, o.keep); }
    std::string operator()(const deck::EllipseOutline& o) const { return text("ellipse", true, o.keep); }
    std::string operator()(const deck::CurveOutline& o) const { return text("curve", o.closed, o.keep); }
    std::string operator()(const deck::PolylineOutline& o) const {
      std::string corners = wall.corner_radius > 0.0 ? fmt::format(" rounded with {:.6g}", wall.corner_radius) : "";
      for (const double radius : wall.corner_radii)
        corners += (corners.empty() ? " rounded with " : ", ") + fmt::format("{:.6g}", radius);
      return text("polyline" + corners, o.closed, o.keep);
    }
    static std::string text(const std::string& what, bool is_closed, Keep keep) {
      if (!is_closed) return what + ", the structure to its left";
      return what + ", the structure " + deck::text_of(deck::keep_words, keep);
    }
  };
  if (wall.outline) return std::visit(Words{wall}, *wall.outline);
  return deck::text_of(deck::side_words, wall.side) + " the structure";
}

void add_walls(const Model& model, Lines& lines) {
  const State at_rest{.x = Vector::Zero(model.structure().size({}))};
  auto gaps = first_gaps(model, at_rest);
  for (const deck::Wall& wall : model.whole_deck().walls)
    lines.add("walls", fmt::format("{}: {}, {}", wall.name, where_it_is(wall), text_of(gaps[wall.name], model)));
}

void add_model(const Model& model, Lines& lines) {
  const deck::Deck& deck = model.whole_deck();
  lines.add("title", deck.title);
  lines.add("nodes", std::to_string(model.structure().node_count()));
  lines.add("unknowns", std::to_string(model.structure().size({})));
  for (const deck::Member& member : deck.members)
    lines.add("members", fmt::format("{}: {}, {} {}", member.name, deck::text_of(deck::theory_words, member.theory),
                                     member.elements, member.elements == 1 ? "element" : "elements"));
  for (const deck::Support& support : deck.supports) {
    std::vector<std::string> directions;
    for (const Dof direction : support.directions)
      directions.push_back(deck::text_of(deck::direction_words, direction));
    lines.add("supports", fmt::format("{}: {}", support.point, fmt::join(directions, ", ")));
  }
  for (const deck::Prescribed& moved : deck.prescribed)
    lines.add("moved", movement_text(moved, deck.units).text + (moved.constant ? ", constant" : ", times λ"));
  for (const deck::Wall& wall : deck.walls)
    if (wall.motion) lines.add("moved", movement_text(wall, deck.units).text + ", times λ");
  for (const deck::Load& load : deck.loads) {
    lines.add("loads", load_text(load, deck.units).text + (load.constant ? ", constant" : ", times λ"));
  }
  for (const deck::Spring& spring : deck.springs) lines.add("springs", spring_text(spring, deck.units));
  add_walls(model, lines);
}

// Where contact is looked for, and what that means for the loads.
void add_contact(const deck::Deck& deck, Lines& lines) {
  if (deck.walls.empty()) return;
  if (deck.contact.is_compliant())
    return lines.add("contact", "anywhere along the members: walls are compliant, their pressure is integrated");
  const deck::PointsOfContact contact = deck::points_of_contact(deck);
  switch (contact.points) {
    case deck::ContactPoints::moving:
      lines.add("contact", "anywhere along the members (moving): " + contact.why);
      break;
    case deck::ContactPoints::nodes:
      lines.add("contact", "at the nodes of the mesh: " + contact.why);
      lines.add("contact", "loads of snaps depend on the mesh: compare several numbers of elements");
      break;
  }
}

// The least and greatest coefficient of a wall on what may touch it.
std::pair<double, double> coefficients(const MultiplierContact& contact, const std::string& wall) {
  std::pair range(infinity, 0.0);
  for (Index j = 0; j < contact.contact_count(); ++j) {
    const Candidate& candidate = contact.candidate(j);
    if (candidate.label().wall != wall) continue;
    range.first = std::min(range.first, candidate.friction());
    range.second = std::max(range.second, candidate.friction());
  }
  return range;
}

// A member of which more than one element lies on a wall at the start.
std::string lies_on(const MultiplierContact& contact, const std::string& wall, const State& at_rest, double touching) {
  std::unordered_map<std::string, Index> touched;
  for (Index j = 0; j < contact.contact_count(); ++j) {
    const Candidate& candidate = contact.candidate(j);
    const bool touches = candidate.label().wall == wall && std::abs(candidate.gap(at_rest)) <= touching;
    if (touches && ++touched[candidate.label().member] > 2) return candidate.label().member;
  }
  return {};
}

// Of compliant walls.
void add_elastic_friction(const CompliantContact& contact, const deck::Deck& deck, Lines& lines) {
  for (const deck::Wall& wall : deck.walls) {
    std::pair range(infinity, 0.0);
    double stiffness = 0.0;
    for (Index j = 0; j < contact.contact_count(); ++j) {
      if (contact.wall(j).name != wall.name) continue;
      range = {std::min(range.first, contact.wall(j).friction), std::max(range.second, contact.wall(j).friction)};
      stiffness = (wall.law ? *wall.law : *deck.contact.law).along();
    }
    const auto [least, most] = range;
    if (most <= 0.0) continue;
    lines.add("friction",
              fmt::format("{}: {}, along members, elastic up to it with {:.6g} by length", wall.name,
                          least < most ? fmt::format("{:.6g} to {:.6g}", least, most) : fmt::format("{:.6g}", most),
                          stiffness));
    if (most > 1.0) lines.add("friction", wall.name + ": above 1 a load may have several states");
  }
}

void add_friction(const Model& model, Lines& lines) {
  const deck::Deck& deck = model.whole_deck();
  if (model.compliant() != nullptr) return add_elastic_friction(*model.compliant(), deck, lines);
  const MultiplierContact* const contact = model.contact();
  if (contact == nullptr || !contact->has_friction()) return;
  const double touching = 1e-9 * model.structure().length_scale();
  const State at_rest{.x = Vector::Zero(model.structure().size({}))};
  for (const deck::Wall& wall : deck.walls) {
    const auto [least, most] = coefficients(*contact, wall.name);
    if (most <= 0.0) continue;
    lines.add("friction",
              fmt::format("{}: {}, at nodes and free ends", wall.name,
                          least < most ? fmt::format("{:.6g} to {:.6g}", least, most) : fmt::format("{:.6g}", most)));
    if (most > 1.0) lines.add("friction", wall.name + ": above 1 a load may have several states");
    if (const std::string member = lies_on(*contact, wall.name, at_rest, touching); !member.empty())
      lines.add("friction",
                member + " lies along " + wall.name + ": fronts of slip move from node to node, so compare meshes");
  }
}

std::string what_is_shown(const deck::Monitor& monitor) {
  switch (monitor.of()) {
    case deck::Monitored::place:
      break;
    case deck::Monitored::wall:
      return "wall " + monitor.wall;
    case deck::Monitored::structure:
      return monitor.component == deck::Component::dissipation ? "all walls" : "all members";
    case deck::Monitored::gap:
      return to_text(monitor.at) + " and wall " + monitor.wall;
    case deck::Monitored::member:
      return "member " + monitor.member;
    case deck::Monitored::spring:
      return "spring " + monitor.spring;
  }
  return to_text(monitor.at);
}

void add_path(const deck::Deck& deck, Lines& lines) {
  lines.add("path", fmt::format("{}, first step {:.6g} of λ, at most {} points",
                                deck::text_of(deck::path_method_words, deck.path.method), deck.path.step,
                                deck.path.max_points));
  for (const deck::StopBounds& bounds : deck.path.stop.bounds)
    lines.add("stops", fmt::format("{} at {:.6g} and {:.6g}", bounds.name, bounds.low, bounds.high));
  for (const EventKind event : deck.path.stop.events)
    lines.add("stops", "at the first " + deck::text_of(deck::stop_event_words, event));
  if (deck.path.stop.contacts) lines.add("stops", fmt::format("at {} closed contacts", *deck.path.stop.contacts));
  for (const deck::Stage& stage : deck.stages) {
    std::string things;
    for (const std::string& thing : stage.drives) things += (things.empty() ? "" : ", ") + thing;
    lines.add("stage", stage.name + " drives " + things);
  }
  for (const deck::Monitor& monitor : deck.monitors)
    lines.add("monitors", fmt::format("{}: {} of {}", monitor.name,
                                      deck::text_of(deck::component_words, monitor.component), what_is_shown(monitor)));
}

}  // namespace

std::string summary(const Model& model) {
  Lines lines;
  add_model(model, lines);
  add_contact(model.whole_deck(), lines);
  add_friction(model, lines);
  add_path(model.whole_deck(), lines);
  return lines.text(model.whole_deck().source.file);
}

}  // namespace arcwall
