#include "elements/kinked_springs.hpp"

#include <algorithm>
#include <utility>

namespace arcwall {

namespace {

// The entries of a row that are not zero: hardly any of a stretch.
std::vector<Index> entries_of(const Row& row) {
  std::vector<Index> entries;
  for (Index i = 0; i < row.dx.size(); ++i)
    if (row.dx[i] != 0.0) entries.push_back(i);
  return entries;
}

}  // namespace

KinkedSprings::KinkedSprings(const System& inner, const std::vector<Spring>& springs)
    : inner_(inner), springs_(springs) {
  for (std::size_t i = 0; i < springs_.size(); ++i)
    for (const SpringLaw::Kink& kink : springs_[i].law->kinks())
      kinks_.push_back({.spring = i,
                        .stretch = kink.stretch,
                        .jump = kink.jump,
                        .sense = kink.stretch < 0.0 ? -1.0 : 1.0,
                        .width = springs_[i].law->width()});
}

// Null of a guard of the inner system.
const KinkedSprings::Kink* KinkedSprings::kink(const ActiveSet& active_set, Index j) const {
  const Index k = j - static_cast<Index>(active_set.contacts());
  return k >= 0 && k < kink_count() ? &kinks_[static_cast<std::size_t>(k)] : nullptr;
}

// The inner system's number of a guard: kinks stand behind its contacts and before its validity bounds.
Index KinkedSprings::inner_number(const ActiveSet& active_set, Index j) const {
  return j < static_cast<Index>(active_set.contacts()) ? j : j - kink_count();
}

double KinkedSprings::stretch(const Kink& kink, const State& state) const {
  const Spring& spring = springs_[kink.spring];
  return spring.second->value(state) - (spring.first ? spring.first->value(state) : 0.0);
}

Row KinkedSprings::stretch_gradient(const Kink& kink, const State& state) const {
  const Spring& spring = springs_[kink.spring];
  Row row = spring.second->gradient(state);
  if (!spring.first) return row;
  const Row first = spring.first->gradient(state);
  row.dx -= first.dx;
  row.dlambda -= first.dlambda;
  return row;
}

// δ: whether the active set has passed the kink's stretch, less whether the stretch has.
double KinkedSprings::misplaced(const Kink& kink, bool beyond, double stretch) {
  const bool passed = beyond == (kink.sense > 0.0);
  return (passed ? 1.0 : 0.0) - (stretch >= kink.stretch ? 1.0 : 0.0);
}

// visit(kink, stretch, δ) of each kink on whose wrong side, by the active set, the stretch is.
template <class Visit>
void KinkedSprings::for_each_misplaced(const State& state, const Visit& visit) const {
  const std::size_t contacts = state.active_set.contacts();
  for (std::size_t k = 0; k < kinks_.size(); ++k) {
    const double u = stretch(kinks_[k], state);
    const double off = misplaced(kinks_[k], state.active_set[contacts + k] != 0, u);
    if (off != 0.0) visit(kinks_[k], u, off);
  }
}

State KinkedSprings::with_kinks(State state) const {
  if (state.active_set.kinks() == kinks_.size()) return state;
  std::vector<std::uint8_t> status;
  for (const Kink& kink : kinks_)
    status.push_back(kink.sense * (stretch(kink, state) - kink.stretch) > 0.0 ? std::uint8_t{1} : std::uint8_t{0});
  state.active_set = state.active_set.with_kinks(status);
  return state;
}

Row KinkedSprings::force_gradient_off(std::size_t spring, const State& state) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  if (state.active_set.kinks() == 0) return row;
  for_each_misplaced(state, [&](const Kink& kink, double, double off) {
    if (kink.spring != spring) return;
    const Row gradient = stretch_gradient(kink, state);
    row.dx += off * kink.jump * gradient.dx;
    row.dlambda += off * kink.jump * gradient.dlambda;
  });
  return row;
}

Row KinkedForce::gradient(const State& state) const {
  Row row = inner_->gradient(state);
  for (const Part& part : parts_) {
    const Row off = springs_.force_gradient_off(part.spring, state);
    row.dx += part.sign * off.dx;
    row.dlambda += part.sign * off.dlambda;
  }
  return row;
}

void KinkedSprings::residual(const State& state, Eigen::Ref<Vector> F) const {
  inner_.residual(state, F);
  for_each_misplaced(state, [&](const Kink& kink, double u, double off) {
    F += off * kink.jump * (u - kink.stretch) * stretch_gradient(kink, state).dx;
  });
}

void KinkedSprings::linearize(const State& state, Linearization& out) const {
  inner_.linearize(state, out);
  for_each_misplaced(state, [&](const Kink& kink, double u, double off) {
    const Row gradient = stretch_gradient(kink, state);
    const double k = off * kink.jump;
    out.F += k * (u - kink.stretch) * gradient.dx;
    out.F_lambda += k * gradient.dlambda * gradient.dx;
    const std::vector<Index> entries = entries_of(gradient);
    for (const Index column : entries)
      for (const Index row : entries)
        if (row >= column) out.K.coeffRef(row, column) += k * gradient.dx[row] * gradient.dx[column];
    if (entries.size() != 1) return;
    const Index i = entries.front();
    out.ground.push_back({.row = i, .column = i, .stiffness = k * gradient.dx[i] * gradient.dx[i]});
  });
}

double KinkedSprings::energy(const State& state) const {
  double energy = inner_.energy(state);
  for_each_misplaced(state, [&](const Kink& kink, double u, double off) {
    energy += 0.5 * off * kink.jump * (u - kink.stretch) * (u - kink.stretch);
  });
  return energy;
}

ActiveSet KinkedSprings::open_active_set() const {
  return inner_.open_active_set().with_kinks(std::vector<std::uint8_t>(kinks_.size(), 0));
}

double KinkedSprings::kink_guard(const Kink& kink, const State& state, std::size_t j) const {
  const double ahead = kink.sense * (kink.stretch - stretch(kink, state)) / kink.width;
  return state.active_set[j] != 0 ? -ahead : ahead;
}

Vector KinkedSprings::guards(const State& state) const {
  const Vector inner = inner_.guards(state);
  const auto contacts = static_cast<Index>(state.active_set.contacts()), kinks = kink_count();
  Vector guards(inner.size() + kinks);
  guards << inner.head(contacts), Vector::Zero(kinks), inner.tail(inner.size() - contacts);
  for (Index k = 0; k < kinks; ++k)
    guards[contacts + k] =
        kink_guard(kinks_[static_cast<std::size_t>(k)], state, static_cast<std::size_t>(contacts + k));
  return guards;
}

double KinkedSprings::guard(const State& state, Index j) const {
  if (const Kink* const at = kink(state.active_set, j)) return kink_guard(*at, state, static_cast<std::size_t>(j));
  return inner_.guard(state, inner_number(state.active_set, j));
}

Row KinkedSprings::guard_gradient(const State& state, Index j) const {
  const Kink* const at = kink(state.active_set, j);
  if (at == nullptr) return inner_.guard_gradient(state, inner_number(state.active_set, j));
  Row row = stretch_gradient(*at, state);
  const double factor = (state.active_set[static_cast<std::size_t>(j)] != 0 ? at->sense : -at->sense) / at->width;
  row.dx *= factor;
  row.dlambda *= factor;
  return row;
}

GuardsAlong KinkedSprings::guards_along(const State& state, const Direction& direction) const {
  const State without_kinks{.x = state.x, .lambda = state.lambda, .active_set = state.active_set.with_kinks({})};
  const GuardsAlong inner = inner_.guards_along(without_kinks, direction);
  const auto contacts = static_cast<Index>(state.active_set.contacts()), kinks = kink_count();
  GuardsAlong along{.values = guards(state), .rates = Vector(inner.rates.size() + kinks)};
  along.rates << inner.rates.head(contacts), Vector::Zero(kinks), inner.rates.tail(inner.rates.size() - contacts);
  for (Index j = contacts; j < contacts + kinks; ++j) along.rates[j] = apply(guard_gradient(state, j), direction);
  return along;
}

std::string KinkedSprings::watched_place(const State& state, Index j) const {
  if (kink(state.active_set, j) != nullptr) return "a kink of a spring's law";
  return inner_.watched_place(state, inner_number(state.active_set, j));
}

// Beyond the kink the law gives Δ w p more than straight on, in either sense.
Vector KinkedSprings::unit_force(const State& state, Index j) const {
  const Kink* const at = kink(state.active_set, j);
  if (at == nullptr) return inner_.unit_force(state, inner_number(state.active_set, j));
  return -at->jump * at->width * stretch_gradient(*at, state).dx;
}

Enforcement KinkedSprings::enforcement(const ActiveSet& active_set, Index j) const {
  if (kink(active_set, j) != nullptr) return {.compliance = 1.0};
  return inner_.enforcement(active_set, inner_number(active_set, j));
}

// A change of the mesh keeps to the pieces of the laws.
Transition KinkedSprings::keeping_kinks(Transition transition, const ActiveSet& from) const {
  transition.guess = Deferred<State>([inner = std::move(transition.guess), from] {
    State guess = inner.get();
    guess.active_set = guess.active_set.with_kinks_of(from);
    return guess;
  });
  return transition;
}

std::vector<Transition> KinkedSprings::transitions(const State& state, const Direction& forward, Index bound,
                                                   double tolerance) const {
  std::vector<Transition> found = inner_.transitions(state, forward, inner_number(state.active_set, bound), tolerance);
  for (Transition& transition : found) transition = keeping_kinks(std::move(transition), state.active_set);
  return found;
}

StepVerdict KinkedSprings::check(const CheckedStep& step) const {
  CheckedStep inner = step;
  if (inner.located && inner.located->guard) {
    auto& guard = inner.located->guard;
    guard = kink(step.from.active_set, *guard) != nullptr ? std::nullopt
                                                          : std::optional(inner_number(step.from.active_set, *guard));
  }
  StepVerdict verdict = inner_.check(inner);
  for (Transition& restart : verdict.restarts) restart = keeping_kinks(std::move(restart), step.from.active_set);
  return verdict;
}

}  // namespace arcwall
