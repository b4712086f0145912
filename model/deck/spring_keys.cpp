// Springs.
#include <string>
#include <variant>
#include <vector>

#include "core/text.hpp"
#include "model/deck/cursor.hpp"
#include "model/deck/deck_keys.hpp"
#include "model/deck/key_reader.hpp"

namespace arcwall::deck {

namespace {

// The stiffness of either kind of spring at points: one key, which says the same of both.
Stiffness* stiffness_of(Spring& spring) {
  if (auto* ground = std::get_if<GroundSpring>(&spring.kind)) return &ground->stiffness;
  if (auto* between = std::get_if<PointToPointSpring>(&spring.kind)) return &between->stiffness;
  return nullptr;
}

void stiffness_key(Keys& keys, Stiffness& stiffness) {
  bool right = true;
  const auto one = [&](Keys& of, const char* key, double& value, const Dimension& unit) {
    right = of.number(optional(key), value, unit, not_negative, "") == of.has(key) && right;
  };
  keys.table(
      "stiffness", Form::in_line,
      [&](Keys& of) {
        one(of, "x", stiffness.x, unit::line_load);
        one(of, "z", stiffness.z, unit::line_load);
        one(of, "rotation", stiffness.rotation, unit::moment);
        if (of.reads() && right && stiffness == Stiffness{})
          keys.report("stiffness", "the spring has no stiffness", "give x, z or rotation, greater than 0");
      },
      "[force/length], of the rotation [force length]; at least one > 0");
}

void between_keys(Keys& keys, const Deck& deck, PointToPointSpring& spring) {
  if (!keys.names("between", spring.points, Named::point, EmptyList::refused,
                  "instead of `at`: two points, of whose displacements and rotations the differences count"))
    return;
  if (spring.points.size() != 2)
    return keys.report("between",
                       "a spring joins two points, and this one names " + std::to_string(spring.points.size()),
                       "name two points");
  for (const std::string& point : spring.points)
    if (!ends_a_member(deck, point))
      keys.report("between", "no member ends at point " + point, "name points at the ends of members");
}

void foundation_keys(Keys& keys, Foundation& foundation) {
  keys.name("on", foundation.member, Named::member, "instead of `at`: a member, with `foundation`");
  keys.table(
      "foundation", Form::in_line,
      [&](Keys& of) {
        const bool x = of.number(optional("x"), foundation.x, unit::stress, not_negative, "");
        const bool z = of.number(optional("z"), foundation.z, unit::stress, not_negative, "");
        const bool right = x == of.has("x") && z == of.has("z");
        if (of.reads() && right && foundation.x == 0.0 && foundation.z == 0.0)
          keys.report("foundation", "the foundation has no stiffness", "give x or z, greater than 0");
      },
      "springs to the ground all along the member: force per length of the undeformed axis and of displacement "
      "[force/length²]; at least one > 0");
}

void spring_keys(Keys& keys, Spring& spring, const Deck& deck) {
  std::vector<std::string> given;
  for (const char* key : {"at", "between", "on"})
    if (keys.has(key)) given.emplace_back(key);
  if (keys.reads() && given.size() != 1) {
    keys.report(given.empty() ? "at" : given[1],
                given.empty() ? "the spring has none of `at`, `between` and `on`"
                              : "the spring has both `" + given[0] + "` and `" + given[1] + "`",
                "give `at` for a spring to the ground, `between` for one between two points, or `on` for a foundation");
    return keys.give_up();
  }
  keys.alternative<GroundSpring>(
      "at", spring.kind, [&](GroundSpring& ground) { keys.place("at", ground.at, "a place: spring to the ground"); });
  keys.alternative<PointToPointSpring>("between", spring.kind,
                                       [&](PointToPointSpring& between) { between_keys(keys, deck, between); });
  const bool along = keys.reads() ? keys.has("on") : std::holds_alternative<Foundation>(spring.kind);
  if (keys.applies(!along, "stiffness", "belongs to a spring at points", "give `foundation` instead"))
    stiffness_key(keys, *stiffness_of(spring));
  keys.alternative<Foundation>("on", spring.kind, [&](Foundation& foundation) { foundation_keys(keys, foundation); });
  if (keys.reads() && !along)
    keys.applies(false, "foundation", "belongs to a spring along a member", "write `on`, or give stiffness");
}

}  // namespace

void declare_springs(Keys& root, Deck& deck) {
  root.tables(
      optional("spring"), deck.springs, [&](Keys& keys, Spring& spring) { spring_keys(keys, spring, deck); }, "");
}

}  // namespace arcwall::deck
