#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/candidate.hpp"
#include "continuation/path_point.hpp"

/// What the outputs say of a run: plain values, and the states they were read off.
namespace arcwall {

/// A monitor's name and unit.
struct RecordColumn {
  std::string name{};
  std::string unit{};  ///< without brackets; may be empty
};

/// A closed contact of a point: a row of contacts.csv.
struct RecordForce {
  ContactLabel label{};
  double x = 0.0;                    ///< present [length]
  double force = 0.0;                ///< along the wall's normal [force]
  std::optional<double> pressure{};  ///< [force/length]; empty of a point force
};

/// A row of path.csv.
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
  std::optional<EventKind> event{};  ///< of several the last that is no change of contact, else the last
  std::vector<RecordForce> forces{};
  State state{};
};

/// A contact that changes.
struct RecordContact {
  ContactLabel label{};
  double x = 0.0;  ///< present, of the contact point [length]
};

/// How λ of an event depends on a number of the deck.
struct RecordSensitivity {
  std::string key{};              ///< as the deck names it
  double value = 0.0;             ///< of the number
  std::optional<double> slope{};  ///< dλ/dvalue [1 over the number's unit]; empty: there is none, or none is known
  std::string why_none{};         ///< then
};

/// A contact point or a contact zone.
struct RecordStretch {
  ContactLabel label{};  ///< of its first point
  bool is_zone = false;
  double force = 0.0;  ///< in sum [force]
};

struct RecordReturn;

/// Where a structure falls to behind an event, at the same λ.
struct RecordJump {
  std::string reason{},
      why{};  ///< `no_equilibrium`, `not_found` or `two_destinations`, and in words why; empty where it comes to rest
  double lambda = 0.0;
  std::vector<double> monitors{};
  std::vector<RecordStretch> contacts{};  ///< along the members
  std::string contact_pattern{};          ///< the walls of these, `upper lower upper`; `upper=` of a stretch
  double energy = 0.0;                    ///< total potential [force·length]
  double energy_released = 0.0;           ///< energy before less energy behind [force·length]
  std::optional<Index> unstable{};
  std::optional<Index> on_branch{};                 ///< the branch that passes through the state, if one does
  double arc = 0.0;                                 ///< along it
  std::size_t point = 0;                            ///< the last point of the record before it
  std::shared_ptr<const RecordReturn> on_return{};  ///< λ taken back from there; null: no loss of stability is known
  std::optional<double> energy_dissipated{};        ///< energy lost in a closed loop [force·length]
  std::vector<RecordJump> destinations{};  ///< of `two_destinations`: in one sense of the mode and in the other
};

/// Where the state that was fallen to loses its stability as λ goes back.
struct RecordReturn {
  double lambda = 0.0;
  EventKind kind = EventKind::limit_point;
  std::vector<double> monitors{};
  std::shared_ptr<const RecordJump> jump{};
};

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
  double lambda_uncertainty = 0.0;               ///< half-width in λ of what is left uncertain
  std::vector<RecordContact> contacts{};         ///< of a change of contact
  std::optional<Extremum> extremum{};            ///< of λ, at a limit point
  std::optional<std::string> monitor{};          ///< of a turning point
  std::optional<BranchEnd> branch_end{};         ///< of an end
  std::optional<Continuum> continuum{};     ///< of a change of contact: the branch keeps to one member from here on
  std::optional<BranchType> branch_type{};  ///< of a branch point
  Index multiplicity = 1;                   ///< of a branch point: critical modes
  bool unconfirmed = false;                 ///< zero is touched without a change of sign, as nearly as can be told
  bool mesh_artefact = false;               ///< of a branch point that only contact at nodes makes
  std::vector<Index> branches{};            ///< that leave a branch point
  std::vector<double> mode{};  ///< rates of the monitors along the critical mode of a branch point; may be empty
  std::vector<RecordSensitivity> sensitivity{};  ///< by the deck's numbers of `path.sensitivity`, in their order
  std::shared_ptr<const RecordJump> jump{};      ///< null: the structure does not fall, or that was not asked for
};

/// What became of a try to find an equilibrium that no traced branch passes.
enum class SearchOutcome {
  found,         ///< it led to one
  mirror_image,  ///< it began at the image of an equilibrium, which is one, too: not traced
  known,         ///< it led to one that a traced branch passes, or that was found before
  nodes_only,    ///< to one of contact at nodes, near which none of contact that slides was found
  not_found,     ///< to none
};

inline constexpr std::size_t search_outcomes = static_cast<std::size_t>(SearchOutcome::not_found) + 1;

/// What becomes of an equilibrium that was found.
enum class FoundFate {
  pending,      ///< it is to be traced
  traced,       ///< as a branch, or two
  on_branch,    ///< a branch passes it that was found with another one
  beyond_stop,  ///< it is beyond a bound of path.stop
  not_traced,   ///< no step leads off it
};

/// An equilibrium that was found at some λ.
struct RecordFound {
  std::string contact_pattern{};  ///< its contacts, as of a jump
  std::vector<double> monitors{};
  double energy = 0.0;
  std::optional<Index> unstable{};
  FoundFate fate = FoundFate::pending;
  std::vector<Index> branches{};  ///< that begin there, or the one that passes it
};

/// What was looked for at one λ, besides the traced branches.
struct RecordSearch {
  double lambda = 0.0;
  Index known = 0;                                ///< equilibria of traced branches
  std::array<Index, search_outcomes> outcomes{};  ///< of the tries, by SearchOutcome
  std::vector<RecordFound> found{};
};

struct RecordBranch {
  Index id = 0;
  Index stage = 0;                ///< counts from 0
  std::optional<Index> parent{};  ///< the branch it leaves
  std::optional<Index> origin{};  ///< the event at which it does
  bool mirror_image = false;      ///< its mirror image leaves there too and is not traced
  bool found = false;             ///< it begins at an equilibrium that was found beside the other branches
  Index points = 0;
  double least_lambda = infinity, greatest_lambda = -infinity;  ///< of its points
  std::optional<BranchEnd> end{};                               ///< empty while it goes on
};

/// A branch point and its event, for the branches that leave it.
struct RecordBranchPoint {
  std::shared_ptr<const BranchPoint> point{};
  Index event = 0;
};

struct Record {
  std::string deck{};  ///< file name without folder
  std::string title{};
  std::string energy_unit{}, length_unit{}, force_unit{};
  bool has_walls = false;
  bool moves_supports = false;
  std::vector<std::string> stages{};  ///< their names; empty if the deck has none
  std::vector<RecordColumn> columns{};
  std::vector<RecordBranch> branches{};
  std::vector<RecordPoint> points{};
  std::vector<RecordEvent> events{};
  std::vector<RecordBranchPoint> branch_points{};
  std::vector<RecordSearch> searches{};

  /// The number of the stage that a branch is of.
  Index stage_number(Index branch) const {
    return stages.empty() ? 0 : branches[static_cast<std::size_t>(branch)].stage;
  }
  /// The name of the stage that a branch is of; empty without stages.
  std::string stage_of(Index branch) const {
    return stages.empty() ? "" : stages[static_cast<std::size_t>(stage_number(branch))];
  }
  std::string steps{};  ///< lines of steps.jsonl; empty unless they are wanted
};

}  // namespace arcwall
