#include "model/deck_family.hpp"

#include <algorithm>
#include <utility>

#include "model/deck/writer.hpp"
#include "model/sensitivities.hpp"

namespace arcwall {

namespace {

constexpr std::size_t most_kept = 16;

}  // namespace

struct DeckFamily::Kept {
  double value = 0.0;
  std::shared_ptr<const Model> model{};  // null: there is no such deck
  std::string problem{};                 // then
  Piece common{}, own{};                 // the piece that was asked for last, and what it is there
  bool has_piece = false;
};

DeckFamily::DeckFamily(const deck::Deck& deck, deck::DeckNumber number)
    : deck_(without_answers(deck)), text_(deck::to_toml(deck_)), number_(std::move(number)) {
  own_ = std::make_shared<const Model>(deck_);
  spacing_ = natural_step(number_, own_->structure());
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
    made.model = value == number_.value
                     ? own_
                     : std::make_shared<const Model>(deck::with_number(text_, deck_.source.file, number_, value));
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
  if (!one.has_piece || !(one.common == state.piece)) {
    const auto there = state_on(*one.model, state);
    if (!there) {
      problem_ = "its mesh is another one";
      return std::nullopt;
    }
    one.common = state.piece;
    one.own = there->piece;
    one.has_piece = true;
  }
  Member member{.system = std::shared_ptr<const System>(one.model, &one.model->system()),
                .state = {.x = state.x, .lambda = state.lambda, .piece = one.own}};
  if (!turning_.empty())
    for (const Watch& watch : one.model->watched())
      if (watch.label == turning_) member.turning = watch.quantity;
  return member;
}

std::string first_message(const InputError& error) {
  const Diagnostic& first = error.diagnostics().front();
  return (first.key.empty() ? "" : first.key + ": ") + first.message;
}

std::optional<State> state_on(const Model& model, const State& state) {
  if (model.sliding() != nullptr) return model.sliding()->taken_over(state);
  const System& system = model.system();
  if (system.open_piece().size() != state.piece.size() || system.size(state.piece) != state.x.size())
    return std::nullopt;
  return state;
}

}  // namespace arcwall
