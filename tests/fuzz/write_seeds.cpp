// fuzz_seeds FOLDER: writes what the fuzz targets begin with into FOLDER/deck_text and FOLDER/checkpoint: the examples
// and the sample decks of the tests, and checkpoints of short runs; and into FOLDER/deck.dict the keys and words of a
// deck.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>

#include "apps/cli/example_decks.hpp"
#include "apps/output/files.hpp"
#include "model/checkpoint/checkpoint_file.hpp"
#include "model/deck/key_list.hpp"
#include "tests/fuzz/kept_runs.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::fuzz {
namespace {

namespace fs = std::filesystem;

void write_decks(const fs::path& folder) {
  fs::create_directories(folder);
  for (const ExampleDeck& example : example_decks())
    write_whole(folder / (std::string(example.name) + ".toml"), example.text);
  write_whole(folder / "column.toml", deck::column_deck);
  write_whole(folder / "full.toml", deck::full_deck);
}

void write_checkpoints(const fs::path& folder) {
  fs::create_directories(folder);
  for (std::size_t i = 0; i < kept_runs().size(); ++i) {
    nlohmann::json content = kept_runs()[i];
    std::fill_n(content.begin(), head_entries, nullptr);
    std::string bytes(1, static_cast<char>(i));
    nlohmann::json::to_cbor(content, bytes);
    write_whole(folder / std::to_string(i), bytes);
  }
  write_whole(folder / "whole", to_checkpoint(kept_runs().front()));
}

// As libFuzzer wants it in a dictionary.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '\\';
    result += c == '\n' ? std::string("\\x0A") : std::string(1, c);
  }
  return result + "\"\n";
}

void write_dictionary(const fs::path& file) {
  using Kind = deck::DeclaredKey::Kind;
  std::set<std::string> entries;
  for (const deck::DeclaredKey& key : deck::declared_keys()) {
    for (const std::string& word : key.words) entries.insert(quoted("\"" + word + "\""));
    if (key.name == "*") continue;
    if (key.kind == Kind::value || key.kind == Kind::inner_table) {
      entries.insert(quoted(key.name + " = "));
    } else if (key.kind == Kind::named_tables) {
      entries.insert(quoted("[" + key.name + "."));
    } else {
      entries.insert(quoted(beginning(key) + "\n"));
    }
  }
  std::string text;
  for (const std::string& entry : entries) text += entry;
  write_whole(file, text);
}

}  // namespace
}  // namespace arcwall::fuzz

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: fuzz_seeds FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder(argv[1]);
  arcwall::fuzz::write_decks(folder / "deck_text");
  arcwall::fuzz::write_checkpoints(folder / "checkpoint");
  arcwall::fuzz::write_dictionary(folder / "deck.dict");
  return 0;
}
