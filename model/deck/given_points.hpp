#pragma once

#include <string>

#include "model/deck/cursor.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

/// Gives profiles and outlines of a document the lists `x` and `z` in place of `points`, a list of [x, z] or the name
/// of a CSV file in the folder of the deck, and smooths them where `smoothing` asks for it. Reports what is wrong.
void use_given_points(Value& root, const std::string& deck_file, Findings& findings);

/// The text of a deck's file in which lists of points stand in place of the names of their files, on the same lines:
/// what is done with it later needs no other file. A file that cannot be read stays, for the reader to report.
std::string read_deck_file(const std::string& file);

}  // namespace arcwall::deck
