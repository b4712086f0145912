#include <algorithm>
#include <filesystem>
#include <iostream>

#include "apps/cli/commands.hpp"
#include "apps/cli/example_decks.hpp"
#include "apps/output/files.hpp"
#include "apps/output/text_table.hpp"
#include "apps/sweep/sweep_file.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/deck/reader.hpp"

namespace arcwall {

namespace {

void list_examples() {
  std::vector<std::vector<std::string>> rows;
  for (const auto* list : {&example_decks(), &example_devices()})
    for (const ExampleDeck& example : *list) {
      const std::string name(example.name);
      rows.push_back({name, deck::read_deck_text(example.text, name + ".toml").title});
    }
  for (const ExampleDeck& example : example_sweeps()) {
    const std::string name(example.name);
    rows.push_back({name, sweep::read_sweep_text(example.text, name + ".toml").title});
  }
  std::cout << text_table({{"name"}, {"title"}}, rows);
}

const ExampleDeck& example_named(const std::string& name) {
  std::vector<std::string> names;
  for (const auto* list : {&example_decks(), &example_devices(), &example_sweeps()})
    for (const ExampleDeck& example : *list) {
      if (example.name == name) return example;
      names.emplace_back(example.name);
    }
  const std::string near = nearest(name, names);
  throw InputError("there is no example " + name + (near.empty() ? "" : " (did you mean " + near + "?)") +
                   "; trace-path examples lists them");
}

ExitStatus examples(const Options& options) {
  const std::optional<std::string> file = options.text("out");
  if (options.words().empty()) {
    if (file) throw InputError("--out needs the name of an example; trace-path examples lists them");
    list_examples();
    return ExitStatus::success;
  }
  const ExampleDeck& example = example_named(options.words().front());
  if (!file) {
    std::cout << example.text;
    return ExitStatus::success;
  }
  std::error_code ignored;
  if (std::filesystem::exists(*file, ignored))
    throw OutputError(*file + ": is there already; remove it or name another file with --out");
  write_whole(*file, example.text);
  return ExitStatus::success;
}

}  // namespace

Command examples_command() {
  return {.description = {.name = "examples",
                          .example = "trace-path examples channel --out channel.toml",
                          .usage = "[NAME] [options]",
                          .summary = "list the example decks and sweeps, or write one of them",
                          .options = {{"out", "FILE", "write the deck into a new file (default: standard output)"}},
                          .least_words = 0,
                          .most_words = 1},
          .run = examples};
}

}  // namespace arcwall
