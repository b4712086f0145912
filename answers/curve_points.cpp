#include "answers/curve_points.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "continuation/step/corrector.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

constexpr double vanishing = 1e-8;  // guards below this are zero at the event, which is landed on
constexpr double beside = 1e-4;     // of a point, where eigenvalues are counted [path metric]

bool is_at_change(const FoundEvent& found) {
  return std::any_of(found.arc.events.begin(), found.arc.events.end(), [](const Event& one) {
    return changes_contact(one.kind) || one.kind == EventKind::contact_limit_point;
  });
}

// What changes contact there, the fastest along the path first.
std::vector<Index> vanishing_guards(const System& system, const FoundEvent& found) {
  const State& state = found.event.state;
  const Vector guards = system.guards(state);
  std::vector<Index> list;
  for (Index j = 0; j < guards.size(); ++j)
    if (std::abs(guards[j]) <= vanishing) list.push_back(j);
  if (found.arc.to.tangent.dx.size() != state.x.size() || list.size() < 2) return list;
  const Vector rates = system.guards_along(state, found.arc.to.tangent).rates.cwiseAbs();
  std::stable_sort(list.begin(), list.end(), [&](Index a, Index b) { return rates[a] > rates[b]; });
  return list;
}

// Negative eigenvalues and the two nearest zero, a little way along a direction.
class Beside {
 public:
  Beside(const SystemFamily::Member& at, Metric metric, const MakeFactorization& make)
      : at_(at), metric_(std::move(metric)), corrector_(*at.system, {}, metric_.lambda_scale(), make) {}

  std::optional<Index> count(const Direction& along, double distance) {
    const State here = moved(at_.state, along, distance);
    const CorrectorResult result = corrector_.inspect(here, metric_, along);
    if (!result.converged()) return std::nullopt;
    return result.negative ? result.negative : corrector_.count_here(here, result.nearest);
  }

  // (−1)ⁿ |μ₁ μ₂|, with n negative eigenvalues, which are told, and the two nearest zero: continuous where these change
  // places with others.
  std::optional<double> nearest_product(const Direction& along, double distance, std::optional<Index>& negative) {
    negative = count(along, distance);
    const auto pairs = corrector_.near_null(moved(at_.state, along, distance), metric_.weights(), 2);
    if (!negative || !pairs || pairs->values.size() < 2) return std::nullopt;
    return (*negative % 2 == 0 ? 1.0 : -1.0) * std::abs(pairs->values[0] * pairs->values[1]);
  }

 private:
  const SystemFamily::Member& at_;
  Metric metric_;
  Corrector corrector_;
};

}  // namespace

constexpr const char* several_modes =
    "several modes are critical at once; add an imperfection that separates them, or follow another event";

std::optional<FollowedEvent> followed(const System& system, const FoundEvent& found, std::string& problem) {
  const auto refuse = [&](const char* why) {
    problem = why;
    return std::optional<FollowedEvent>();
  };
  const Event& event = found.event;
  if (event.unconfirmed) return refuse("the event is unconfirmed");
  const bool at_change = is_at_change(found);
  if (event.kind == EventKind::branch_point) {
    const BranchPoint& point = *event.branching;
    if (at_change || point.modes.empty())
      return refuse("several branches leave a contact change there; follow that contact change");
    if (point.multiplicity > 1) return refuse(several_modes);
    return FollowedEvent{.criterion = Criterion::crossing};
  }
  if (event.kind == EventKind::value_crossing) {
    if (at_change || found.arc.events.size() > 1)
      return refuse("another event lies at the same point; watch another value");
    return FollowedEvent{.criterion = Criterion::value, .value = *event.value};
  }
  if (at_change) {
    FollowedEvent contact{.criterion = Criterion::guard, .guards = vanishing_guards(system, found)};
    if (contact.guards.empty())
      return refuse("the contact change there is not exact, since the mesh changes with it; try other elements");
    return contact;
  }
  const bool crosses = std::any_of(found.arc.events.begin(), found.arc.events.end(),
                                   [](const Event& one) { return one.branching != nullptr; });
  if (crosses && event.kind == EventKind::limit_point) return refuse(several_modes);
  return FollowedEvent{.criterion = Criterion::turning};
}

double CurveReader::crossing_value(const State& state) const {
  const auto member = system_.at(state);
  const auto along = member ? system_.along_path(state, *member) : std::nullopt;
  if (!along) return std::nan("");
  const Metric metric = system_.metric_of(*member);
  if (system_.event().criterion == Criterion::guard) return along->dlambda / metric.lambda_scale();
  if (member->watched) return 1.0;
  Beside sides(*member, metric, factorization());
  SideCounts counts;
  const auto before = sides.nearest_product(*along, -beside, counts.before);
  const auto after = sides.nearest_product(*along, beside, counts.after);
  std::swap(counted_[0], counted_[1]);
  counted_[0] = {state, counts};
  return before && after ? (*after - *before) / (2.0 * beside) : std::nan("");
}

void add_scenery(const Model& model, const State& state, CurvePoint& to) {
  to.shape = shape_of(model, state);
  to.walls = wall_shapes(model, state.lambda);
  to.heights = section_heights(model.whole_deck());
}

CurvePoint CurveReader::read_off(const PathPoint& at, SideCounts& counts) const {
  const State& state = at.state;
  const auto member = system_.at(state);
  const auto model = family_.model(state.lambda);
  assert(member && model);
  CurvePoint point{.arc = at.arc, .key = state.lambda, .lambda = EventSystem::lambda_of(state)};
  for (const MonitorColumn& column : model->monitors()) point.monitors.push_back(column.quantity->value(member->state));
  const double slope = EventSystem::lambda_rate(state, at.tangent) / at.tangent.dlambda;
  if (std::isfinite(slope)) point.slope = slope;
  point.slopes = monitor_slopes(at);
  count_sides(state, *member, counts);
  point.unstable_before = counts.before;
  point.unstable_after = counts.after;
  point.contacts = model->closed_contacts(member->state);
  add_scenery(*model, member->state, point);
  point.state = system_.in_common_terms(state);
  return point;
}

// dm/dκ of the monitors along the curve: states that follow its tangent to the samples' values of κ.
std::vector<std::optional<double>> CurveReader::monitor_slopes(const PathPoint& at) const {
  const State& state = at.state;
  const State event = system_.in_common_terms(state);
  const std::size_t count = family_.own().monitors().size();
  std::vector<std::optional<double>> slopes(count);
  const Index n = event.x.size();
  const Direction motion{.dx = at.tangent.dx.head(n) / at.tangent.dlambda,
                         .dlambda = EventSystem::lambda_rate(state, at.tangent) / at.tangent.dlambda};
  if (!motion.dx.allFinite() || !std::isfinite(motion.dlambda)) return slopes;
  std::vector<double> sums(count, 0.0);
  for (const WeightedMember& sample : system_.samples(event, state.lambda)) {
    const State there = moved(sample.member.state, motion, sample.kappa - state.lambda);
    const std::vector<MonitorColumn>& monitors = family_.model(sample.kappa)->monitors();
    for (std::size_t i = 0; i < count; ++i) sums[i] += sample.weight * monitors[i].quantity->value(there);
  }
  for (std::size_t i = 0; i < count; ++i)
    if (std::isfinite(sums[i]) && !family_.own().monitors()[i].is_place) slopes[i] = sums[i];
  return slopes;
}

std::optional<SideCounts> CurveReader::counted(const State& state) const {
  for (const auto& [known, counts] : counted_)
    if (known == state) return counts;
  return std::nullopt;
}

// On both sides of the event, in the order that changes least from the point before.
void CurveReader::count_sides(const State& state, const SystemFamily::Member& member, SideCounts& counts) const {
  const auto along = system_.along_path(state, member);
  const SideCounts last = std::exchange(counts, {});
  if (!along) return;
  Beside sides(member, system_.metric_of(member), factorization());
  if (system_.event().criterion != Criterion::guard) {
    const auto known = counted(state);
    counts = known ? *known : SideCounts{sides.count(*along, -beside), sides.count(*along, beside)};
  } else {
    counts.before = sides.count(*along, 0.0);
    const auto j = static_cast<std::size_t>(system_.event().guards.front());
    if (j >= member.state.active_set.size()) return;
    ActiveSet other = member.state.active_set;
    other[j] = other[j] == 0 ? 1 : 0;
    const SystemFamily::Member behind{.system = member.system,
                                      .state = member.system->with_active_set(member.state, other)};
    Direction there{.dx = member.system->transfer(along->dx, member.state.active_set, other),
                    .dlambda = along->dlambda};
    counts.after = Beside(behind, system_.metric_of(behind), factorization()).count(there, 0.0);
  }
  const auto off = [](const std::optional<Index>& a, const std::optional<Index>& b) {
    return a && b ? std::abs(*a - *b) : 0;
  };
  if (off(counts.after, last.before) + off(counts.before, last.after) <
      off(counts.before, last.before) + off(counts.after, last.after))
    std::swap(counts.before, counts.after);
}

}  // namespace arcwall
