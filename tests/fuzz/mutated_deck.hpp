#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace arcwall::fuzz {

/// Calls `use` with the text of a deck that differs from an example or a sample in some values, words, parts and lists,
/// as the data say; mostly one that is read. An InputError is an answer like any other. Returns 0, what libFuzzer
/// wants.
///
/// With ARCWALL_FUZZ_SHOW set in the environment the deck is printed, and the errors in it.
int with_mutated_deck(const std::uint8_t* data, std::size_t size, const std::function<void(const std::string&)>& use);

}  // namespace arcwall::fuzz
