#include "apps/output/load_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "apps/output/report_data.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/words.hpp"

namespace arcwall {

namespace {

std::string short_number(double value) { return fmt::format("{:.6g}", value); }
std::string pair_text(const deck::Vector& v) { return fmt::format("({:.6g}, {:.6g})", v.x, v.z); }
bool acts_nowhere(const deck::Vector& v) { return v.x == 0.0 && v.z == 0.0; }

LoadText load_words(const deck::PointLoad& load, const deck::Units& units) {
  const std::string moment_unit = unit_text(deck::unit::moment, units);
  const bool pushes = !acts_nowhere(load.force), turns = load.moment != 0.0;
  LoadText result{.text = "at " + to_text(load.at)};
  if (pushes) result.text += " force " + with_unit(pair_text(load.force), units.force);
  if (turns) result.text += " moment " + with_unit(short_number(load.moment), moment_unit);
  if (units.force.empty() || pushes == turns) return result;
  result.size = pushes ? with_unit(short_number(std::hypot(load.force.x, load.force.z)), units.force)
                       : with_unit(short_number(std::abs(load.moment)), moment_unit);
  return result;
}

LoadText load_words(const deck::MemberLoad& load, const deck::Units& units) {
  const std::string unit = unit_text(deck::unit::line_load, units);
  LoadText result{.text = "on " + load.member + " " + with_unit(pair_text(load.distributed), unit)};
  if (load.distributed_to) result.text += " to " + with_unit(pair_text(*load.distributed_to), unit);
  if (load.frame == LoadFrame::member) result.text += " along and across its axis";
  if (load.per == LoadMeasure::plan) result.text += " per length in x";
  if (!unit.empty() && !load.distributed_to)
    result.size = with_unit(short_number(std::hypot(load.distributed.x, load.distributed.z)), unit);
  return result;
}

// `z 2.5 kN/cm, rotation 3 kN cm`: those that are not zero.
std::string stiffness_words(const deck::Stiffness& k, const deck::Units& units) {
  std::string text;
  const auto add = [&](const char* direction, double value, const deck::Dimension& unit) {
    if (value == 0.0) return;
    text += (text.empty() ? "" : ", ") + std::string(direction) + " " +
            with_unit(short_number(value), unit_text(unit, units));
  };
  add("x", k.x, deck::unit::line_load);
  add("z", k.z, deck::unit::line_load);
  add("rotation", k.rotation, deck::unit::moment);
  return text;
}

std::string law_words(const deck::TableLaw& law) {
  return deck::text_of(deck::spring_direction_words, law.direction) + " by a law of " +
         std::to_string(law.displacement.size()) + " points";
}

std::string spring_words(const deck::GroundSpring& spring, const deck::Units& units) {
  return "at " + to_text(spring.at) + " " +
         (spring.law ? law_words(*spring.law) : stiffness_words(spring.stiffness, units));
}

std::string spring_words(const deck::PointToPointSpring& spring, const deck::Units& units) {
  return "between " + spring.points[0] + " and " + spring.points[1] + " " +
         (spring.law ? law_words(*spring.law) : stiffness_words(spring.stiffness, units));
}

std::string spring_words(const deck::Foundation& foundation, const deck::Units& units) {
  if (foundation.law) return "foundation of " + foundation.member + " " + law_words(*foundation.law);
  return "foundation of " + foundation.member + " " +
         with_unit(pair_text({.x = foundation.x, .z = foundation.z}), unit_text(deck::unit::stress, units));
}

LoadText load_words(const deck::Heat& heat, const deck::Units&) {
  LoadText result{.text = "on " + heat.member, .name = "heat of " + heat.member, .size = ""};
  if (heat.temperature != 0.0) result.text += " temperature " + short_number(heat.temperature);
  if (heat.gradient != 0.0) result.text += " gradient " + short_number(heat.gradient);
  if (heat.gradient == 0.0) result = {.text = result.text, .name = "temperature of " + heat.member, .size = ""};
  return result;
}

LoadText load_words(const deck::Pressure& load, const deck::Units& units) {
  const std::string unit = unit_text(deck::unit::line_load, units);
  LoadText result{.text = "on " + load.member + " pressure " + with_unit(short_number(load.pressure), unit),
                  .name = "pressure on " + load.member};
  if (!unit.empty()) result.size = with_unit(short_number(std::abs(load.pressure)), unit);
  return result;
}

}  // namespace

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

LoadText load_text(const deck::Load& load, const deck::Units& units) {
  return std::visit([&](const auto& action) { return load_words(action, units); }, load.action);
}

std::string spring_text(const deck::Spring& spring, const deck::Units& units) {
  return std::visit([&](const auto& kind) { return spring_words(kind, units); }, spring.kind);
}

// Of one direction the size is that of its value.
LoadText movement_text(const deck::Prescribed& moved, const deck::Units& units) {
  LoadText result{.text = "", .name = "", .size = ""};
  const auto add = [&](const std::string& what, const std::optional<double>& value, const std::string& unit) {
    if (!value) return;
    const bool first = result.name.empty();
    result.name = first ? what + " of " + moved.point : "movement of " + moved.point;
    result.size = first && !unit.empty() ? with_unit(short_number(std::abs(*value)), unit) : "";
    result.text += (first ? "" : ", ") + what + " of " + moved.point + " " + with_unit(short_number(*value), unit);
  };
  add("displacement in x", moved.x, units.length);
  add("displacement in z", moved.z, units.length);
  add("rotation", moved.rotation, "rad");
  if (moved.from == deck::MovedFrom::stage) result.text += " from where it is when its stage begins";
  return result;
}

LoadText movement_text(const deck::Wall& wall, const deck::Units& units) {
  const deck::WallMotion& motion = *wall.motion;
  LoadText result{.text = "wall " + wall.name, .name = "way of " + wall.name, .size = ""};
  const bool goes = motion.x != 0.0 || motion.z != 0.0, turns = motion.rotation != 0.0;
  if (goes) result.text += " by " + with_unit(pair_text({.x = motion.x, .z = motion.z}), units.length);
  if (turns) result.text += " turned by " + short_number(motion.rotation) + " rad";
  if (goes && !turns && !units.length.empty())
    result.size = with_unit(short_number(std::hypot(motion.x, motion.z)), units.length);
  if (turns && !goes)
    result = {.text = result.text, .name = "rotation of " + wall.name, .size = short_number(motion.rotation) + " rad"};
  return result;
}

std::vector<LoadText> driven_by_lambda(const deck::Deck& deck, const deck::Stage* stage) {
  std::vector<LoadText> driven;
  const auto is_driven = [&](const std::string& thing) { return stage == nullptr || drives(*stage, thing); };
  const auto add = [&](LoadText text, std::string key) {
    text.key = std::move(key);
    driven.push_back(std::move(text));
  };
  for (std::size_t i = 0; i < deck.loads.size(); ++i) {
    const std::string thing = deck::driven_thing("load", i);
    if (deck.loads[i].constant || !is_driven(thing)) continue;
    add(load_text(deck.loads[i], deck.units), thing);
    driven.back().text = "load " + driven.back().text;
  }
  for (std::size_t i = 0; i < deck.prescribed.size(); ++i) {
    const std::string thing = deck::driven_thing("prescribed", i);
    if (!deck.prescribed[i].constant && is_driven(thing)) add(movement_text(deck.prescribed[i], deck.units), thing);
  }
  for (const deck::Wall& wall : deck.walls)
    if (wall.motion && is_driven("wall." + wall.name))
      add(movement_text(wall, deck.units), "wall." + wall.name + ".motion");
  return driven;
}

std::string name_of_lambda(const deck::Deck& deck, const deck::Stage* stage) {
  const std::vector<LoadText> driven = driven_by_lambda(deck, stage);
  if (driven.size() != 1 || driven.front().name == LoadText{}.name) return "";
  return driven.front().name + (driven.front().size.empty() ? "" : ", times " + driven.front().size);
}

std::string title_of_lambda(const std::vector<LoadText>& driven) {
  if (driven.size() != 1) return "load factor λ";
  const LoadText& one = driven.front();
  return shown_name(one.name) + " λ" + (one.size.empty() ? "" : ", times " + shown_name(one.size));
}

bool is_movement(const std::vector<LoadText>& driven) {
  const auto is_load = [](const LoadText& one) { return one.key.empty() || one.key.starts_with("load."); };
  return !driven.empty() && std::none_of(driven.begin(), driven.end(), is_load);
}

std::vector<std::string> names_of_lambda(const deck::Deck& deck) {
  if (deck.stages.empty()) return {name_of_lambda(deck)};
  std::vector<std::string> names;
  for (const deck::Stage& stage : deck.stages) names.push_back(name_of_lambda(deck, &stage));
  return names;
}

}  // namespace arcwall
