#include "model/model.hpp"

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

// By so many times the structure's size loose bodies may move before they count as adrift: a wall may be that far.
constexpr int farthest = 20;

std::vector<std::string> names_of_walls(const deck::Deck& deck) {
  std::vector<std::string> names;
  for (const deck::Wall& wall : deck.walls) names.push_back(wall.name);
  return names;
}

bool has_interference(const deck::Deck& deck) {
  return std::any_of(deck.walls.begin(), deck.walls.end(),
                     [](const deck::Wall& wall) { return wall.interference > 0.0; });
}

std::vector<Theory> theories_of(const deck::Deck& deck) {
  std::vector<Theory> theories;
  for (const deck::Member& member : deck.members) theories.push_back(member.theory);
  return theories;
}

// Whether a grip holds a point in a stage: what acts on that point changes what the grip bears, if nothing else.
bool has_grip(const deck::Deck& deck, std::size_t stage) {
  for (std::size_t i = 0; i < deck.prescribed.size(); ++i)
    if (const auto grips = gripping_stage(deck, i); grips && *grips <= stage) return true;
  return false;
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
    : Model(std::make_shared<const deck::Deck>(deck), frame ? *frame : deck::frame_of(deck), 0, std::nullopt) {
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
  ended_stages_.push_back(std::move(end));
  return true;
}

Model::Model(std::shared_ptr<const deck::Deck> whole, const deck::Frame& frame, Index stage,
             std::optional<std::vector<DrivenThing>> progress)
    : whole_deck_(std::move(whole)),
      stage_(stage),
      progress_(progress ? std::move(*progress) : things_to_drive(*whole_deck_)),
      deck_(in_frame(deck_of_stage(whole_deck_, static_cast<std::size_t>(stage), progress_), frame)) {
  DeckProblems problems(whole_deck_->source);
  StructureOfDeck described = describe_structure(*deck_, problems);
  problems.raise();
  DeckProblems mechanism(whole_deck_->source);
  check_mechanism(*deck_, mechanism);
  if (!mechanism.empty()) {
    if (hold_loose_bodies())
      described = describe_structure(*deck_, problems);
    else
      ramp_holds_ = holds_until_stiffened(*deck_);
    if (ramp_holds_.empty()) check_mechanism(*deck_, problems);
    problems.raise();
  }
  hold_between_walls(*deck_, described.builder);

  structure_ = described.builder.build();
  const bool changes_a_grip = structure_->size({}) > 0 && has_grip(*whole_deck_, static_cast<std::size_t>(stage_));
  if (!moves_something(*structure_) && !changes_a_grip && (structure_->size({}) == 0 || !moves_walls(*deck_)))
    report_nothing_moves(*whole_deck_, static_cast<std::size_t>(stage_), structure_->size({}) == 0, problems);
  if (takes_increments(*deck_, *structure_, problems))
    incremental_structure_ = std::make_unique<IncrementalStructure>(*structure_);
  DeckProblems not_at_rest(whole_deck_->source);  // where a stage begins the structure is no longer there
  if (may_slide(*deck_, described.builder)) sliding_structure_ = sliding_structure(described.builder, false);
  const PinchedPlaces pinched = sliding_structure_ ? pinched_places(*deck_, *sliding_structure_) : PinchedPlaces{};
  DeckProblems& at_rest = stage_ == 0 ? problems : not_at_rest;
  check_compliant_walls(*deck_, *structure_, at_rest);
  std::vector<Candidate> candidates;
  if (!deck_->contact.is_compliant()) candidates = contact_candidates(*deck_, *structure_, pinched, at_rest);
  const bool sliding = slides(*deck_, described.builder, candidates, problems);
  if (stage_ == 0) check_friction(*deck_, *structure_, candidates, sliding, problems);
  if (!sliding) sliding_structure_.reset();
  if (!sliding) check_hollow_corners(*deck_, problems);
  std::vector<std::uint8_t> node_contacts;
  if (!sliding) node_contacts = stand_for_members(*structure_, candidates);
  if (problems.empty()) make_contact(described.builder, std::move(candidates), sliding);
  for (const LooseHolds::Hold& hold : loose_holds_.holds)
    held_.push_back(described.places.find(hold.at, structure_->members()).node);
  for (const LooseHolds::Hold& hold : ramp_holds_.holds)
    held_in_ramp_.push_back(described.places.find(hold.at, structure_->members()).node);
  if (sliding_ && stage_ == 0 && problems.empty())
    check_between_nodes(*deck_, sliding_ramp_ ? *sliding_ramp_ : *sliding_, problems);
  body_ = sliding ? body_of(*structure_, *sliding_structure_)
                  : body_of(*structure_, theories_of(*deck_), incremental_structure_.get());
  make_kinks();
  const Measured read_off{.structure = *structure_,
                          .body = *body_,
                          .places = described.places,
                          .contacts = contacts(),
                          .rigid_walls = contact_ ? names_of_walls(*deck_) : std::vector<std::string>{},
                          .kinked = kinked_.get()};
  monitors_ = monitor_columns(*deck_, read_off, problems);
  structure_->nodal_terms().for_each_moved_support(
      [&](Index dof, double rate) { moved_.push_back({.rate = rate, .reaction = support_reaction(read_off, dof)}); });
  for (const std::size_t next : grips_of(*whole_deck_, static_cast<std::size_t>(stage_) + 1)) {
    const std::string& point = whole_deck_->prescribed[next].point;
    const Index node = described.places.joints.at(point);
    const auto rotation = described.places.rotations.find(point);
    gripped_next_.push_back(
        {.x = body_->motion(structure_->dof(node, Dof::x)),
         .z = body_->motion(structure_->dof(node, Dof::z)),
         .rotation = rotation == described.places.rotations.end() ? nullptr : body_->motion(rotation->second)});
  }
  options_ = trace_options(*deck_, read_off, monitors_, problems);
  options_.node_contacts = std::move(node_contacts);
  check_watched(*deck_, problems);
  if (problems.empty()) check_search(*this, problems);
  if (stage_ == 0) check_sensitivity(*whole_deck_, problems);
  if (stage_ == 0) check_curve(*whole_deck_, problems);
  problems.raise();
  if (!loose_holds_.empty()) {
    options_.lambda_scale = lambda_scale_if_held(*deck_, false);
    options_.corner.max_enumerated = 0;
  }

  if (contact_ && stage_ == 0) {
    std::vector<std::string> told = interference_warnings(*deck_, *contact_, sliding_.get());
    std::move(told.begin(), told.end(), std::back_inserter(warnings_));
  }
  if (contact_) {
    const ContactScales& scales = sliding_ ? sliding_->scales() : contact_->scales();
    options_.mesh_error_of_forces = mesh_error_of_forces(scales);
  }
  for (const std::string& name : deck_->path.watch) {
    const MonitorColumn& column = *deck::find(monitors_, name);
    watched_.push_back({.quantity = column.quantity, .label = name, .kind = kind_of(column, *deck_)});
  }
  explore_.policy = deck_->path.branches;
  explore_.depth = deck_->path.depth;
  for (const MonitorColumn& monitor : monitors_)
    if (!monitor.is_place) explore_.preference.push_back(monitor.raw);
  if (stage_ == 0)
    for (const deck::Spring& spring : deck_->springs) {
      if (std::string warning = smoothed_law(spring, frame.factor()); !warning.empty())
        warnings_.push_back(std::move(warning));
      if (loose_holds_.empty()) continue;
      if (std::string warning = flat_law(spring, deck_->units); !warning.empty())
        warnings_.push_back(std::move(warning));
    }
  if (is_unbounded(deck_->path))
    warnings_.push_back("no bound in [path.stop] ends the path: it continues to path.max_points = " +
                        std::to_string(deck_->path.max_points) +
                        ", the default, whatever λ is then; give bounds, as stop = { lambda = [-1.0, 10.0] }");
  if (deck_->path.events != EventSearch::locate && explore_.policy != BranchPolicy::primary &&
      !wants_increments(*deck_))
    warnings_.push_back("events = \"" + deck::text_of(deck::events_words, deck_->path.events) +
                        "\" locates no bifurcations, so branches = \"" +
                        deck::text_of(deck::branches_words, explore_.policy) +
                        "\" has no effect and the run stays on its first branch; leave out events, or write branches = "
                        "\"primary\"");
  if (const std::string warning = start_outside_bounds(deck_->path); !warning.empty() && !wants_increments(*deck_))
    warnings_.push_back(warning);
}

std::shared_ptr<const Observable> Model::quantity(const std::string& name) const {
  if (name == "lambda") return std::make_shared<ParameterValue>();
  const MonitorColumn* const column = deck::find(monitors_, name);
  return column != nullptr ? column->quantity : nullptr;
}

// Springs for what nothing but contact holds are part of the deck that is traced.
bool Model::hold_loose_bodies() {
  loose_holds_ = loose_holds(*deck_);
  const std::vector<deck::Spring> springs = loose_holds_.springs();
  deck::Deck held = *deck_;
  held.springs.insert(held.springs.end(), springs.begin(), springs.end());
  deck_ = std::make_shared<const deck::Deck>(std::move(held));
  if (!loose_holds_.empty()) warnings_.push_back(loose_holds_.warning(*deck_));
  return !loose_holds_.empty();
}

// The deck's structure with springs, so many times as stiff, in place of those that hold loose bodies.
StructureOfDeck Model::described_if_held(const LooseHolds& holds, double times) const {
  deck::Deck held = *deck_;
  held.springs.resize(held.springs.size() - loose_holds_.holds.size());
  const std::vector<deck::Spring> springs = holds.springs(times);
  held.springs.insert(held.springs.end(), springs.begin(), springs.end());
  DeckProblems known(held.source);
  StructureOfDeck described = describe_structure(held, known);
  hold_between_walls(held, described.builder);
  return described;
}

// The structure with springs as stiff as its members in place of those that hold loose bodies.
std::unique_ptr<Structure> Model::held_structure(bool ramp) const {
  const double times = softest_stiffness(*deck_, *structure_) / loose_holds_.stiffness();
  return described_if_held(loose_holds_, times).builder.build(ramp);
}

// While constant loads grow the springs of loose bodies may bear a small part of them: which way the bodies go to their
// rest is then no matter of round-off in the members' axial forces.
double Model::stiffness_of_ramp_holds() const {
  constexpr double borne = 1e-4;  // of the resultant of constant loads, by springs that give by the structure's size
  if (loose_holds_.empty()) return 0.0;
  return std::max(loose_holds_.stiffness(), borne * constant_resultant(*deck_).norm() / structure_->length_scale());
}

// A loose body moves by any amount under hardly any load before it meets something: the λ that would deform it counts.
double Model::lambda_scale_if_held(const deck::Deck& deck, bool ramp) const {
  const auto held = held_structure(ramp);
  TraceOptions options = options_;
  options.lambda_scale.reset();
  const auto scale_of = [&](const System& system) {
    const ActiveSet open = system.open_active_set();
    return Tracer(system, {.state = {.x = Vector::Zero(system.size(open)), .lambda = 0.0, .active_set = open}}, options)
        .lambda_scale();
  };
  if (deck.contact.is_compliant()) return scale_of(*compliant_contact(deck, *held));
  DeckProblems known(deck.source);
  return scale_of(MultiplierContact(*held, contact_candidates(deck, *held, {}, known), contact_->scales()));
}

// Whether the structure resists by itself, where a mechanism was held, more than the springs did.
bool Model::is_stiffened(const State& state) const {
  if (ramp_holds_.empty()) return true;
  Linearization now;
  BorderedSolver solver;
  system().linearize(state, now);
  if (solver.factorize(now, system().multiplier_count(state.active_set)) != FactorStatus::ok) return false;
  for (std::size_t i = 0; i < held_in_ramp_.size(); ++i)
    for (const Dof direction : {Dof::x, Dof::z}) {
      const deck::Stiffness& springs = ramp_holds_.holds[i].stiffness;
      const double stiffness = direction == Dof::x ? springs.x : springs.z;
      const Vector unit = body_->motion(structure_->dof(held_in_ramp_[i], direction))->gradient(state).dx;
      Matrix moved = unit;
      if (!solver.solve_inner(moved) || !(stiffness * std::abs(unit.dot(moved.col(0))) < 1.0)) return false;
    }
  return true;
}

std::optional<std::string> Model::adrift(const State& state) const {
  for (std::size_t i = 0; i < held_.size(); ++i) {
    double squared = 0.0;
    for (const Dof direction : {Dof::x, Dof::z})
      squared += std::pow(body_->motion(structure_->dof(held_[i], direction))->value(state), 2.0);
    if (squared <= std::pow(farthest * structure_->length_scale(), 2.0)) continue;
    return "neither supports nor contact hold the body at \"" + to_text(loose_holds_.holds[i].at) +
           "\", which has moved by more than " + std::to_string(farthest) + " times the size of the structure";
  }
  return std::nullopt;
}

void Model::make_contact(const StructureBuilder& builder, std::vector<Candidate> candidates, bool sliding) {
  const auto constant = [](const auto& driven) { return driven.constant; };
  const bool ramp =
      stage_ == 0 && (std::any_of(whole_deck_->loads.begin(), whole_deck_->loads.end(), constant) ||
                      std::any_of(whole_deck_->prescribed.begin(), whole_deck_->prescribed.end(), constant) ||
                      has_interference(*deck_));
  const StructureBuilder of_ramp = [&] {
    if (!ramp) return builder;
    if (!ramp_holds_.empty()) return described_if_held(ramp_holds_, 1.0).builder;
    if (loose_holds_.empty()) return builder;
    return described_if_held(loose_holds_, stiffness_of_ramp_holds() / loose_holds_.stiffness()).builder;
  }();
  if (ramp) ramp_structure_ = of_ramp.build(true);
  if (deck_->contact.is_compliant() && !deck_->walls.empty()) {
    compliant_ = compliant_contact(*deck_, *structure_);
    if (ramp) ramp_compliant_ = compliant_contact(with_walls_of_ramp(*deck_, *structure_), *ramp_structure_);
  } else if (!deck_->walls.empty()) {
    const auto held = loose_holds_.empty() ? nullptr : held_structure(false);
    const ContactScales scales = contact_scales(*deck_, *structure_, held ? *held : *structure_, deck_->path.step);
    const System& inner = incremental_structure_ ? static_cast<const System&>(*incremental_structure_) : *structure_;
    const ContactLaw law{.method = deck_->contact.method, .stiffness = deck_->contact.penalty.value_or(0.0)};
    contact_ = std::make_unique<MultiplierContact>(inner, std::move(candidates), scales, law);
    DeckProblems known(deck_->source);  // those of the structure itself
    if (ramp)
      ramp_contact_ = std::make_unique<MultiplierContact>(
          *ramp_structure_, contact_candidates(with_walls_of_ramp(*deck_, *structure_), *ramp_structure_, {}, known),
          scales, law);
    if (!sliding) return;
    const auto on = [&](const SlidingStructure& structure, const deck::Deck& deck, double stiffness_of_holds) {
      ContactScales of_body = scales;
      of_body.slack = stiffness_of_holds * farthest * structure_->length_scale();
      return std::make_unique<SlidingContact>(structure, sliding_obstacles(deck, structure), of_body,
                                              deck.path.equilibrium_family);
    };
    sliding_ = on(*sliding_structure_, *deck_, loose_holds_.stiffness());
    if (!ramp) return;
    sliding_ramp_structure_ = sliding_structure(of_ramp, true);
    sliding_ramp_ = on(*sliding_ramp_structure_, with_walls_of_ramp(*deck_, *structure_), stiffness_of_ramp_holds());
  }
}

std::unique_ptr<CompliantContact> Model::compliant_contact(const deck::Deck& deck, const Structure& structure) const {
  std::vector<CompliantContact::Wall> walls;
  for (CompliantWallOfMember& wall : compliant_walls(
           deck, [&](Index m) -> const MemberMesh& { return structure.members()[static_cast<std::size_t>(m)]; }))
    walls.push_back(std::move(wall.contact));
  return std::make_unique<CompliantContact>(structure, std::move(walls), structure_->length_scale());
}

// The strands of the ramp are those of the path, on which λ may load two members differently that what is constant
// loads alike.
std::unique_ptr<SlidingStructure> Model::sliding_structure(const StructureBuilder& builder, bool ramp) const {
  const auto strands_at_ends = [this](const std::string& member) {
    constexpr double inside = 1e-9;  // fraction
    return std::array{sliding_structure_->find(member, inside).strand,
                      sliding_structure_->find(member, 1.0 - inside).strand};
  };
  const auto are_joined = [&](const std::string& a, const std::string& b) {
    const auto of_a = strands_at_ends(a), of_b = strands_at_ends(b);
    return std::find_first_of(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) != of_a.end();
  };
  return builder.build_sliding(ramp, [&](const std::string& a, const std::string& b) {
    return same_walls(*deck_, a, b) && !is_driven_apart(*whole_deck_, a) && !is_driven_apart(*whole_deck_, b) &&
           (!ramp || are_joined(a, b));
  });
}

// What is traced, with the pieces that laws of springs consist of.
void Model::make_kinks() {
  const auto& springs = structure_->nodal_terms().law_springs();
  const auto has_kinks = [](const NodalTerms::LawSpring& spring) { return !spring.law->kinks().empty(); };
  if (incremental_structure_ || std::none_of(springs.begin(), springs.end(), has_kinks)) return;
  const auto on = [&](const System& inner, const Body& body) {
    std::vector<KinkedSprings::Spring> kinked;
    for (const NodalTerms::LawSpring& spring : springs)
      kinked.push_back({.law = spring.law,
                        .first = spring.first ? body.motion(*spring.first) : nullptr,
                        .second = body.motion(spring.second)});
    return std::make_unique<KinkedSprings>(inner, kinked);
  };
  kinked_ = on(system(), *body_);
  if (!ramp_structure_) return;
  ramp_body_ = sliding_ramp_ ? body_of(*ramp_structure_, *sliding_ramp_structure_)
                             : body_of(*ramp_structure_, theories_of(*deck_), nullptr);
  kinked_ramp_ = on(*ramp_system(), *ramp_body_);
}

// What grows while constant loads do, but for the pieces of laws.
const System* Model::ramp_system() const {
  if (sliding_ramp_) return sliding_ramp_.get();
  if (ramp_contact_) return ramp_contact_.get();
  if (ramp_compliant_) return ramp_compliant_.get();
  return ramp_structure_.get();
}

const System& Model::system() const {
  if (kinked_) return *kinked_;
  if (sliding_) return *sliding_;
  if (contact_) return *contact_;
  if (compliant_) return *compliant_;
  if (incremental_structure_) return *incremental_structure_;
  return *structure_;
}

LoadIncrements Model::increments(State start) {
  const double scale = Tracer(system(), start, options_).lambda_scale();
  const Index n = structure_->size({});
  const auto advance = [this, n](const State& state) {
    incremental_structure_->advance({.x = state.x.head(n), .lambda = state.lambda});
  };
  return {system(), std::move(start), scale, advance, options_.factorization};
}

std::optional<State> Model::start(std::string& reason) const {
  State state{.x = {}, .lambda = 0.0, .active_set = {}};
  if (contact_) state.active_set = contact_->open_active_set();
  state.x = Vector::Zero(contact_ ? contact_->size(state.active_set) : structure_->size({}));
  if (compliant_) state.active_set = compliant_->touched_at(state);
  if (sliding_) state = sliding_->start(deck_->path.step);
  if (!ramp_structure_) return with_kinks(std::move(state));
  // What is constant grows from nothing along a path of their own, contacts included.
  TraceOptions options;
  options.step.first = 0.1;
  options.mesh_error_of_forces = options_.mesh_error_of_forces;
  options.target_values.push_back(
      {.quantity = std::make_shared<ParameterValue>(), .value = 1.0, .stops = true, .label = "all"});
  if (!loose_holds_.empty()) {
    options.lambda_scale = lambda_scale_if_held(with_walls_of_ramp(*deck_, *structure_), true);
    options.corner.max_enumerated = 0;
  }
  const System* ramp = ramp_system();
  if (sliding_ramp_) state = sliding_ramp_->start(1.0);
  if (kinked_ramp_) {
    ramp = kinked_ramp_.get();
    state = kinked_ramp_->with_kinks(std::move(state));
  }
  constexpr int most_laid = 20;  // so often: what is laid down may peel off again
  int laid = 0;
  constexpr double far_back = -1.0;  // of their value: a path that has turned back by so much does not return
  double most = 0.0;
  std::optional<Tracer> tracer(std::in_place, *ramp, state, options);
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
    const bool falls = sliding_ramp_ && !loose_holds_.empty() && state.lambda != 1.0 && laid < most_laid;
    auto lying = falls ? sliding_ramp_->with_strands_come_to_lie(state, 1.0) : std::nullopt;
    if (!lying) continue;
    lying->active_set = lying->active_set.with_kinks_of(state.active_set);
    tracer.emplace(*ramp, std::move(*lying), options);
    ++laid;
  }
  if (!tracer->end() || tracer->end()->reason != EndReason::stop) {
    const bool turns_back = state.lambda < most;
    reason = "the constant loads and movements find no equilibrium: their growth";
    if (turns_back)
      reason += fmt::format(" turns back at about {:.2g} of their value, where the structure buckles or snaps", most);
    if (tracer->end())
      reason += fmt::format("{} ends at {:.4g} of {} ({})", turns_back ? ", and" : "", state.lambda,
                            turns_back ? "it" : "their value", tracer->end()->detail);
    return std::nullopt;
  }
  if (sliding_) {
    state.lambda = deck_->path.step;
    reason = sliding_->why_not_lying(sliding_->adopted(state));
  }
  state.lambda = 0.0;
  if (!reason.empty()) return std::nullopt;
  State begun = begun_from(state);
  if (is_stiffened(begun)) return begun;
  reason =
      "the structure is a mechanism, which can move without strain, and the constant loads and movements do not "
      "stiffen it";
  return std::nullopt;
}

// λ goes from 0 on in the direction of the first step.
State Model::begun_from(const State& state) const {
  if (!sliding_) return state;
  State begun = sliding_->with_flat_parts_loaded(sliding_->adopted(state), deck_->path.step);
  begun.active_set = begun.active_set.with_kinks_of(state.active_set);
  return begun;
}

State Model::taken_over(const State& last, const Model& before) const {
  State state = grips_of(*whole_deck_, static_cast<std::size_t>(stage_)).empty() ? last : gripped(last, before);
  state.lambda = 0.0;
  return begun_from(state);
}

// The unknowns of the stage before, but for those that this stage holds where they are.
State Model::gripped(const State& state, const Model& before) const {
  if (sliding_) return sliding_->gripped(*before.sliding_, state);
  Vector x(structure_->size({}));
  for (Index i = 0; i < x.size(); ++i) x[i] = before.structure_->value(state, structure_->dof_of_unknown(i));
  if (contact_) return contact_->gripped(*before.contact_, state, x);
  return {.x = std::move(x), .lambda = state.lambda, .active_set = state.active_set};
}

// With λ as one more unknown the second variation has the same unstable directions, and one more if the force that goes
// with λ, Σ ū′ R, falls along the path: Haynsworth's inertia of K and of what eliminating the unknowns leaves.
std::optional<Index> Model::unstable_under_dead_load(const PathPoint& point) const {
  constexpr double vanishing = 1e-6;  // of the parts of a rate
  if (moved_.empty() || !point.count.unstable) return std::nullopt;
  if (!system().slipping(point.state.active_set).empty()) return std::nullopt;  // K with slips is not symmetric
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

const ContactQuery* Model::contacts() const {
  if (sliding_) return sliding_.get();
  if (compliant_) return compliant_.get();
  return contact_.get();
}

// A pinch is one contact of the active set and two of the user.
Index Model::closed_contacts(const State& state) const {
  const std::size_t pinches = sliding_ ? sliding_layout(state.active_set).pinched_points().size() : 0;
  return state.active_set.closed_count() + static_cast<Index>(pinches);
}

}  // namespace arcwall
