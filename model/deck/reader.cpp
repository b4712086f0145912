#include "model/deck/reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "core/text.hpp"
#include "model/deck/arithmetic.hpp"
#include "model/deck/cursor.hpp"
#include "model/deck/deck_keys.hpp"
#include "model/deck/given_points.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/key_reader.hpp"
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

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + text;
  return all;
}

// What other programs and books call parts of a deck, and how that is said here.
constexpr std::array<std::pair<std::string_view, std::string_view>, 42> said_otherwise{{
    {"displacement", "a point is moved by [[prescribed]], with x, z or rotation"},
    {"displacements", "a point is moved by [[prescribed]], with x, z or rotation"},
    {"imposed", "a point is moved by [[prescribed]], with x, z or rotation"},
    {"imposed_displacement", "a point is moved by [[prescribed]], with x, z or rotation"},
    {"prescribed_displacement", "a point is moved by [[prescribed]], with x, z or rotation"},
    {"settlement", "a point is moved by [[prescribed]], with x, z or rotation"},
    {"sp", "directions are held by [support] and moved by [[prescribed]]"},
    {"boundary", "directions are held by [support] and moved by [[prescribed]]"},
    {"boundaries", "directions are held by [support] and moved by [[prescribed]]"},
    {"constraint", "directions are held by [support] and moved by [[prescribed]]"},
    {"fix", "directions are held by [support] and moved by [[prescribed]]"},
    {"foundation", "a foundation is a [[spring]] with on and foundation"},
    {"winkler", "a foundation is a [[spring]] with on and foundation"},
    {"bedding", "a foundation is a [[spring]] with on and foundation"},
    {"elastic_support", "an elastic support is a [[spring]] with at and stiffness"},
    {"indenter", "an obstacle is a [[wall]], which moves by its motion"},
    {"obstacle", "an obstacle is a [[wall]]"},
    {"contact_surface", "an obstacle is a [[wall]]"},
    {"nodal_load", "loads are [[load]], with at and force or moment"},
    {"thermal", "a member is heated by a [[load]] with on and temperature"},
    {"temperature", "a member is heated by a [[load]] with on and temperature"},
    {"heat", "a member is heated by a [[load]] with on and temperature"},
    {"pressure", "a member is pressed by a [[load]] with on and pressure"},
    {"step", "parts of a run are [[stage]], with name and drives"},
    {"load_step", "parts of a run are [[stage]], with name and drives"},
    {"imposed_displacements", "a point is moved by [[prescribed]], with x, z or rotation"},
    {"prescribed_displacements", "a point is moved by [[prescribed]], with x, z or rotation"},
    {"support_motion", "a point is moved by [[prescribed]], with x, z or rotation"},
    {"motion", "a wall is moved by its motion, a point by [[prescribed]]"},
    {"moving_wall", "an obstacle is a [[wall]], which moves by its motion"},
    {"bc", "directions are held by [support] and moved by [[prescribed]]"},
    {"bcs", "directions are held by [support] and moved by [[prescribed]]"},
    {"dirichlet", "directions are held by [support] and moved by [[prescribed]]"},
    {"neumann", "loads are [[load]], with at and force or moment"},
    {"elastic_foundation", "a foundation is a [[spring]] with on and foundation"},
    {"link", "two points are joined by a [[spring]] with between"},
    {"links", "two points are joined by a [[spring]] with between"},
    {"expansion", "expansion is a key of [material.NAME]"},
    {"thermal_expansion", "expansion is a key of [material.NAME]"},
    {"steps", "parts of a run are [[stage]], with name and drives"},
    {"stop", "what ends the path is [path.stop]"},
    {"phase", "parts of a run are [[stage]], with name and drives"},
}};

// Whether a table says that its wall stands upright, which no profile does.
bool is_upright(const Value& wall) {
  constexpr std::array<std::string_view, 6> words{"left", "right", "vertical", "upright", "wall", "x"};
  const auto is_word_for_it = [&](const Value* value) {
    return value != nullptr && value->kind == Value::Kind::string &&
           std::find(words.begin(), words.end(), value->string) != words.end();
  };
  const auto is_number = [](const Value* value) {
    return value != nullptr && (value->kind == Value::Kind::integer || value->kind == Value::Kind::number);
  };
  if (wall.kind != Value::Kind::table || find(wall, "outline") != nullptr) return false;
  if (is_word_for_it(find(wall, "side"))) return true;
  const Value* profile = find(wall, "profile");
  if (profile == nullptr || profile->kind != Value::Kind::table) return false;
  if (is_word_for_it(find(*profile, "type"))) return true;
  if (is_number(find(*profile, "x")) && find(*profile, "z") == nullptr) return true;
  const Value* slope = find(*profile, "slope");
  return is_number(slope) && std::isinf(slope->number);
}

void report_upright_walls(const Value& root, Findings& findings) {
  const Value* walls = find(root, "wall");
  if (walls == nullptr || walls->kind != Value::Kind::array) return;
  for (std::size_t i = 0; i < walls->items.size(); ++i) {
    const Value& wall = walls->items[i];
    if (!is_upright(wall)) continue;
    const std::string table = "wall." + std::to_string(i);
    const Value* profile = find(wall, "profile");
    findings.add_for_all_of(table, profile == nullptr ? wall.position : profile->key_position, table,
                            "a profile z = ψ(x) with a side above or below cannot be vertical",
                            "give the wall, in place of profile and side, outline = { type = \"half-plane\", point = "
                            "[2.0, 0.0], normal = [-1.0, 0.0] }, with a point of it and its normal out of the wall");
  }
}

// A part under another name leaves others without what they refer to, so this is said first.
void report_unknown_parts(const Value& root, Findings& findings) {
  std::vector<std::string> known, all;
  for (const DeclaredKey& part : declared_keys()) {
    if (!part.table.empty()) continue;
    known.push_back(part.name);
    all.push_back(beginning(part));
  }
  for (const Value& item : root.items) {
    if (std::find(known.begin(), known.end(), item.key) != known.end()) continue;
    constexpr std::size_t longest_compared = 100;
    const auto known_word = std::find_if(said_otherwise.begin(), said_otherwise.end(),
                                         [&](const auto& words) { return words.first == item.key; });
    if (known_word != said_otherwise.end()) {
      findings.add_first(item.key_position, key_text(item.key), in_quotes(item.key) + " is no part of a deck",
                         std::string(known_word->second));
      continue;
    }
    const std::string near = item.key.size() <= longest_compared ? nearest(item.key, known) : "";
    const auto meant = std::find(known.begin(), known.end(), near) - known.begin();
    findings.add_first(
        item.key_position, key_text(item.key), in_quotes(item.key, longest_compared) + " is no part of a deck",
        near.empty() ? "its parts are " + joined(all) : "did you mean " + all[static_cast<std::size_t>(meant)] + "?");
  }
}

Deck read_root(Value value, Source source) {
  Deck deck{.source = std::move(source)};
  Findings findings(deck.source);
  if (value.items.empty()) {
    findings.add(value.position, "deck", "there is nothing in it", "begin with a deck of trace-path examples");
    findings.throw_if_any();
  }
  use_given_points(value, deck.source.file, findings);
  Arithmetic arithmetic(value);
  arithmetic.report_cycles(findings);
  Cursor root(value, "", findings, &arithmetic);
  const Names names = names_in(value);
  KeyReader reader(root, names, deck);
  declare_keys(reader, deck);
  report_unknown_parts(value, findings);
  report_upright_walls(value, findings);
  findings.throw_if_any();
  deck.formulas = arithmetic.formulas();
  return deck;
}

}  // namespace

Deck read_deck(const std::string& file, const std::vector<std::string>& assignments) {
  return read_deck_text(read_deck_file(file), file, assignments);
}

Deck read_deck_text(std::string_view text, const std::string& file_name, const std::vector<std::string>& assignments) {
  return read_deck_value(parse_deck(text, file_name), file_name, assignments);
}

Deck read_deck_value(Value root, const std::string& file_name, const std::vector<std::string>& assignments) {
  assign_all(root, assignments);
  return read_root(std::move(root), {.file = file_name, .assignments = assignments});
}

}  // namespace arcwall::deck
