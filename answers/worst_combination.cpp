#include "answers/worst_combination.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "answers/event_curve.hpp"
#include "answers/find_event.hpp"
#include "answers/sensitivities.hpp"
#include "model/deck/numbers.hpp"
#include "model/model.hpp"

namespace arcwall {

namespace {

constexpr int most_runs = 30;
constexpr double settled_turn = 1e-6;  // of the direction from run to run [rad]

struct EventOfRun {
  double lambda = 0.0;
  Vector slopes{};
};

// The event of the deck with other values, and where it is no higher than `best` its slopes by them.
std::optional<EventOfRun> event_at(const deck::Deck& deck, const std::vector<deck::DeckNumber>& numbers,
                                   const Vector& values, const EventOfRun* best, const std::function<bool()>& stopped,
                                   std::string& problem) {
  deck::Deck varied = without_answers(deck);
  varied.path.sensitivity = deck.curve->worst;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    varied = with_number(varied, numbers[i], values[static_cast<Index>(i)]);
  const Model model(varied);
  const auto found = find_event(model, deck.curve->event, deck.curve->number, stopped, problem);
  if (!found) return std::nullopt;
  EventOfRun of{.lambda = found->event.state.lambda, .slopes = Vector::Zero(values.size())};
  if (best != nullptr && of.lambda > best->lambda) return of;
  const auto rows = Sensitivities(model, {}).of(found->arc, found->event);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].slope) {
      problem = fmt::format("λ of the event has no slope by {}: {}", rows[i].key, rows[i].why_none);
      return std::nullopt;
    }
    of.slopes[static_cast<Index>(i)] = *rows[i].slope;
  }
  return of;
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

  auto here = event_at(deck, numbers, own, nullptr, stopped, worst.problem);
  worst.runs = 1;
  if (!here) return worst;
  worst.own_lambda = here->lambda;
  Vector direction = -here->slopes.normalized();
  if (!direction.allFinite() || here->slopes.norm() == 0.0) {
    worst.problem = "λ of the event has no slope by these numbers";
    return worst;
  }
  worst.values = worst.own;
  worst.slopes = list_of(here->slopes);
  worst.lambda = here->lambda;
  std::optional<EventOfRun> best;
  while (worst.runs < most_runs && !(stopped && stopped())) {
    auto next = event_at(deck, numbers, own + radius * direction, best ? &*best : nullptr, stopped, worst.problem);
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
