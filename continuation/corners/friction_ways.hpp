#pragma once

#include <optional>
#include <vector>

#include "continuation/corners/corner.hpp"

/// The ways on from a corner with friction: combinations of stick, slip and open whose rates fulfil the law.
namespace arcwall {

/// A contact, and what it may do from here on; the first is what it would do at once where nothing is known: one whose
/// force has vanished opens, one whose gap has closes.
struct BoundContact {
  Index contact = 0;
  std::vector<ContactMode> modes{};
  bool touches = false;  ///< without a force
  bool ended = false;    ///< its slip has: a stick has the same tangent, along which its friction stays at the bound
};

/// One combination of modes: its equations hold at the corner, and the rates along the direction fulfil the law.
struct Continuation {
  std::vector<ModeOfContact> modes{};
  State state{};
  Direction direction{};  ///< unit
  std::vector<Index> slipping{};
  Vector relieved{};  ///< by each slip alone of the friction that drives it [scale of guards]
  std::optional<Index> unstable{};
  double dissipation = 0.0;
};

/// The contacts that stand at a bound: those that touch without a force, those that stick with |T| = μ p, and those
/// that slip, which may stick from here on.
std::vector<BoundContact> choices_at(const TraceTools& tools, const Corner& corner, std::optional<Index> landed,
                                     std::optional<Index> ended);

struct WaysOn {
  std::vector<Continuation> ways{};
  bool all_known = false;
};

/// The ways on of contacts that stand at a bound. Of few contacts all combinations are tried, of many one with λ in
/// the sense is looked for first.
WaysOn ways_on(TraceTools& tools, const Corner& corner, const std::vector<BoundContact>& choices, double sense);

/// How the structure moves along a direction: with all contacts open, of unit length.
Direction motion_along(const TraceTools& tools, const Corner& corner, const State& state, const Direction& direction);

/// The power that friction dissipates along a way, a unit of its direction.
double dissipation_along(const FrictionalContact& friction, const Continuation& way);

inline int sign_of_rate(double value) { return value > 0.0 ? 1 : value < 0.0 ? -1 : 0; }

}  // namespace arcwall
