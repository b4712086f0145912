// Walls and the treatment of contact.
#include <algorithm>
#include <string>
#include <unordered_set>
#include <vector>

#include "core/text.hpp"
#include "model/deck/deck_keys.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

void spline_keys(Keys& keys, SplineProfile& profile) {
  given_points_keys(keys, true);
  if (!curve_keys(keys, profile.x, profile.z)) return;
  for (std::size_t i = 1; i < profile.x.size(); ++i) {
    if (profile.x[i] > profile.x[i - 1]) continue;
    return keys.report("x", round_trip(profile.x[i]) + " follows " + round_trip(profile.x[i - 1]),
                       "give x in increasing order");
  }
  // Between such points slopes are quotients of what is lost in the digits of the whole.
  constexpr double least_step = 1e-9;
  for (std::size_t i = 1; i < profile.x.size(); ++i) {
    if (profile.x[i] - profile.x[i - 1] > least_step * (profile.x.back() - profile.x.front())) continue;
    return keys.report("x",
                       round_trip(profile.x[i]) + " and " + round_trip(profile.x[i - 1]) +
                           " are the same to 9 digits of the wall's length",
                       "remove one of them");
  }
}

void profile_keys(Keys& keys, Wall& wall) {
  const Option<FlatProfile> flat{
      "flat", "z", [&](FlatProfile& profile) { keys.number("z", profile.z, unit::place_z, any_number, ""); }};
  const Option<LineProfile> line{"line", "z + slope·x", [&](LineProfile& profile) {
                                   keys.number("z", profile.z, unit::length, any_number, "");
                                   keys.number("slope", profile.slope, unit::none, any_number, "");
                                 }};
  const Option<CircleProfile> circle{"circle", "the upper arc for `\"below\"`, the lower one for `\"above\"`",
                                     [&](CircleProfile& profile) {
                                       keys.vector("centre", profile.centre, unit::place, "");
                                       keys.number("radius", profile.radius, unit::length, positive, "");
                                     }};
  const Option<ParabolaProfile> parabola{"parabola", "apex.z + ½ curvature (x − apex.x)²",
                                         [&](ParabolaProfile& profile) {
                                           keys.vector("apex", profile.apex, unit::place, "");
                                           keys.number("curvature", profile.curvature, unit::curvature, any_number, "");
                                         }};
  const Option<SplineProfile> spline{
      "spline", "interpolating cubic; x strictly increasing, at least 2 points; \"not a knot\" ends",
      [&](SplineProfile& profile) { spline_keys(keys, profile); }};
  keys.one_of("type", wall.profile, "ψ", flat, line, circle, parabola, spline);
}

// `taken`: the names of the walls before it.
void name_key(Keys& keys, std::unordered_set<std::string>& taken, Wall& wall) {
  if (!keys.text("name", wall.name, "its name in the events")) return;
  if (!is_name(wall.name)) {
    keys.report("name", in_quotes(wall.name, 60) + " is no name", "use letters, digits, _ and - only");
  } else if (!taken.insert(wall.name).second) {
    keys.report("name", in_quotes(wall.name) + " is the name of another wall", "give each wall its own");
  }
}

void motion_keys(Keys& keys, WallMotion& motion) {
  keys.table(
      optional("motion", "none"), Form::in_line,
      [&](Keys& of) {
        of.number(optional("x"), motion.x, unit::length, any_number, "");
        of.number(optional("z"), motion.z, unit::length, any_number, "");
        of.number(optional("rotation"), motion.rotation, unit::none, any_number, "");
        of.vector(optional("about"), motion.about, unit::place, "");
        if (of.reads() && !of.has("x") && !of.has("z") && !of.has("rotation"))
          keys.report("motion", "the wall does not move", "give at least one of x, z and rotation");
      },
      "rigid-body motion times λ: translation `x`, `z` [length] and `rotation` [rad] about the point `about`, which "
      "moves along");
}

// The points of a table, of which each message names one key.
void check_table(Keys& keys, const WallLaw& law) {
  const std::vector<double>&p = law.penetration, &w = law.pressure;
  if (p.size() != w.size() || p.size() < 2)
    return keys.report(
        "pressure",
        "the law has " + std::to_string(p.size()) + " penetrations and " + std::to_string(w.size()) + " pressures",
        "give as many of both, at least 2");
  if (p.front() != 0.0 || w.front() != 0.0)
    return keys.report("penetration", "the law does not begin without pressure at penetration 0",
                       "let the first of both be 0");
  // Between such points the stiffness is a quotient of what is lost in the digits of the whole.
  constexpr double least_step = 1e-9;
  for (std::size_t i = 1; i < p.size(); ++i)
    if (!(p[i] - p[i - 1] > least_step * p.back()))
      return keys.report("penetration", round_trip(p[i]) + " follows " + round_trip(p[i - 1]),
                         "order the penetrations, each once to 9 digits of the last");
  if (std::any_of(w.begin(), w.end(), [](double pressure) { return pressure < 0.0; }))
    return keys.report("pressure", "a pressure is negative: walls push only", "give pressures of 0 or more");
  if (std::all_of(w.begin(), w.end(), [](double pressure) { return pressure == 0.0; }))
    keys.report("pressure", "the wall has no pressure", "give pressures greater than 0");
}

void law_keys(Keys& keys, WallLaw& law, std::string_view otherwise) {
  keys.table(
      optional("law", otherwise), Form::in_line,
      [&](Keys& of) {
        const bool has_table =
            of.reads() ? of.has("penetration") || of.has("pressure") : of.lists() || !law.penetration.empty();
        if (of.reads() && has_table == of.has("stiffness")) {
          of.report("stiffness", has_table ? "the law has both a stiffness and a table" : "the law has no stiffness",
                    "give `stiffness`, or `penetration` and `pressure`");
          return of.give_up();
        }
        if (!has_table || of.lists()) of.number("stiffness", law.stiffness, unit::stress, positive, "");
        of.number(optional("tangential_stiffness", "that at penetration 0"), law.tangential_stiffness, unit::stress,
                  positive, "along the wall, of what friction holds; by length of axis");
        if (of.applies(!has_table || of.lists(), "depth", "belongs to a law with a stiffness", "remove it"))
          of.number(optional("depth"), law.depth, unit::length, positive, "");
        if (!of.applies(has_table, "interpolation", "belongs to a table of penetrations and pressures", "remove it"))
          return;
        const bool penetration = of.numbers("penetration", law.penetration, unit::length, "");
        const bool pressure = of.numbers("pressure", law.pressure, unit::line_load, "");
        of.word(optional("interpolation", "linear"), law.interpolation, interpolation_words, "");
        if (of.reads() && penetration && pressure) check_table(of, law);
      },
      "of method `\"compliant\"`: pressure by penetration");
}

void check_faces(Keys& keys, const Deck& deck, const Wall& wall) {
  std::vector<const Member*> members;
  for (const Member& member : deck.members)
    if (concerns(wall, member.name)) members.push_back(&member);
  const Member* without = member_without_faces(deck, members);
  if (wall.contact_surface == ContactSurface::axis || without == nullptr) return;
  keys.report(
      "contact_surface",
      "the wall acts on faces, but section " + without->section + " of member " + without->name + " has no height",
      "give the section a height, or write contact_surface = \"axis\"");
}

void wall_keys(Keys& keys, Wall& wall, std::unordered_set<std::string>& taken, const Deck& deck) {
  name_key(keys, taken, wall);
  const bool has_outline = keys.reads() ? keys.has("outline") : wall.outline.has_value();
  if (keys.applies(!has_outline, "side",
                   "belongs to a profile: the direction of an outline gives the side of the structure", "remove it"))
    keys.word("side", wall.side, side_words,
              "of a profile. `\"above\"`: the structure is below the wall; `\"below\"`: above it");
  keys.word(optional("contact_surface"), wall.contact_surface, contact_surface_words,
            "`\"face\"`: the face of the section towards the wall; `\"axis\"`: the centreline, required for trusses");
  keys.names(optional("members", "all"), wall.members, Named::member, EmptyList::refused, "names");
  if (keys.applies(!has_outline, "profile", "does not go with an outline", "keep one of them"))
    keys.table(
        "profile", Form::dotted, [&](Keys& of) { profile_keys(of, wall); },
        "z = ψ(x), one of the following; or an `outline`");
  outline_keys(keys, wall);
  keys.number(optional("interference"), wall.interference, unit::length, not_negative,
              "allowed overlap with the undeformed structure. The wall starts that far back and moves into place while "
              "the constant "
              "loads are applied");
  keys.number(optional("friction"), wall.friction, unit::none, coefficient_of_friction,
              "coefficient μ of Coulomb friction: a contact sticks up to a friction force μ p, and slips at it");
  keys.part("law", wall.law, [&](WallLaw& law) { law_keys(keys, law, "`contact.law`"); });
  keys.part("motion", wall.motion, [&](WallMotion& motion) { motion_keys(keys, motion); });
  check_faces(keys, deck, wall);
}

template <class Part>
std::vector<std::string> names_of(const std::vector<Part>& parts) {
  std::vector<std::string> names;
  for (const Part& part : parts) names.push_back(part.name);
  return names;
}

// Reports a name that none of the deck's parts has.
void check_part(Keys& keys, const char* key, const std::string& kind, const std::string& name,
                const std::vector<std::string>& known) {
  if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string near = nearest(name, known);
  keys.report(key, "there is no " + kind + " " + in_quotes(name, 60),
              near.empty() ? "name one of the deck" : "did you mean " + in_quotes(near, 60) + "?");
}

void friction_keys(Keys& keys, const Deck& deck, FrictionPair& pair) {
  keys.text(optional("wall", "all"), pair.wall, "name of a wall");
  keys.text(optional("member", "all"), pair.member, "name of a member");
  keys.text(optional("point", "all"), pair.point, "end point of a member");
  keys.number("coefficient", pair.coefficient, unit::none, coefficient_of_friction, "instead of the wall's `friction`");
  if (!keys.reads()) return;
  if (pair.wall.empty() && pair.member.empty() && pair.point.empty())
    keys.report("coefficient", "say what it is for: wall, member or point", "");
  std::vector<std::string> ends;
  for (const Member& member : deck.members) ends.insert(ends.end(), {member.from, member.to});
  check_part(keys, "wall", "wall", pair.wall, names_of(deck.walls));
  check_part(keys, "member", "member", pair.member, names_of(deck.members));
  check_part(keys, "point", "end of a member", pair.point, ends);
}

void check_law(Keys& keys, const Deck& deck, const Contact& contact) {
  const auto has_none = [](const Wall& wall) { return !wall.law; };
  const auto without = std::find_if(deck.walls.begin(), deck.walls.end(), has_none);
  if (without != deck.walls.end() && !contact.law)
    keys.report("law", "is missing: wall " + in_quotes(without->name) + " has no law of its own",
                "add law = { stiffness = … }, the pressure by penetration");
}

void friction_at_key(Keys& keys, Contact& contact) {
  keys.word(optional("friction_at"), contact.friction_at, friction_at_words,
            "`\"touch\"`: friction acts on the face; `\"axis\"`: on the axis");
}

void rigid_contact_keys(Keys& keys, const Deck& deck, Contact& contact) {
  keys.word(optional("points", "by theory"), contact.points, contact_points_words,
            "`\"moving\"`: positions of contact points are unknowns; `\"nodes\"`: contact at mesh nodes only");
  // A default that depends on other keys is a comment: who reads the deck sees it, and it goes with the keys.
  if (keys.writes() && !contact.points && !deck.walls.empty()) {
    const PointsOfContact found = points_of_contact(deck);
    keys.comment("points = " + in_quotes(text_of(contact_points_words, found.points)) + ": " + found.why);
  }
  friction_at_key(keys, contact);
  keys.number(optional("penalty", "none"), contact.penalty, unit::stress, positive,
              "force per length of axis and of penetration; > 0, required by `\"penalty\"` and `\"augmented\"`");
  keys.number(optional("gap_tolerance"), contact.gap_tolerance, unit::length, positive,
              "of `\"augmented\"`: bound on gaps of closed contacts");
  const bool has_springs =
      contact.method == ContactLaw::Method::penalty || contact.method == ContactLaw::Method::augmented;
  if (has_springs && !keys.has("penalty"))
    keys.report("penalty", "is missing: method " + text_of(contact_method_words, contact.method) + " needs it",
                "add penalty, a number greater than 0");
}

void contact_keys(Keys& keys, const Deck& deck, Contact& contact) {
  keys.word(optional("method"), contact.method, contact_method_words,
            "`\"multiplier\"`: exact; `\"penalty\"`: springs of stiffness `penalty` in compression; `\"augmented\"`: "
            "exact, multiplier plus spring; `\"compliant\"`: pressure by `law`");
  const bool compliant = contact.is_compliant();
  if (compliant && (keys.reads() || has_friction(deck))) friction_at_key(keys, contact);
  if (!compliant) rigid_contact_keys(keys, deck, contact);
  for (const char* key : {"points", "penalty", "gap_tolerance"})
    keys.applies(!compliant, key, "does not go with method \"compliant\", whose pressure is integrated along members",
                 "remove it");
  if (keys.applies(compliant || keys.lists(), "law", "belongs to method \"compliant\"",
                   "write method = \"compliant\", or remove it"))
    keys.part("law", contact.law, [&](WallLaw& law) { law_keys(keys, law, "none"); });
  if (keys.reads() && compliant) check_law(keys, deck, contact);
}

}  // namespace

bool declare_walls(Keys& root, Deck& deck) {
  std::unordered_set<std::string> taken;
  const auto keys_of_wall = [&](Keys& keys, Wall& wall) { wall_keys(keys, wall, taken, deck); };
  const bool all_right = root.tables(optional("wall"), deck.walls, keys_of_wall, "");
  root.tables(
      optional("friction"), deck.frictions, [&](Keys& keys, FrictionPair& pair) { friction_keys(keys, deck, pair); },
      "");
  root.table(
      optional("contact"), Form::header, [&](Keys& keys) { contact_keys(keys, deck, deck.contact); }, "");
  return all_right;
}

}  // namespace arcwall::deck
