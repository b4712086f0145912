#include "model/recorder.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "model/deck/key_list.hpp"
#include "model/dissipation.hpp"
#include "model/event_names.hpp"
#include "model/friction_at_wall.hpp"

namespace arcwall {

namespace {

bool moves_supports(const deck::Deck& deck) {
  return std::any_of(deck.prescribed.begin(), deck.prescribed.end(),
                     [](const deck::Prescribed& moved) { return !moved.constant; });
}

std::optional<double> pressure_of(const ContactPoint& contact, const deck::Frame& frame) {
  auto pressure = contact.pressure();
  if (pressure) *pressure *= frame.factor(-1);
  return pressure;
}

std::optional<RecordFriction> friction_of(const ContactPoint& contact, const deck::Frame& frame) {
  if (!contact.friction) return std::nullopt;
  const FrictionOfContact& friction = *contact.friction;
  RecordFriction told{.mode = friction.mode,
                      .force = friction.force,
                      .coefficient = friction.coefficient,
                      .slip = frame.factor() * friction.slip,
                      .tangent_x = friction.tangent.x(),
                      .tangent_z = friction.tangent.y()};
  if (friction.anchor) told.anchor = frame.place(contact.place).x();
  return told;
}

std::vector<RecordForce> forces_at(const Model* model, const State& state) {
  std::vector<RecordForce> forces;
  if (model == nullptr || model->contacts() == nullptr) return forces;
  for (const ContactPoint& contact : model->contacts()->closed_contacts(state))
    forces.push_back({.label = contact.label,
                      .x = model->frame().place(contact.place).x(),
                      .force = contact.force,
                      .pressure = pressure_of(contact, model->frame()),
                      .friction = friction_of(contact, model->frame())});
  return forces;
}

// By differences: a system gives Π, but not its derivatives by λ and by the places of contact points.
double energy_rate(const Model& model, const State& state, const Direction& tangent) {
  constexpr double step = 1e-6;  // [path metric]
  const double at_fixed_slips =
      (model.energy(moved(state, tangent, step)) - model.energy(moved(state, tangent, -step))) / (2.0 * step);
  if (model.system().history() == nullptr) return at_fixed_slips;
  const ElasticFrictionPower power(*model.compliant(), "");
  return at_fixed_slips - model.frame().factor() * power.rate(state, tangent);
}

// Empty without a tangent.
std::optional<RecordRates> rates_along(const Model* model, const State& state, const Direction& tangent) {
  if (model == nullptr || tangent.dx.size() != state.x.size() || state.x.size() == 0) return std::nullopt;
  RecordRates rates{.lambda = tangent.dlambda, .energy = energy_rate(*model, state, tangent)};
  for (const MonitorColumn& monitor : model->monitors())
    rates.monitors.push_back(monitor.quantity->rate(state, tangent));
  return rates;
}

// The critical mode has no λ, and only that of a smooth crossing is known.
std::vector<double> mode_rates(const Model* model, const BranchPoint& point) {
  std::vector<double> result;
  if (model == nullptr || point.mode.dx.size() != point.state.x.size()) return result;
  for (const MonitorColumn& monitor : model->monitors())
    result.push_back(monitor.quantity->gradient(point.state).dx.dot(point.mode.dx));
  return result;
}

// What a monitor shows of what walls have dissipated.
double dissipation_of(const deck::Deck& deck, const deck::Monitor& monitor, const std::vector<double>& dissipation) {
  double sum = 0.0;
  for (std::size_t wall = 0; wall < dissipation.size(); ++wall)
    if (monitor.wall.empty() || monitor.wall == deck.walls[wall].name) sum += dissipation[wall];
  return monitor.sign * sum;
}

}  // namespace

Record empty_record(const Model& model) {
  const deck::Deck& deck = model.deck();
  Record record{.deck = std::filesystem::path(deck.source.file).filename().string(),
                .title = deck.title,
                .energy_unit = unit_text(deck::unit::energy, deck.units),
                .length_unit = deck.units.length,
                .force_unit = deck.units.force,
                .has_walls = !deck.walls.empty(),
                .has_friction = deck::has_friction(deck),
                .moves_supports = moves_supports(model.whole_deck())};
  for (const deck::Stage& stage : model.whole_deck().stages) record.stages.push_back(stage.name);
  for (const MonitorColumn& monitor : model.monitors())
    record.columns.push_back({monitor.name, monitor.unit, monitor.roundoff});
  return record;
}

Recorder::Recorder(const Model& model, Record& record, const BranchRecord& branch)
    : Recorder(&model, model.system(), record, record.branches.size()) {
  begin(branch);
}

Recorder::Recorder(const System& system, Record& record, const BranchRecord& branch)
    : Recorder(nullptr, system, record, record.branches.size()) {
  begin(branch);
}

void Recorder::begin(const BranchRecord& branch) {
  RecordBranch added{.id = static_cast<Index>(branch_),
                     .stage = model_ == nullptr ? 0 : model_->stage(),
                     .mirror_image = branch.mirror_image,
                     .found = branch.found,
                     .after_jump = branch.after_jump};
  if (branch.parent) added.parent = *branch.parent;
  const auto same = [&](const RecordBranchPoint& known) { return known.point == branch.origin; };
  const auto origin = std::find_if(record_.branch_points.begin(), record_.branch_points.end(), same);
  if (branch.origin && origin != record_.branch_points.end()) {
    added.origin = origin->event;
    record_.events[static_cast<std::size_t>(origin->event)].branches.push_back(added.id);
  }
  record_.branches.push_back(std::move(added));
}

// Monitors at a state; what friction has dissipated until there no state tells.
std::vector<double> Recorder::values(const State& state, const std::vector<double>& dissipation) const {
  std::vector<double> result;
  if (model_ == nullptr) return result;
  for (const MonitorColumn& monitor : model_->monitors())
    result.push_back(
        monitor.component == deck::Component::dissipation
            ? dissipation_of(model_->deck(), *deck::find(model_->deck().monitors, monitor.name), dissipation)
            : monitor.quantity->value(state));
  return result;
}

// A branch goes on from the event where it leaves another, a stage from where the one before has ended.
std::vector<double> Recorder::dissipation_at_start() const {
  const RecordBranch& branch = record_.branches[branch_];
  for (auto point = record_.points.rbegin(); point != record_.points.rend(); ++point) {
    if (!branch.origin) return point->dissipation;
    const RecordEvent& origin = record_.events[static_cast<std::size_t>(*branch.origin)];
    if (point->branch == origin.branch && point->step == origin.step) return point->dissipation;
  }
  return std::vector<double>(model_->deck().walls.size(), 0.0);
}

namespace {

// What friction of compliant walls has dissipated until a state, one a wall; it is part of the history.
std::vector<double> dissipated_elastically(const Model& model, const State& state) {
  const std::vector<deck::Wall>& walls = model.deck().walls;
  std::vector<double> sums(walls.size(), 0.0);
  const CompliantContact& contact = *model.compliant();
  for (Index j = 0; j < contact.contact_count(); ++j) {
    const auto wall = static_cast<std::size_t>(deck::find(walls, contact.wall(j).name) - walls.data());
    sums[wall] += model.frame().factor() * contact.elastic_friction()->dissipated(state, static_cast<std::size_t>(j));
  }
  return sums;
}

}  // namespace

// The slips just behind a point of the path, with what they have dissipated since an event at which unknowns changed.
std::vector<RecordSlip> Recorder::slips_behind(const State& event, const PathPoint& behind) const {
  const double unit = model_->frame().factor();
  std::vector<RecordSlip> slips = slips_along(model_->friction(), behind.state, behind.tangent, unit);
  if (event.active_set != behind.state.active_set)
    add_dissipated_before(*model_->friction(), event, behind.state, unit, slips);
  return slips;
}

// Empty without friction.
std::vector<double> Recorder::dissipation_until(const PathTangent& arrives, const PathPoint& to) const {
  if (model_ == nullptr || !record_.has_friction) return {};
  if (model_->system().history() != nullptr) return dissipated_elastically(*model_, to.state);
  if (record_.branches[branch_].points == 0) return dissipation_at_start();
  const RecordPoint& before = record_.points.back();
  std::vector<double> sums = before.dissipation;
  const auto wall_of = [&](const State& state, Index contact) {
    const std::vector<deck::Wall>& walls = model_->deck().walls;
    return deck::find(walls, model_->contacts()->contact(state, contact).label.wall) - walls.data();
  };
  const auto slips = slips_along(model_->friction(), arrives.state, arrives.tangent, model_->frame().factor());
  // Points that a step inserts are open: what slips has other numbers then, but the same order.
  for (std::size_t i = 0; i < slips.size() && slips.size() == before.slips.size(); ++i) {
    const auto wall = wall_of(arrives.state, slips[i].contact);
    sums[static_cast<std::size_t>(wall)] +=
        before.slips[i].before + dissipated(before.slips[i], slips[i], to.arc - before.arc);
  }
  if (to.state.active_set == arrives.state.active_set) return sums;
  for (const RecordSlip& behind : slips_behind(arrives.state, to))
    sums[static_cast<std::size_t>(wall_of(to.state, behind.contact))] += behind.before;
  return sums;
}

void Recorder::add(const Arc& arc, const PathPoint& leaves) {
  const PathPoint& to = arc.to;
  const PathTangent arrives = arc.arrives.value_or(PathTangent{.state = to.state, .tangent = to.tangent});
  const std::vector<double> dissipation = dissipation_until(arrives, to);
  const bool has_kink = leaves.state.active_set != arrives.state.active_set;
  record_.points.push_back(
      {.branch = branch().id,
       .step = branch().points,
       .arc = to.arc,
       .lambda = to.state.lambda,
       .monitors = values(to.state, dissipation),
       .count = to.count,
       .unstable_load_control = model_ == nullptr ? std::nullopt : model_->unstable_under_dead_load(to),
       .contacts = model_ == nullptr ? 0 : model_->closed_contacts(to.state),
       .energy = model_ == nullptr ? system_.energy(to.state) : model_->energy(to.state),
       .iterations = to.iterations,
       .residual = to.residual,
       .forces = forces_at(model_, to.state),
       .dissipation = dissipation,
       .slips = dissipation.empty() ? std::vector<RecordSlip>() : slips_behind(to.state, leaves),
       .rates = rates_along(model_, arrives.state, arrives.tangent),
       .rates_after = has_kink ? rates_along(model_, leaves.state, leaves.tangent) : std::nullopt,
       .state = to.state});
  ++branch().points;
  branch().least_lambda = std::min(branch().least_lambda, to.state.lambda);
  branch().greatest_lambda = std::max(branch().greatest_lambda, to.state.lambda);
  for (const Event& event : arc.events) {
    if (event.branching)
      record_.branch_points.push_back({.point = event.branching, .event = static_cast<Index>(record_.events.size())});
    add_event(recorded(event, to.state));
  }
}

void Recorder::end(const BranchEnd& end) {
  branch().end = end;
  if (branch().points == 0) return;
  const RecordPoint& last = record_.points.back();
  // It may stand on an event, and is no surer than that.
  double lambda_uncertainty = 0.0;
  for (auto event = record_.events.rbegin(); event != record_.events.rend(); ++event) {
    if (event->branch != branch().id || event->step != last.step) break;
    lambda_uncertainty = std::max(lambda_uncertainty, event->lambda_uncertainty);
  }
  add_event({.kind = EventKind::end,
             .arc = last.arc,
             .lambda = last.lambda,
             .monitors = last.monitors,
             .unstable_before = last.count.unstable,
             .unstable_after = last.count.unstable,
             .residual = last.residual,
             .lambda_uncertainty = lambda_uncertainty,
             .branch_end = end});
}

RecordEvent Recorder::recorded(const Event& event, const State& at) const {
  RecordEvent record{.kind = event.kind,
                     .arc = event.arc,
                     .lambda = at.lambda,
                     .monitors = values(at, record_.points.back().dissipation),
                     .unstable_before = event.unstable_before,
                     .unstable_after = event.unstable_after,
                     .residual = event.residual,
                     .lambda_uncertainty = event.lambda_uncertainty,
                     .extremum = event.extremum,
                     .continuum = event.continuum,
                     .unconfirmed = event.unconfirmed};
  if (const auto origin = record_.branches[branch_].origin; event.kind == EventKind::start && origin)
    record.lambda_uncertainty = record_.events[static_cast<std::size_t>(*origin)].lambda_uncertainty;
  if (event.kind == EventKind::turning_point || event.kind == EventKind::value_crossing) record.monitor = event.label;
  record.value = event.value;
  if (record.continuum && model_ != nullptr) {
    record.continuum->energy *= model_->frame().factor();
    record.continuum->length *= model_->frame().factor();
  }
  if (event.branching) {
    record.branch_type = event.branching->type;
    record.multiplicity = event.branching->multiplicity;
    record.mesh_artefact = event.branching->mesh_artefact;
    record.mode = mode_rates(model_, *event.branching);
  }
  const bool names_contacts = changes_contact(event.kind) || !event.friction_ways.empty();
  if (model_ == nullptr || !names_contacts) return record;
  for (const Index j : event.guards) {
    const ContactPoint contact = model_->contacts()->contact(event.state, j);
    record.contacts.push_back({.label = contact.label, .x = model_->frame().place(contact.place).x()});
    record.contacts.back().friction = friction_of(contact, model_->frame());
    if (record.contacts.back().friction) record.contacts.back().force = contact.force;
  }
  for (const FrictionWay& way : event.friction_ways) {
    RecordFrictionWay told{.lambda_sense = way.lambda_sense,
                           .dissipation = model_->frame().factor() * way.dissipation,
                           .unstable = way.unstable,
                           .taken = way.taken};
    for (const ModeOfContact& mode : way.modes)
      told.contacts.push_back(
          {.label = model_->contacts()->contact(event.state, mode.contact).label, .mode = mode.mode});
    record.ways.push_back(std::move(told));
  }
  record.all_ways_known = event.all_ways_known;
  return record;
}

void Recorder::add_event(RecordEvent event) {
  event.id = static_cast<Index>(record_.events.size());
  event.branch = branch().id;
  event.step = branch().points - 1;
  RecordPoint& point = record_.points.back();
  event.unstable_load_control = point.unstable_load_control;
  const bool adds_nothing = point.event && event.kind == EventKind::value_crossing;
  const bool is_told = !point.event || changes_contact(*point.event) || !changes_contact(event.kind);
  if (is_told && !adds_nothing) point.event = event.kind;
  record_.events.push_back(std::move(event));
}

}  // namespace arcwall
