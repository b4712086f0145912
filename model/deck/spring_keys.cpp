// Springs.
#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/text.hpp"
#include "model/deck/cursor.hpp"
#include "model/deck/deck_keys.hpp"
#include "model/deck/key_reader.hpp"
#include "model/deck/words.hpp"

namespace arcwall::deck {

namespace {

// The stiffness of either kind of spring at points: one key, which says the same of both.
Stiffness* stiffness_of(Spring& spring) {
  if (auto* ground = std::get_if<GroundSpring>(&spring.kind)) return &ground->stiffness;
  if (auto* between = std::get_if<PointToPointSpring>(&spring.kind)) return &between->stiffness;
  return nullptr;
}

std::optional<TableLaw>* law_of(Spring& spring) {
  if (auto* ground = std::get_if<GroundSpring>(&spring.kind)) return &ground->law;
  if (auto* between = std::get_if<PointToPointSpring>(&spring.kind)) return &between->law;
  return nullptr;
}

void check_law(Keys& keys, const TableLaw& law) {
  const auto& u = law.displacement;
  const auto& force = law.force;
  if (u.size() != force.size() || u.size() < 2)
    return keys.report(
        "force",
        "the law has " + std::to_string(u.size()) + " displacements and " + std::to_string(force.size()) + " forces",
        "give as many of both, at least 2");
  if (std::adjacent_find(u.begin(), u.end(), std::greater_equal<>()) != u.end())
    return keys.report("displacement", "the displacements do not increase", "order them, each once");
  // Between such points the stiffness is a quotient of what is lost in the digits of the whole.
  constexpr double least_step = 1e-9;
  for (std::size_t i = 1; i < u.size(); ++i)
    if (u[i] - u[i - 1] <= least_step * (u.back() - u.front()))
      return keys.report(
          "displacement",
          round_trip(u[i - 1]) + " and " + round_trip(u[i]) + " are the same to 9 digits of the law's displacements",
          "remove one of them");
  if (std::all_of(force.begin(), force.end(), [](double f) { return f == 0.0; }))
    return keys.report("force", "the spring has no force", "give forces other than 0");
  const auto rest = std::find(u.begin(), u.end(), 0.0);
  if (rest == u.end() || force[static_cast<std::size_t>(rest - u.begin())] != 0.0)
    keys.report("displacement", "the spring is not without force at displacement 0",
                "let one of the displacements be 0, with force 0");
}

// Of a spring at points straight pieces are the default.
void law_keys(Keys& keys, TableLaw& law, bool at_points) {
  keys.table(
      optional("law", "none"), Form::in_line,
      [&](Keys& of) {
        of.word("direction", law.direction, spring_direction_words, "");
        const bool u = of.numbers("displacement", law.displacement, unit::none, "");
        const bool force = of.numbers("force", law.force, unit::none, "");
        of.word(optional("interpolation", at_points ? "linear" : "smooth"), law.interpolation, interpolation_words, "");
        if (of.reads() && at_points && !law.interpolation) law.interpolation = SpringLaw::Interpolation::linear;
        if (of.reads() && u && force) check_law(of, law);
      },
      "instead of `stiffness` or `foundation`: table of `force` (of a foundation per length) over `displacement` in "
      "one `direction` (`\"x\"`, `\"z\"`, `\"rotation\"`), constant beyond its ends. `interpolation` is `\"linear\"` "
      "(default of springs at points) or `\"smooth\"` (the only one of foundations)");
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
                  "instead of `at`: two points; their relative displacement counts"))
    return;
  if (spring.points.size() != 2)
    return keys.report("between",
                       "a spring joins two points, and this one names " + std::to_string(spring.points.size()),
                       "name two points");
  for (const std::string& point : spring.points)
    if (!ends_a_member(deck, point))
      keys.report("between", "no member ends at point " + point, "name points at the ends of members");
}

// The key `law` is listed with springs at points.
void foundation_law_key(Keys& keys, Foundation& foundation) {
  keys.part("law", foundation.law, [&](TableLaw& law) {
    law_keys(keys, law, false);
    if (keys.reads() && law.direction == Dof::rotation)
      keys.report("law", "a foundation resists no rotation", "give direction = \"x\" or \"z\"");
    if (keys.reads() && law.interpolation == SpringLaw::Interpolation::linear)
      keys.report(
          "law", "the law of a foundation cannot be linear: each of its places would come to a kink by itself",
          "give interpolation = \"smooth\" and a point close to either side of each kink, or springs at points");
  });
}

void foundation_keys(Keys& keys, Foundation& foundation) {
  keys.name("on", foundation.member, Named::member, "instead of `at`: a member, with `foundation` or a law");
  if (!keys.lists()) foundation_law_key(keys, foundation);
  if (foundation.law || (keys.reads() && keys.has("law"))) {
    keys.applies(false, "foundation", "does not go together with a law", "write two springs");
    return;
  }
  keys.table(
      "foundation", Form::in_line,
      [&](Keys& of) {
        const bool x = of.number(optional("x"), foundation.x, unit::stress, not_negative, "");
        const bool z = of.number(optional("z"), foundation.z, unit::stress, not_negative, "");
        const bool right = x == of.has("x") && z == of.has("z");
        if (of.reads() && right && foundation.x == 0.0 && foundation.z == 0.0)
          keys.report("foundation", "the foundation has no stiffness", "give x or z, greater than 0");
      },
      "springs to the ground along the member: force per undeformed length and displacement; at least one > 0");
}

void name_key(Keys& keys, Spring& spring, const Deck& deck) {
  if (keys.writes() && spring.name.empty()) return;
  if (!keys.text(optional("name", "none"), spring.name, "letters, digits, _ and -; for monitors")) return;
  if (!is_name(spring.name)) {
    keys.report("name", in_quotes(spring.name, 60) + " is no name", "use letters, digits, _ and - only");
  } else if (find(deck.springs, spring.name) != nullptr) {
    keys.report("name", in_quotes(spring.name) + " is the name of another spring", "give each spring its own");
  }
}

void spring_keys(Keys& keys, Spring& spring, const Deck& deck) {
  name_key(keys, spring, deck);
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
  keys.alternative<GroundSpring>("at", spring.kind, [&](GroundSpring& ground) {
    keys.place("at", ground.at, "location of a spring to the ground");
  });
  keys.alternative<PointToPointSpring>("between", spring.kind,
                                       [&](PointToPointSpring& between) { between_keys(keys, deck, between); });
  const bool along = keys.reads() ? keys.has("on") : std::holds_alternative<Foundation>(spring.kind);
  const bool has_law = !along && (keys.reads() ? keys.has("law") : law_of(spring)->has_value());
  if (has_law) keys.applies(keys.lists(), "stiffness", "does not go together with a law", "write two springs");
  if (!has_law && keys.applies(!along, "stiffness", "belongs to a spring at points", "give `foundation` instead"))
    stiffness_key(keys, *stiffness_of(spring));
  if (!along) keys.part("law", *law_of(spring), [&](TableLaw& law) { law_keys(keys, law, true); });
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
