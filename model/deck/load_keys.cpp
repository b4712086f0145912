// Supports, movements of supports, and loads.
#include <algorithm>
#include <cmath>
#include <string>

#include "model/deck/deck_keys.hpp"
#include "model/deck/key_reader.hpp"

namespace arcwall::deck {

namespace {

bool support_key(Keys& keys, const Key& key, Support& support, const Deck& deck) {
  if (keys.refers(key, Named::point) && !ends_a_member(deck, support.point))
    keys.report_key(key, "no member ends at this point", "support the end of a member");
  const bool is_plane = keys.reads() ? !keys.holds_array(key.name) : support.symmetry.has_value();
  if (!is_plane) {
    keys.words(key, support.directions, direction_words, "is no direction", "the directions that are fixed");
  } else if (keys.word(key, support.symmetry, symmetry_words, "a plane of symmetry")) {
    support.directions = {*support.symmetry, Dof::rotation};
  }
  return true;
}

void prescribed_keys(Keys& keys, Prescribed& moved, const Deck& deck) {
  if (keys.name("at", moved.point, Named::point, "a point; every given direction is prescribed") &&
      !ends_a_member(deck, moved.point))
    keys.report("at", "no member ends at point " + moved.point, "name a point at the end of a member");
  keys.number(optional("x", "free"), moved.x, unit::length, any_number, "displacement");
  keys.number(optional("z", "free"), moved.z, unit::length, any_number, "displacement");
  keys.number(optional("rotation", "free"), moved.rotation, unit::none, any_number,
              "of the rigidly joined member ends [rad]");
  keys.flag(optional("constant"), moved.constant, "constant, not scaled by λ");
  keys.word(optional("from"), moved.from, moved_from_words,
            "`\"stage\"`: free until the first stage that drives it, which fixes the point where it is");
  if (!keys.has("x") && !keys.has("z") && !keys.has("rotation"))
    keys.report("at", "nothing is prescribed", "give at least one of x, z and rotation");
}

void shape_belongs_to_distributed(Keys& keys) {
  for (const char* key : {"distributed_to", "frame", "per"})
    if (keys.reads() && !keys.has("distributed"))
      keys.applies(false, key, "belongs to a load that is distributed", "leave it out");
}

void point_load_keys(Keys& keys, PointLoad& load) {
  keys.place("at", load.at, "location of a point load, with `force`, `moment` or both");
  keys.vector(optional("force"), load.force, unit::force, "`[x, z]`");
  keys.number(optional("moment"), load.moment, unit::moment, any_number,
              "does work on the rotation of the section, at any size");
  keys.applies(false, "distributed", "belongs to a load on a member", "write `on` instead of `at`");
  bool along = keys.has("distributed");
  for (const char* key : {"pressure", "temperature", "gradient"}) {
    along = along || keys.has(key);
    if (keys.reads()) keys.applies(false, key, "belongs to a load on a member", "write `on` instead of `at`");
  }
  shape_belongs_to_distributed(keys);
  if (!along && !keys.has("force") && !keys.has("moment"))
    keys.report("force", "the load has neither force nor moment", "give at least one of them");
}

// A load by length of plan needs a member that has one.
void check_plan(Keys& keys, const Deck& deck, const MemberLoad& load) {
  constexpr double vertical = 1e-12;  // of the length: below, x is beyond the resolution of the coordinates
  const Member* member = load.per == LoadMeasure::plan ? find(deck.members, load.member) : nullptr;
  if (member == nullptr || !std::holds_alternative<Straight>(member->axis)) return;
  const Point *from = find(deck.points, member->from), *to = find(deck.points, member->to);
  if (from == nullptr || to == nullptr) return;
  if (std::abs(to->at.x - from->at.x) <= vertical * std::abs(to->at.z - from->at.z))
    keys.report("per", "member " + member->name + " is vertical and has no length of plan: the load on it is zero",
                "leave out per, or leave out the load");
}

void member_load_keys(Keys& keys, MemberLoad& load, const Deck& deck) {
  keys.name("on", load.member, Named::member,
            "instead of `at`: a member, with `distributed`, `pressure` or a temperature");
  Key distributed("distributed");
  if (keys.reads() && !keys.has(distributed.name)) {
    keys.report("distributed", "is missing: the load on a member has no distributed, pressure, temperature or gradient",
                "give one of them");
    keys.ignore({"pressure", "temperature", "gradient"});  // known where it is asked which keys there are
    distributed.presence = Presence::optional;
  }
  keys.vector(distributed, load.distributed, unit::line_load, "`[x, z]`, dead, per length of the undeformed axis");
  keys.part("distributed_to", load.distributed_to, [&](Vector& to) {
    keys.vector(optional("distributed_to", "uniform"), to, unit::line_load,
                "`[x, z]` at the member's end, linear along its axis from `distributed`");
  });
  keys.word(optional("frame"), load.frame, frame_words,
            "of `distributed`: `\"member\"` gives components along the undeformed axis and across it, to the left");
  keys.word(optional("per"), load.per, per_words, "of `distributed`: `\"x\"` per length of plan, as snow");
  if (keys.reads()) check_plan(keys, deck, load);
  for (const char* key : {"force", "moment"})
    keys.applies(false, key, "belongs to a load at a point", "write `at` instead of `on`, or give distributed");
}

void check_heat(Keys& keys, const Deck& deck, const Heat& heat) {
  const Member* member = find(deck.members, heat.member);
  if (member == nullptr) return;
  const Material* material = find(deck.materials, member->material);
  if (material != nullptr && material->expansion.value_or(0.0) == 0.0)
    keys.report("on",
                "material " + material->name + " of member " + member->name +
                    (material->expansion ? " has expansion = 0: temperatures do nothing" : " has no expansion"),
                (material->expansion ? "give expansion of material." : "add expansion to material.") + material->name);
  if (member->theory == Theory::essenburg)
    keys.report("on", "member " + member->name + " is of theory essenburg, which does not support temperatures",
                "take theory \"reissner\"");
  if (member->theory == Theory::truss && heat.gradient != 0.0)
    keys.report("gradient", "member " + member->name + " is a truss, which does not bend", "leave it out");
}

void heat_keys(Keys& keys, Heat& heat, const Deck& deck) {
  const bool on = keys.lists() || keys.name("on", heat.member, Named::member, "");
  keys.number(optional("temperature"), heat.temperature, unit::none, any_number,
              "instead of `distributed`: change of temperature of the member [degree]");
  keys.number(
      optional("gradient"), heat.gradient, unit::none, any_number,
      "through-depth temperature gradient [degree/length], positive if the left face is hotter; not for trusses");
  for (const char* key : {"distributed", "force", "moment"})
    keys.applies(keys.lists(), key, "does not go together with a temperature", "write two loads");
  shape_belongs_to_distributed(keys);
  if (keys.reads() && on) check_heat(keys, deck, heat);
}

void pressure_keys(Keys& keys, Pressure& load, const Deck& deck) {
  const bool on = keys.lists() || keys.name("on", load.member, Named::member, "");
  keys.number("pressure", load.pressure, unit::line_load, any_number,
              "instead of `distributed`: follower pressure, normal to the deformed axis and per deformed length; "
              "positive to the right; not for trusses");
  for (const char* key : {"distributed", "temperature", "gradient", "force", "moment"})
    keys.applies(keys.lists(), key, "does not go together with a pressure", "write two loads");
  shape_belongs_to_distributed(keys);
  const Member* member = keys.reads() && on ? find(deck.members, load.member) : nullptr;
  if (member != nullptr && member->theory == Theory::truss)
    keys.report("on", "member " + member->name + " is a truss, which cannot carry a pressure",
                "use theory \"euler-bernoulli\" or \"elastica\", or forces at its ends");
}

void load_keys(Keys& keys, Load& load, const Deck& deck) {
  const bool at = keys.has("at"), on = keys.has("on");
  const bool presses = keys.reads() ? on && keys.has("pressure") : std::holds_alternative<Pressure>(load.action);
  const bool heats = keys.reads() ? on && (keys.has("temperature") || keys.has("gradient"))
                                  : std::holds_alternative<Heat>(load.action);
  const bool spreads = !heats && !presses;
  if (keys.reads() && at == on) {
    keys.report(at ? "on" : "at", at ? "the load has both `at` and `on`" : "the load has neither `at` nor `on`",
                "give `at` for a point or `on` for a member");
    keys.give_up();
  } else {
    keys.alternative<PointLoad>("at", load.action, [&](PointLoad& action) { point_load_keys(keys, action); });
    if (spreads || keys.lists())
      keys.alternative<MemberLoad>("on", load.action,
                                   [&](MemberLoad& action) { member_load_keys(keys, action, deck); });
    if (presses || keys.lists())
      keys.alternative<Pressure>("on", load.action, [&](Pressure& action) { pressure_keys(keys, action, deck); });
    if ((heats && !presses) || keys.lists())
      keys.alternative<Heat>("on", load.action, [&](Heat& action) { heat_keys(keys, action, deck); });
  }
  keys.flag(optional("constant"), load.constant, "constant, not scaled by λ");
}

bool is_zero(const PointLoad& load) { return load.force == Vector{} && load.moment == 0.0; }
bool is_zero(const MemberLoad& load) {
  return load.distributed == Vector{} && load.distributed_to.value_or(Vector{}) == Vector{};
}
bool is_zero(const Pressure& load) { return load.pressure == 0.0; }
bool is_zero(const Heat& heat) { return heat.temperature == 0.0 && heat.gradient == 0.0; }

bool follows_lambda(const Load& load) {
  return !load.constant && std::visit([](const auto& action) { return !is_zero(action); }, load.action);
}

bool moves_with_lambda(const Prescribed& moved) {
  return !moved.constant &&
         (moved.x.value_or(0.0) != 0.0 || moved.z.value_or(0.0) != 0.0 || moved.rotation.value_or(0.0) != 0.0);
}

bool moves_with_lambda(const Wall& wall) {
  return wall.motion && (wall.motion->x != 0.0 || wall.motion->z != 0.0 || wall.motion->rotation != 0.0);
}

// The directions in which both move a point.
std::string moved_by_both(const Prescribed& a, const Prescribed& b) {
  std::string directions;
  const auto add = [&](const char* direction, bool both) {
    if (both) directions += (directions.empty() ? "" : ", ") + std::string(direction);
  };
  add("x", a.x && b.x);
  add("z", a.z && b.z);
  add("rotation", a.rotation && b.rotation);
  return directions;
}

}  // namespace

bool declare_loads(Keys& root, Deck& deck) {
  root.table(
      optional("support"), Form::header,
      [&](Keys& keys) {
        keys.entries(deck.supports, &Support::point,
                     [&](const Key& key, Support& support) { return support_key(keys, key, support, deck); });
      },
      "");
  const bool moves = root.tables(
      optional("prescribed"), deck.prescribed,
      [&](Keys& keys, Prescribed& moved) { prescribed_keys(keys, moved, deck); }, "");
  return root.tables(
             optional("load"), deck.loads, [&](Keys& keys, Load& load) { load_keys(keys, load, deck); }, "") &&
         moves;
}

bool varies(const Deck& deck, const std::string& thing) {
  bool found = false;
  const auto look = [&](const std::string& kind, const auto& things, const auto& moves) {
    for (std::size_t i = 0; i < things.size(); ++i)
      found = found || (thing == driven_thing(kind, i) && moves(things[i]));
  };
  look("load", deck.loads, follows_lambda);
  look("prescribed", deck.prescribed, [](const Prescribed& moved) { return moves_with_lambda(moved); });
  for (const Wall& wall : deck.walls) found = found || (thing == "wall." + wall.name && moves_with_lambda(wall));
  return found;
}

namespace {

// Whether a load acts at a point, be it named as an end of a member.
bool acts_at(const Deck& deck, const Place& at, const std::string& point) {
  if (!at.fraction) return at.name == point;
  const Member* const member = find(deck.members, at.name);
  return member != nullptr &&
         ((*at.fraction == 0.0 && member->from == point) || (*at.fraction == 1.0 && member->to == point));
}

// The mirror image of what acts across a plane of symmetry at a point of it, or turns it, acts against it.
void check_plane(Keys& root, const Deck& deck, const Support& plane) {
  const bool across_x = *plane.symmetry == Dof::x;
  const std::string axis = across_x ? "x" : "z";
  const auto report = [&](const char* table, const Position& position, const std::string& what,
                          const std::string& cure) {
    Key key(table);
    key.position = position;
    root.report_key(key, what + " the plane of symmetry at " + plane.point + ": its mirror image would act against it",
                    cure);
  };
  for (std::size_t i = 0; i < deck.loads.size(); ++i) {
    const auto* const load = std::get_if<PointLoad>(&deck.loads[i].action);
    if (load == nullptr || !acts_at(deck, load->at, plane.point)) continue;
    if ((across_x ? load->force.x : load->force.z) != 0.0)
      report("load", deck.loads[i].position, driven_thing("load", i) + " acts across",
             "leave out its component in " + axis + ", or model the whole");
    if (load->moment != 0.0)
      report("load", deck.loads[i].position, driven_thing("load", i) + " turns",
             "leave out its moment, or model the whole");
  }
  for (std::size_t i = 0; i < deck.prescribed.size(); ++i) {
    const Prescribed& moved = deck.prescribed[i];
    if (moved.point != plane.point) continue;
    if (across_x ? moved.x.has_value() : moved.z.has_value())
      report("prescribed", moved.position, driven_thing("prescribed", i) + " moves across",
             "leave out its " + axis + ", or model the whole");
    if (moved.rotation)
      report("prescribed", moved.position, driven_thing("prescribed", i) + " turns",
             "leave out its rotation, or model the whole");
  }
}

// What a movement that begins from a stage cannot be.
void check_grip(Keys& root, const Deck& deck, std::size_t which) {
  const Prescribed& moved = deck.prescribed[which];
  const std::string name = driven_thing("prescribed", which);
  Key key("prescribed");
  key.position = moved.position;
  const auto report = [&](const std::string& message, const std::string& cure) {
    root.report_key(key, name + " has from = \"stage\", " + message, cure);
  };
  if (moved.constant)
    return report("but is constant: it holds from the start", "leave out from, or leave out constant and drive it");
  if (deck.stages.empty())
    return report("but the deck has no stages",
                  "leave out from, or write [[stage]] tables, of which a later one drives it");
  if (gripping_stage(deck, which) == std::optional<std::size_t>(0))
    return report("but the first stage drives it: there is no stage before in which the point could move",
                  "leave out from, or let an earlier stage drive what moves the point");
  const auto holds = [](const Support& support, Dof direction) {
    return std::find(support.directions.begin(), support.directions.end(), direction) != support.directions.end();
  };
  const std::pair<Dof, bool> directions[] = {
      {Dof::x, moved.x.has_value()}, {Dof::z, moved.z.has_value()}, {Dof::rotation, moved.rotation.has_value()}};
  for (const Support& support : deck.supports)
    for (const auto& [direction, given] : directions)
      if (given && support.point == moved.point && holds(support, direction))
        return report(
            "but support." + support.point + " holds " + text_of(direction_words, direction) + " from the start",
            "leave out from, or take the direction from the support");
  for (std::size_t other = 0; other < deck.prescribed.size(); ++other) {
    if (other == which || deck.prescribed[other].point != moved.point) continue;
    if (deck.prescribed[other].from == MovedFrom::stage && other > which) continue;  // told there
    const std::string both = moved_by_both(deck.prescribed[other], moved);
    if (!both.empty())
      return report("but " + driven_thing("prescribed", other) + " holds " + moved.point + " in " + both + ", too",
                    "write one movement of the direction, and drive it in several stages");
  }
}

}  // namespace

// A constant movement and one that λ multiplies add, and so do those that stages drive apart.
void check_movements(Keys& root, const Deck& deck) {
  for (const Support& support : deck.supports)
    if (support.symmetry) check_plane(root, deck, support);
  for (std::size_t i = 0; i < deck.prescribed.size(); ++i)
    if (deck.prescribed[i].from == MovedFrom::stage) check_grip(root, deck, i);
  const auto name = [](std::size_t i) { return driven_thing("prescribed", i); };
  const auto driven_apart = [&](std::size_t a, std::size_t b) {
    return std::any_of(deck.stages.begin(), deck.stages.end(),
                       [&](const Stage& stage) { return drives(stage, name(a)) != drives(stage, name(b)); });
  };
  for (std::size_t i = 0; i < deck.prescribed.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Prescribed &second = deck.prescribed[i], &first = deck.prescribed[j];
      const std::string directions = moved_by_both(first, second);
      if (first.point != second.point || directions.empty() || first.constant != second.constant) continue;
      if (first.from == MovedFrom::stage || second.from == MovedFrom::stage) continue;  // reported as a grip
      if (!first.constant && driven_apart(i, j)) continue;
      Key key("prescribed");
      key.position = second.position;
      root.report_key(key, name(j) + " and " + name(i) + " both move " + first.point + " in " + directions,
                      "write one, or make one of them constant");
    }
}

void check_driven(Keys& root, const Deck& deck) {
  if (std::any_of(deck.loads.begin(), deck.loads.end(), follows_lambda)) return;
  const auto moves = [](const auto& moved) { return moves_with_lambda(moved); };
  if (std::any_of(deck.prescribed.begin(), deck.prescribed.end(), moves)) return;
  if (std::any_of(deck.walls.begin(), deck.walls.end(), moves)) return;
  const std::string cure =
      "add a [[load]] with at and force, a [[prescribed]] movement of a point, or a motion of a [[wall]]";
  if (deck.loads.empty() && deck.prescribed.empty())
    return root.report("load", "nothing varies with λ: there is no load, no prescribed movement and no wall that moves",
                       cure);
  root.report("load", "nothing varies with λ: all loads and movements are constant or zero", cure);
}

}  // namespace arcwall::deck
