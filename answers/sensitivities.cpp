#include "answers/sensitivities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "answers/deck_family.hpp"
#include "continuation/event_curves/event_derivative.hpp"
#include "core/central_difference.hpp"
#include "core/error.hpp"

namespace arcwall {

namespace {

const deck::StopBounds* bounds_of_lambda(const deck::Deck& deck, std::size_t stage) {
  const auto& own = deck.stages[stage].stop;
  const std::vector<deck::StopBounds>& bounds = own ? own->bounds : deck.path.stop.bounds;
  const auto is_lambda = [](const deck::StopBounds& one) { return one.name == "lambda"; };
  const auto found = std::find_if(bounds.begin(), bounds.end(), is_lambda);
  return found == bounds.end() ? nullptr : &*found;
}

// Where a stage of a varied deck ends: at its own bound of λ. Elsewhere it ends at what moves with the number, in a way
// that is not followed.
std::optional<double> end_of_stage(const deck::Deck& deck, const deck::Deck& varied, std::size_t stage, double lambda) {
  const deck::StopBounds *const own = bounds_of_lambda(deck, stage), *const other = bounds_of_lambda(varied, stage);
  if (own == nullptr || other == nullptr) return std::nullopt;
  if (lambda == own->low) return other->low;
  if (lambda == own->high) return other->high;
  return std::nullopt;
}

// What turns or passes a value at an event; null at others.
std::shared_ptr<const Observable> watched_of(const Model& model, const Event& event) {
  if (event.kind == EventKind::limit_point) return model.quantity("lambda");
  const bool is_watched = event.kind == EventKind::turning_point || event.kind == EventKind::value_crossing;
  return is_watched ? model.quantity(event.label) : nullptr;
}

std::vector<RatedQuantity> quantities_of(const Model& model) {
  std::vector<RatedQuantity> quantities;
  for (const MonitorColumn& column : model.monitors())
    quantities.push_back(
        {.value = column.is_place ? nullptr : column.quantity, .roundoff = column.roundoff});  // places jump
  return quantities;
}

// Steps of a number, by its natural one: that, shorter ones where it is too long, and a longer one.
constexpr double steps[] = {10.0, 1.0, 1e-1, 1e-2, 1e-3};
constexpr std::size_t longer_step = 0, natural = 1;

// Sections and materials are measured by themselves: a wire's second moment is next to nothing beside L⁴.
bool is_measured_by_itself(const deck::DeckNumber& number) {
  if (!number.enters.empty())
    return std::any_of(number.enters.begin(), number.enters.end(),
                       [](const auto& entered) { return is_measured_by_itself(entered.first); });
  const auto is_in = [&](const char* table) { return number.key.starts_with(table); };
  return (is_in("section.") || is_in("material.")) && number.unit.force == 0 && number.value != 0.0;
}

bool has_sensitivity(EventKind kind) {
  return kind != EventKind::start && kind != EventKind::end && kind != EventKind::user;
}

}  // namespace

// A variable's makes none of the numbers that it enters change by more than theirs.
double natural_step(const deck::DeckNumber& number, const Model& model) {
  constexpr double of_force = 3e-3, of_value = 1e-3, of_unit = 1e-5;
  if (!number.enters.empty()) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [entered, slope] : number.enters)
      least = std::min(least, natural_step(entered, model) / std::abs(slope));
    return least;
  }
  const double unit = std::pow(model.size(), number.unit.length) *
                      std::pow(std::max(model.structure().force_scale(), 1e-300), number.unit.force);
  if (is_measured_by_itself(number)) return of_value * std::abs(number.value);
  if (number.unit.force != 0) return number.value != 0.0 ? of_force * std::abs(number.value) : of_unit * unit;
  return std::max(of_value * std::abs(number.value), of_unit * unit);
}

// The models of decks with values beside a number's own, or why there are none.
struct Sensitivities::Beside {
  struct One {
    std::unique_ptr<Model> model;  // of the first stage
    double offset, weight, coarse_weight;
  };
  std::vector<One> models{};
  std::string problem{};

  void build(const deck::Deck& deck, const deck::Frame& frame, const deck::DeckNumber& number, double h,
             const std::vector<StageEnd>& ended_stages);
};

void Sensitivities::Beside::build(const deck::Deck& deck, const deck::Frame& frame, const deck::DeckNumber& number,
                                  double h, const std::vector<StageEnd>& ended_stages) {
  models.clear();
  problem.clear();
  const deck::Deck with_stages = with_visits_as_stages(deck);
  for (const DifferencePlace& place : central_difference) {
    std::unique_ptr<Model> model;
    try {
      model = std::make_unique<Model>(with_number(deck, number, number.value + place.offset * h), frame);
    } catch (const InputError& error) {
      problem = "a slightly different value gives no valid deck: " + first_message(error);
      return;
    }
    for (std::size_t stage = 0; stage < ended_stages.size(); ++stage) {
      const auto end = end_of_stage(with_stages, model->whole_deck(), stage, ended_stages[stage].lambda);
      if (!end) {
        problem = "an earlier load step did not end at a bound of lambda, and the change of its end is not followed";
        return;
      }
      if (!ended_stages[stage].grips.empty()) {
        problem =
            "a load step grips a point where an earlier one has left it, and the change of that place is not "
            "followed";
        return;
      }
      model->begin_stage({.lambda = *end});
    }
    models.push_back({.model = std::move(model),
                      .offset = place.offset * h,
                      .weight = place.weight / h,
                      .coarse_weight = place.coarse_weight / h});
  }
}

Sensitivities::Sensitivities(const Model& model, std::vector<StageEnd> ended_stages)
    : model_(model), ended_stages_(std::move(ended_stages)) {
  for (const std::string& key : model.given_deck().path.sensitivity)
    numbers_.push_back(std::get<deck::DeckNumber>(deck::number_of(model.given_deck(), key)));
  for (std::size_t i = 0; i < numbers_.size(); ++i) beside_.emplace_back(std::size(steps));
}

Sensitivities::~Sensitivities() = default;

// Shorter steps serve where a longer one makes a wrong deck: a member inside a wall, say.
const Sensitivities::Beside& Sensitivities::beside(std::size_t number, std::size_t step) {
  std::unique_ptr<Beside>& kept = beside_[number][step];
  const bool shortest = step + 1 == std::size(steps);
  if (!kept) {
    const deck::DeckNumber& varied = numbers_[number];
    kept = std::make_unique<Beside>();
    kept->build(without_answers(model_.given_deck()), model_.frame(), varied,
                steps[step] * natural_step(varied, model_), ended_stages_);
  }
  return kept->problem.empty() || shortest ? *kept : beside(number, step + 1);
}

// Empty where their mesh is another one.
std::optional<std::vector<SystemSample>> Sensitivities::samples_of(const Beside& beside, const Event& event) const {
  std::vector<SystemSample> samples;
  for (const Beside::One& other : beside.models) {
    const Model& model = other.model->at_stage(model_.stage());
    auto state = state_on(model, event.state);
    if (!state) return std::nullopt;
    samples.push_back({.system = &model.system(),
                       .state = std::move(*state),
                       .watched = watched_of(model, event),
                       .quantities = quantities_of(model),
                       .offset = other.offset,
                       .weight = other.weight,
                       .coarse_weight = other.coarse_weight});
  }
  return samples;
}

EventDerivative Sensitivities::by_steps_from(std::size_t first, std::size_t number, EventDerivatives& derivatives,
                                             const Event& event) {
  EventDerivative best;
  for (std::size_t step = first; step < std::size(steps); ++step) {
    const Beside& decks = beside(number, step);
    if (!decks.problem.empty()) return {.value = std::nullopt, .why_none = decks.problem};
    const auto samples = samples_of(decks, event);
    if (!samples) return {.value = std::nullopt, .why_none = "a slightly different value gives another mesh"};
    EventDerivative derivative = derivatives.by(*samples);
    if (!derivative.steps_too_long) return derivative;
    if (step == first || derivative.off < best.off) best = std::move(derivative);
  }
  return best;
}

// Where λ depends on an area by the members' extension alone, the natural step changes it by little more than
// round-off.
EventDerivative Sensitivities::by(std::size_t number, EventDerivatives& derivatives, const Event& event) {
  constexpr double hardly = 1e-2;  // of λ by all of the number
  EventDerivative found = by_steps_from(natural, number, derivatives, event);
  const deck::DeckNumber& varied = numbers_[number];
  if (!is_measured_by_itself(varied) || !found.value) return found;
  if (std::abs(*found.value * varied.value) > hardly * std::abs(event.state.lambda)) return found;
  EventDerivative surer = by_steps_from(longer_step, number, derivatives, event);
  return surer.value ? surer : found;
}

std::vector<RecordSensitivity> Sensitivities::of(const Arc& arc, const Event& event) {
  std::vector<RecordSensitivity> found;
  if (numbers_.empty() || !has_sensitivity(event.kind)) return found;
  const double lambda_scale = std::max(std::abs(event.state.lambda), std::abs(model_.options().step.first));
  EventDerivatives derivatives(model_.system(), arc, event, watched_of(model_, event), quantities_of(model_),
                               lambda_scale, model_.options().factorization);
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    EventDerivative derivative = by(i, derivatives, event);
    found.push_back({.key = model_.whole_deck().path.sensitivity[i],
                     .value = numbers_[i].value,
                     .slope = derivative.value,
                     .rates = std::move(derivative.rates),
                     .why_none = std::move(derivative.why_none)});
  }
  return found;
}

}  // namespace arcwall
