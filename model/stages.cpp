#include "model/stages.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

namespace arcwall {

namespace {

deck::Vector times(double factor, const deck::Vector& v) { return {.x = factor * v.x, .z = factor * v.z}; }

void scale(deck::PointLoad& load, double factor) {
  load.force = times(factor, load.force);
  load.moment *= factor;
}
void scale(deck::MemberLoad& load, double factor) {
  load.distributed = times(factor, load.distributed);
  if (load.distributed_to) load.distributed_to = times(factor, *load.distributed_to);
}
void scale(deck::Pressure& load, double factor) { load.pressure *= factor; }
void scale(deck::Heat& heat, double factor) {
  heat.temperature *= factor;
  heat.gradient *= factor;
}

deck::Load held(deck::Load load, double gone) {
  if (auto* const at_point = std::get_if<deck::PointLoad>(&load.action)) {
    at_point->has_force = at_point->force != deck::Vector{};
    at_point->has_moment = at_point->moment != 0.0;
  }
  std::visit([gone](auto& action) { scale(action, gone); }, load.action);
  load.constant = true;
  return load;
}

deck::Prescribed held(deck::Prescribed moved, double gone) {
  for (std::optional<double>* value : {&moved.x, &moved.z, &moved.rotation})
    if (*value) **value *= gone;
  moved.constant = true;
  return moved;
}

// A movement at rest where its stage has taken hold of the point.
deck::Prescribed held_at(deck::Prescribed moved, const GripPlace& place) {
  if (moved.x) moved.x = place.x;
  if (moved.z) moved.z = place.z;
  if (moved.rotation) moved.rotation = place.rotation;
  moved.constant = true;
  return moved;
}

const DrivenThing& progress_of(const std::vector<DrivenThing>& progress, const std::string& name) {
  return *std::find_if(progress.begin(), progress.end(), [&](const DrivenThing& one) { return one.name == name; });
}

// What has gone so far is held, and what the stage drives goes on from there.
std::vector<deck::Load> loads_in_stage(const deck::Deck& deck, const deck::Stage& stage,
                                       const std::vector<DrivenThing>& progress) {
  std::vector<deck::Load> result;
  for (std::size_t i = 0; i < deck.loads.size(); ++i) {
    const deck::Load& load = deck.loads[i];
    const std::string name = deck::driven_thing("load", i);
    result.push_back(load.constant ? load : held(load, progress_of(progress, name).gone));
    if (!load.constant && drives(stage, name)) result.push_back(load);
  }
  return result;
}

// Likewise. Movements that are not driven stay in the list, so that they hold their directions; but one that takes hold
// of its point in a later stage leaves it free. From then on it counts from where the point was.
std::vector<deck::Prescribed> movements_in_stage(const deck::Deck& deck, std::size_t stage,
                                                 const std::vector<DrivenThing>& progress) {
  std::vector<deck::Prescribed> result;
  for (std::size_t i = 0; i < deck.prescribed.size(); ++i) {
    const deck::Prescribed& moved = deck.prescribed[i];
    if (moved.constant) {
      result.push_back(moved);
      continue;
    }
    const std::string name = deck::driven_thing("prescribed", i);
    const DrivenThing& so_far = progress_of(progress, name);
    const auto grips = gripping_stage(deck, i);
    result.push_back(held(moved, so_far.gone));
    result.back().holds = !grips || *grips <= stage;
    if (!result.back().holds) continue;
    if (grips) result.push_back(held_at(moved, so_far.grip));
    if (drives(deck.stages[stage], name)) result.push_back(moved);
  }
  return result;
}

}  // namespace

std::vector<std::size_t> grips_of(const deck::Deck& deck, std::size_t stage) {
  std::vector<std::size_t> grips;
  for (std::size_t i = 0; i < deck.prescribed.size(); ++i)
    if (gripping_stage(deck, i) == std::optional(stage)) grips.push_back(i);
  return grips;
}

std::vector<DrivenThing> things_to_drive(const deck::Deck& deck) {
  std::vector<DrivenThing> progress;
  for (const std::string& name : deck::driven_things(deck)) progress.push_back({.name = name});
  return progress;
}

std::shared_ptr<const deck::Deck> deck_of_stage(const std::shared_ptr<const deck::Deck>& whole, std::size_t stage,
                                                const std::vector<DrivenThing>& progress) {
  const deck::Deck& deck = *whole;
  if (deck.stages.empty()) return whole;
  const deck::Stage& now = deck.stages[stage];
  deck::Deck result = deck;
  result.loads = loads_in_stage(deck, now, progress);
  result.prescribed = movements_in_stage(deck, stage, progress);
  for (deck::Wall& wall : result.walls)
    if (wall.motion)
      wall.motion->progress = {.constant = progress_of(progress, "wall." + wall.name).gone,
                               .proportional = drives(now, "wall." + wall.name) ? 1.0 : 0.0};
  if (now.stop) result.path.stop = *now.stop;
  if (!now.output_at.empty()) result.path.output_at = now.output_at;
  result.path.step = now.step.value_or(deck.path.step);
  result.path.max_step = now.max_step.value_or(deck.path.max_step);
  result.path.branches = now.branches.value_or(deck.path.branches);
  result.stages.clear();
  return std::make_shared<const deck::Deck>(std::move(result));
}

bool is_driven_apart(const deck::Deck& deck, const std::string& member) {
  const auto acts_along = [&](const auto& action) {
    if constexpr (std::is_same_v<std::decay_t<decltype(action)>, deck::PointLoad>)
      return false;
    else
      return action.member == member;
  };
  return !deck.stages.empty() && std::any_of(deck.loads.begin(), deck.loads.end(), [&](const deck::Load& load) {
    return !load.constant && std::visit(acts_along, load.action);
  });
}

std::vector<DrivenThing> progress_after(const deck::Deck& deck, std::size_t stage, const StageEnd& end,
                                        std::vector<DrivenThing> progress) {
  const bool goes_on = stage + 1 < deck.stages.size() && deck.stages[stage + 1].goes_on;
  for (DrivenThing& one : progress)
    if (!goes_on && drives(deck.stages[stage], one.name)) one.gone += end.lambda;
  const std::vector<std::size_t> grips = grips_of(deck, stage + 1);
  for (std::size_t i = 0; i < grips.size(); ++i)
    for (DrivenThing& one : progress)
      if (one.name == deck::driven_thing("prescribed", grips[i])) one.grip = end.grips[i];
  return progress;
}

}  // namespace arcwall
