#include "model/deck_checks.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <variant>

#include "core/text.hpp"
#include "model/build_contact.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/numbers.hpp"
#include "model/deck/value.hpp"

namespace arcwall {

bool moves_something(const Structure& structure) {
  if (structure.size({}) == 0) return false;
  if (structure.metric({}).squared_motion_by_lambda > 0.0) return true;
  Linearization now;
  structure.linearize({.x = Vector::Zero(structure.size({}))}, now);
  return now.F_lambda.size() > 0 && now.F_lambda.cwiseAbs().maxCoeff() > 0.0;
}

void report_nothing_moves(const deck::Deck& deck, std::size_t stage, bool all_is_held, DeckProblems& problems) {
  std::string key = deck.loads.empty() ? "prescribed" : "load";
  deck::Position position;
  if (!deck.stages.empty()) {
    key = "stage.drives";
    position = deck.stages[stage].position;
  } else if (!deck.loads.empty()) {
    position = deck.loads.front().position;
  } else if (!deck.prescribed.empty()) {
    position = deck.prescribed.front().position;
  }
  if (all_is_held)
    return problems.add(position, key, "every direction is held: nothing is left to move",
                        "leave a direction free, or divide the members more finely");
  problems.add(position, key, "what λ multiplies acts on directions that are held: nothing moves",
               "load a free direction");
}

void check_sensitivity(const deck::Deck& deck, DeckProblems& problems) {
  if (deck.path.sensitivity.empty()) return;
  if (deck.path.method == deck::PathMethod::incremental)
    problems.add(deck.path.position, "path.sensitivity",
                 "method \"incremental\" finds no events whose derivatives mean anything", "use method \"spherical\"");
  if (deck.path.events != EventSearch::locate)
    problems.add(deck.path.position, "path.sensitivity", "events that are not located have no derivatives",
                 "write events = \"locate\"");
  for (const std::string& key : deck.path.sensitivity) {
    const auto found = deck::number_of(deck, key);
    if (const auto* const none = std::get_if<deck::NoNumber>(&found))
      problems.add(deck.path.position, "path.sensitivity", deck::in_quotes(key, 100) + " " + none->message, none->cure);
  }
}

void check_curve(const deck::Deck& deck, DeckProblems& problems) {
  if (!deck.curve) return;
  const deck::EventToFollow& curve = *deck.curve;
  const auto add = [&](const char* key, std::string message, std::string cure) {
    problems.add(curve.position, key, std::move(message), std::move(cure));
  };
  std::vector<std::string> keys = curve.worst;
  if (!curve.parameter.empty()) keys.push_back(curve.parameter);
  for (const std::string& key : keys) {
    const char* const at = curve.parameter.empty() ? "curve.worst" : "curve.parameter";
    const auto found = deck::number_of(deck, key);
    if (const auto* const none = std::get_if<deck::NoNumber>(&found))
      add(at, deck::in_quotes(key, 100) + " " + none->message, none->cure);
  }
}

std::string start_outside_bounds(const deck::Path& path) {
  const auto bounds = std::find_if(path.stop.bounds.begin(), path.stop.bounds.end(),
                                   [](const deck::StopBounds& one) { return one.name == "lambda"; });
  if (bounds == path.stop.bounds.end()) return {};
  if (std::isinf(bounds->low) || std::isinf(bounds->high)) return {};  // a value of `visit`, to which λ goes
  const std::string between = "stop.lambda = [" + round_trip(bounds->low) + ", " + round_trip(bounds->high) + "]";
  if (bounds->low > 0.0 || bounds->high < 0.0)
    return "λ begins at 0, outside of " + between + ": the path ends where it comes to either bound";
  const bool leaves = (bounds->low == 0.0 && path.step < 0.0) || (bounds->high == 0.0 && path.step > 0.0);
  if (!leaves) return {};
  return "λ begins at 0 and leaves " + between + " at once, since step = " + round_trip(path.step) +
         ": the path ends where it comes back";
}

bool wants_increments(const deck::Deck& deck) { return deck.path.method == deck::PathMethod::incremental; }

bool may_slide(const deck::Deck& deck, const StructureBuilder& builder) {
  return !deck.walls.empty() && points_of_contact(deck).points == deck::ContactPoints::moving &&
         deck.contact.method == ContactLaw::Method::rigid && !wants_increments(deck) && builder.can_slide() &&
         why_tapers_hold_contact(deck).empty();
}

void check_hollow_corners(const deck::Deck& deck, DeckProblems& problems) {
  for (const deck::Wall& wall : deck.walls)
    if (parts_of(wall).size() > 1)
      problems.add(
          wall.position, "wall.outline",
          "the outline has hollow corners that are sharp: what touches in one touches two lines at once, which "
          "contact at nodes does not know",
          "give a corner_radius, or make a wall of each line");
}

bool slides(const deck::Deck& deck, const StructureBuilder& builder, const std::vector<Candidate>& candidates,
            DeckProblems& problems) {
  const auto held = std::find_if(candidates.begin(), candidates.end(),
                                 [](const Candidate& candidate) { return candidate.opposite().has_value(); });
  if (held != candidates.end() && wants_increments(deck))
    problems.add({}, "path.method",
                 "method \"incremental\" does not support walls without clearance on both sides of a member, such as " +
                     held->label().wall,
                 "use \"spherical\", or leave a clearance");
  if (deck.walls.empty() || points_of_contact(deck).points == deck::ContactPoints::nodes) return false;
  if (held != candidates.end()) {
    problems.add({}, "contact.points",
                 "points = \"moving\" does not support walls without clearance on both sides of a member, such as " +
                     held->label().wall,
                 "use \"nodes\", or leave a clearance");
    return false;
  }
  if (const std::string why = why_tapers_hold_contact(deck); !why.empty()) {
    problems.add({}, "contact.points", why,
                 "use \"nodes\", or contact_surface = \"axis\" and a section without a table");
    return false;
  }
  if (may_slide(deck, builder)) return true;
  problems.add({}, "contact.points",
               "points = \"moving\" needs members whose contact forces are point forces, theory \"euler-bernoulli\" or "
               "\"elastica\" throughout, method \"multiplier\", and a path that is not incremental",
               "use \"nodes\"");
  return false;
}

std::vector<std::string> interference_warnings(const deck::Deck& deck, const MultiplierContact& at_nodes,
                                               const SlidingContact* sliding) {
  std::set<std::string> outside;  // walls with an interference that no node overlaps with
  for (const deck::Wall& wall : deck.walls)
    if (wall.interference > 0.0) outside.insert(wall.name);
  if (outside.empty() || (sliding != nullptr && sliding->entered(sliding->rest(), 0.0))) return {};
  const State rest{.x = Vector::Zero(at_nodes.size(at_nodes.open_active_set())), .lambda = 0.0};
  for (Index j = 0; j < at_nodes.contact_count(); ++j) {
    const Candidate& candidate = at_nodes.candidate(j);
    if (outside.contains(candidate.label().wall) && candidate.gap(rest) < 0.0) outside.erase(candidate.label().wall);
  }
  std::vector<std::string> warnings;
  for (const std::string& wall : outside)
    warnings.push_back("the interference of wall \"" + wall +
                       "\" has no effect: the undeformed structure does not overlap with the wall as it is drawn; "
                       "draw the wall where it is to be in the end");
  return warnings;
}

void check_friction_at_start(const SlidingContact& contact, double toward, DeckProblems& problems) {
  if (const std::string why = contact.why_friction_is_not_modelled(toward); !why.empty())
    problems.add({}, "contact.points", why, "write points = \"nodes\", or leave it out");
}

namespace {

// What contact points that move along members ask of friction besides.
void check_moving_friction(const deck::Deck& deck, const SlidingStructure& sliding, DeckProblems& problems) {
  for (const deck::Wall& wall : deck.walls) {
    std::map<Index, double> of_strands;
    for (const deck::Member& member : deck.members) {
      const double friction = deck::friction_of(deck, wall, member.name, 0.5);
      const auto [known, is_new] = of_strands.try_emplace(sliding.find(member.name, 0.5).strand, friction);
      if (is_new || known->second == friction) continue;
      problems.add(
          wall.position, "wall.friction",
          "contact points move along members, and friction changes where member \"" + member.name + "\" meets the next",
          "write contact.points = \"nodes\", or one coefficient for both");
    }
  }
  for (const deck::Monitor& monitor : deck.monitors) {
    if (monitor.component != deck::Component::slip &&
        !(is_of_friction(monitor.component) && monitor.of() == deck::Monitored::gap))
      continue;
    problems.add(monitor.position, "monitor.component",
                 "contact points move along members, so that no place has friction of its own",
                 "write contact.points = \"nodes\", or name the wall alone; contacts.csv has the slip of each contact");
  }
}

}  // namespace

void check_friction(const deck::Deck& deck, const Structure& structure, const std::vector<Candidate>& candidates,
                    const SlidingStructure* sliding, DeckProblems& problems) {
  if (!deck::has_friction(deck)) return;
  const auto& springs = structure.nodal_terms().law_springs();
  if (std::any_of(springs.begin(), springs.end(),
                  [](const NodalTerms::LawSpring& spring) { return !spring.law->kinks().empty(); }))
    problems.add({}, "spring.law", "friction is not known beside laws of straight pieces",
                 "write interpolation = \"smooth\" in the law");
  const auto rough = [](const Candidate& candidate) { return candidate.friction() > 0.0; };
  if (sliding != nullptr) check_moving_friction(deck, *sliding, problems);
  if (deck.contact.method != ContactLaw::Method::rigid && !deck.contact.is_compliant())
    problems.add({}, "contact.method", "springs in place of walls have no friction",
                 "contact.method = \"multiplier\" has");
  if (wants_increments(deck))
    problems.add(deck.path.position, "path.method", "load increments without iteration know no friction",
                 "use \"spherical\"");
  if (std::any_of(candidates.begin(), candidates.end(),
                  [&](const Candidate& candidate) { return rough(candidate) && candidate.opposite(); }))
    problems.add({}, "friction", "what two stops press together without a gap has no known friction",
                 "leave a clearance, or leave out the friction of these walls");
  const bool on_axis = deck.contact.friction_at == deck::FrictionAt::axis;
  const auto on_faces = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
    const Obstacle& wall = candidate.obstacle();
    const bool on_curved_profile = &candidate.rubbing_point() != &candidate.point() && !wall.knots().empty();
    return rough(candidate) && (on_axis ? on_curved_profile : wall.half_height() > 0.0);
  });
  if (on_faces != candidates.end())
    problems.add(deck::find(deck.walls, on_faces->label().wall)->position, "wall.friction",
                 on_axis ? "friction on the axis beside a curved profile is not known"
                         : "friction on faces that roll on an outline is not known",
                 on_axis ? "use an outline, or leave out contact.friction_at"
                         : "write contact.friction_at = \"axis\" or contact_surface = \"axis\", or use a profile");
  const std::string by_history = "events behind the first slip depend on the way that led there";
  if (deck.curve)
    problems.add({}, "curve", by_history, "leave out [curve]: a sweep over the same key runs a path for each value");
  if (!deck.path.sensitivity.empty())
    problems.add(deck.path.position, "path.sensitivity", by_history, "leave it out, or sweep over the key");
  if (deck.path.search || !deck.path.search_at.empty())
    problems.add(deck.path.position, "path.search", by_history, "leave it out");
  if (deck.path.branches == BranchPolicy::jump)
    problems.add(deck.path.position, "path.branches", "it jumps; where it comes to rest depends on the motion",
                 "use \"most-stable\", which follows the path");
  if (deck.path.branches == BranchPolicy::all)
    problems.add(deck.path.position, "path.branches", "friction makes every path one of its own history",
                 "use \"most-stable\" or \"primary\"");
}

void check_between_nodes(const deck::Deck& deck, const SlidingContact& contact, DeckProblems& problems) {
  const double round_off = 1e-9 * contact.scales().length;
  const auto entered = contact.entered(contact.rest(), round_off);
  if (!entered) return;
  const deck::Wall& wall = *deck::find(deck.walls, entered->label.wall);
  problems.add(
      wall.position, "wall." + wall.name,
      fmt::format("member \"{}\" is inside the wall at the start: at {}:{:.4g}, between nodes, by {:.4g}{}",
                  entered->label.member, entered->label.member, entered->label.fraction,
                  deck.frame.factor() * entered->depth, deck.units.length.empty() ? "" : " " + deck.units.length),
      "move the wall, or give it an interference");
}

void check_watched(const deck::Deck& deck, DeckProblems& problems) {
  for (const std::string& name : deck.path.watch) {
    const deck::Monitor& monitor = *deck::find(deck.monitors, name);
    const bool pressure = is_pressure(monitor.component);
    if (monitor.component == deck::Component::friction_use || monitor.component == deck::Component::dissipation)
      problems.add(deck.path.position, "path.watch", "\"" + name + "\" has no turning points that are solved for",
                   "watch the friction-force of the wall");
    if (is_extreme(monitor.component))
      problems.add(deck.path.position, "path.watch",
                   "\"" + name + "\" is what is greatest or least along a member, which may turn where its place jumps",
                   pressure ? "watch the displacement of a place, as in at = \"MEMBER:0.5\", component = \"z\""
                            : "watch the moment at a place, as in at = \"MEMBER:0.5\", component = \"moment\"");
  }
}

bool takes_increments(const deck::Deck& deck, const Structure& structure, DeckProblems& problems) {
  if (!wants_increments(deck)) return false;
  const bool possible = structure.can_be_updated();
  if (!possible)
    problems.add(
        deck.path.position, "path.method",
        "method \"incremental\" needs members of theory \"euler-bernoulli\" or \"essenburg\" throughout, whose "
        "sections do not taper",
        "use \"spherical\"");
  for (const deck::Load& load : deck.loads)
    if (load.constant)
      problems.add(load.position, "load", "method \"incremental\" has no constant loads",
                   "multiply all loads by lambda, or use method \"spherical\"");
  for (const deck::Load& load : deck.loads)
    if (std::holds_alternative<deck::Heat>(load.action))
      problems.add(load.position, "load", "method \"incremental\" does not support temperatures",
                   "use method \"spherical\"");
  for (const deck::Load& load : deck.loads)
    if (std::holds_alternative<deck::Pressure>(load.action))
      problems.add(load.position, "load", "method \"incremental\" does not support follower pressure",
                   "use method \"spherical\"");
  for (const deck::Prescribed& moved : deck.prescribed)
    problems.add(moved.position, "prescribed", "method \"incremental\" moves no supports", "use method \"spherical\"");
  for (const deck::Wall& wall : deck.walls)
    if (wall.interference > 0.0)
      problems.add(wall.position, "wall.interference", "method \"incremental\" pushes no walls to their places",
                   "use method \"spherical\"");
  return possible;
}

namespace {

std::string law_of(const deck::Spring& spring) {
  return "the law of " + (spring.name.empty() ? "a spring" : "spring \"" + spring.name + "\"");
}

}  // namespace

std::string flat_law(const deck::Spring& spring, const deck::Units& units) {
  const auto* foundation = std::get_if<deck::Foundation>(&spring.kind);
  if (foundation == nullptr || !foundation->law || foundation->law->law().at(0.0).stiffness != 0.0) return {};
  return fmt::format(
      "{} has slope 0 at displacement 0, and no support holds what it holds: the stiffness is singular at the start, "
      "and no step may leave it; give the law a small force on its side without one, as 0.001 {} at its last point",
      law_of(spring), unit_text(deck::unit::line_load, units));
}

std::string smoothed_law(const deck::Spring& spring, double unit) {
  constexpr int parts = 32;  // of an interval, between which the difference is read off
  const auto* foundation = std::get_if<deck::Foundation>(&spring.kind);
  if (foundation == nullptr || !foundation->law || foundation->law->interpolation) return {};
  const deck::TableLaw* const law = &*foundation->law;
  const SpringLaw smooth = law->law();
  const SpringLaw straight(law->displacement, law->force, SpringLaw::Interpolation::linear);
  double off = 0.0, at = 0.0, greatest = 0.0;
  for (const double force : law->force) greatest = std::max(greatest, std::abs(force));
  for (std::size_t i = 0; i + 1 < law->displacement.size(); ++i)
    for (int k = 1; k < parts; ++k) {
      const double u = std::lerp(law->displacement[i], law->displacement[i + 1], double(k) / parts);
      const double difference = std::abs(smooth.at(u).force - straight.at(u).force);
      if (difference <= off) continue;
      off = difference;
      at = u;
    }
  return fmt::format(
      "{} is smooth between its points: at displacement {:.4g} it is {:.2g} % of its maximum force off a "
      "straight line; give points closer together, or confirm it with interpolation = \"smooth\"",
      law_of(spring), unit * at, 100.0 * off / greatest);
}

}  // namespace arcwall
