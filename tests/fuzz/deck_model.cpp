// Decks with odd values as models: what a deck builds, what `check` says of it and the state that it starts from are
// values, or there is an InputError. What follows from there is the matter of deck_path. To bring constant loads on
// takes up to some seconds, so one deck in 32 has to start.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "apps/cli/summary.hpp"
#include "model/deck/reader.hpp"
#include "model/model.hpp"
#include "tests/fuzz/mutated_deck.hpp"
#include "tests/fuzz/one_in.hpp"
#include "tests/fuzz/require.hpp"

namespace arcwall::fuzz {
namespace {

// Of a model of some tenths of a millisecond.
constexpr std::int64_t most_elements = 20;

std::int64_t elements(const deck::Deck& deck) {
  std::int64_t count = 0;
  for (const deck::Member& member : deck.members) count += member.elements;
  return count;
}

void build(const std::string& text) {
  deck::Deck deck = deck::read_deck_text(text, "fuzz.toml");
  if (elements(deck) > most_elements) return;
  const Model model(std::move(deck));
  require(!summary(model).empty(), "check says nothing");
  if (!is_one_in(32, text)) return;
  std::string reason;
  const std::optional<State> start = model.start(reason);
  require(start ? start->x.allFinite() && start->lambda == 0.0 : !reason.empty(),
          "the start is not finite, or there is none for no reason");
}

}  // namespace
}  // namespace arcwall::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return arcwall::fuzz::with_mutated_deck(data, size, arcwall::fuzz::build);
}
