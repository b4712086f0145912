#include "model/step_ledger.hpp"

#include <cassert>
#include <cmath>

#include <nlohmann/json.hpp>
#include "model/event_names.hpp"

namespace arcwall {

using OrderedJson = nlohmann::ordered_json;

namespace {

std::string_view to_text(StepOutcome outcome) {
  switch (outcome) {
    case StepOutcome::accepted:
      return "accepted";
    case StepOutcome::too_many_iterations:
      return "too_many_iterations";
    case StepOutcome::diverged:
      return "diverged";
    case StepOutcome::complex_roots:
      return "complex_roots";
    case StepOutcome::singular:
      return "singular";
    case StepOutcome::not_finite:
      return "not_finite";
    case StepOutcome::obstructed:
      return "wall_end";
    case StepOutcome::behind_end:
      return "behind_end";
    case StepOutcome::left_path:
      return "left_path";
    case StepOutcome::tangent_angle:
      return "tangent_angle";
    case StepOutcome::event_not_located:
      return "event_not_located";
    case StepOutcome::penetration:
      return "penetration";
    case StepOutcome::blocked:
      return "blocked";
    case StepOutcome::contact_inserted:
      return "contact_inserted";
    case StepOutcome::events_unclear:
      return "events_unclear";
    case StepOutcome::ended:
      return "ended";
  }
  assert(false);
  return {};
}

std::string_view to_text(Strategy strategy) {
  switch (strategy) {
    case Strategy::tangent_guess:
      return "tangent_guess";
    case Strategy::beside_singular:
      return "beside_singular";
    case Strategy::longer_step:
      return "longer_step";
    case Strategy::near_guard:
      return "near_guard";
    case Strategy::other_zone:
      return "other_zone";
    case Strategy::shorter_zone:
      return "shorter_zone";
    case Strategy::more_iterations:
      return "more_iterations";
    case Strategy::unsure_zone:
      return "unsure_zone";
    case Strategy::nearly_degenerate:
      return "nearly_degenerate";
  }
  assert(false);
  return {};
}

// Contacts that change and other events.
OrderedJson events_of(const Model& model, const Arc& arc) {
  OrderedJson events = OrderedJson::array();
  for (const Event& event : arc.events) {
    OrderedJson json{{"kind", to_text(event.kind)}};
    if (changes_contact(event.kind)) {
      json["contact"] = OrderedJson::array();
      for (const Index j : event.guards) {
        const ContactLabel label = model.contacts()->contact(event.state, j).label;
        json["contact"].push_back({{"wall", label.wall}, {"member", label.member}, {"fraction", label.fraction}});
      }
    }
    events.push_back(std::move(json));
  }
  return events;
}

}  // namespace

std::string ledger_line(const Model& model, Index branch, const StepAttempt& attempt) {
  OrderedJson json{
      {"branch", branch}, {"arc", attempt.arc}, {"radius", attempt.radius}, {"outcome", to_text(attempt.outcome)}};
  json["iterations"] = attempt.iterations;
  json["residual"] = attempt.residual;
  json["root"] = attempt.roots ? OrderedJson(attempt.roots->taken) : OrderedJson(nullptr);
  json["other_root"] =
      attempt.roots && attempt.roots->other ? OrderedJson(*attempt.roots->other) : OrderedJson(nullptr);
  json["turn"] = attempt.turn ? OrderedJson(*attempt.turn) : OrderedJson(nullptr);
  json["strategies"] = OrderedJson::array();
  for (const Strategy strategy : attempt.strategies) json["strategies"].push_back(to_text(strategy));
  if (attempt.accepted) {
    json["lambda"] = attempt.accepted->to.state.lambda;
    json["length"] = attempt.accepted->to.arc - attempt.arc;
    json["events"] = events_of(model, *attempt.accepted);
  }
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace arcwall
