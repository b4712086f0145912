#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "continuation/explorer.hpp"
#include "continuation/load_increments.hpp"
#include "continuation/path_point.hpp"
#include "model/assembly.hpp"
#include "model/deck/deck.hpp"
#include "model/stages.hpp"

namespace arcwall {

struct StructureOfDeck;

/// Describes a monitor, a column of path.csv.
struct MonitorColumn {
  std::string name{};
  std::string unit{};  ///< `cm`, `rad`, `kN`, `kN cm`; without brackets
  deck::Component component = deck::Component::z;
  std::shared_ptr<const Observable> quantity{};  ///< with the deck's sign, in the user's unit
  std::shared_ptr<const Observable> raw{};       ///< in the model's frame without the deck's sign; null for a position
  bool is_place = false;                         ///< the position of a maximum along a member
  double roundoff = 0.0;                         ///< of its values near zero
  double factor = 1.0;                           ///< the user's value over that in the model's frame
};

/// Builds from a deck the system, its monitors and the options of tracing.
class Model {
 public:
  /// Builds the model. Throws InputError with all diagnostics: an unsupported feature, a mechanism, a point inside a
  /// wall, a load without effect. `frame`: that of another model whose states it is to take; empty: the deck's.
  explicit Model(deck::Deck deck, const std::optional<deck::Frame>& frame = {});

  /// Returns the traced deck in the coordinates of frame(): of a deck with stages, that of this model's stage. States,
  /// structure(), system() and body() are in this frame; monitors and a Record are in the user's coordinates.
  const deck::Deck& deck() const { return *path_.deck; }

  /// Returns the coordinates in which the model computes.
  const deck::Frame& frame() const { return deck().frame; }

  /// Returns the size of the structure in the user's unit [length].
  double size() const { return frame().factor() * structure().length_scale(); }

  /// Returns the total potential energy in the user's unit [force·length].
  double energy(const State& state) const { return frame().factor() * system().energy(state); }

  /// Returns the given deck with all stages, of which each value of `visit` is one, in the user's coordinates.
  const deck::Deck& whole_deck() const { return *whole_deck_; }

  /// Returns the deck as it was given.
  const deck::Deck& given_deck() const { return *given_deck_; }

  /// Returns how this model's stage ends in a state.
  StageEnd end_in(const State& last) const;

  /// Ends the last stage and builds the model of the next one. Returns false if there is none, or if it takes hold of
  /// other points.
  bool begin_stage(StageEnd end);

  /// Returns how each finished stage has ended.
  const std::vector<StageEnd>& ended_stages() const { return ended_stages_; }

  /// Returns the model of a stage, counted from 0.
  Model& at_stage(Index stage) { return stage == 0 ? *this : *later_[static_cast<std::size_t>(stage) - 1]; }
  const Model& at_stage(Index stage) const { return const_cast<Model&>(*this).at_stage(stage); }

  /// Return the number of this model's stage, and its name; empty without stages.
  Index stage() const { return stage_; }
  std::string stage_name() const {
    return whole_deck_->stages.empty() ? "" : whole_deck_->stages[static_cast<std::size_t>(stage_)].name;
  }
  const Structure& structure() const { return *path_.structure; }

  /// Returns the structure of the path, and what it touches.
  const Assembly& path() const { return path_; }

  /// Returns the contact of the mesh nodes; null if the deck has no walls, or compliant ones.
  const MultiplierContact* contact() const { return path_.contact.get(); }

  /// Returns the contact of compliant walls; null if they are not.
  const CompliantContact* compliant() const { return path_.compliant.get(); }

  /// Returns contact with moving points; null for node contact.
  const SlidingContact* sliding() const { return path_.sliding.get(); }

  /// Returns the friction of the contacts; null if there is none.
  const FrictionalContact* friction() const { return dynamic_cast<const FrictionalContact*>(contacts()); }

  /// Returns the state with the kink statuses of spring laws; computes missing ones from the elongations.
  State with_kinks(State state) const { return path_.with_kinks(std::move(state)); }

  /// Returns the structure with moving mesh nodes; null for node contact.
  const SlidingStructure* sliding_structure() const { return path_.sliding_structure.get(); }

  /// Returns the view of the structure that is independent of its mesh.
  const Body& body() const { return *path_.body; }

  /// Returns the traced system: the structure with its contacts.
  const System& system() const { return path_.system(); }

  /// Returns true if the deck requests load increments instead of path following.
  bool in_increments() const { return path_.increments != nullptr; }

  /// Returns load increments from a start. They change the model's reference configuration: use them for one run only.
  LoadIncrements increments(State start);

  /// Returns the query of a state's contacts, of either kind; null if the deck has no walls.
  const ContactQuery* contacts() const { return path_.contacts(); }

  const std::vector<MonitorColumn>& monitors() const { return monitors_; }

  /// Returns λ or the monitor of that name; null if there is none.
  std::shared_ptr<const Observable> quantity(const std::string& name) const;

  /// Returns the number of unstable directions under load control: the prescribed displacements are free and their
  /// reactions are constant. Empty if λ moves no support, or if the number is indeterminate.
  std::optional<Index> unstable_under_dead_load(const PathPoint& point) const;
  const TraceOptions& options() const { return options_; }
  const std::vector<Watch>& watched() const { return watched_; }
  const ExploreOptions& explore() const { return explore_; }

  /// Returns warnings, one sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Returns the equilibrium at λ = 0 under the constant loads and prescribed displacements, by tracing their growth.
  /// Empty if there is none; `reason` then receives the cause.
  std::optional<State> start(std::string& reason) const;

  /// Returns the end state of the previous stage, `before`, as the start of this one.
  State taken_over(const State& last, const Model& before) const;

  /// Returns true if supports leave the structure rigid-body motions, which contact alone restrains.
  bool is_loose() const { return !path_.holds.empty(); }

  /// Returns the message if a body without supports has moved away from its contacts; else empty.
  std::optional<std::string> adrift(const State& state) const;

  /// Returns the number of closed contact points.
  Index closed_contacts(const State& state) const;

 private:
  State begun_from(const State& state) const;
  State gripped(const State& state, const Model& before) const;
  Model(std::shared_ptr<const deck::Deck> given, const deck::Frame& frame);
  // `progress`: of what λ drives, before the stage; empty where nothing has gone before it.
  Model(std::shared_ptr<const deck::Deck> whole, const deck::Frame& frame, Index stage,
        std::optional<std::vector<DrivenThing>> progress);
  bool hold_loose_bodies();
  bool has_ramp() const;
  Assembly make_ramp(const StructureOfDeck& described, const LooseHolds& until_stiffened) const;
  StructureOfDeck described_with(const LooseHolds& holds) const;
  bool is_stiffened(const State& state) const;
  std::unique_ptr<Structure> stiffly_held(const Assembly& of) const;
  double stiffness_of_ramp_holds() const;
  double lambda_scale_if_held(const Assembly& of) const;
  std::function<bool(const std::string&, const std::string&)> may_join() const;
  ContactScales scales_of_contact() const;
  std::optional<State> grown(std::string& reason) const;
  TraceOptions options_up_to(const Assembly& of, double lambda) const;
  State begun_at_rest(const Assembly& of, double first) const;

  std::shared_ptr<const deck::Deck> given_deck_, whole_deck_;
  Index stage_ = 0;
  std::vector<DrivenThing> progress_;  // before this stage
  std::vector<std::unique_ptr<Model>> later_;
  std::vector<StageEnd> ended_stages_;
  Assembly path_;                 // of the stage; its holds are those of loose bodies
  std::optional<Assembly> ramp_;  // empty where nothing is constant; its holds may also be those of a mechanism
  std::vector<MonitorColumn> monitors_;
  struct MovedDof {
    double rate;                                 // by λ
    std::shared_ptr<const Observable> reaction;  // of the support
  };
  std::vector<MovedDof> moved_;
  struct GrippedPoint {
    std::shared_ptr<const Observable> x, z, rotation;  // the last is null where the point has none
  };
  std::vector<GrippedPoint> gripped_next_;  // of grips_of() the next stage
  TraceOptions options_;
  std::vector<Watch> watched_;
  ExploreOptions explore_;
  std::vector<std::string> warnings_;
};

}  // namespace arcwall
