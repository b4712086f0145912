#include "apps/deck/reader.hpp"

#include <string>
#include <utility>

#include "apps/deck/cursor.hpp"
#include "apps/deck/reader_parts.hpp"
#include "apps/deck/toml_source.hpp"

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
  root.finish();
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
