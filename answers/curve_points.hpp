#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "answers/deck_family.hpp"
#include "answers/event_curve.hpp"
#include "answers/find_event.hpp"
#include "continuation/event_curves/event_system.hpp"

namespace arcwall {

/// How an event of a path is followed; empty, with the reason in `problem`, where it is not.
std::optional<FollowedEvent> followed(const System& system, const FoundEvent& found, std::string& problem);

/// Unstable directions before and behind an event along the path; empty where they cannot be told.
struct SideCounts {
  std::optional<Index> before{}, after{};
};

/// What points of a curve of events say. `family` and `system` must outlive it.
class CurveReader {
 public:
  CurveReader(const DeckFamily& family, const EventSystem& system) : family_(family), system_(system) {}

  /// A point of the curve; `counts` are those of the point before it, and become its own: they are told in the order
  /// that changes least.
  CurvePoint read_off(const PathPoint& at, SideCounts& counts) const;

  /// Zero where a second mode is critical: along the path (−1)ⁿ |μ₁ μ₂| falls by the critical eigenvalue's rate times
  /// the second eigenvalue. Where a contact changes, the rate of λ along the path. NaN where it cannot be told.
  double crossing_value(const State& state) const;

 private:
  std::vector<std::optional<double>> monitor_slopes(const PathPoint& at) const;
  std::optional<SideCounts> counted(const State& state) const;
  void count_sides(const State& state, const SystemFamily::Member& member, SideCounts& counts) const;
  const MakeFactorization& factorization() const { return family_.own().options().factorization; }

  const DeckFamily& family_;
  const EventSystem& system_;
  mutable std::array<std::pair<State, SideCounts>, 2> counted_{};  // of the states that were asked about last
};

}  // namespace arcwall
