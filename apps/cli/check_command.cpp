#include <iostream>

#include "apps/cli/commands.hpp"
#include "apps/cli/summary.hpp"
#include "model/deck/reader.hpp"

namespace arcwall {

namespace {

ExitStatus check(const Options& options) {
  const Model model(deck::read_deck(options.words().front(), options.texts("set")));
  for (const std::string& warning : model.warnings()) std::cerr << "warning: " << warning << "\n";
  std::cout << summary(model);
  return ExitStatus::success;
}

}  // namespace

Command check_command() {
  return {.description = {.name = "check",
                          .example = "trace-path check channel.toml",
                          .usage = "DECK [options]",
                          .summary = "validate a deck and summarise the model",
                          .options = {set_option()},
                          .least_words = 1,
                          .most_words = 1},
          .run = check};
}

}  // namespace arcwall
