#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "continuation/event_curves/event_condition.hpp"
#include "continuation/event_curves/system_family.hpp"
#include "core/system.hpp"

namespace arcwall {

/// Which event is followed.
struct FollowedEvent {
  Criterion criterion = Criterion::turning;
  std::vector<Index>
      guards{};        ///< that vanish all along the curve; of Criterion::guard the first is what is solved for
  double value = 0.0;  ///< of Criterion::value
};

/// An event of a family of systems as a system of its own: its paths are curves of the event in two parameters
/// (docs/theory.md, section 14). The contacts of the event are fixed; unknown are its x and λ, and of a crossing the
/// size μ of what would part its branches; the parameter is κ:
///
///     F(x, λ; κ) + μ f = 0,    the event's one or two equations = 0.
///
/// The guards of the event's active set are validity bounds here: behind one of them the event is another one, unless
/// the mesh alone changes.
class EventSystem final : public System {
 public:
  /// `family` must outlive this. `lambda_scale`: λ₀ of the metric of x and λ.
  EventSystem(const SystemFamily& family, FollowedEvent event, double lambda_scale, MakeFactorization make);

  /// An event's state, in the family's terms, as a state here; empty if it cannot be told what is singular there.
  std::optional<State> of_event(const State& event, double kappa) const;

  /// The event's state of a point of the curve, in the family's terms.
  State in_common_terms(const State& state) const;

  /// The same in the terms of the system for its κ; empty where there is none.
  std::optional<SystemFamily::Member> at(const State& state) const;

  /// The direction of the path through the event at a point, in the terms of the system for its κ.
  std::optional<Direction> along_path(const State& state, const SystemFamily::Member& member) const;

  /// λ of a point.
  static double lambda_of(const State& state);

  /// The part of λ in a direction at a point; over its part of κ it is dλ/dκ.
  static double lambda_rate(const State& state, const Direction& direction);

  const FollowedEvent& event() const { return event_; }

  /// Members near κ with an event's state, in the family's terms, from which derivatives by κ are made; empty where
  /// there are too few.
  std::vector<WeightedMember> samples(const State& event, double kappa) const;

  /// What the unknowns of a state here mean, as plain values: for those who keep states.
  struct Meaning {
    ActiveSet active_set{};  ///< of the event, in the family's terms
    Vector weights{};        ///< of the unknowns of the event
    Index multipliers = 0, guards = 0;
    EventBorder border{};
  };

  /// Null of a layout that is not of a state here.
  static const Meaning* meaning_of(const Layout& layout);

  /// A layout of that meaning.
  static std::shared_ptr<const Layout> with_meaning(Meaning meaning);

  /// The metric of x and λ alone.
  Metric metric_of(const SystemFamily::Member& member) const;

  Dimensions dimensions(const ActiveSet& active_set) const override;
  void residual(const State& state, Eigen::Ref<Vector> F) const override;
  void linearize(const State& state, Linearization& out) const override;
  double energy(const State& state) const override;
  StateMetric metric(const ActiveSet& active_set) const override;
  CountedDirections counted_directions(const ActiveSet&) const override { return CountedDirections::none; }

  Vector guards(const State& state) const override;
  Row guard_gradient(const State& state, Index j) const override;
  GuardsAlong guards_along(const State& state, const Direction& direction) const override;
  std::string watched_place(const State& state, Index j) const override;

  std::vector<Transition> transitions(const State& state, const Direction& forward, Index bound,
                                      double tolerance) const override;
  StepVerdict check(const CheckedStep& step) const override;
  std::optional<std::string> penetrated_place(const State& state, double margin) const override;
  std::optional<PathKink> kink_between(const State& from, const State& to) const override;

 private:
  class EventLayout;

  bool border_fits_at(const State& state, const SystemFamily::Member& member) const;
  std::optional<Transition> with_new_border(const State& from, const Direction& forward) const;

  static const EventLayout& layout_of(const ActiveSet& active_set);
  Index extra() const { return event_.criterion == Criterion::crossing ? 2 : 1; }
  // An event's state `event`, in the family's terms, as one here; `at`: the same in those of the system for κ. `like`:
  // a state whose μ it has.
  State extended(const SystemFamily::Member& at, const State& event, double kappa, EventBorder border,
                 const State* like = nullptr) const;
  std::optional<std::vector<EventEquation>> equations(const SystemFamily::Member& at, const EventBorder& border,
                                                      Linearization& here, std::vector<WeightedMember>& samples) const;
  bool vanishes(Index guard) const;
  std::optional<Transition> remeshed(const State& from, const Transition& transition, const Direction& forward) const;

  const SystemFamily& family_;
  FollowedEvent event_;
  double lambda_scale_;
  MakeFactorization make_;
};

}  // namespace arcwall
