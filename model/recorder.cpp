#include "model/recorder.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "model/deck/key_list.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

bool moves_supports(const deck::Deck& deck) {
  return std::any_of(deck.prescribed.begin(), deck.prescribed.end(),
                     [](const deck::Prescribed& moved) { return !moved.constant; });
}

std::vector<double> values(const Model* model, const State& state) {
  std::vector<double> result;
  if (model == nullptr) return result;
  for (const MonitorColumn& monitor : model->monitors()) result.push_back(monitor.quantity->value(state));
  return result;
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
                      .slip = frame.factor() * friction.slip};
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

// Empty without a tangent.
std::optional<RecordRates> rates_along(const Model* model, const State& state, const Direction& tangent) {
  if (model == nullptr || tangent.dx.size() != state.x.size() || state.x.size() == 0) return std::nullopt;
  RecordRates rates{.lambda = tangent.dlambda};
  for (const MonitorColumn& monitor : model->monitors())
    rates.monitors.push_back(apply(monitor.quantity->gradient(state), tangent));
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

void Recorder::add(const Arc& arc, const PathPoint& leaves) {
  const PathPoint& to = arc.to;
  const PathTangent arrives = arc.arrives.value_or(PathTangent{.state = to.state, .tangent = to.tangent});
  const bool has_kink = leaves.state.active_set != arrives.state.active_set;
  record_.points.push_back(
      {.branch = branch().id,
       .step = branch().points,
       .arc = to.arc,
       .lambda = to.state.lambda,
       .monitors = values(model_, to.state),
       .count = to.count,
       .unstable_load_control = model_ == nullptr ? std::nullopt : model_->unstable_under_dead_load(to),
       .contacts = model_ == nullptr ? 0 : model_->closed_contacts(to.state),
       .energy = model_ == nullptr ? system_.energy(to.state) : model_->energy(to.state),
       .iterations = to.iterations,
       .residual = to.residual,
       .forces = forces_at(model_, to.state),
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
                     .monitors = values(model_, at),
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
  if (model_ == nullptr || !changes_contact(event.kind)) return record;
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
