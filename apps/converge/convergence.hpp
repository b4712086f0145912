#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/converge/extrapolation.hpp"
#include "model/deck/deck.hpp"
#include "model/record.hpp"

namespace arcwall {

/// A mesh of the study and what was traced on it.
struct MeshRun {
  double times = 1.0;           ///< elements of every member, as a multiple of the deck's
  std::vector<int> elements{};  ///< of the members, in the deck's order
  std::string problem{};        ///< why nothing was traced; empty otherwise
  Record record{};
};

/// λ or a monitor of an event.
struct ConvergedValue {
  std::vector<std::optional<double>> on_mesh{};  ///< by mesh; empty where no event matches, or where it is infinite
  double uncertainty = 0.0;                      ///< the greatest of the meshes
  std::optional<double> penalty{};               ///< how far springs as walls give way to it; only with those
  Extrapolation limit{};
  std::optional<double> error_of_deck{};  ///< on the deck's own mesh; empty where it has no such event
};

/// An event on the finest mesh that has it, with what the other meshes say of it.
struct ConvergedEvent {
  RecordEvent event{};
  Index number = 1;            ///< among those of its kind on its mesh, in their order
  bool behind_a_slip = false;  ///< it depends on the way that led there, and nothing is extrapolated
  ConvergedValue lambda{};
  std::vector<ConvergedValue> monitors{};  ///< in the order of the columns; empty values where one is known on no mesh
};

/// How sure the events of a deck are.
struct Convergence {
  std::string deck{};  ///< file name without folder
  std::string title{};
  std::vector<std::string> members{};   ///< their names
  std::vector<RecordColumn> columns{};  ///< the monitors
  double factor = 2.0;
  std::size_t own_mesh = 0;              ///< number of the deck's own mesh
  std::vector<MeshRun> meshes{};         ///< from coarse to fine
  std::vector<ConvergedEvent> events{};  ///< in their order along the path
  std::vector<std::string> notes{};      ///< one sentence each
};

struct MeshStudy {
  int levels = 3;                                    ///< number of meshes, at least 2
  int factor = 2;                                    ///< of each to the one before, at least 2
  std::function<void(const MeshRun& run)> begins{};  ///< is told of each run before it begins
  std::function<bool()> stopped{};                   ///< is asked at each point; true ends the study
};

/// Runs a deck on meshes with 1/factor, 1, factor, … times the elements of every member, and compares the events. Where
/// a member cannot be divided so, or a place of the deck would be no node, the first mesh is the deck's own. Throws
/// InputError where a deck is wrong. Empty if it was stopped.
std::optional<Convergence> converge(const deck::Deck& deck, const MeshStudy& study);

/// For each event of `events` the one of `others` that is the same, if there is one: of one kind, with the same walls,
/// in the same order, and near in λ and the monitors, as parts of their ranges on the path.
std::vector<std::optional<std::size_t>> matched(const Record& record, const Record& other);

}  // namespace arcwall
