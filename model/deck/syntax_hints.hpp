#pragma once

#include <optional>
#include <string_view>

#include "model/deck/deck.hpp"

namespace arcwall::deck {

/// What a text that is not TOML was likely meant to be: text without quotes, a decimal comma, a bracket that is
/// missing. `refused` is where the parser stopped. Empty if it looks like none of the usual mistakes; else with line,
/// column, message and cure.
std::optional<Diagnostic> syntax_hint(std::string_view text, const Position& refused);

}  // namespace arcwall::deck
