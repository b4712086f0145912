#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "apps/cli/example_decks.hpp"
#include "model/session.hpp"

namespace arcwall::test {

/// A deck and the record of its run, in memory.
class TracedDeck {
 public:
  explicit TracedDeck(std::string_view text, const std::vector<std::string>& assignments = {})
      : run_({.deck = "deck.toml", .deck_text = std::string(text), .assignments = assignments}) {
    if (!run_.begin()) ADD_FAILURE() << run_.problem();
    while (run_.next() != nullptr) {
    }
  }

  const Session& session() const { return run_; }
  const Model& model() const { return run_.model(); }
  const Record& record() const { return run_.record(); }
  const State& last() const { return record().points.back().state; }

 private:
  Session run_;
};

/// The text of an example that comes with the program.
inline std::string_view example(const std::string& name) {
  for (const ExampleDeck& deck : example_decks())
    if (deck.name == name) return deck.text;
  ADD_FAILURE() << "no example is called " << name;
  return {};
}

}  // namespace arcwall::test
