#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "continuation/corners/outgoing_directions.hpp"
#include "continuation/events/branch_point.hpp"
#include "continuation/events/event_detector.hpp"
#include "continuation/path_point.hpp"
#include "continuation/segment.hpp"
#include "continuation/stability.hpp"
#include "continuation/step/corrector.hpp"
#include "continuation/step/step_attempt.hpp"
#include "continuation/step/step_control.hpp"

namespace arcwall {

/// A bound that ends the branch, or a value to land on and go on.
struct TargetValue {
  std::shared_ptr<const Observable> quantity{};
  double value = 0.0;
  bool stops = false;
  std::string label{};  ///< for messages: `mid = -0.16`
};

/// A kind of event that ends the branch.
struct StopEvent {
  EventKind kind = EventKind::limit_point;
  std::string label{};  ///< for messages: `event = limit-point`
};

/// What is done about zeros of the detectors inside a step.
enum class EventSearch {
  locate,  ///< each becomes a point of the path
  detect,  ///< reported at the end of the step, with the interval
  none,
};

/// What to trace and how. The defaults need no tuning.
struct TraceOptions {
  PathMethod method = PathMethod::spherical;
  std::shared_ptr<const Observable> control{};  ///< of `displacement`
  StepOptions step{};
  CorrectorOptions corrector{};
  CornerOptions corner{};
  std::vector<TargetValue> target_values{};
  std::optional<Index> stop_contacts{};  ///< number of closed contacts that ends the branch
  std::vector<StopEvent> stop_events{};  ///< the first of any of these ends the branch
  EventSearch events = EventSearch::locate;
  std::vector<EventDetector> detectors{};  ///< besides limit points and watched monitors
  bool node_contacts = false;      ///< contacts cannot slide along the body: branch points with closed ones are marked
  double guard_tolerance = 1e-12;  ///< guards above −this are fulfilled, those within it degenerate
  double localisation = 1e-12;     ///< bracket of an event as a part of its step
  int max_points = 5000;
  bool every_ray = false;  ///< report a corner that several rays leave also where one alone of them is stable
  std::function<void(const StepAttempt&)> ledger{};  ///< is told of every attempted step
  bool stay = false;  ///< at a corner that only unstable rays leave: keep the old contacts where one does
};

/// λ′ of the unit tangent, scaled to [−1, 1]: its zeros are limit points.
EventDetector limit_point_detector(const Metric& metric);

/// The rate of a quantity along the unit tangent, scaled likewise: its zeros are turning points of the quantity.
EventDetector turning_detector(const System& system, const Metric& metric, std::shared_ptr<const Observable> quantity,
                               std::string label);

/// A monitor whose turning points are events.
struct Watch {
  std::shared_ptr<const Observable> quantity{};
  std::string label{};
};

/// A branch point that another branch passes through.
struct KnownPoint {
  State state{};
  int branch = 0;
};

/// Where a branch begins: at a state alone, forward with λ; or at a branch point, along one of its tangents.
struct BranchStart {
  State state{};
  std::optional<Direction> forward{};    ///< unit tangent at a branch point
  Direction mode{};                      ///< the first step keeps its component along this
  double distance = 0.02;                ///< of the first step off a branch point [path metric]
  std::optional<Index> unstable{};       ///< of the branch point
  std::optional<double> lambda_scale{};  ///< of the metric, as on the branches before
  std::vector<KnownPoint> known{};       ///< branch points where this branch would join another
};

/// Traces one branch arc by arc, from a state on the path.
class Tracer {
 public:
  /// `system` must outlive this; the start solves its equations or nearly so.
  Tracer(const System& system, BranchStart start, TraceOptions options, std::vector<Watch> watched = {});
  Tracer(const System& system, State start, TraceOptions options, std::vector<Watch> watched = {})
      : Tracer(system, BranchStart{.state = std::move(start)}, std::move(options), std::move(watched)) {}
  Tracer(const Tracer&) = delete;  // its parts share workspaces

  /// The next arc; the first has length zero and carries the `start` event. Empty when the branch has ended: see end().
  std::optional<Arc> next();

  /// Why the branch ended; empty while it goes on.
  const std::optional<BranchEnd>& end() const { return end_; }

  /// Ends the branch where it is (a time limit, an interrupt).
  void stop(BranchEnd end) { end_ = std::move(end); }

  /// λ₀ of the path metric.
  double lambda_scale() const { return metric_.lambda_scale(); }

  /// The last accepted point.
  const PathPoint& here() const { return here_; }

  /// The one before it on the same smooth arc, without its eigenpairs; empty behind a corner and at the start.
  const std::optional<PathPoint>& before() const { return before_; }

  /// Visits all that changes while the branch is traced: `archive(values…)` writes or reads them, `Archive::reads` says
  /// which. A tracer of the same system and options into which they are read goes on to the same last bit.
  template <typename Archive>
  void serialize(Archive& archive) {
    double lambda_scale = metric_.lambda_scale();
    archive(lambda_scale, start_, step_, here_, before_, values_before_, signs_, held_, after_, near_, vanishing_,
            nearest_, visited_, ahead_, others_, end_, last_failure_, invalid_reason_, refined_, points_, standing_);
    archive.require(signs_.size() == (points_ == 0 ? 0 : detectors_.size()));
    archive.require(!before_ || values_before_.size() == here_.nearest.values.size());
    for (const Singular& singular : near_) archive.require(is_known(singular.found));
    if constexpr (Archive::reads) metric_ = Metric(system_.weights(here_.state.piece), lambda_scale);
  }

 private:
  // Something that happens inside a step.
  struct Found {
    enum class What { branch_point, detector, target_value } what;
    friend constexpr std::int64_t greatest(What) { return static_cast<std::int64_t>(What::target_value); }
    std::size_t which;
    double t;  // estimate, then place, as a fraction of the step
    double half_width;

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(what, which, t, half_width);
    }
  };

  // A step that was taken: its end, and whether that lies on a corner.
  struct Step {
    PathPoint to;
    bool corner = false;
    Index guard = -1;        // landed on
    double turn = 0.0;       // of the tangent [rad]
    double slack = 0.0;      // by how much other guards are violated at the corner: they belong to it
    bool continuum = false;  // whether a continuum of equilibria lies behind the corner
  };

  // A singular point of a step, located: a branch point, a limit point, or both at one place.
  struct Singular {
    Found found;
    PathPoint at;
    Index change;                                            // of the number of negative eigenvalues, held, across it
    std::shared_ptr<const BranchPoint> branching = nullptr;  // empty: a limit point alone
    bool suspected = false;

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(found, at, change, branching, suspected);
    }
  };

  bool is_known(const Found& found) const;
  std::optional<Arc> begin();
  std::optional<Arc> begin_at_branch_point();
  std::optional<Arc> advance(double s);
  std::optional<Step> take(double s);
  std::optional<Step> take_clear_of_singular(double s);
  void stop_at(const TargetValue& landed, const PathPoint& to);
  void stop_at(const std::vector<Event>& events);
  bool trustworthy(const PathPoint& to, double s, double& turn) const;
  bool hides_two_zeros(const Segment& segment, double part) const;
  State predicted(double s) const;

  struct GuardCrossing {
    Index guard;
    double t;
  };
  std::optional<GuardCrossing> first_crossing(const Segment& segment) const;
  bool land(Step& step, GuardCrossing crossing);
  bool lands_where_it_began(const PathPoint& at, Index guard) const;
  bool leads_to_continuum(const Step& step) const;
  Direction tangent_from(const PathPoint& from, const PathPoint& to) const;

  bool find_singular(const PathPoint& to, std::vector<Singular>& found);
  bool find_limit_point(const PathPoint& to, std::vector<Singular>& found);
  bool find_branch_points(const PathPoint& to, std::vector<Singular>& found);
  bool find_touching_limit(const Segment& segment, std::vector<Singular>& found);
  int change_at_limit(const PathPoint& at);
  void add_branch_point_at_limit(const PathPoint& before, const PathPoint& after, double half_width, Singular& limit);
  std::optional<PathPoint> beside(const Segment& segment, double t);
  bool made_by_nodes(const State& state) const;
  PathPoint point_at(const SingularPlace& place);
  Singular singular_at(const SingularPlace& place, double chord_dlambda);
  bool dips(const Segment& segment);
  class Middle;
  bool dips(const Segment& segment, Index here, Index there, Middle& middle);
  Vector values_of_modes(const PathPoint& modes_at, const PathPoint& values_at) const;
  bool rises_from_zero(const Segment& segment, Index there);
  StabilityCount count_behind(const PathPoint& beyond, Index change);
  std::optional<Found> earliest(const Segment& segment, const std::optional<Found>& already) const;
  class ZeroSearch;
  std::optional<PathPoint> locate(Found& found, const PathPoint& to);
  std::optional<PathPoint> correct_onto(const PathConstraint& constraint, const Segment& segment, double t);
  std::optional<PathPoint> correct_onto(const PathConstraint& constraint, const Segment& segment, State guess,
                                        double distance, Wanted wanted);
  void find_pairs(PathPoint& at);
  Event event_of(const Found& found, const PathPoint& at, const PathPoint& beyond, const StabilityCount& behind,
                 double length) const;
  std::vector<Event> events_of(const Singular& singular, const PathPoint& at, const PathPoint& beyond,
                               const StabilityCount& behind, double length) const;

  bool turn_corner(PathPoint& at, Index landed, double slack, std::vector<Event>& events);
  bool pass_limit(PathPoint& at, Index limit, double slack, std::vector<Event>& events);
  bool pass_shifted_limit(PathPoint& at, std::vector<Event>& events);
  enum class Effort { usual, patient };
  const Transition* enter_any(const std::vector<Transition>& transitions, const PathPoint& from,
                              std::optional<PathPoint>& after);
  std::optional<PathPoint> enter(const Transition& transition, const PathPoint& from, Effort effort = Effort::usual);
  void refine(const State& violated, double margin);
  void add_turns(const PathPoint& after, Event event, std::vector<Event>& events) const;
  Piece held_by(const Ray& ray, const State& corner) const;
  std::optional<Index> count_along(const Ray& ray, const State& corner);
  std::optional<Ray> choose(std::vector<Ray> rays, const PathPoint& at, std::optional<Index>& unstable);
  Event one_sided_branch_point(const PathPoint& before, const PathPoint& after) const;
  Direction open_direction(const Direction& direction, const Piece& piece) const;
  void add_corner_events(const PathPoint& before, const PathPoint& after, std::vector<Event>& events) const;

  Linearization& workspace(const Piece& piece) { return corrector_.factorized().workspace(piece); }
  // The pairs nearest zero that were known last.
  const NearNull& nearest() const { return here_.nearest.values.size() > 0 ? here_.nearest : nearest_; }
  PathPoint point_of(CorrectorResult result, const Direction& forward) const;
  PathPoint go_to(PathPoint point);
  void decide_count(PathPoint& point);
  std::vector<int> signs_at(const PathPoint& point) const;
  bool passes(const PathPoint& to, const State& place);
  std::optional<BranchEnd> end_where_known(const PathPoint& to, State* place = nullptr);
  std::nullopt_t rejected(StepOutcome outcome);
  void tell_ledger(const std::optional<Arc>& arc);
  void give_up();

  const System& system_;
  TraceOptions options_;
  std::vector<Watch> watched_;
  std::vector<EventDetector> detectors_;
  Corrector corrector_;
  Metric metric_;
  StabilityCounter counter_;
  StepControl step_;
  PathPoint here_;
  std::optional<PathPoint> before_;  // the point before here_, if the arc between is smooth, without its modes
  Vector values_before_;             // eigenvalues there of the modes of here_; NaN where a mode was not known
  std::vector<int> signs_;           // of each detector just after here_
  std::optional<Index> held_;        // negative eigenvalues just after here_, closed contacts held
  StabilityCount after_;             // the count just after here_
  std::vector<Singular> near_;       // located with the singular point here_ and just behind it
  Index vanishing_ = 0;              // eigenvalues that are zero at here_
  NearNull nearest_;                 // the pairs nearest zero that were known before here_
  CornerWorkspace corner_;
  BranchStart start_;
  // A corner and the ways, outward, that were taken from it or led to it, with all contacts open.
  struct Visited {
    State corner;
    std::vector<Direction> ways;

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(corner, ways);
    }
  };
  std::vector<Visited> visited_;
  std::optional<Arc> ahead_;  // the first point of a piece, behind a corner that was just passed
  std::vector<Ray> others_;   // rays of the last corner that were not taken
  std::optional<BranchEnd> end_;
  CorrectorStatus last_failure_ = CorrectorStatus::converged;
  std::optional<std::string> invalid_reason_;
  StepAttempt attempt_;   // under way
  bool refined_ = false;  // the last attempt ended with a finer description of its start
  int points_ = 0;
  int standing_ = 0;  // corners in a row at one place
};

}  // namespace arcwall
