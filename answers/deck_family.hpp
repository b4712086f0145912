#pragma once

#include <list>
#include <memory>
#include <string>
#include <utility>

#include "continuation/event_curves/system_family.hpp"
#include "core/error.hpp"
#include "model/deck/numbers.hpp"
#include "model/model.hpp"

namespace arcwall {

/// The models of a deck with other values of one of its numbers. They are built when they are asked for, from the deck
/// with the value in place, and the last ones are kept.
class DeckFamily final : public SystemFamily {
 public:
  /// `deck`: without stages. Throws InputError where it is wrong.
  DeckFamily(const deck::Deck& deck, deck::DeckNumber number);
  ~DeckFamily() override;

  /// The model of the deck's own value, in whose terms states are common.
  const Model& own() const { return *own_; }

  /// The model for a value; null where there is no such deck: problem() then says why.
  std::shared_ptr<const Model> model(double value) const;

  /// What was wrong with the last deck that was asked for and could not be built; empty if all could since another
  /// such was put in its place.
  const std::string& problem() const { return problem_; }
  void recall_problem(std::string problem) const { problem_ = std::move(problem); }

  /// What turns or passes a value at the event, a monitor or `lambda`, which members have from then on.
  void set_watched(std::string name) { watched_ = std::move(name); }

  std::optional<Member> at(double kappa, const State& state) const override;
  std::optional<State> in_common_terms(const State& state) const override;
  double spacing() const override { return spacing_; }

 private:
  struct Kept;

  Kept& kept(double value) const;

  deck::Deck deck_;
  std::string text_;  // of the deck
  deck::DeckNumber number_;
  std::string watched_;
  std::shared_ptr<const Model> own_;
  double spacing_ = 0.0;
  mutable std::list<Kept> kept_;  // the last one asked for first
  mutable std::string problem_;
};

/// A state in the unknowns of another model of a family; empty where its mesh is another one.
std::optional<State> state_on(const Model& model, const State& state);

/// The first thing that is wrong, with its key.
std::string first_message(const InputError& error);

}  // namespace arcwall
