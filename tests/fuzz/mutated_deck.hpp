#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <string>

namespace arcwall::fuzz {

/// The text of a deck that differs from an example or a sample in some values, words, parts and lists; mostly one that
/// is read.
std::string mutated_deck(FuzzedDataProvider& data);

}  // namespace arcwall::fuzz
