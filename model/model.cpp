#include "model/model.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/text.hpp"
#include "model/build_contact.hpp"
#include "model/build_path.hpp"
#include "model/build_structure.hpp"
#include "model/deck_mesh.hpp"
#include "model/event_curve.hpp"
#include "model/sensitivities.hpp"

namespace arcwall {

namespace {

// The greatest force by which supports that λ moves begin to move the structure, moments over its length [force].
double force_of_movements(const Structure& structure) {
  if (structure.squared_motion_by_lambda({}) == 0.0) return 0.0;
  const auto start = Tracer(structure, {.x = Vector::Zero(structure.size({}))}, {}).next();
  if (!start) return 0.0;
  const Direction& tangent = start->to.tangent;
  double greatest = 0.0;
  structure.nodal_terms().for_each_moved_support([&](Index freedom, double) {
    const Row row = structure.reaction_gradient(start->to.state, freedom);
    const double rate = std::abs(row.dx.dot(tangent.dx) / tangent.dlambda + row.dlambda);
    const bool turns = structure.meaning_of_freedom(freedom).freedom == Freedom::rotation;
    greatest = std::max(greatest, turns ? rate / structure.length_scale() : rate);
  });
  return greatest;
}

// The force that the most flexible member has against a wall that λ moves [force].
double force_of_walls(const deck::Deck& deck, const Structure& structure) {
  double speed = 0.0;
  for (const deck::Wall& wall : deck.walls)
    speed = std::max(speed, obstacle_of(wall)->greatest_speed(structure.length_scale()));
  return speed > 0.0 ? softest_stiffness(deck, structure) * speed : 0.0;
}

bool moves_walls(const deck::Deck& deck) {
  return std::any_of(deck.walls.begin(), deck.walls.end(),
                     [](const deck::Wall& wall) { return !motion_of(wall).is_none(); });
}

// By so many times the structure's size loose bodies may move before they count as adrift: a wall may be that far.
constexpr int farthest = 20;

// Forces below the tolerance times this scale count as zero: small against what λ brings in a step, above the round-off
// of the mesh. `held` is the structure with supports for what nothing but contact holds.
ContactScales contact_scales(const deck::Deck& deck, const Structure& structure, const Structure& held,
                             double first_step) {
  constexpr double steps = 10.0;
  const double tolerance = TraceOptions{}.guard_tolerance;
  const double force = std::max({structure.force_scale(), force_of_movements(held), force_of_walls(deck, structure)});
  const double driven = std::max(steps * force * std::abs(first_step), 1e-300);
  return {.length = structure.length_scale(),
          .force = std::max(driven, structure.force_roundoff() / tolerance),
          .driven = driven};
}

// See TraceOptions. No less than a force is known to.
double mesh_error_of_forces(const ContactScales& scales) {
  const double known = 10.0 * TraceOptions{}.guard_tolerance;
  return std::max(mesh_error * std::min(1.0, scales.driven / scales.force), known);
}

bool moves_something(const Structure& structure) {
  if (structure.size({}) == 0) return false;
  if (structure.squared_motion_by_lambda({}) > 0.0) return true;
  Linearization now;
  structure.linearize({.x = Vector::Zero(structure.size({}))}, now);
  return now.F_lambda.size() > 0 && now.F_lambda.cwiseAbs().maxCoeff() > 0.0;
}

void report_nothing_moves(const deck::Deck& deck, std::size_t stage, bool all_is_held, DeckProblems& problems) {
  std::string key = deck.loads.empty() ? "prescribed" : "load";
  deck::Position position;
  if (!deck.stages.empty()) {
    key = "stage.drives";
    position = deck.stages[stage].position;
  } else if (!deck.loads.empty()) {
    position = deck.loads.front().position;
  } else if (!deck.prescribed.empty()) {
    position = deck.prescribed.front().position;
  }
  if (all_is_held)
    return problems.add(position, key, "every direction is held: nothing is left to move",
                        "leave a direction free, or divide the members more finely");
  problems.add(position, key, "what λ multiplies acts on directions that are held: nothing moves",
               "load a free direction");
}

// How the path begins to leave the bounds of λ where it starts; empty if it does not.
std::string start_outside_bounds(const deck::Path& path) {
  const auto bounds = std::find_if(path.stop.bounds.begin(), path.stop.bounds.end(),
                                   [](const deck::StopBounds& one) { return one.name == "lambda"; });
  if (bounds == path.stop.bounds.end()) return {};
  const std::string between = "stop.lambda = [" + round_trip(bounds->low) + ", " + round_trip(bounds->high) + "]";
  if (bounds->low > 0.0 || bounds->high < 0.0)
    return "λ begins at 0, outside of " + between + ": the path ends where it comes to either bound";
  const bool leaves = (bounds->low == 0.0 && path.step < 0.0) || (bounds->high == 0.0 && path.step > 0.0);
  if (!leaves) return {};
  return "λ begins at 0 and leaves " + between + " at once, since step = " + round_trip(path.step) +
         ": the path ends where it comes back";
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

bool increments_of(const deck::Deck& deck) { return deck.path.method == deck::PathMethod::incremental; }

bool may_slide(const deck::Deck& deck, const StructureBuilder& builder) {
  return !deck.walls.empty() && points_of_contact(deck).points == deck::ContactPoints::sliding &&
         deck.contact.method == ContactLaw::Method::rigid && !increments_of(deck) && builder.can_slide();
}

// A node that is a contact touches a wall once.
void check_hollow_corners(const deck::Deck& deck, DeckProblems& problems) {
  for (const deck::Wall& wall : deck.walls)
    if (parts_of(wall).size() > 1)
      problems.add(
          wall.position, "wall.outline",
          "the outline has hollow corners that are sharp: what touches in one touches two lines at once, which "
          "contact at nodes does not know",
          "give a corner_radius, or make a wall of each line");
}

// Whether contact points slide, which springs, increments and members of other theories do not allow.
bool slides(const deck::Deck& deck, const StructureBuilder& builder, const std::vector<Candidate>& candidates,
            DeckProblems& problems) {
  const auto held = std::find_if(candidates.begin(), candidates.end(),
                                 [](const Candidate& candidate) { return candidate.opposite().has_value(); });
  if (held != candidates.end() && increments_of(deck))
    problems.add({}, "path.method",
                 "method \"incremental\" knows no member that walls hold from both sides without clearance, as " +
                     held->label().wall + " does",
                 "use \"spherical\", or leave a clearance");
  if (deck.walls.empty() || points_of_contact(deck).points == deck::ContactPoints::nodes) return false;
  if (held != candidates.end()) {
    problems.add({}, "contact.points",
                 "points = \"sliding\" knows no member that walls hold from both sides without clearance, as " +
                     held->label().wall + " does",
                 "use \"nodes\", or leave a clearance");
    return false;
  }
  if (may_slide(deck, builder)) return true;
  problems.add({}, "contact.points",
               "points = \"sliding\" needs members whose contact forces are point forces, theory \"classic\" or "
               "\"elastica\" throughout, method \"multiplier\", and a path that is not incremental",
               "use \"nodes\"");
  return false;
}

// What is inside a wall at the start though none of its nodes is: a wall may be narrower than an element.
void check_between_nodes(const deck::Deck& deck, const SlidingContact& contact, DeckProblems& problems) {
  const double round_off = 1e-9 * contact.scales().length;
  const auto entered = contact.entered(contact.rest(), round_off);
  if (!entered) return;
  const deck::Wall& wall = *deck::find(deck.walls, entered->label.wall);
  problems.add(wall.position, "wall." + wall.name,
               fmt::format("member \"{}\" is inside the wall at the start: at {}:{:.4g}, between nodes, by {:.4g}",
                           entered->label.member, entered->label.member, entered->label.fraction, entered->depth),
               "move the wall or the member apart");
}

// What is greatest along a member turns in a kink where its place jumps. An event there would have no derivatives.
void check_watched(const deck::Deck& deck, DeckProblems& problems) {
  for (const std::string& name : deck.path.watch) {
    const deck::Monitor& monitor = *deck::find(deck.monitors, name);
    const bool moment = monitor.component == deck::Component::greatest_moment;
    if (moment || monitor.component == deck::Component::greatest_pressure)
      problems.add(deck.path.position, "path.watch",
                   "\"" + name + "\" is what is greatest along a member, which may turn where its place jumps",
                   moment ? "watch the moment at a place, as in at = \"MEMBER:0.5\", component = \"moment\""
                          : "watch the displacement of a place, as in at = \"MEMBER:0.5\", component = \"z\"");
  }
}

// What is looked for beside the path is looked for on the deck's mesh.
void check_search(const Model& model, DeckProblems& problems) {
  if (model.deck().path.search && !DeckMesh(model).is_complete())
    problems.add(model.deck().path.position, "path.search", "the deck's mesh has unknowns that its contact does not",
                 "leave out search, or write contact.points = \"nodes\"");
}

// Whether increments can be taken where the deck wants them.
bool takes_increments(const deck::Deck& deck, const Structure& structure, DeckProblems& problems) {
  if (!increments_of(deck)) return false;
  const bool possible = structure.can_be_updated();
  if (!possible)
    problems.add(deck.path.position, "path.method",
                 "method \"incremental\" needs members of theory \"classic\" or \"essenburg\" throughout",
                 "use \"spherical\"");
  for (const deck::Load& load : deck.loads)
    if (load.constant)
      problems.add(load.position, "load", "method \"incremental\" has no constant loads",
                   "multiply all loads by lambda, or use method \"spherical\"");
  for (const deck::Load& load : deck.loads)
    if (std::holds_alternative<deck::Heat>(load.action))
      problems.add(load.position, "load", "method \"incremental\" knows no temperatures", "use method \"spherical\"");
  for (const deck::Load& load : deck.loads)
    if (std::holds_alternative<deck::Pressure>(load.action))
      problems.add(load.position, "load", "method \"incremental\" knows no pressure that follows the axis",
                   "use method \"spherical\"");
  for (const deck::Prescribed& moved : deck.prescribed)
    problems.add(moved.position, "prescribed", "method \"incremental\" moves no supports", "use method \"spherical\"");
  for (const deck::Wall& wall : deck.walls)
    if (wall.interference > 0.0)
      problems.add(wall.position, "wall.interference", "method \"incremental\" pushes no walls to their places",
                   "use method \"spherical\"");
  return possible;
}

}  // namespace

// The models of later stages are built once to see whether they can be.
Model::Model(deck::Deck deck) : Model(std::make_shared<const deck::Deck>(std::move(deck)), 0, std::nullopt) {
  for (std::size_t stage = 1; stage < whole_deck_->stages.size(); ++stage)
    for (const std::string& warning : Model(whole_deck_, static_cast<Index>(stage), progress_).warnings_)
      if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end()) warnings_.push_back(warning);
}

bool Model::begin_stage(double lambda) {
  const std::size_t ended = ended_stages_.size();
  if (ended + 1 >= whole_deck_->stages.size()) return false;
  const Model& last = at_stage(static_cast<Index>(ended));
  auto progress = progress_after(whole_deck_->stages[ended], lambda, last.progress_);
  later_.push_back(std::unique_ptr<Model>(new Model(whole_deck_, static_cast<Index>(ended) + 1, std::move(progress))));
  ended_stages_.push_back(lambda);
  return true;
}

Model::Model(std::shared_ptr<const deck::Deck> whole, Index stage, std::optional<std::vector<DrivenThing>> progress)
    : whole_deck_(std::move(whole)),
      stage_(stage),
      progress_(progress ? std::move(*progress) : things_to_drive(*whole_deck_)),
      deck_(deck_of_stage(whole_deck_, static_cast<std::size_t>(stage), progress_)) {
  DeckProblems problems(deck_->source);
  StructureOfDeck described = describe_structure(*deck_, problems);
  problems.raise();
  if (hold_loose_bodies()) described = describe_structure(*deck_, problems);
  hold_between_walls(*deck_, described.builder);
  check_mechanism(*deck_, problems);
  problems.raise();

  structure_ = described.builder.build();
  if (!moves_something(*structure_) && (structure_->size({}) == 0 || !moves_walls(*deck_)))
    report_nothing_moves(*whole_deck_, static_cast<std::size_t>(stage_), structure_->size({}) == 0, problems);
  if (takes_increments(*deck_, *structure_, problems))
    incremental_structure_ = std::make_unique<IncrementalStructure>(*structure_);
  DeckProblems not_at_rest(deck_->source);  // where a stage begins the structure is no longer there
  if (may_slide(*deck_, described.builder)) sliding_structure_ = sliding_structure(described.builder, false);
  const PinchedPlaces pinched = sliding_structure_ ? pinched_places(*deck_, *sliding_structure_) : PinchedPlaces{};
  auto candidates = contact_candidates(*deck_, *structure_, pinched, stage_ == 0 ? problems : not_at_rest);
  const bool sliding = slides(*deck_, described.builder, candidates, problems);
  if (!sliding) sliding_structure_.reset();
  if (!sliding) check_hollow_corners(*deck_, problems);
  if (problems.empty()) make_contact(described.builder, std::move(candidates), sliding);
  for (const LooseHolds::Hold& hold : loose_holds_.holds)
    held_.push_back(described.places.find(hold.at, structure_->members()).node);
  if (sliding_ && stage_ == 0 && problems.empty())
    check_between_nodes(*deck_, sliding_ramp_ ? *sliding_ramp_ : *sliding_, problems);
  body_ = sliding ? body_of(*structure_, *sliding_structure_)
                  : body_of(*structure_, theories_of(*deck_), incremental_structure_.get());
  const Measured read_off{.structure = *structure_,
                          .body = *body_,
                          .places = described.places,
                          .contacts = contacts(),
                          .system = &system()};
  monitors_ = monitor_columns(*deck_, read_off, problems);
  structure_->nodal_terms().for_each_moved_support(
      [&](Index freedom, double rate) { moved_.push_back({.rate = rate, .reaction = body_->reaction(freedom)}); });
  options_ = trace_options(*deck_, read_off, monitors_, problems);
  check_watched(*deck_, problems);
  if (problems.empty()) check_search(*this, problems);
  if (stage_ == 0) check_sensitivity(*whole_deck_, problems);
  if (stage_ == 0) check_curve(*whole_deck_, problems);
  problems.raise();
  if (!loose_holds_.empty()) {
    options_.lambda_scale = lambda_scale_if_held(*deck_, false);
    options_.corner.max_enumerated = 0;
  }

  if (contact_) {
    const ContactScales& scales = sliding_ ? sliding_->scales() : contact_->scales();
    options_.mesh_error_of_forces = mesh_error_of_forces(scales);
  }
  for (const std::string& name : deck_->path.watch)
    watched_.push_back({.quantity = deck::find(monitors_, name)->quantity, .label = name});
  explore_.policy = deck_->path.branches;
  explore_.depth = deck_->path.depth;
  for (const MonitorColumn& monitor : monitors_)
    if (!monitor.is_place) explore_.preference.push_back(monitor.raw);
  const auto turns = [](const MemberMesh& mesh) { return mesh.rotations.front().has_value(); };
  if (is_unbounded(deck_->path))
    warnings_.push_back("nothing in [path.stop] ends the path: it goes on to path.max_points = " +
                        std::to_string(deck_->path.max_points) +
                        ", the default, whatever λ is then; give bounds, as stop = { lambda = [-1.0, 10.0] }");
  if (const std::string warning = start_outside_bounds(deck_->path); !warning.empty() && !increments_of(*deck_))
    warnings_.push_back(warning);
  options_.node_contacts =
      contact_ && !sliding_ && std::any_of(structure_->members().begin(), structure_->members().end(), turns);
}

// Springs for what nothing but contact holds are part of the deck that is traced.
bool Model::hold_loose_bodies() {
  DeckProblems mechanism(deck_->source);
  check_mechanism(*deck_, mechanism);
  if (mechanism.empty()) return false;
  loose_holds_ = loose_holds(*deck_);
  const std::vector<deck::Spring> springs = loose_holds_.springs();
  deck::Deck held = *deck_;
  held.springs.insert(held.springs.end(), springs.begin(), springs.end());
  deck_ = std::make_shared<const deck::Deck>(std::move(held));
  if (!loose_holds_.empty()) warnings_.push_back(loose_holds_.warning(deck_->units));
  return !loose_holds_.empty();
}

// The deck's structure with springs so many times as stiff in place of those that hold loose bodies.
StructureOfDeck Model::described_if_held(double times) const {
  deck::Deck held = *deck_;
  held.springs.resize(held.springs.size() - loose_holds_.holds.size());
  const std::vector<deck::Spring> springs = loose_holds_.springs(times);
  held.springs.insert(held.springs.end(), springs.begin(), springs.end());
  DeckProblems known(held.source);
  StructureOfDeck described = describe_structure(held, known);
  hold_between_walls(held, described.builder);
  return described;
}

// The structure with springs as stiff as its members in place of those that hold loose bodies.
std::unique_ptr<Structure> Model::held_structure(bool ramp) const {
  return described_if_held(softest_stiffness(*deck_, *structure_) / loose_holds_.stiffness()).builder.build(ramp);
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
  DeckProblems known(deck.source);
  const MultiplierContact contact(*held, contact_candidates(deck, *held, {}, known), contact_->scales());
  TraceOptions options = options_;
  options.lambda_scale.reset();
  const Piece open = contact.open_piece();
  return Tracer(contact, {.state = {.x = Vector::Zero(contact.size(open)), .lambda = 0.0, .piece = open}}, options)
      .lambda_scale();
}

std::optional<std::string> Model::adrift(const State& state) const {
  for (std::size_t i = 0; i < held_.size(); ++i) {
    double squared = 0.0;
    for (const Freedom direction : {Freedom::x, Freedom::z})
      squared += std::pow(body_->motion(structure_->freedom(held_[i], direction))->value(state), 2.0);
    if (squared <= std::pow(farthest * structure_->length_scale(), 2.0)) continue;
    return "nothing holds the body at \"" + to_text(loose_holds_.holds[i].at) + "\", which has moved by more than " +
           std::to_string(farthest) + " times the size of the structure";
  }
  return std::nullopt;
}

void Model::make_contact(const StructureBuilder& builder, std::vector<Candidate> candidates, bool sliding) {
  const auto constant = [](const auto& driven) { return driven.constant; };
  const bool ramp =
      stage_ == 0 && (std::any_of(whole_deck_->loads.begin(), whole_deck_->loads.end(), constant) ||
                      std::any_of(whole_deck_->prescribed.begin(), whole_deck_->prescribed.end(), constant) ||
                      has_interference(*deck_));
  const bool falls = ramp && !loose_holds_.empty();
  const StructureBuilder of_ramp =
      falls ? described_if_held(stiffness_of_ramp_holds() / loose_holds_.stiffness()).builder : builder;
  if (ramp) ramp_structure_ = of_ramp.build(true);
  if (!deck_->walls.empty()) {
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
                                              deck.path.continuum);
    };
    sliding_ = on(*sliding_structure_, *deck_, loose_holds_.stiffness());
    if (!ramp) return;
    sliding_ramp_structure_ = sliding_structure(of_ramp, true);
    sliding_ramp_ = on(*sliding_ramp_structure_, with_walls_of_ramp(*deck_, *structure_), stiffness_of_ramp_holds());
  }
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

const System& Model::system() const {
  if (sliding_) return *sliding_;
  if (contact_) return *contact_;
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
  State state{.x = {}, .lambda = 0.0, .piece = contact_ ? contact_->open_piece() : Piece()};
  state.x = Vector::Zero(contact_ ? contact_->size(state.piece) : structure_->size({}));
  if (sliding_) state = sliding_->start(deck_->path.step);
  if (!ramp_structure_) return state;
  // What is constant grows from nothing along a path of their own, contacts included.
  TraceOptions options;
  options.step.first = 0.1;
  options.mesh_error_of_forces = options_.mesh_error_of_forces;
  options.max_points = 2000;
  options.events = EventSearch::none;
  options.target_values.push_back(
      {.quantity = std::make_shared<ParameterValue>(), .value = 1.0, .stops = true, .label = "all"});
  if (!loose_holds_.empty()) {
    options.lambda_scale = lambda_scale_if_held(with_walls_of_ramp(*deck_, *structure_), true);
    options.corner.max_enumerated = 0;
  }
  const System* ramp = ramp_structure_.get();
  if (ramp_contact_) ramp = ramp_contact_.get();
  if (sliding_ramp_) {
    ramp = sliding_ramp_.get();
    state = sliding_ramp_->start(1.0);
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
  return begun_from(state);
}

// λ goes from 0 on in the direction of the first step.
State Model::begun_from(const State& state) const {
  if (!sliding_) return state;
  return sliding_->with_flat_parts_loaded(sliding_->adopted(state), deck_->path.step);
}

State Model::taken_over(const State& last) const {
  State state = last;
  state.lambda = 0.0;
  return begun_from(state);
}

// With λ as one more unknown the second variation has the same unstable directions, and one more if the force that goes
// with λ, Σ ū′ R, falls along the path: Haynsworth's inertia of K and of what eliminating the unknowns leaves.
std::optional<Index> Model::unstable_under_dead_load(const PathPoint& point) const {
  constexpr double vanishing = 1e-6;  // of the parts of a rate
  if (moved_.empty() || !point.count.unstable) return std::nullopt;
  double rate = 0.0, size = 0.0;
  for (const MovedFreedom& moved : moved_) {
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
  return contact_.get();
}

// A pinch is one contact of the piece and two of the user.
Index Model::closed_contacts(const State& state) const {
  const std::size_t pinches = sliding_ ? sliding_layout(state.piece).pinched_points().size() : 0;
  return state.piece.closed_count() + static_cast<Index>(pinches);
}

}  // namespace arcwall
