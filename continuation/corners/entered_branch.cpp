#include "continuation/corners/entered_branch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "continuation/path_tolerances.hpp"

namespace arcwall {

namespace {

// A point of the branch, `distance` from the corner along the mode [path metric].
struct Place {
  State state{};
  Direction tangent{};
  double distance = 0.0;
};

// One side of a pitchfork in a corner. Towards the corner the mode says ever more of the forces at the ends of the part
// that has no length there; along the branch forces hardly change. So guesses move positions by the mode and leave the
// forces.
class SideOfCorner {
 public:
  SideOfCorner(const System& system, Corrector& corrector, const Metric& metric, const BranchPoint& point, int sign,
               double guard_tolerance)
      : system_(system),
        corrector_(corrector),
        metric_(metric),
        corner_(point.state),
        mode_(sign > 0 ? point.mode : reversed(point.mode)),
        guards_there_(system.guards(point.state)),
        guard_tolerance_(guard_tolerance) {
    corrector_.inspect(corner_, metric_, point.along);
    const Index of_K = corrector_.factorized().equations().K.cols();
    const Index forces = system.multiplier_count(corner_.active_set);
    mode_.dx.segment(of_K - forces, forces).setZero();
  }

  // An equilibrium of the branch at some distance from the corner, `distance` or a part of it; empty if there is none.
  std::optional<Place> begin(const double distance) {
    constexpr int most_tried = 12;
    double d = distance;
    for (int tried = 0; tried < most_tried; ++tried, d *= 0.5) {
      const PlaneConstraint plane(metric_, corner_, mode_, d);
      CorrectorResult at = corrector_.correct_patiently(moved(corner_, mode_, d), plane, metric_, mode_, d);
      if (at.converged() && metric_.distance(at.state, corner_) <= 2.0 * distance && may_be_passed(at.state))
        return place(std::move(at), d);
    }
    return std::nullopt;
  }

  // Follows the branch from there to where all guards hold: the places on the way, that one the last. Empty where it is
  // not followed so far.
  std::vector<Place> follow(Place from) {
    constexpr double longest = 0.5, shortest = 0.01;  // steps, in distances from the corner
    constexpr double farthest = 1.0;                  // [path metric]
    std::vector<Place> places{std::move(from)};
    double step = longest;
    while (!holds(places.back().state)) {
      const Place& last = places.back();
      if (step < shortest || last.distance > farthest) return {};
      const double length = step * last.distance / metric_.inner(last.tangent, mode_);
      const double distance = (1.0 + step) * last.distance;
      const PlaneConstraint plane(metric_, corner_, mode_, distance);
      CorrectorResult at =
          corrector_.correct(moved(last.state, last.tangent, length), plane, metric_, last.tangent, std::abs(length));
      if (at.converged() && may_be_passed(at.state))
        places.push_back(place(std::move(at), distance));
      else
        step *= 0.5;
    }
    return places;
  }

 private:
  // Whether nothing is violated but what is violated right behind the corner: the new part's own length.
  bool may_be_passed(const State& state) const {
    if (system_.penetrated_place(state, -penetration_tolerance)) return false;
    const Vector guards = system_.guards(state);
    return (guards.array() >= -guard_tolerance_ || guards_there_.array() < -guard_tolerance_).all();
  }

  bool holds(const State& state) const { return (system_.guards(state).array() >= -guard_tolerance_).all(); }

  // Its tangent leads away from the corner.
  Place place(CorrectorResult at, double distance) const {
    if (metric_.inner(at.tangent, mode_) < 0.0) at.tangent = reversed(std::move(at.tangent));
    return {.state = std::move(at.state), .tangent = std::move(at.tangent), .distance = distance};
  }

  const System& system_;
  Corrector& corrector_;
  const Metric& metric_;
  const State& corner_;
  Direction mode_;
  Vector guards_there_;
  double guard_tolerance_;
};

}  // namespace

std::optional<EnteredBranch> enter_branch(const System& system, Corrector& corrector, const Metric& metric,
                                          const BranchPoint& point, int sign, double distance, double guard_tolerance) {
  constexpr double begins = 0.25;  // of the way to the first point, if the branch is known from there on
  SideOfCorner side(system, corrector, metric, point, sign, guard_tolerance);
  auto beginning = side.begin(distance);
  if (!beginning) return std::nullopt;
  const double entered_at = beginning->distance;
  const std::vector<Place> places = side.follow(std::move(*beginning));
  if (places.empty()) return std::nullopt;
  const auto begin = std::find_if(places.rbegin(), places.rend(), [&](const Place& place) {
    return place.distance <= begins * places.back().distance || place.distance == entered_at;
  });
  return EnteredBranch{
      .begin = begin->state, .tangent = begin->tangent, .first = places.back().state, .distance = entered_at};
}

}  // namespace arcwall
