#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "apps/cli/example_decks.hpp"
#include "model/session.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::test {

/// A deck and the record of its run, in memory.
class TracedDeck {
 public:
  explicit TracedDeck(std::string_view text, const std::vector<std::string>& assignments = {})
      : run_(traced(std::string(text), assignments)) {}

  const Session& session() const { return run_; }
  const Model& model() const { return run_.model(); }
  const Record& record() const { return run_.record(); }
  const State& last() const { return record().points.back().state; }

 private:
  Session run_;
};

inline std::vector<RecordEvent> events_of(const TracedDeck& traced, EventKind kind) {
  return events_of(traced.record(), kind);
}

inline const RecordEvent& event_of(const TracedDeck& traced, EventKind kind, int number = 1) {
  return event_of(traced.record(), kind, number);
}

/// The first problem of a deck that is refused; empty of one that runs.
inline std::string said_of(const std::string& deck) {
  try {
    const TracedDeck run(deck);
  } catch (const InputError& error) {
    return to_text(error.diagnostics().front());
  }
  return {};
}

/// The text of an example or a device that comes with the program.
inline std::string_view example(const std::string& name) {
  for (const auto* const decks : {&example_devices(), &example_decks()})
    for (const ExampleDeck& deck : *decks)
      if (deck.name == name) return deck.text;
  ADD_FAILURE() << "no example is called " << name;
  return {};
}

}  // namespace arcwall::test
