#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "tests/model/deck/sample_decks.hpp"

/// Decks that are wrong in one place, and what is said of it.
namespace arcwall::deck::bad_decks_test {

/// The full deck with one place changed, and a diagnostic that must be among those for it.
struct BadDeck {
  const char* from;
  const char* to;
  const char* key;              ///< the diagnostic's key ends with this
  const char* says;             ///< part of its message or its cure
  std::optional<int> line = 0;  ///< counted from that of the change; empty: elsewhere
};

inline constexpr std::optional<int> elsewhere = std::nullopt;

inline std::vector<Diagnostic> diagnostics_of(const std::string& text) {
  try {
    read_deck_text(text, "bad.toml");
  } catch (const InputError& error) {
    return error.diagnostics();
  }
  return {};
}

inline std::string all_of(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) text += to_text(diagnostic) + "\n";
  return text;
}

inline int line_of(std::string_view text, std::string_view part) {
  const std::string_view before = text.substr(0, text.find(part));
  return static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
}

inline bool matches(const Diagnostic& found, const BadDeck& bad) {
  const bool line = !bad.line || found.line == line_of(full_deck, bad.from) + *bad.line;
  const bool says = (found.message + "; " + found.cure).find(bad.says) != std::string::npos;
  return line && says && found.key.ends_with(bad.key) && found.file == "bad.toml";
}

inline void expect_refused(const std::vector<BadDeck>& decks) {
  for (const BadDeck& bad : decks) {
    const auto found = diagnostics_of(replaced(full_deck, bad.from, bad.to));
    const bool matched = std::any_of(found.begin(), found.end(), [&bad](const auto& one) { return matches(one, bad); });
    EXPECT_TRUE(matched) << bad.from << " -> " << bad.to << "\n" << all_of(found);
  }
}

}  // namespace arcwall::deck::bad_decks_test
