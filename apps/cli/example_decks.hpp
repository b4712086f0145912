#pragma once

#include <string_view>
#include <vector>

namespace arcwall {

/// A deck, or a sweep over one, that comes with the program.
struct ExampleDeck {
  std::string_view name{};
  std::string_view text{};
};

/// In the order of their names; made from the files of examples/ when the program is built.
const std::vector<ExampleDeck>& example_decks();

/// Decks of real devices, likewise: each has a number that can be had by hand.
const std::vector<ExampleDeck>& example_devices();

/// The sweeps, likewise.
const std::vector<ExampleDeck>& example_sweeps();

}  // namespace arcwall
