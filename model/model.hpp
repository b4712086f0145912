#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/multiplier_contact.hpp"
#include "contact/sliding_contact.hpp"
#include "continuation/explorer.hpp"
#include "continuation/load_increments.hpp"
#include "continuation/path_point.hpp"
#include "elements/incremental_structure.hpp"
#include "elements/kinked_springs.hpp"
#include "elements/sliding_structure.hpp"
#include "model/body.hpp"
#include "model/deck/deck.hpp"
#include "model/loose_bodies.hpp"
#include "model/stages.hpp"

namespace arcwall {

struct StructureOfDeck;

/// A column of path.csv.
struct MonitorColumn {
  std::string name{};
  std::string unit{};  ///< `cm`, `rad`, `kN`, `kN cm`; without brackets
  deck::Component component = deck::Component::z;
  std::shared_ptr<const Observable> quantity{};  ///< with the deck's sign
  std::shared_ptr<const Observable> raw{};       ///< without; null of a place
  bool is_place = false;                         ///< where the greatest along a member is, whose component this is
};

/// A deck made ready to be traced: the model, what is read off it, and how it is followed.
class Model {
 public:
  /// Builds the model. Throws InputError with all diagnostics: what this version does not support, a mechanism, a point
  /// that is inside a wall, a load that moves nothing.
  explicit Model(deck::Deck deck);

  /// What is traced: of a deck with stages that of this model's stage.
  const deck::Deck& deck() const { return *deck_; }

  /// What was given, with all stages.
  const deck::Deck& whole_deck() const { return *whole_deck_; }

  /// Ends the stage that was begun last at λ and builds the model of the next one. False if there is none.
  bool begin_stage(double lambda);

  /// The λ at which stages have ended.
  const std::vector<double>& ended_stages() const { return ended_stages_; }

  /// The model in whose terms the states of a stage are; stages count from 0.
  Model& at_stage(Index stage) { return stage == 0 ? *this : *later_[static_cast<std::size_t>(stage) - 1]; }
  const Model& at_stage(Index stage) const { return const_cast<Model&>(*this).at_stage(stage); }

  /// Which stage this model is of, and its name; empty without stages.
  Index stage() const { return stage_; }
  std::string stage_name() const {
    return whole_deck_->stages.empty() ? "" : whole_deck_->stages[static_cast<std::size_t>(stage_)].name;
  }
  const Structure& structure() const { return *structure_; }

  /// The nodes of the deck's mesh among the walls; null if the deck has no walls.
  const MultiplierContact* contact() const { return contact_.get(); }

  /// Contact points that slide; null where contact is tied to nodes.
  const SlidingContact* sliding() const { return sliding_.get(); }

  /// The state with what the piece of the system says of laws with kinks: by the stretches, where it does not.
  State with_kinks(State state) const { return kinked_ ? kinked_->with_kinks(std::move(state)) : state; }

  /// The structure of those; null likewise.
  const SlidingStructure* sliding_structure() const { return sliding_structure_.get(); }

  /// What is read off the structure in a state, whichever mesh it has.
  const Body& body() const { return *body_; }

  /// What is traced: the structure with its contacts.
  const System& system() const;

  /// Whether load increments are taken instead of steps along the equations' path.
  bool in_increments() const { return incremental_structure_ != nullptr; }

  /// The increments from the start, whose reference configuration is the model's: for one run alone.
  LoadIncrements increments(State start);

  /// What tells the contacts of a state, whichever kind they are of; null if the deck has no walls.
  const ContactQuery* contacts() const;

  const std::vector<MonitorColumn>& monitors() const { return monitors_; }

  /// How many unstable directions a point has if all that λ moves were free to go along and driven by the force that it
  /// has there, held: a dead load. Empty where no support is moved, or where that cannot be told.
  std::optional<Index> unstable_under_dead_load(const PathPoint& point) const;
  const TraceOptions& options() const { return options_; }
  const std::vector<Watch>& watched() const { return watched_; }
  const ExploreOptions& explore() const { return explore_; }

  /// What the user should know though it is no error: one sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// The state at λ = 0 under the constant loads and movements, found by tracing their growth from nothing. `reason`
  /// says why there is none.
  std::optional<State> start(std::string& reason) const;

  /// The state in which the stage before has ended, as the start of this one.
  State taken_over(const State& last) const;

  /// Why a state is none that contact could hold: a body that nothing but contact holds was pushed away. Empty if
  /// there is none such.
  std::optional<std::string> adrift(const State& state) const;

  /// Number of closed contact points.
  Index closed_contacts(const State& state) const;

 private:
  State begun_from(const State& state) const;
  void make_kinks();
  // `progress`: of what λ drives, before the stage; empty where nothing has gone before it.
  Model(std::shared_ptr<const deck::Deck> whole, Index stage, std::optional<std::vector<DrivenThing>> progress);
  bool hold_loose_bodies();
  StructureOfDeck described_if_held(double times) const;
  std::unique_ptr<Structure> held_structure(bool ramp) const;
  double stiffness_of_ramp_holds() const;
  double lambda_scale_if_held(const deck::Deck& deck, bool ramp) const;
  std::unique_ptr<SlidingStructure> sliding_structure(const StructureBuilder& builder, bool ramp) const;
  // Also the structure under what is constant alone.
  void make_contact(const StructureBuilder& builder, std::vector<Candidate> candidates, bool sliding);

  std::shared_ptr<const deck::Deck> whole_deck_;
  Index stage_ = 0;
  std::vector<DrivenThing> progress_;  // before this stage
  std::vector<std::unique_ptr<Model>> later_;
  std::vector<double> ended_stages_;
  std::shared_ptr<const deck::Deck> deck_;  // of the stage
  LooseHolds loose_holds_;
  std::vector<Index> held_;  // nodes of their points
  std::unique_ptr<Structure> structure_, ramp_structure_;
  std::unique_ptr<IncrementalStructure> incremental_structure_;
  std::unique_ptr<MultiplierContact> contact_, ramp_contact_;
  std::unique_ptr<SlidingStructure> sliding_structure_, sliding_ramp_structure_;
  std::unique_ptr<SlidingContact> sliding_, sliding_ramp_;
  std::unique_ptr<Body> body_;
  std::unique_ptr<KinkedSprings> kinked_, kinked_ramp_;  // where laws of springs have kinks
  std::unique_ptr<Body> ramp_body_;                      // whose stretches those of the ramp are
  std::vector<MonitorColumn> monitors_;
  struct MovedFreedom {
    double rate;                                 // by λ
    std::shared_ptr<const Observable> reaction;  // of the support
  };
  std::vector<MovedFreedom> moved_;
  TraceOptions options_;
  std::vector<Watch> watched_;
  ExploreOptions explore_;
  std::vector<std::string> warnings_;
};

}  // namespace arcwall
