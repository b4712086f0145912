#include "model/worst_combination.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "continuation/explorer.hpp"
#include "model/deck/numbers.hpp"
#include "model/event_curve.hpp"
#include "model/event_names.hpp"
#include "model/model.hpp"
#include "model/sensitivities.hpp"

namespace arcwall {

namespace {

constexpr int most_runs = 30;
constexpr double settled_turn = 1e-6;  // of the direction from run to run [rad]

struct EventOfRun {
  double lambda = 0.0;
  Vector slopes{};
};

// The event of the deck with other values, and its slopes by them.
std::optional<EventOfRun> event_at(const deck::Deck& deck, const std::vector<deck::DeckNumber>& numbers,
                                   const Vector& values, std::string& problem) {
  deck::Deck varied = deck;
  varied.path.sensitivity = deck.curve->worst;
  const deck::EventToFollow wanted = *deck.curve;
  varied.curve.reset();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    varied = with_number(varied, numbers[i], values[static_cast<Index>(i)]);
  const Model model(varied);
  auto start = model.start(problem);
  if (!start) return std::nullopt;
  Sensitivities sensitivities(model, {});
  Explorer explorer(model.system(), std::move(*start), model.options(), model.watched(), model.explore());
  int found = 0;
  while (const auto step = explorer.next()) {
    for (const Event& event : step->arc.events) {
      if (event.kind != wanted.event || ++found < wanted.number) continue;
      EventOfRun of{.lambda = event.state.lambda, .slopes = Vector::Zero(values.size())};
      const auto rows = sensitivities.of(step->arc, event);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!rows[i].slope) {
          problem = fmt::format("λ of the event has no slope by {}: {}", rows[i].key, rows[i].why_none);
          return std::nullopt;
        }
        of.slopes[static_cast<Index>(i)] = *rows[i].slope;
      }
      return of;
    }
  }
  problem = fmt::format("with other values the path has no {} {}", to_text(wanted.event), wanted.number);
  return std::nullopt;
}

std::vector<double> list_of(const Vector& vector) { return {vector.begin(), vector.end()}; }

}  // namespace

// On the sphere |v − v₀| = r the least λ has its slopes along v₀ − v: a fixed point of v ↦ v₀ − r ∇λ/|∇λ|. Where a step
// does not lower λ the way to it is halved.
WorstCombination worst_combination(const deck::Deck& deck, const std::function<bool()>& stopped) {
  const Model checked(deck);  // reports all that is wrong
  require_curve(deck);
  WorstCombination worst{.keys = deck.curve->worst};
  std::vector<deck::DeckNumber> numbers;
  for (const std::string& key : worst.keys) numbers.push_back(std::get<deck::DeckNumber>(deck::number_of(deck, key)));
  Vector own(static_cast<Index>(numbers.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) own[static_cast<Index>(i)] = numbers[i].value;
  worst.own = list_of(own);
  const double radius = *deck.curve->radius;

  auto here = event_at(deck, numbers, own, worst.problem);
  worst.runs = 1;
  if (!here) return worst;
  worst.own_lambda = here->lambda;
  Vector direction = -here->slopes.normalized();
  if (!direction.allFinite() || here->slopes.norm() == 0.0) {
    worst.problem = "λ of the event has no slope by these numbers";
    return worst;
  }
  std::optional<EventOfRun> best;
  while (worst.runs < most_runs && !(stopped && stopped())) {
    auto next = event_at(deck, numbers, own + radius * direction, worst.problem);
    ++worst.runs;
    if (!next && !best) return worst;
    if (!next || (best && next->lambda > best->lambda)) {
      const Vector back = (Eigen::Map<const Vector>(worst.values.data(), own.size()) - own) / radius;
      if ((direction - back).norm() <= settled_turn) {
        worst.settled = true;
        break;
      }
      direction = (direction + back).normalized();
      continue;
    }
    best = next;
    worst.values = list_of(own + radius * direction);
    worst.slopes = list_of(best->slopes);
    worst.lambda = best->lambda;
    const Vector ahead = -best->slopes.normalized();
    worst.settled = (ahead - direction).norm() <= settled_turn;
    if (worst.settled) break;
    direction = ahead;
  }
  worst.problem.clear();
  return worst;
}

}  // namespace arcwall
