// Any bytes as the text of a deck: the reader ends in a deck or in an InputError that says something. A deck that was
// read is written and read again to the same deck. Comments that begin with `#--set ` are assignments of the command
// line, so every input is a file that `trace-path check` reads as well.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/writer.hpp"
#include "tests/fuzz/require.hpp"

namespace arcwall::fuzz {
namespace {

constexpr std::string_view marker = "#--set ";
constexpr std::size_t most_assignments = 8;

std::vector<std::string> assignments_in(std::string_view text) {
  std::vector<std::string> assignments;
  for (std::size_t at = text.find(marker); at != std::string_view::npos && assignments.size() < most_assignments;) {
    const std::string_view rest = text.substr(at + marker.size());
    assignments.emplace_back(rest.substr(0, rest.find('\n')));
    at = text.find(marker, at + marker.size());
  }
  return assignments;
}

void check_diagnostics(const InputError& error) {
  require(!error.diagnostics().empty(), "a deck is refused without a reason");
  for (const Diagnostic& diagnostic : error.diagnostics())
    require(!to_text(diagnostic).empty(), "a reason has no words");
}

void read(std::string_view text) {
  deck::Deck deck;
  try {
    deck = deck::read_deck_text(text, "fuzz.toml", assignments_in(text));
  } catch (const InputError& error) {
    check_diagnostics(error);
    return;
  }
  require(deck::read_deck_text(deck::to_toml(deck), "again.toml") == deck, "a deck that is written reads otherwise");
}

}  // namespace
}  // namespace arcwall::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  arcwall::fuzz::read({reinterpret_cast<const char*>(data), size});
  return 0;
}
