#pragma once

#include <string>
#include <vector>

#include "tests/apps/traced_deck.hpp"

namespace arcwall::verify {

/// Decks whose events are of all kinds but spreads.
inline std::vector<test::TracedDeck> decks_with_events() {
  std::vector<test::TracedDeck> decks;
  decks.emplace_back(test::example("channel"));
  decks.emplace_back(test::example("channel"),
                     std::vector<std::string>{"contact.points=\"nodes\"", "member.column.elements=16"});
  decks.emplace_back(test::example("arch"));
  decks.emplace_back(test::example("cylinder"));
  decks.emplace_back(test::example("foundation"));
  decks.emplace_back(test::example("lee"), std::vector<std::string>{"path.watch=[\"down\", \"right\"]"});
  decks.emplace_back(test::example("truss"));
  return decks;
}

}  // namespace arcwall::verify
