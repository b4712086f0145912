#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/candidate.hpp"
#include "continuation/path_point.hpp"
#include "core/frictional_contact.hpp"

/// Results of a run: plain values for the output files, and the states.
namespace arcwall {

/// Stores a monitor's name and unit.
struct RecordColumn {
  std::string name{};
  std::string unit{};     ///< without brackets; may be empty
  double roundoff = 0.0;  ///< of values near zero
};

/// Stores what friction does at a closed contact.
struct RecordFriction {
  ContactMode mode = ContactMode::sticks;
  double force = 0.0;                       ///< T, along the wall's tangent [force]
  double coefficient = 0.0;                 ///< μ [-]
  double slip = 0.0;                        ///< since the contact closed [length]
  double tangent_x = 1.0, tangent_z = 0.0;  ///< the wall's tangent, with the structure to its left
  std::optional<double> anchor{};           ///< x of the place where it sticks [length]
};

/// Stores a slip that goes on from a point, with its rates by the arc length.
struct RecordSlip {
  Index contact = 0;   ///< its number
  double force = 0.0;  ///< T, along the wall's tangent [force]
  double force_rate = 0.0;
  ContactPlace place{};  ///< [length]
  ContactPlace rates{};
  bool rolls = false;   ///< along the member: else it is a node or an end, and slips by dw
  double before = 0.0;  ///< what it has dissipated between the point and where its active set begins [force·length]

  friend bool operator==(const RecordSlip&, const RecordSlip&) = default;
};

/// Stores a closed contact of a point, a row of contacts.csv.
struct RecordForce {
  ContactLabel label{};
  double x = 0.0;                    ///< current position [length]
  double force = 0.0;                ///< along the wall's normal [force]
  std::optional<double> pressure{};  ///< [force/length]; empty of a point force
  std::optional<RecordFriction> friction{};
};

/// Stores the derivatives of λ, of the total potential energy and of the monitors by the arc length, along the path.
struct RecordRates {
  double lambda = 0.0;
  double energy = 0.0;
  std::vector<double> monitors{};  ///< one a column of the record
};

/// Stores a point, a row of path.csv.
struct RecordPoint {
  Index branch = 0;
  Index step = 0;  ///< counts from 0 within the branch
  double arc = 0.0;
  double lambda = 0.0;
  std::vector<double> monitors{};  ///< one a column of the record
  StabilityCount count{};
  std::optional<Index> unstable_load_control{};  ///< see Model::unstable_under_dead_load()
  Index contacts = 0;                            ///< closed
  double energy = 0.0;
  int iterations = 0;
  double residual = 0.0;             ///< relative
  std::optional<EventKind> event{};  ///< if several: the last that is no contact change, else the last
  std::vector<RecordForce> forces{};
  std::vector<double> dissipation{};         ///< by friction since the start of the run, one a wall [force·length];
                                             ///< empty without friction
  std::vector<RecordSlip> slips{};           ///< just after it
  std::optional<RecordRates> rates{};        ///< just before the point; empty of load increments
  std::optional<RecordRates> rates_after{};  ///< just after it, where the path has a kink; else empty
  State state{};
};

/// Stores a contact that changes.
struct RecordContact {
  ContactLabel label{};
  double x = 0.0;                            ///< current position of the contact point [length]
  std::optional<double> force{};             ///< of a change with friction [force]
  std::optional<RecordFriction> friction{};  ///< of a closed contact with friction, behind the change
};

/// Stores an admissible way on from a change of contacts with friction.
struct RecordFrictionWay {
  struct Contact {
    ContactLabel label{};
    ContactMode mode = ContactMode::open;
  };
  std::vector<Contact> contacts{};  ///< those that might change
  int lambda_sense = 0;             ///< sign of the rate of λ
  double dissipation = 0.0;         ///< power of friction along the unit tangent
  std::optional<Index> unstable{};
  bool taken = false;
};

/// Stores the sensitivity of an event's λ and monitors to a parameter of the deck.
struct RecordSensitivity {
  std::string key{};              ///< as the deck names it
  double value = 0.0;             ///< of the parameter
  std::optional<double> slope{};  ///< dλ/dvalue [1 over the parameter's unit]; empty: none exists or is known
  std::vector<std::optional<double>> rates{};  ///< dm/dvalue of the monitors m; empty: as above
  std::string why_none{};                      ///< cause of an empty slope
};

/// Stores a contact point or a contact zone.
struct RecordStretch {
  ContactLabel label{};  ///< of its first point
  bool is_zone = false;
  double force = 0.0;  ///< total [force]
};

struct RecordReturn;

/// Stores the state to which a structure jumps at constant λ after an event.
struct RecordJump {
  std::string reason{},
      why{};  ///< `no_equilibrium`, `not_found` or `two_destinations`, and its cause; empty if there is one state
  double lambda = 0.0;
  std::vector<double> monitors{};
  std::vector<RecordStretch> contacts{};  ///< along the members
  std::string contact_pattern{};          ///< the walls of these, `upper lower upper`; `upper=` for a zone
  double energy = 0.0;                    ///< total potential [force·length]
  double energy_released = 0.0;           ///< energy before minus energy after the jump [force·length]
  std::optional<Index> unstable{};
  std::optional<Index> on_branch{};                 ///< traced branch through the state; empty: none
  double arc = 0.0;                                 ///< along it
  std::size_t point = 0;                            ///< the last point of the record before it
  std::shared_ptr<const RecordReturn> on_return{};  ///< jump as λ reverses; null: no loss of stability is known
  std::optional<double> energy_dissipated{};        ///< energy lost in a closed loop [force·length]
  std::vector<RecordJump> destinations{};           ///< of `two_destinations`: one for each sign of the mode
  State state{};                                    ///< equilibrium after the jump; without entries if there is none
};

/// Stores the loss of stability of the destination of a jump as λ reverses.
struct RecordReturn {
  double lambda = 0.0;
  EventKind kind = EventKind::limit_point;
  std::vector<double> monitors{};
  std::shared_ptr<const RecordJump> jump{};
};

/// Stores an event.
struct RecordEvent {
  Index id = 0;  ///< counts from 0 over all branches
  EventKind kind = EventKind::start;
  Index branch = 0;
  Index step = 0;  ///< of the point it lies on
  double arc = 0.0;
  double lambda = 0.0;
  std::vector<double> monitors{};
  std::optional<Index> unstable_before{}, unstable_after{};
  std::optional<Index> unstable_load_control{};  ///< of its point
  double residual = 0.0;                         ///< relative
  double lambda_uncertainty = 0.0;               ///< half-width in λ
  std::vector<RecordContact> contacts{};         ///< of a change of contact
  std::vector<RecordFrictionWay> ways{};         ///< of a change of contacts with friction: all that were found
  bool all_ways_known = false;                   ///< every combination was tried
  std::optional<Extremum> extremum{};            ///< of λ, at a limit point
  std::optional<std::string> monitor{};          ///< of a turning point or a value crossing
  std::optional<double> value{};                 ///< of a value crossing: the value that is passed
  std::optional<BranchEnd> branch_end{};         ///< of an end
  std::optional<Continuum> continuum{};          ///< equilibrium family of which the branch follows one from here on
  std::optional<BranchType> branch_type{};       ///< of a branch point
  Index multiplicity = 1;                        ///< of a branch point: critical modes
  bool unconfirmed = false;                      ///< a zero without a detected change of sign
  bool mesh_artefact = false;                    ///< of a branch point due to node contact alone
  std::vector<Index> branches{};                 ///< that bifurcate at a branch point
  std::vector<double> mode{};  ///< rates of the monitors along the critical mode of a branch point; may be empty
  std::vector<RecordSensitivity> sensitivity{};  ///< one a parameter of `path.sensitivity`, in their order
  std::shared_ptr<const RecordJump> jump{};      ///< null: no jump, or jumps were not requested
};

/// Outcomes of an initial guess in the search for disconnected branches.
enum class SearchOutcome {
  found,         ///< it converged to a new equilibrium
  mirror_image,  ///< it started at the mirror image of an equilibrium, itself an equilibrium: not traced
  known,         ///< it converged to an equilibrium on a traced branch, or found before
  nodes_only,    ///< it converged with node contact, but not with moving contact points
  not_found,     ///< it did not converge
};

inline constexpr std::size_t search_outcomes = static_cast<std::size_t>(SearchOutcome::not_found) + 1;

/// States of an equilibrium that was found by search.
enum class FoundFate {
  pending,      ///< not yet traced
  traced,       ///< traced as one branch or two
  on_branch,    ///< it lies on another branch found by search
  beyond_stop,  ///< it is beyond a bound of path.stop
  not_traced,   ///< no step from it converged
};

/// Stores an equilibrium that was found by search.
struct RecordFound {
  std::string contact_pattern{};  ///< its contacts, as of a jump
  std::vector<double> monitors{};
  double energy = 0.0;
  std::optional<Index> unstable{};
  FoundFate fate = FoundFate::pending;
  std::vector<Index> branches{};  ///< that start there, or pass through it
};

/// Stores the search for disconnected branches at one λ.
struct RecordSearch {
  double lambda = 0.0;
  Index known = 0;                                ///< equilibria of traced branches
  std::array<Index, search_outcomes> outcomes{};  ///< number of guesses by SearchOutcome
  std::vector<RecordFound> found{};
};

/// Stores a branch.
struct RecordBranch {
  Index id = 0;
  Index stage = 0;                ///< counts from 0
  std::optional<Index> parent{};  ///< branch that it leaves; empty: none
  std::optional<Index> origin{};  ///< event at which it leaves: a bifurcation, or the start of a jump; empty: none
  bool mirror_image = false;      ///< its mirror image also bifurcates there and is not traced
  bool found = false;             ///< a disconnected branch
  bool after_jump = false;        ///< it starts where a jump from its parent ended
  Index points = 0;
  double least_lambda = infinity, greatest_lambda = -infinity;  ///< of its points
  std::optional<BranchEnd> end{};                               ///< empty before the end
};

/// Stores a branch point and the number of its event.
struct RecordBranchPoint {
  std::shared_ptr<const BranchPoint> point{};
  Index event = 0;
};

struct Record {
  std::string deck{};  ///< file name without folder
  std::string title{};
  std::string energy_unit{}, length_unit{}, force_unit{};
  bool has_walls = false;
  bool has_friction = false;
  bool moves_supports = false;
  std::vector<std::string> stages{};  ///< their names; empty if the deck has none
  std::vector<RecordColumn> columns{};
  std::vector<RecordBranch> branches{};
  std::vector<RecordPoint> points{};
  std::vector<RecordEvent> events{};
  std::vector<RecordBranchPoint> branch_points{};
  std::vector<RecordSearch> searches{};

  /// Returns the number of a branch's stage, counted from 0.
  Index stage_number(Index branch) const {
    return stages.empty() ? 0 : branches[static_cast<std::size_t>(branch)].stage;
  }
  /// Returns the name of a branch's stage; empty without stages.
  std::string stage_of(Index branch) const {
    return stages.empty() ? "" : stages[static_cast<std::size_t>(stage_number(branch))];
  }
  std::string steps{};  ///< lines of steps.jsonl; empty unless requested
};

}  // namespace arcwall
