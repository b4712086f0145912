#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "model/event_names.hpp"

namespace arcwall::test {

/// The text of a deck, traced to the end of its paths. What does not speak of jumps has none, which would take time.
inline Session traced(const std::string& deck, std::vector<std::string> assignments = {}) {
  const auto speaks = [](const std::string& text) { return text.find("jumps") != std::string::npos; };
  if (!speaks(deck) && std::none_of(assignments.begin(), assignments.end(), speaks))
    assignments.emplace_back("path.jumps=false");
  Session run = make_session({.deck = "deck.toml", .deck_text = deck, .assignments = assignments});
  if (!run.begin()) ADD_FAILURE() << run.problem();
  while (run.next() != nullptr) {
  }
  return run;
}

/// The events of a kind, in their order.
inline std::vector<RecordEvent> events_of(const Record& record, EventKind kind) {
  std::vector<RecordEvent> found;
  for (const RecordEvent& event : record.events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

/// One of them, the first being number 1. Throws if there is none.
inline const RecordEvent& event_of(const Record& record, EventKind kind, int number = 1) {
  for (const RecordEvent& event : record.events)
    if (event.kind == kind && --number == 0) return event;
  throw std::runtime_error("there is no such " + std::string(to_text(kind)));
}

}  // namespace arcwall::test
