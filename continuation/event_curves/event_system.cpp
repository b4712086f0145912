#include "continuation/event_curves/event_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcwall {

namespace {

constexpr double least_fit = 0.5;    // cosine between the border and what is singular, below which another one is due
constexpr double still_zero = 1e-6;  // of the followed guard on another mesh

// Weights of values at whole numbers from `first` on in the derivative at t of the polynomial through them (Lagrange).
std::vector<double> weights_of_derivative(int first, int count, double t) {
  std::vector<double> weights;
  const int last = first + count - 1;
  for (int k = first; k <= last; ++k) {
    double sum = 0.0;
    for (int m = first; m <= last; ++m) {
      if (m == k) continue;
      double part = 1.0 / double(k - m);
      for (int l = first; l <= last; ++l)
        if (l != k && l != m) part *= (t - double(l)) / double(k - l);
      sum += part;
    }
    weights.push_back(sum);
  }
  return weights;
}

Direction base_direction(const Direction& direction, Index n) {
  return {.dx = direction.dx.head(n), .dlambda = direction.dx[n]};
}

}  // namespace

class EventSystem::EventLayout final : public Layout, public Meaning {
 public:
  explicit EventLayout(Meaning meaning) : Meaning(std::move(meaning)), base_size(weights.size()) {}

  Index base_size;
};

const EventSystem::Meaning* EventSystem::meaning_of(const Layout& layout) {
  return dynamic_cast<const EventLayout*>(&layout);
}

std::shared_ptr<const Layout> EventSystem::with_meaning(Meaning meaning) {
  return std::make_shared<EventLayout>(std::move(meaning));
}

EventSystem::EventSystem(const SystemFamily& family, FollowedEvent event, double lambda_scale, MakeFactorization make)
    : family_(family), event_(std::move(event)), lambda_scale_(lambda_scale), make_(std::move(make)) {}

const EventSystem::EventLayout& EventSystem::layout_of(const ActiveSet& active_set) {
  return static_cast<const EventLayout&>(*active_set.layout());
}

Metric EventSystem::metric_of(const SystemFamily::Member& member) const {
  return {member.system->weights(member.state.active_set), lambda_scale_};
}

State EventSystem::in_common_terms(const State& state) const {
  const EventLayout& layout = layout_of(state.active_set);
  return {.x = state.x.head(layout.base_size), .lambda = state.x[layout.base_size], .active_set = layout.active_set};
}

std::optional<SystemFamily::Member> EventSystem::at(const State& state) const {
  return family_.at(state.lambda, in_common_terms(state));
}

std::optional<Direction> EventSystem::along_path(const State& state, const SystemFamily::Member& member) const {
  return path_direction(event_.criterion, member, layout_of(state.active_set).border, metric_of(member), make_);
}

double EventSystem::lambda_of(const State& state) { return state.x[layout_of(state.active_set).base_size]; }

double EventSystem::lambda_rate(const State& state, const Direction& direction) {
  return direction.dx[layout_of(state.active_set).base_size];
}

State EventSystem::extended(const SystemFamily::Member& at, const State& event, double kappa, EventBorder border,
                            const State* like) const {
  const System& system = *at.system;
  const ActiveSet& active_set = at.state.active_set;
  auto layout = with_meaning({.active_set = event.active_set,
                              .weights = system.weights(active_set),
                              .multipliers = system.multiplier_count(active_set),
                              .guards = system.guard_count(active_set),
                              .border = std::move(border)});
  State state{
      .x = Vector::Zero(event.x.size() + extra()), .lambda = kappa, .active_set = ActiveSet(0, 0, std::move(layout))};
  state.x.head(event.x.size()) = event.x;
  state.x[event.x.size()] = event.lambda;
  if (like != nullptr && extra() == 2) state.x[event.x.size() + 1] = like->x[like->x.size() - 1];
  return state;
}

std::optional<State> EventSystem::of_event(const State& event, double kappa) const {
  const auto member = family_.at(kappa, event);
  if (!member) return std::nullopt;
  auto border = event_border(event_.criterion, *member, metric_of(*member), make_);
  if (!border) return std::nullopt;
  return extended(*member, event, kappa, std::move(*border));
}

Dimensions EventSystem::dimensions(const ActiveSet& active_set) const {
  const EventLayout& layout = layout_of(active_set);
  return {.unknowns = layout.base_size + extra(), .multipliers = layout.multipliers, .bounds = layout.guards};
}

double EventSystem::energy(const State& state) const {
  const auto member = at(state);
  return member ? member->system->energy(member->state) : std::numeric_limits<double>::quiet_NaN();
}

StateMetric EventSystem::metric(const ActiveSet& active_set) const {
  const EventLayout& layout = layout_of(active_set);
  Vector weights = Vector::Ones(layout.base_size + extra());
  weights.head(layout.base_size) = layout.weights;
  weights[layout.base_size] = 1.0 / (lambda_scale_ * lambda_scale_);
  return {.weights = std::move(weights)};
}

// --- equations ------------------------------------------------------------------------------------------------------

// Where there is no deck on one side of κ, a little above a stiffness of zero, say, all are on the other one. Empty
// where that does not do.
std::vector<WeightedMember> EventSystem::samples(const State& event, double kappa) const {
  constexpr int count = 5, few = 3;
  const double h = family_.spacing(), middle = std::round(kappa / h), t = kappa / h - middle;
  for (const int shift : {0, 1, -1, 2, -2, 3, -3}) {
    const int first = shift - count / 2, nearest = std::clamp(-few / 2, first, first + count - few);
    const std::vector<double> weights = weights_of_derivative(first, count, t);
    const std::vector<double> of_few = weights_of_derivative(nearest, few, t);
    std::vector<WeightedMember> samples;
    for (int i = 0; i < count; ++i) {
      const double there = (middle + double(first + i)) * h;
      auto member = family_.at(there, event);
      if (!member) break;
      WeightedMember& sample = samples.emplace_back(WeightedMember{
          .member = std::move(*member), .weight = weights[static_cast<std::size_t>(i)] / h, .kappa = there});
      const int among_few = first + i - nearest;
      if (among_few >= 0 && among_few < few) sample.few = of_few[static_cast<std::size_t>(among_few)] / h;
    }
    if (samples.size() == count) return samples;
  }
  return {};
}

std::optional<std::vector<EventEquation>> EventSystem::equations(const SystemFamily::Member& at,
                                                                 const EventBorder& border, Linearization& here,
                                                                 std::vector<WeightedMember>& samples) const {
  if (event_.criterion == Criterion::value) return std::vector{passed_value(at, event_.value, border, samples)};
  if (event_.criterion != Criterion::guard)
    return singular_equations(event_.criterion, at, border, here, samples, metric_of(at), make_);
  const Index j = event_.guards.front();
  EventEquation equation{.value = at.system->guard(at.state, j), .row = at.system->guard_gradient(at.state, j)};
  for (const WeightedMember& sample : samples)
    equation.by_kappa += sample.weight * sample.member.system->guard(sample.member.state, j);
  return std::vector{std::move(equation)};
}

void EventSystem::residual(const State& state, Eigen::Ref<Vector> F) const {
  const EventLayout& layout = layout_of(state.active_set);
  F.setConstant(std::numeric_limits<double>::quiet_NaN());
  const auto member = at(state);
  if (!member) return;
  Linearization here;
  member->system->linearize(member->state, here);
  std::vector<WeightedMember> none;
  const auto found = equations(*member, layout.border, here, none);
  if (!found) return;
  F.head(layout.base_size) = here.F;
  if (extra() == 2) F.head(layout.base_size) += state.x[layout.base_size + 1] * layout.border.column;
  for (std::size_t k = 0; k < found->size(); ++k) F[layout.base_size + static_cast<Index>(k)] = (*found)[k].value;
}

namespace {

// ∂F/∂x of the extended equations: the border grows by λ and μ, which stand behind its unknowns, and by the event's
// equations.
//
//   [ K    B    F_λ  f ]        [ F_κ ]
//   [ C_x  C_s  F_λ  f ],       [ F_κ ]
//   [ σ_x       σ_λ  0 ]        [ σ_κ ]
void extend(const Linearization& here, const std::vector<EventEquation>& equations, const Vector& column,
            Linearization& out) {
  const Index k = here.K.cols(), m = here.B.cols(), n = k + m, e = static_cast<Index>(equations.size());
  out.K = here.K;
  out.translation_free = here.translation_free;
  out.ground = here.ground;
  out.holding = here.holding;
  out.holding.resize(static_cast<std::size_t>(m + e), 0);
  out.border_rates = Vector::Zero(m + e);
  out.B = Matrix::Zero(k, m + e);
  out.C = LongRows::Zero(m + e, n + e);
  if (m > 0) {
    out.border_rates.head(m) = here.border_rates;
    out.B.leftCols(m) = here.B;
    out.C.topLeftCorner(m, n) = here.C;
  }
  const auto put_column = [&](Index j, const Vector& of) {
    out.B.col(m + j) = of.head(k);
    out.C.col(n + j).head(m) = of.tail(m);
  };
  put_column(0, here.F_lambda);
  if (e == 2) put_column(1, column);
  for (Index j = 0; j < e; ++j) {
    const EventEquation& equation = equations[static_cast<std::size_t>(j)];
    out.F[n + j] = equation.value;
    out.C.row(m + j).head(n) = equation.row.dx;
    out.C(m + j, n) = equation.row.dlambda;
    out.F_lambda[n + j] = equation.by_kappa;
  }
}

}  // namespace

void EventSystem::linearize(const State& state, Linearization& out) const {
  const EventLayout& layout = layout_of(state.active_set);
  const Index n = layout.base_size, e = extra();
  out.F = Vector::Constant(n + e, std::numeric_limits<double>::quiet_NaN());
  const State event = in_common_terms(state);
  const auto member = family_.at(state.lambda, event);
  if (!member) return;
  std::vector<WeightedMember> beside = samples(event, state.lambda);
  if (beside.empty()) return;
  if (!out.inner) out.inner = std::make_unique<Linearization>();
  Linearization& here = *out.inner;
  member->system->linearize(member->state, here);
  const auto found = equations(*member, layout.border, here, beside);
  if (!found) return;
  out.F.head(n) = here.F;
  if (e == 2) out.F.head(n) += state.x[n + 1] * layout.border.column;
  out.F_lambda = Vector::Zero(n + e);
  Vector F(n);
  for (const WeightedMember& sample : beside) {
    if (sample.F.size() == 0) sample.member.system->residual(sample.member.state, F);
    out.F_lambda.head(n) += sample.weight * (sample.F.size() == 0 ? F : sample.F);
  }
  extend(here, *found, layout.border.column, out);
  out.pattern_of = state.active_set;
}

// --- guards ---------------------------------------------------------------------------------------------------------

bool EventSystem::vanishes(Index guard) const {
  return std::find(event_.guards.begin(), event_.guards.end(), guard) != event_.guards.end();
}

Vector EventSystem::guards(const State& state) const {
  const auto member = at(state);
  if (!member) return Vector::Ones(guard_count(state.active_set));
  Vector guards = member->system->guards(member->state);
  for (const Index j : event_.guards) guards[j] = 1.0;
  return guards;
}

Row EventSystem::guard_gradient(const State& state, Index j) const {
  const Index n = layout_of(state.active_set).base_size;
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  const auto member = at(state);
  if (vanishes(j) || !member) return row;
  const Row base = member->system->guard_gradient(member->state, j);
  row.dx.head(n) = base.dx;
  row.dx[n] = base.dlambda;
  for (const WeightedMember& sample : samples(in_common_terms(state), state.lambda))
    row.dlambda += sample.weight * sample.member.system->guard(sample.member.state, j);
  return row;
}

GuardsAlong EventSystem::guards_along(const State& state, const Direction& direction) const {
  const Index count = guard_count(state.active_set);
  const auto member = at(state);
  if (!member || count == 0) return {.values = Vector::Ones(count), .rates = Vector::Zero(count)};
  GuardsAlong along =
      member->system->guards_along(member->state, base_direction(direction, layout_of(state.active_set).base_size));
  if (direction.dlambda != 0.0)
    for (const WeightedMember& sample : samples(in_common_terms(state), state.lambda))
      along.rates += direction.dlambda * sample.weight * sample.member.system->guards(sample.member.state);
  for (const Index j : event_.guards) {
    along.values[j] = 1.0;
    along.rates[j] = 0.0;
  }
  return along;
}

std::string EventSystem::watched_place(const State& state, Index j) const {
  const auto member = at(state);
  return member ? member->system->watched_place(member->state, j) : std::string();
}

// --- other meshes ---------------------------------------------------------------------------------------------------

// What a transition of one of the family's systems, with the event's state at `from`, makes of that point of the curve;
// empty if the event is not on the new mesh.
std::optional<Transition> EventSystem::remeshed(const State& from, const Transition& transition,
                                                const Direction& forward) const {
  if (transition.change != Transition::Change::remeshed || transition.quantity) return std::nullopt;
  const auto event = family_.in_common_terms(transition.guess.get());
  const auto ahead = event ? family_.at(from.lambda, *event) : std::nullopt;
  if (!ahead) return std::nullopt;
  const Index count = ahead->system->guard_count(ahead->state.active_set);
  for (const Index j : event_.guards)
    if (j >= count || std::abs(ahead->system->guard(ahead->state, j)) > still_zero) return std::nullopt;
  auto border = event_border(event_.criterion, *ahead, metric_of(*ahead), make_);
  if (!border) return std::nullopt;
  State guess = extended(*ahead, *event, from.lambda, std::move(*border), &from);
  const Index n = event->x.size();
  Direction on = {.dx = Vector::Zero(guess.x.size()), .dlambda = forward.dlambda};
  on.dx.head(n) = transition.forward.dx;
  on.dx[n] = transition.forward.dlambda;
  return Transition{.change = Transition::Change::remeshed, .guess = std::move(guess), .forward = std::move(on)};
}

std::vector<Transition> EventSystem::transitions(const State& state, const Direction& forward, Index bound,
                                                 double tolerance) const {
  const auto member = at(state);
  if (!member) return {};
  const auto contacts = static_cast<Index>(member->state.active_set.size());
  if (bound >= contacts) {
    const auto ahead = member->system->transitions(
        member->state, base_direction(forward, layout_of(state.active_set).base_size), bound, tolerance);
    if (!ahead.empty())
      if (auto same_event = remeshed(state, ahead.front(), forward)) return {std::move(*same_event)};
  }
  Transition end{.change = Transition::Change::unsupported};
  end.detail = bound < contacts ? (member->state.active_set[static_cast<std::size_t>(bound)] != 0
                                       ? "a contact of the event opens there"
                                       : "another contact closes there")
                                : "a contact of the event changes its kind there";
  return {std::move(end)};
}

bool EventSystem::border_fits_at(const State& state, const SystemFamily::Member& member) const {
  return border_fits(member, layout_of(state.active_set).border, metric_of(member), make_) >= least_fit;
}

// The same point with a border made anew.
std::optional<Transition> EventSystem::with_new_border(const State& from, const Direction& forward) const {
  const State start = in_common_terms(from);
  const auto here = family_.at(from.lambda, start);
  if (!here) return std::nullopt;
  const auto before = along_path(from, *here);
  auto border = event_border(event_.criterion, *here, metric_of(*here), make_, before ? &*before : nullptr);
  if (!border) return std::nullopt;
  Transition same{.change = Transition::Change::remeshed};
  same.guess = extended(*here, start, from.lambda, std::move(*border), &from);
  same.forward = forward;
  return same;
}

// That of the member at the step's end on the step from the event's state at its start; and a border that fits no more.
StepVerdict EventSystem::check(const CheckedStep& step) const {
  const auto end = at(step.to);
  if (!end) return {.fault = step.located ? StepVerdict::Fault::penetration : StepVerdict::Fault::none};
  const auto begin = family_.at(step.to.lambda, in_common_terms(step.from));
  const State& start = begin ? begin->state : end->state;
  if (!step.located) return end->system->check({.from = start, .to = end->state});
  CheckedStep::LocatedEnd located = *step.located;
  const Direction* const given = std::exchange(located.from, nullptr);
  const Direction* const forward = begin ? given : nullptr;
  Direction of_member;
  if (forward != nullptr) {
    of_member = base_direction(*forward, layout_of(step.from.active_set).base_size);
    located.from = &of_member;
  }
  StepVerdict verdict = end->system->check({.from = start, .to = end->state, .located = located});
  std::vector<Transition> restarts;
  for (const Transition& layout : std::exchange(verdict.restarts, {}))
    if (auto same_event = remeshed(step.from, layout, *forward)) restarts.push_back(std::move(*same_event));
  if (verdict.fault == StepVerdict::Fault::none && !border_fits_at(step.to, *end)) {
    verdict.fault = StepVerdict::Fault::penetration;
    restarts.clear();
    if (forward != nullptr && !end->system->penetrated_place(end->state, located.gap_seen))
      if (auto same = with_new_border(step.from, *forward)) restarts.push_back(std::move(*same));
  }
  verdict.restarts = std::move(restarts);
  return verdict;
}

std::optional<std::string> EventSystem::penetrated_place(const State& state, double margin) const {
  const auto member = at(state);
  if (!member) return std::string();
  if (auto place = member->system->penetrated_place(member->state, margin)) return place;
  return border_fits_at(state, *member) ? std::nullopt : std::optional<std::string>(std::string());
}

// Its place is one of the member's unknowns.
std::optional<PathKink> EventSystem::kink_between(const State& from, const State& to) const {
  const auto begin = family_.at(to.lambda, in_common_terms(from)), end = at(to);
  if (!begin || !end || !end->system->kink_between(begin->state, end->state)) return std::nullopt;
  return PathKink{};
}

}  // namespace arcwall
