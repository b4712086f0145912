#include "answers/event_curve.hpp"

#include <fmt/format.h>

#include <cassert>
#include <utility>

#include "answers/curve_tracing.hpp"
#include "model/build_structure.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/numbers.hpp"
#include "model/event_names.hpp"
#include "model/model.hpp"

namespace arcwall {

void require_curve(const deck::Deck& deck) {
  DeckProblems problems(deck.source);
  const deck::EventToFollow& curve = *deck.curve;
  const auto add = [&](const char* key, std::string message, std::string cure) {
    problems.add(curve.position, key, std::move(message), std::move(cure));
  };
  if (!deck.stages.empty() || !deck.path.visit.empty())
    add("curve", "events of decks with stages or visit are not followed", "leave out [curve], or these");
  if (deck.path.method == deck::PathMethod::incremental)
    add("curve", "method \"incremental\" has no events that could be followed", "use method \"spherical\"");
  if (deck.path.events != EventSearch::locate)
    add("curve", "events that are not located are not followed", "write events = \"locate\"");
  if (curve.event == EventKind::turning_point && deck.path.watch.empty())
    add("curve.event", "no monitor is watched, so that none turns", "add watch = [\"MONITOR\"] to [path]");
  if (curve.event == EventKind::value_crossing && deck.path.watch_zero.empty() && deck.path.watch_values.empty())
    add("curve.event", "no value is watched, so that none is passed", "add watch = { zero = [\"MONITOR\"] } to [path]");
  const auto number = deck::number_of(deck, curve.parameter);
  if (const auto* const found = std::get_if<deck::DeckNumber>(&number); found != nullptr && !curve.parameter.empty())
    if (found->value < curve.range[0] || found->value > curve.range[1])
      add("curve.range", fmt::format("the deck's own value of {}, {}, is outside", curve.parameter, found->value),
          "give a range that contains it");
  problems.raise();
}

EventCurve trace_event_curve(const deck::Deck& deck, const std::function<bool()>& stopped) {
  CurveTracing tracing(deck);
  while (tracing.advance())
    if (stopped && stopped()) tracing.stop({.reason = EndReason::interrupted, .detail = "stopped"});
  return tracing.curve();
}

std::string_view to_text(CurveSpecialKind kind) {
  switch (kind) {
    case CurveSpecialKind::begins:
      return "begins";
    case CurveSpecialKind::ends:
      return "ends";
    case CurveSpecialKind::cusp:
      return "cusp";
    case CurveSpecialKind::crossing:
      return "crossing";
  }
  assert(false);
  return "";
}

}  // namespace arcwall
