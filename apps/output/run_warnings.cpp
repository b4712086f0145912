#include "apps/output/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/exit_status.hpp"
#include "apps/output/walls_between_nodes.hpp"
#include "contact/sliding/layout.hpp"
#include "model/shape.hpp"

namespace arcwall {

namespace {

std::string listed(const std::vector<Index>& numbers) {
  constexpr std::size_t most = 10;
  std::string list;
  for (std::size_t i = 0; i < std::min(numbers.size(), most); ++i)
    list += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
  if (numbers.size() > most) list += ", …";
  return list;
}

bool has_constants(const deck::Deck& deck) {
  const auto constant = [](const auto& driven) { return driven.constant; };
  return std::any_of(deck.loads.begin(), deck.loads.end(), constant) ||
         std::any_of(deck.prescribed.begin(), deck.prescribed.end(), constant);
}

}  // namespace

std::string warning_of_start(const Model& model, const Record& record) {
  if (record.points.empty()) return {};
  const std::optional<Index> unstable = record.points.front().count.unstable;
  if (!unstable || *unstable == 0) return {};
  const std::string directions = fmt::format("{} unstable direction{}", *unstable, *unstable == 1 ? "" : "s");
  if (!has_constants(model.whole_deck()))
    return "the path starts at a state with " + directions + ", which a real structure would leave";
  return "the constant loads and movements lead to a state with " + directions +
         ": on the way there a real structure would have left this equilibrium for another one. The path that is "
         "traced "
         "starts on an unstable branch; make the loads smaller, give the structure an imperfection, or let λ drive "
         "them";
}

namespace {

// Of any point of a member, from its stress-free place.
double greatest_displacement(const Model& model, const Record& record, const RecordPoint& point) {
  double greatest = 0.0;
  for (const MemberShape& member : shape_of(model.at_stage(record.stage_number(point.branch)), point.state).members)
    for (const ShapePoint& place : member.points)
      if (place.displacement.allFinite()) greatest = std::max(greatest, place.displacement.norm());
  return greatest;
}

// At some of the points of the paths, from the last one back until it is `enough`.
double greatest_displacement(const Model& model, const Record& record, double enough) {
  constexpr std::size_t most = 20;
  const std::size_t count = record.points.size(), looked_at = std::min(count, most);
  double greatest = 0.0;
  for (std::size_t i = looked_at; i-- > 0 && greatest < enough;)
    greatest =
        std::max(greatest, greatest_displacement(model, record, record.points[i * (count - 1) / (looked_at - 1)]));
  return greatest;
}

// Steps are limited by their length, so that what is too soft moves no further than others, and λ hardly at all.
double displacement_of_first_step(const Model& model, const Record& record) {
  const RecordPoint &first = record.points[0], &second = record.points[1];
  const double moved = greatest_displacement(model, record, second) - greatest_displacement(model, record, first);
  const double gone = std::abs(second.lambda - first.lambda);
  return second.branch == first.branch && gone > 0.0 ? std::abs(moved) * std::abs(model.deck().path.step) / gone : 0.0;
}

bool has_ended_as_asked(const Record& record) {
  return std::all_of(record.branches.begin(), record.branches.end(), [](const RecordBranch& branch) {
    return branch.end && exit_status(branch.end->reason) == ExitStatus::success;
  });
}

}  // namespace

// A body that only contact holds moves freely before it is held; one that does not move at all, or whose path ends
// before it is loaded, tells nothing.
std::string warning_of_units(const Model& model, const Record& record) {
  constexpr double small = 1e-6, large = 1e6, roundoff = 1e-14;  // of the size
  const std::string advice =
      ": the units of the deck hardly fit together. Lengths, forces and stresses have to be of one system, as mm, N "
      "and "
      "N/mm², or m, kN and kN/m²";
  if (record.points.size() < 2) return {};
  const double size = model.size();
  const double step = model.is_loose() ? 0.0 : displacement_of_first_step(model, record) / size;
  if (step > large)
    return fmt::format("a first step of λ as the deck has it would move the structure by {:.1e} times its size", step) +
           advice;
  if (!has_ended_as_asked(record)) return {};
  const double part = greatest_displacement(model, record, small * size) / size;
  return part >= small || part <= roundoff
             ? ""
             : fmt::format("the structure has moved by no more than {:.1e} times its size, all along", part) + advice;
}

std::string warning_of_found(const Record& record) {
  const std::vector<Index> early = found_that_ended_early(record);
  if (early.empty()) return {};
  return fmt::format(
      "{} of the branches that the search has found ended early ({}): events.txt says why. The status is that "
      "of the other branches",
      early.size(), listed(early));
}

namespace {

// By which an element turns [rad].
double greatest_turn(const State& state, Index strands) {
  const SlidingMesh& mesh = sliding_layout(state.active_set).mesh();
  const MeshState now = mesh_state_of(state);
  double greatest = 0.0;
  for (Index strand = 0; strand < strands; ++strand)
    for (Index position = 1; position < mesh.nodes(strand); ++position)
      greatest = std::max(
          greatest, std::abs(mesh.node(strand, position, now).angle - mesh.node(strand, position - 1, now).angle));
  return greatest;
}

}  // namespace

std::string warning_of_bent(const Model& model, const Record& record) {
  constexpr double most_turn = 0.3;  // of which elements tell how the body bends
  constexpr Index looked_at = 10;    // points of a branch
  if (model.sliding() == nullptr || model.in_increments()) return {};
  std::vector<Index> bent;
  double greatest = 0.0;
  for (const RecordPoint& point : record.points) {
    const Index every = std::max(record.branches[static_cast<std::size_t>(point.branch)].points / looked_at, Index{1});
    if (point.contacts == 0 || point.step % every != 0 || (!bent.empty() && bent.back() == point.branch)) continue;
    const double turn = greatest_turn(point.state, model.sliding_structure()->strands());
    if (turn <= most_turn) continue;
    bent.push_back(point.branch);
    greatest = std::max(greatest, turn);
  }
  if (bent.empty()) return {};
  return fmt::format(
      "on branch{} {} elements turn by more than {} rad (by {:.1f}) where contact may slide along them: how many "
      "directions are unstable there, and where contact changes, the mesh does not tell for sure. Give the members "
      "more "
      "elements",
      bent.size() == 1 ? "" : "es", listed(bent), most_turn, greatest);
}

std::vector<std::string> warnings_of_paths(const Model& model, const Record& record) {
  std::vector<std::string> all;
  for (std::string warning : {warning_of_units(model, record), warning_of_found(record), warning_of_bent(model, record),
                              warning_of_walls_between_nodes(model, record)})
    if (!warning.empty()) all.push_back(std::move(warning));
  return all;
}

std::vector<std::string> run_warnings(const Model& model, const Record& record) {
  std::vector<std::string> all = model.warnings();
  if (std::string start = warning_of_start(model, record); !start.empty()) all.push_back(std::move(start));
  for (std::string& warning : warnings_of_paths(model, record)) all.push_back(std::move(warning));
  return all;
}

}  // namespace arcwall
