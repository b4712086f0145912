#include "model/deck/reader.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "core/text.hpp"
#include "model/deck/cursor.hpp"
#include "model/deck/reader_parts.hpp"
#include "model/deck/toml_source.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

void assign_all(Value& root, const std::vector<std::string>& assignments) {
  std::vector<Diagnostic> diagnostics;
  int number = 0;
  for (const std::string& assignment : assignments) {
    try {
      assign(root, assignment, ++number);
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!diagnostics.empty()) throw InputError(std::move(diagnostics));
}

struct DeckPart {
  std::string_view key, written;
};

constexpr std::array<DeckPart, 13> deck_parts{{{"title", "title"},
                                               {"description", "description"},
                                               {"units", "[units]"},
                                               {"material", "[material.NAME]"},
                                               {"section", "[section.NAME]"},
                                               {"point", "[point]"},
                                               {"member", "[member.NAME]"},
                                               {"support", "[support]"},
                                               {"load", "[[load]]"},
                                               {"wall", "[[wall]]"},
                                               {"contact", "[contact]"},
                                               {"path", "[path]"},
                                               {"monitor", "[[monitor]]"}}};

// A part under another name leaves others without what they refer to, so this is said first.
void report_unknown_parts(const Value& root, Findings& findings) {
  std::vector<std::string> known;
  std::string all;
  for (const DeckPart& part : deck_parts) {
    known.emplace_back(part.key);
    all += (all.empty() ? "" : ", ") + std::string(part.written);
  }
  for (const Value& item : root.items) {
    if (std::find(known.begin(), known.end(), item.key) != known.end()) continue;
    constexpr std::size_t longest_compared = 100;
    const std::string near = item.key.size() <= longest_compared ? nearest(item.key, known) : "";
    const auto meant =
        std::find_if(deck_parts.begin(), deck_parts.end(), [&](const DeckPart& part) { return part.key == near; });
    findings.add_first(
        item.key_position, key_text(item.key), in_quotes(item.key, longest_compared) + " is no part of a deck",
        meant == deck_parts.end() ? "its parts are " + all : "did you mean " + std::string(meant->written) + "?");
  }
}

Deck read_root(const Value& value, Source source) {
  Deck deck{.source = std::move(source)};
  Findings findings(deck.source);
  Cursor root(value, "", findings);
  const Names names = names_in(value);
  read_labels(root, deck);
  read_materials(root, deck);
  read_sections(root, deck);
  read_points(root, deck);
  read_members(root, names, deck);
  read_supports(root, names, deck);
  read_loads(root, names, deck);
  read_walls(root, names, deck);
  read_contact(root, deck);
  read_monitors(root, names, deck);
  read_path(root, names, deck);
  report_unknown_parts(value, findings);
  findings.throw_if_any();
  return deck;
}

}  // namespace

Deck read_deck(const std::string& file, const std::vector<std::string>& assignments) {
  return read_deck_text(read_text_file(file), file, assignments);
}

Deck read_deck_text(std::string_view text, const std::string& file_name, const std::vector<std::string>& assignments) {
  Value root = parse_toml(text, file_name);
  assign_all(root, assignments);
  return read_root(root, {.file = file_name, .assignments = assignments});
}

}  // namespace arcwall::deck
