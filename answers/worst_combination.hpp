#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/deck/deck.hpp"

namespace arcwall {

/// The change of some numbers of a deck, of a given norm, that lowers λ of an event most.
struct WorstCombination {
  std::vector<std::string> keys{};
  std::vector<double> own{};     ///< the deck's values
  std::vector<double> values{};  ///< the worst ones
  std::vector<double> slopes{};  ///< dλ/dvalue there
  double own_lambda = 0.0;       ///< of the event of the deck
  double lambda = 0.0;           ///< of the event with the worst values
  int runs = 0;                  ///< of decks
  bool settled = false;          ///< the direction has settled: the change points against the slopes
  std::string problem{};         ///< why there is none; empty otherwise
};

/// By the sensitivities of the event: from the deck's values in the direction in which λ falls fastest, and again with
/// the slopes that are found there, until the direction stays (docs/theory.md, section 14). Throws InputError where the
/// deck is wrong. `stopped` is asked between runs; true ends the search.
WorstCombination worst_combination(const deck::Deck& deck, const std::function<bool()>& stopped);

}  // namespace arcwall
