#include "answers/deck_family.hpp"

#include <algorithm>
#include <utility>

#include "answers/sensitivities.hpp"
#include "model/deck/writer.hpp"

namespace arcwall {

namespace {

constexpr std::size_t most_kept = 16;

}  // namespace

struct DeckFamily::Kept {
  double value = 0.0;
  std::shared_ptr<const Model> model{};  // null: there is no such deck
  std::string problem{};                 // then
  ActiveSet common{}, own{};             // the active set that was asked for last, and what it is there
  bool has_active_set = false;
};

DeckFamily::DeckFamily(const deck::Deck& deck, deck::DeckNumber number)
    : deck_(without_answers(deck)), text_(deck::to_toml(deck_)), number_(std::move(number)) {
  own_ = std::make_shared<const Model>(deck_);
  spacing_ = natural_step(number_, *own_);
}

DeckFamily::~DeckFamily() = default;

DeckFamily::Kept& DeckFamily::kept(double value) const {
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& one) { return one.value == value; });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    if (!found->model) problem_ = found->problem;
    return kept_.front();
  }
  Kept made{.value = value};
  try {
    made.model =
        value == number_.value
            ? own_
            : std::make_shared<const Model>(deck::with_number(text_, deck_.source.file, number_, value), own_->frame());
  } catch (const InputError& error) {
    problem_ = made.problem = first_message(error);
  }
  kept_.push_front(std::move(made));
  if (kept_.size() > most_kept) kept_.pop_back();
  return kept_.front();
}

std::shared_ptr<const Model> DeckFamily::model(double value) const { return kept(value).model; }

std::optional<State> DeckFamily::in_common_terms(const State& state) const { return state_on(*own_, state); }

std::optional<SystemFamily::Member> DeckFamily::at(double kappa, const State& state) const {
  Kept& one = kept(kappa);
  if (!one.model) return std::nullopt;
  if (!one.has_active_set || !(one.common == state.active_set)) {
    const auto there = state_on(*one.model, state);
    if (!there) {
      problem_ = "its mesh is another one";
      return std::nullopt;
    }
    one.common = state.active_set;
    one.own = there->active_set;
    one.has_active_set = true;
  }
  Member member{.system = std::shared_ptr<const System>(one.model, &one.model->system()),
                .state = {.x = state.x, .lambda = state.lambda, .active_set = one.own}};
  if (!watched_.empty()) member.watched = one.model->quantity(watched_);
  return member;
}

std::string first_message(const InputError& error) {
  const Diagnostic& first = error.diagnostics().front();
  return (first.key.empty() ? "" : first.key + ": ") + first.message;
}

// A law whose slopes are equal on both sides of a stretch has a kink there for other values.
std::optional<State> state_on(const Model& model, const State& state) {
  if (model.sliding() != nullptr) {
    auto taken_over = model.sliding()->taken_over(state);
    return taken_over ? std::optional(model.with_kinks(std::move(*taken_over))) : std::nullopt;
  }
  const System& system = model.system();
  if (system.open_active_set().contacts() != state.active_set.contacts() ||
      system.size(state.active_set) != state.x.size())
    return std::nullopt;
  return model.with_kinks(state);
}

}  // namespace arcwall
