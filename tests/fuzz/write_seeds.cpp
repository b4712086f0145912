// fuzz_seeds FOLDER: writes the examples and the sample decks of the tests into it, to begin with.
#include <filesystem>
#include <iostream>

#include "apps/cli/example_decks.hpp"
#include "apps/output/files.hpp"
#include "tests/apps/deck/sample_decks.hpp"

int main(int argc, char** argv) {
  using namespace arcwall;
  if (argc != 2) {
    std::cerr << "usage: fuzz_seeds FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder(argv[1]);
  for (const ExampleDeck& example : example_decks())
    write_whole(folder / (std::string(example.name) + ".toml"), example.text);
  write_whole(folder / "column.toml", deck::column_deck);
  write_whole(folder / "full.toml", deck::full_deck);
  return 0;
}
