#include "model/model.hpp"
#include "model/start_from_nodes.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/algebra/bordered_solver.hpp"
#include "core/text.hpp"
#include "model/build_compliant_walls.hpp"
#include "model/build_contact.hpp"
#include "model/build_monitors.hpp"
#include "model/build_path.hpp"
#include "model/build_structure.hpp"
#include "model/deck/words.hpp"
#include "model/deck_checks.hpp"
#include "model/deck_mesh.hpp"
#include "model/deck_scales.hpp"
#include "model/support_reaction.hpp"

namespace arcwall {

namespace {

std::shared_ptr<const deck::Deck> in_frame(std::shared_ptr<const deck::Deck> deck, const deck::Frame& frame) {
  return frame.is_users() ? deck : std::make_shared<const deck::Deck>(deck::in_frame(*deck, frame));
}

bool moves_walls(const deck::Deck& deck) {
  return std::any_of(deck.walls.begin(), deck.walls.end(),
                     [](const deck::Wall& wall) { return !motion_of(wall).is_none(); });
}

bool has_interference(const deck::Deck& deck) {
  return std::any_of(deck.walls.begin(), deck.walls.end(),
                     [](const deck::Wall& wall) { return wall.interference > 0.0; });
}

// Whether a grip holds a point in a stage: what acts on that point changes what the grip bears, if nothing else.
bool has_grip(const deck::Deck& deck, std::size_t stage) {
  for (std::size_t i = 0; i < deck.prescribed.size(); ++i)
    if (const auto grips = gripping_stage(deck, i); grips && *grips <= stage) return true;
  return false;
}

deck::Deck with_holds(deck::Deck deck, const LooseHolds& holds) {
  const std::vector<deck::Spring> springs = holds.springs();
  deck.springs.insert(deck.springs.end(), springs.begin(), springs.end());
  return deck;
}

std::vector<Index> nodes_of(const LooseHolds& holds, const StructureOfDeck& described, const Structure& structure) {
  std::vector<Index> nodes;
  for (const LooseHolds::Hold& hold : holds.holds)
    nodes.push_back(described.places.find(hold.at, structure.members()).node);
  return nodes;
}

// Of a deck whose problems are known.
std::vector<Candidate> nodes_that_touch(const Assembly& assembly) {
  if (assembly.deck->walls.empty() || assembly.deck->contact.is_compliant()) return {};
  DeckProblems known(assembly.deck->source);
  return contact_candidates(*assembly.deck, *assembly.structure, {}, known, known);
}

// What is looked for beside the path is looked for on the deck's mesh.
void check_search(const Model& model, DeckProblems& problems) {
  if (model.deck().path.search && !DeckMesh(model).is_complete())
    problems.add(model.deck().path.position, "path.search", "the deck's mesh has unknowns that its contact does not",
                 "leave out search, or write contact.points = \"nodes\"");
}

}  // namespace

// The models of later stages are built once to see whether they can be.
Model::Model(deck::Deck deck, const std::optional<deck::Frame>& frame)
    : Model(std::make_shared<const deck::Deck>(deck), frame ? *frame : deck::frame_of(deck)) {}

Model::Model(std::shared_ptr<const deck::Deck> given, const deck::Frame& frame)
    : Model(std::make_shared<const deck::Deck>(with_visits_as_stages(*given)), frame, 0, std::nullopt) {
  given_deck_ = std::move(given);
  for (std::size_t stage = 1; stage < whole_deck_->stages.size(); ++stage)
    for (const std::string& warning : Model(whole_deck_, this->frame(), static_cast<Index>(stage), progress_).warnings_)
      if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end()) warnings_.push_back(warning);
}

StageEnd Model::end_in(const State& last) const {
  StageEnd end{.lambda = last.lambda};
  for (const GrippedPoint& point : gripped_next_)
    end.grips.push_back({.x = frame().factor() * point.x->value(last),
                         .z = frame().factor() * point.z->value(last),
                         .rotation = point.rotation ? point.rotation->value(last) : 0.0});
  return end;
}

bool Model::begin_stage(StageEnd end) {
  const std::size_t ended = ended_stages_.size();
  if (ended + 1 >= whole_deck_->stages.size()) return false;
  if (end.grips.size() != grips_of(*whole_deck_, ended + 1).size()) return false;
  const Model& last = at_stage(static_cast<Index>(ended));
  auto progress = progress_after(*whole_deck_, ended, end, last.progress_);
  later_.push_back(
      std::unique_ptr<Model>(new Model(whole_deck_, frame(), static_cast<Index>(ended) + 1, std::move(progress))));
  later_.back()->given_deck_ = given_deck_;
  ended_stages_.push_back(std::move(end));
  return true;
}

Model::Model(std::shared_ptr<const deck::Deck> whole, const deck::Frame& frame, Index stage,
             std::optional<std::vector<DrivenThing>> progress)
    : whole_deck_(std::move(whole)),
      stage_(stage),
      progress_(progress ? std::move(*progress) : things_to_drive(*whole_deck_)),
      path_{.deck = in_frame(deck_of_stage(whole_deck_, static_cast<std::size_t>(stage), progress_), frame)} {
  DeckProblems problems(whole_deck_->source);
  StructureOfDeck described = describe_structure(deck(), problems);
  problems.raise();
  DeckProblems mechanism(whole_deck_->source);
  check_mechanism(deck(), mechanism);
  LooseHolds until_stiffened;  // of a mechanism that what is constant stiffens
  if (!mechanism.empty()) {
    if (hold_loose_bodies())
      described = describe_structure(deck(), problems);
    else
      until_stiffened = holds_until_stiffened(deck());
    if (until_stiffened.empty()) check_mechanism(deck(), problems);
    problems.raise();
  }
  hold_between_walls(deck(), described.builder);

  path_.structure = described.builder.build();
  const bool changes_a_grip = structure().size({}) > 0 && has_grip(*whole_deck_, static_cast<std::size_t>(stage_));
  if (!moves_something(structure()) && !changes_a_grip && (structure().size({}) == 0 || !moves_walls(deck())))
    report_nothing_moves(*whole_deck_, static_cast<std::size_t>(stage_), structure().size({}) == 0, problems);
  if (takes_increments(deck(), structure(), problems))
    path_.increments = std::make_unique<IncrementalStructure>(structure());
  DeckProblems not_at_rest(whole_deck_->source);  // where a stage begins the structure is no longer there
  if (may_slide(deck(), described.builder))
    path_.sliding_structure = described.builder.build_sliding(path_.is_ramp, may_join());
  const PinchedPlaces pinched = sliding_structure() ? pinched_places(deck(), *sliding_structure()) : PinchedPlaces{};
  DeckProblems& at_rest = stage_ == 0 ? problems : not_at_rest;
  check_compliant_walls(deck(), structure(), at_rest);
  std::vector<Candidate> candidates;
  if (!deck().contact.is_compliant()) candidates = contact_candidates(deck(), structure(), pinched, at_rest, problems);
  const bool sliding = slides(deck(), described.builder, candidates, problems);
  if (stage_ == 0) check_friction(deck(), structure(), candidates, sliding ? sliding_structure() : nullptr, problems);
  if (!sliding) path_.sliding_structure.reset();
  if (!sliding) check_hollow_corners(deck(), problems);
  std::vector<std::uint8_t> node_contacts;
  if (!sliding) node_contacts = stand_for_members(structure(), candidates);
  path_.held = nodes_of(path_.holds, described, structure());
  if (problems.empty()) path_.add_contact(std::move(candidates), scales_of_contact(), path_.holds.stiffness());
  path_.add_body();
  if (problems.empty() && has_ramp()) ramp_ = make_ramp(described, until_stiffened);
  if (sliding && stage_ == 0 && problems.empty())
    check_between_nodes(deck(), ramp_ ? *ramp_->sliding : *path_.sliding, problems);
  if (sliding && stage_ == 0 && problems.empty() && path_.sliding->has_friction())
    check_friction_at_start(ramp_ ? *ramp_->sliding : *path_.sliding, ramp_ ? 1.0 : deck().path.step, problems);
  const Measured read_off{.structure = structure(),
                          .body = body(),
                          .places = described.places,
                          .contacts = contacts(),
                          .walls_are_rigid = contact() != nullptr,
                          .kinked = path_.kinked.get()};
  monitors_ = monitor_columns(deck(), read_off, problems);
  structure().nodal_terms().for_each_moved_support(
      [&](Index dof, double rate) { moved_.push_back({.rate = rate, .reaction = support_reaction(read_off, dof)}); });
  for (const std::size_t next : grips_of(*whole_deck_, static_cast<std::size_t>(stage_) + 1)) {
    const std::string& point = whole_deck_->prescribed[next].point;
    const Index node = described.places.joints.at(point);
    const auto rotation = described.places.rotations.find(point);
    gripped_next_.push_back(
        {.x = body().motion(structure().dof(node, Dof::x)),
         .z = body().motion(structure().dof(node, Dof::z)),
         .rotation = rotation == described.places.rotations.end() ? nullptr : body().motion(rotation->second)});
  }
  options_ = trace_options(deck(), read_off, monitors_, problems);
  options_.node_contacts = std::move(node_contacts);
  check_watched(deck(), problems);
  if (problems.empty()) check_search(*this, problems);
  if (stage_ == 0) check_sensitivity(*whole_deck_, problems);
  if (stage_ == 0) check_curve(*whole_deck_, problems);
  problems.raise();
  if (is_loose()) {
    options_.lambda_scale = lambda_scale_if_held(path_);
    options_.corner.max_enumerated = 0;
  }

  if (contact() && stage_ == 0) {
    std::vector<std::string> told = interference_warnings(deck(), *contact(), path_.sliding.get());
    std::move(told.begin(), told.end(), std::back_inserter(warnings_));
  }
  if (contact()) {
    const ContactScales& scales = sliding ? path_.sliding->scales() : contact()->scales();
    options_.mesh_error_of_forces = mesh_error_of_forces(scales);
  }
  for (const std::string& name : deck().path.watch) {
    const MonitorColumn& column = *deck::find(monitors_, name);
    watched_.push_back({.quantity = column.quantity, .label = name, .kind = kind_of(column, deck())});
  }
  explore_.policy = deck().path.branches;
  explore_.depth = deck().path.depth;
  for (const MonitorColumn& monitor : monitors_)
    if (!monitor.is_place) explore_.preference.push_back(monitor.raw);
  if (stage_ == 0)
    for (const deck::Spring& spring : deck().springs) {
      if (std::string warning = smoothed_law(spring, frame.factor()); !warning.empty())
        warnings_.push_back(std::move(warning));
      if (!is_loose()) continue;
      if (std::string warning = flat_law(spring, deck().units); !warning.empty())
        warnings_.push_back(std::move(warning));
    }
  if (is_unbounded(deck().path))
    warnings_.push_back("no bound in [path.stop] ends the path: it continues to path.max_points = " +
                        std::to_string(deck().path.max_points) +
                        ", the default, whatever λ is then; give bounds, as stop = { lambda = [-1.0, 10.0] }");
  if (deck().path.events != EventSearch::locate && explore_.policy != BranchPolicy::primary &&
      !wants_increments(deck()))
    warnings_.push_back("events = \"" + deck::text_of(deck::events_words, deck().path.events) +
                        "\" locates no bifurcations, so branches = \"" +
                        deck::text_of(deck::branches_words, explore_.policy) +
                        "\" has no effect and the run stays on its first branch; leave out events, or write branches = "
                        "\"primary\"");
  if (const std::string warning = start_outside_bounds(deck().path); !warning.empty() && !wants_increments(deck()))
    warnings_.push_back(warning);
}

std::shared_ptr<const Observable> Model::quantity(const std::string& name) const {
  if (name == "lambda") return std::make_shared<ParameterValue>();
  const MonitorColumn* const column = deck::find(monitors_, name);
  return column != nullptr ? column->quantity : nullptr;
}

// Springs for what nothing but contact holds are part of the deck that is traced.
bool Model::hold_loose_bodies() {
  path_.holds = loose_holds(deck());
  if (!is_loose()) return false;
  path_.deck = std::make_shared<const deck::Deck>(with_holds(deck(), path_.holds));
  warnings_.push_back(path_.holds.warning(deck()));
  return true;
}

// The deck's structure with other springs in place of those that hold loose bodies.
StructureOfDeck Model::described_with(const LooseHolds& holds) const {
  deck::Deck held = deck();
  held.springs.resize(held.springs.size() - path_.holds.holds.size());
  held = with_holds(std::move(held), holds);
  DeckProblems known(held.source);
  StructureOfDeck described = describe_structure(held, known);
  hold_between_walls(held, described.builder);
  return described;
}

// The structure with springs as stiff as its members in place of those that hold loose bodies.
std::unique_ptr<Structure> Model::stiffly_held(const Assembly& of) const {
  return described_with(path_.holds.with_stiffness(softest_stiffness(deck(), structure()))).builder.build(of.is_ramp);
}

// While constant loads grow the springs of loose bodies may bear a small part of them: which way the bodies go to their
// rest is then no matter of round-off in the members' axial forces.
double Model::stiffness_of_ramp_holds() const {
  constexpr double borne = 1e-4;  // of the resultant of constant loads, by springs that give by the structure's size
  if (!is_loose()) return 0.0;
  return std::max(path_.holds.stiffness(), borne * constant_resultant(deck()).norm() / structure().length_scale());
}

// A loose body moves by any amount under hardly any load before it meets something: the λ that would deform it counts.
double Model::lambda_scale_if_held(const Assembly& of) const {
  Assembly stiff{.deck = of.deck, .structure = stiffly_held(of)};
  stiff.add_contact(nodes_that_touch(stiff), scales_of_contact(), 0.0);
  TraceOptions options = options_;
  options.lambda_scale.reset();
  const System& system = stiff.system();
  const ActiveSet open = system.open_active_set();
  return Tracer(system, {.state = {.x = Vector::Zero(system.size(open)), .lambda = 0.0, .active_set = open}}, options)
      .lambda_scale();
}

// Whether the structure resists by itself, where a mechanism was held, more than the springs did.
bool Model::is_stiffened(const State& state) const {
  if (is_loose() || ramp_->holds.empty()) return true;
  Linearization now;
  BorderedSolver solver;
  system().linearize(state, now);
  if (solver.factorize(now, system().multiplier_count(state.active_set)) != FactorStatus::ok) return false;
  for (std::size_t i = 0; i < ramp_->held.size(); ++i)
    for (const Dof direction : {Dof::x, Dof::z}) {
      const deck::Stiffness& springs = ramp_->holds.holds[i].stiffness;
      const double stiffness = direction == Dof::x ? springs.x : springs.z;
      const Vector unit = body().motion(structure().dof(ramp_->held[i], direction))->gradient(state).dx;
      Matrix moved = unit;
      if (!solver.solve_inner(moved) || !(stiffness * std::abs(unit.dot(moved.col(0))) < 1.0)) return false;
    }
  return true;
}

std::optional<std::string> Model::adrift(const State& state) const {
  for (std::size_t i = 0; i < path_.held.size(); ++i) {
    double squared = 0.0;
    for (const Dof direction : {Dof::x, Dof::z})
      squared += std::pow(body().motion(structure().dof(path_.held[i], direction))->value(state), 2.0);
    if (squared <= std::pow(LooseHolds::farthest * structure().length_scale(), 2.0)) continue;
    return "neither supports nor contact hold the body at \"" + to_text(path_.holds.holds[i].at) +
           "\", which has moved by more than " + std::to_string(LooseHolds::farthest) +
           " times the size of the structure";
  }
  return std::nullopt;
}

bool Model::has_ramp() const {
  const auto constant = [](const auto& driven) { return driven.constant; };
  return stage_ == 0 && (std::any_of(whole_deck_->loads.begin(), whole_deck_->loads.end(), constant) ||
                         std::any_of(whole_deck_->prescribed.begin(), whole_deck_->prescribed.end(), constant) ||
                         has_interference(deck()));
}

// The path's structure and contacts while what is constant grows.
Assembly Model::make_ramp(const StructureOfDeck& described, const LooseHolds& until_stiffened) const {
  Assembly ramp{.deck = std::make_shared<const deck::Deck>(with_walls_of_ramp(deck(), structure())),
                .is_ramp = true,
                .holds = is_loose() ? path_.holds.with_stiffness(stiffness_of_ramp_holds()) : until_stiffened};
  ramp.held = nodes_of(ramp.holds, described, structure());
  const StructureBuilder builder = ramp.holds.empty() ? described.builder : described_with(ramp.holds).builder;
  ramp.structure = builder.build(ramp.is_ramp);
  if (sliding_structure()) ramp.sliding_structure = builder.build_sliding(ramp.is_ramp, may_join());
  ramp.add_contact(nodes_that_touch(ramp), scales_of_contact(), stiffness_of_ramp_holds());
  ramp.add_body();
  return ramp;
}

// Of the path, and of what is derived from it.
ContactScales Model::scales_of_contact() const {
  if (contact()) return contact()->scales();
  if (deck().walls.empty() || deck().contact.is_compliant()) return {};
  const auto held = is_loose() ? stiffly_held(path_) : nullptr;
  return contact_scales(deck(), structure(), held ? *held : structure(), deck().path.step);
}

// Whether members may be one strand. The strands of the ramp are those of the path, which is built first: λ may load
// two members differently that what is constant loads alike.
std::function<bool(const std::string&, const std::string&)> Model::may_join() const {
  const auto strands_at_ends = [this](const std::string& member) {
    constexpr double inside = 1e-9;  // fraction
    return std::array{sliding_structure()->find(member, inside).strand,
                      sliding_structure()->find(member, 1.0 - inside).strand};
  };
  const auto are_joined = [=](const std::string& a, const std::string& b) {
    const auto of_a = strands_at_ends(a), of_b = strands_at_ends(b);
    return std::find_first_of(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) != of_a.end();
  };
  return [=, this](const std::string& a, const std::string& b) {
    return same_walls(deck(), a, b) && !is_driven_apart(*whole_deck_, a) && !is_driven_apart(*whole_deck_, b) &&
           (!sliding_structure() || are_joined(a, b));
  };
}

LoadIncrements Model::increments(State start) {
  const double scale = Tracer(system(), start, options_).lambda_scale();
  const Index n = structure().size({});
  const auto advance = [this, n](const State& state) {
    path_.increments->advance({.x = state.x.head(n), .lambda = state.lambda});
  };
  return {system(), std::move(start), scale, advance, options_.factorization};
}

// Where λ goes on from rest. Of a member that lies flush on a wall along a part of it, no gap tells how much of the
// part stays in contact, and for small λ the answer does not depend on λ: the path begins behind the first step then,
// where contact at the nodes has decided.
State Model::begun_at_rest(const Assembly& of, double first) const {
  if (!of.sliding || of.sliding->friction() || of.kinked || !of.sliding->rests_on_part()) return of.start(first);
  if (auto begun = begun_from_nodes(of, options_up_to(of, first), options_)) return *begun;
  return of.start(first);
}

std::optional<State> Model::start(std::string& reason) const {
  if (!ramp_) return begun_at_rest(path_, deck().path.step);
  std::optional<State> state = grown(reason);
  if (!state) return std::nullopt;
  if (sliding()) {
    state->lambda = deck().path.step;
    reason = sliding()->why_not_lying(sliding()->adopted(*state));
    if (!reason.empty()) return std::nullopt;
  }
  if (compliant() && compliant()->elastic_friction())
    state = compliant()->elastic_friction()->without_dissipation(*state);
  state->lambda = 0.0;
  State begun = begun_from(*state);
  if (is_stiffened(begun)) return begun;
  reason =
      "the structure is a mechanism, which can move without strain, and the constant loads and movements do not "
      "stiffen it";
  return std::nullopt;
}

// A path from rest to a λ, with the options of Newton's method alone.
TraceOptions Model::options_up_to(const Assembly& of, double lambda) const {
  TraceOptions options;
  options.step.first = lambda;
  options.mesh_error_of_forces = options_.mesh_error_of_forces;
  options.target_values.push_back(
      {.quantity = std::make_shared<ParameterValue>(), .value = lambda, .stops = true, .label = "all"});
  if (is_loose()) {
    options.lambda_scale = lambda_scale_if_held(of);
    options.corner.max_enumerated = 0;
  }
  return options;
}

// What is constant grows from nothing along a path of its own, contacts included. The state is the ramp's.
std::optional<State> Model::grown(std::string& reason) const {
  TraceOptions options = options_up_to(*ramp_, 1.0);
  options.step.first = 0.1;
  constexpr int most_laid = 20;  // so often: what is laid down may peel off again
  int laid = 0;
  constexpr double far_back = -1.0;  // of their value: a path that has turned back by so much does not return
  double most = 0.0;
  State state = begun_at_rest(*ramp_, options.step.first);
  std::optional<Tracer> tracer(std::in_place, ramp_->system(), state, options);
  while (const auto arc = tracer->next()) {
    state = arc->to.state;
    most = std::max(most, state.lambda);
    if (state.lambda < far_back) break;
    if (auto why = adrift(state)) {
      reason = "the constant loads and movements find no equilibrium: " + *why;
      return std::nullopt;
    }
    // A loose body that comes down flush on a wall touches it all along at once, which no event of a path is: it is
    // laid down, and the ramp goes on from there.
    const bool falls = ramp_->sliding && is_loose() && state.lambda != 1.0 && laid < most_laid;
    auto lying = falls ? ramp_->sliding->with_strands_come_to_lie(state, 1.0) : std::nullopt;
    if (!lying) continue;
    lying->active_set = lying->active_set.with_kinks_of(state.active_set);
    tracer.emplace(ramp_->system(), std::move(*lying), options);
    ++laid;
  }
  if (tracer->end() && tracer->end()->reason == EndReason::stop) return state;
  const bool turns_back = state.lambda < most;
  reason = "the constant loads and movements find no equilibrium: their growth";
  if (turns_back)
    reason += fmt::format(" turns back at about {:.2g} of their value, where the structure buckles or snaps", most);
  if (tracer->end())
    reason += fmt::format("{} ends at {:.4g} of {} ({})", turns_back ? ", and" : "", state.lambda,
                          turns_back ? "it" : "their value", tracer->end()->detail);
  return std::nullopt;
}

// λ goes from 0 on in the direction of the first step.
State Model::begun_from(const State& state) const {
  if (!sliding()) return state;
  State begun = sliding()->with_flat_parts_loaded(sliding()->adopted(state), deck().path.step);
  begun.active_set = begun.active_set.with_kinks_of(state.active_set);
  return begun;
}

State Model::taken_over(const State& last, const Model& before) const {
  State state = grips_of(*whole_deck_, static_cast<std::size_t>(stage_)).empty() ? last : gripped(last, before);
  if (!whole_deck_->stages[static_cast<std::size_t>(stage_)].goes_on) state.lambda = 0.0;
  return begun_from(state);
}

// The unknowns of the stage before, but for those that this stage holds where they are.
State Model::gripped(const State& state, const Model& before) const {
  if (sliding()) return sliding()->gripped(*before.sliding(), state);
  Vector x(structure().size({}));
  for (Index i = 0; i < x.size(); ++i) x[i] = before.structure().value(state, structure().dof_of_unknown(i));
  if (contact()) return contact()->gripped(*before.contact(), state, x);
  return {.x = std::move(x), .lambda = state.lambda, .active_set = state.active_set};
}

// With λ as one more unknown the second variation has the same unstable directions, and one more if the force that goes
// with λ, Σ ū′ R, falls along the path: Haynsworth's inertia of K and of what eliminating the unknowns leaves.
std::optional<Index> Model::unstable_under_dead_load(const PathPoint& point) const {
  constexpr double vanishing = 1e-6;  // of the parts of a rate
  if (moved_.empty() || !point.count.unstable) return std::nullopt;
  const bool is_symmetric = system().slipping(point.state.active_set).empty() && system().history() == nullptr;
  if (!is_symmetric) return std::nullopt;
  double rate = 0.0, size = 0.0;
  for (const MovedDof& moved : moved_) {
    const Row row = moved.reaction->gradient(point.state);
    const Vector parts = row.dx.cwiseProduct(point.tangent.dx);
    rate += moved.rate * (parts.sum() + row.dlambda * point.tangent.dlambda);
    size += std::abs(moved.rate) * (parts.cwiseAbs().sum() + std::abs(row.dlambda * point.tangent.dlambda));
  }
  const bool turns = std::abs(rate) <= vanishing * size || point.tangent.dlambda == 0.0;
  if (turns) return std::nullopt;
  return *point.count.unstable + (rate * point.tangent.dlambda < 0.0 ? 1 : 0);
}

// A pinch is one contact of the active set and two of the user.
Index Model::closed_contacts(const State& state) const {
  const std::size_t pinches = sliding() ? sliding_layout(state.active_set).pinched_points().size() : 0;
  return state.active_set.closed_count() + static_cast<Index>(pinches);
}

}  // namespace arcwall
