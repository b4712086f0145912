#include "model/deck/key_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "model/deck/reader.hpp"
#include "model/deck/writer.hpp"
#include "tests/model/deck/deck_page.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::deck::key_list_test {

namespace {

std::string text_of_file(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

const DeclaredKey* declared(const std::vector<DeclaredKey>& keys, const std::string& path) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const DeclaredKey& key) { return key.path() == path; });
  return found == keys.end() ? nullptr : &*found;
}

}  // namespace

TEST(KeyList, HasWhatTheDeclarationsSay) {
  const std::vector<DeclaredKey> keys = declared_keys();

  const DeclaredKey* E = declared(keys, "material.*.E");
  ASSERT_NE(E, nullptr);
  EXPECT_TRUE(E->required && E->option.empty());
  EXPECT_EQ(E->meaning, "Young's modulus, > 0");
  const DeclaredKey* thickness = declared(keys, "section.*.thickness");
  ASSERT_NE(thickness, nullptr);
  EXPECT_EQ(thickness->option, "tube");
  const DeclaredKey* step = declared(keys, "path.step");
  ASSERT_NE(step, nullptr);
  EXPECT_FALSE(step->required);
  EXPECT_EQ(step->otherwise, "0.02");
  const DeclaredKey* side = declared(keys, "wall.#.side");
  ASSERT_NE(side, nullptr);
  EXPECT_EQ(side->words, (std::vector<std::string>{"above", "below"}));
  for (const char* path : {"title", "member.*.sine.waves", "member.*.imperfection.#.amplitude", "wall.#.profile.type",
                           "path.output_at.*", "path.stop.event", "support.*"})
    EXPECT_NE(declared(keys, path), nullptr) << path;
}

// A deck that was written has the keys of the list and no others.
TEST(KeyList, HasEveryKeyOfADeckThatIsWritten) {
  const std::vector<DeclaredKey> keys = declared_keys();
  std::istringstream lines(to_toml(read_deck_text(full_deck, "full.toml")));
  std::string table;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#' || line[0] == ' ') continue;
    if (line[0] == '[') {
      table = line.substr(line.find_first_not_of('['), line.find(']') - line.find_first_not_of('['));
      if (line.starts_with("[[")) table += ".0";
      continue;
    }
    const std::string path = (table.empty() ? "" : table + ".") + line.substr(0, line.find(" = "));
    EXPECT_TRUE(std::any_of(keys.begin(), keys.end(), [&](const DeclaredKey& key) { return key.is(path); })) << path;
  }
}

// Run with ARCWALL_WRITE_PAGES=1 where a declaration has changed: that writes the page.
TEST(KeyList, IsWhatThePageOnDecksShows) {
  const std::string file = std::string(PAGES) + "/reference/deck.md", page = text_of_file(file);
  const std::string now = test::with_tables_of_keys(page);
  if (std::getenv("ARCWALL_WRITE_PAGES") != nullptr) std::ofstream(file) << now;
  EXPECT_TRUE(now == page)
      << "docs/reference/deck.md has other keys: ARCWALL_WRITE_PAGES=1 model_tests --gtest_filter='KeyList.*'";
  for (const DeclaredKey& key : declared_keys()) {
    const bool in_braces =
        key.table.ends_with(".sine") || key.table.ends_with(".curve") || key.table.ends_with(".control") ||
        key.table.ends_with(".imperfection.#") || key.table.ends_with(".profile") || key.table.ends_with(".outline") ||
        key.table.ends_with(".stiffness") || key.table.ends_with(".motion") || key.table == "curve.event" ||
        key.table.ends_with(".foundation") || key.table == "path.watch" || key.table.ends_with(".law");
    if (key.name == "*" || in_braces) continue;
    EXPECT_NE(page.find("<!-- keys of " + (key.table.empty() ? "deck" : key.table) + " -->"), std::string::npos)
        << "docs/reference/deck.md has no table of the keys of " << key.table;
  }
}

TEST(UnitOfKey, IsThatOfWhatTheKeyHolds) {
  const Units units{.length = "cm", .force = "kN"};
  const std::pair<const char*, const char*> expected[] = {{"wall.0.profile.z", "cm"},
                                                          {"member.column.imperfection.1.amplitude", "cm"},
                                                          {"material.steel.E", "kN/cm²"},
                                                          {"section.s.I", "cm⁴"},
                                                          {"load.0.force.1", "kN"},
                                                          {"load.0.moment", "kN cm"},
                                                          {"load.0.distributed", "kN/cm"},
                                                          {"point.E.0", "cm"},
                                                          {"wall.0.profile.curvature", "1/cm"},
                                                          {"member.column.elements", ""},
                                                          {"path.step", ""},
                                                          {"member.column.imperfection.amplitude", "cm"},
                                                          {"member.1.curve.x.3", "cm"},
                                                          {"wall.0.profile.x", "cm"},
                                                          {"wall.0.outline.axes", "cm"},
                                                          {"wall.0.outline.z", "cm"},
                                                          {"wall.0.outline.normal", ""},
                                                          {"wall.0.corner_radius", "cm"},
                                                          {"prescribed.0.x", "cm"},
                                                          {"prescribed.0.rotation", ""},
                                                          {"spring.0.stiffness.z", "kN/cm"},
                                                          {"spring.0.stiffness.rotation", "kN cm"},
                                                          {"spring.1.foundation.x", "kN/cm²"},
                                                          {"contact.gap_tolerance", "cm"},
                                                          {"section.s.nothing", ""}};
  for (const auto& [key, unit] : expected) EXPECT_EQ(unit_of_key(key, units), unit) << key;
  EXPECT_EQ(unit_of_key("material.steel.E", {}), "");
}

}  // namespace arcwall::deck::key_list_test
