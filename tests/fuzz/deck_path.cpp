// Decks with odd values as paths: the first points and the files they make are values, or there is an InputError. A run
// that is kept after these points is read back.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "answers/sessions.hpp"
#include "apps/output/contacts_csv.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/path_csv.hpp"
#include "apps/output/result_json.hpp"
#include "model/deck/reader.hpp"
#include "tests/fuzz/mutated_deck.hpp"
#include "tests/fuzz/require.hpp"

namespace arcwall::fuzz {
namespace {

constexpr int most_points = 5;
constexpr std::int64_t most_elements = 20;

// A size that a run of some milliseconds can have.
bool is_small(const deck::Deck& deck) {
  std::int64_t elements = 0;
  for (const deck::Member& member : deck.members) elements += member.elements;
  return elements <= most_elements;
}

void check_points(const Record& record) {
  double arc = -1.0;
  for (const RecordPoint& point : record.points) {
    require(std::isfinite(point.lambda) && point.state.x.allFinite(), "a point is not finite");
    if (point.branch == 0) require(point.arc >= std::exchange(arc, point.arc), "arc lengths decrease");
  }
}

void write(const Session& run) {
  contacts_csv(run.record(), UnitLabels::shown);
  to_text(events_json(run.record()), JsonLayout::lines);
  events_text(run.record());
  to_text(result_json(run.model(), run.description(), run.record(), {}, 0), JsonLayout::lines);
}

void follow(const std::string& text) {
  if (!is_small(deck::read_deck_text(text, "fuzz.toml"))) return;
  Session run = make_session({.deck = "fuzz.toml", .deck_text = text});
  if (!run.begin()) {
    require(!run.problem().empty(), "there is no start and no reason");
    return;
  }
  for (int points = 0; points < most_points && run.next() != nullptr; ++points) continue;
  check_points(run.record());
  if (run.record().points.empty()) return;
  const Session again = resume_session(run.checkpoint(), "checkpoint", Session::Resume::go_on);
  require(path_csv(again.record(), UnitLabels::shown) == path_csv(run.record(), UnitLabels::shown),
          "a run that is kept reads otherwise");
  run.stop({.reason = EndReason::max_points, .detail = ""});
  run.next();
  write(run);
}

}  // namespace
}  // namespace arcwall::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return arcwall::fuzz::with_mutated_deck(data, size, arcwall::fuzz::follow);
}
