#include "tests/fuzz/kept_runs.hpp"

#include <string>

#include "answers/sessions.hpp"
#include "apps/cli/example_decks.hpp"
#include "model/checkpoint/checkpoint_file.hpp"
#include "tests/fuzz/require.hpp"

namespace arcwall::fuzz {

namespace {

std::string example(const std::string& name) {
  for (const ExampleDeck& deck : example_decks())
    if (deck.name == name) return std::string(deck.text);
  require(false, "there is no such example");
  return {};
}

nlohmann::json kept(const std::string& name, const std::vector<std::string>& assignments, int points) {
  const RunDescription description{.deck = name + ".toml", .deck_text = example(name), .assignments = assignments};
  Session run = make_session(description);
  require(run.begin(), "a base run has no start");
  for (int i = 0; i < points; ++i) run.next();
  return from_checkpoint(run.checkpoint(), "checkpoint");
}

}  // namespace

const std::vector<nlohmann::json>& kept_runs() {
  static const std::vector<nlohmann::json> runs{
      kept("truss", {}, 6),
      kept("channel", {"member.column.elements=4"}, 12),
      kept("channel", {"member.column.elements=4", "contact.points=\"nodes\"", "path.branches=\"all\""}, 12),
      kept("foundation", {"member.beam.elements=4", "path.method=\"incremental\"", "path.output_at={lambda=[0.5]}"}, 4),
  };
  return runs;
}

}  // namespace arcwall::fuzz
