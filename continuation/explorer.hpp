#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "continuation/metric.hpp"
#include "continuation/tracer.hpp"
#include "core/system.hpp"

namespace arcwall {

/// Policies of branch switching.
enum class BranchPolicy {
  primary,      ///< stay on the first branch
  most_stable,  ///< if the branch becomes unstable, switch to the one with fewest unstable directions
  all,          ///< trace every branch found, up to a depth
  jump,         ///< follow stable branches while λ continues; from a loss of stability, jump (ExploreOptions::jump)
};

/// Stores the outcome of a jump at constant λ.
struct JumpEnd {
  std::optional<State> state{};  ///< stable equilibrium; empty: none was found
  std::string why_none{};        ///< cause of an empty state
};

/// Options of an explorer.
struct ExploreOptions {
  BranchPolicy policy = BranchPolicy::primary;
  int depth = 2;                                                ///< greatest depth of a branch, for `all`
  std::vector<std::shared_ptr<const Observable>> preference{};  ///< of two mirror images, take that on which the first
                                                                ///< of these that changes increases
  double distance = 0.02;  ///< length of the first step from a branch point [path metric]
  std::function<JumpEnd(const Event& lost, const PathPoint& behind)> jump{};  ///< for `jump`: the jump from the event
                                                                              ///< `lost`; `behind`: the path behind it
};

/// Describes a branch.
struct BranchRecord {
  int id = 0;
  std::optional<int> parent{};                  ///< branch from which it bifurcates; empty: none
  std::shared_ptr<const BranchPoint> origin{};  ///< its branch point; null: none
  int depth = 0;                                ///< number of its ancestors
  int sign = 1;                                 ///< side of its branch point's mode: 1 or −1
  bool mirror_image = false;                    ///< the branch on the other side is its mirror image and is not traced
  bool found = false;                           ///< a disconnected branch, started by Explorer::begin_at()
  bool after_jump = false;                      ///< it starts where a jump from its parent ended
  std::optional<BranchEnd> end{};               ///< empty before the end
};

/// Returns the sense of a direction from a state in which the first of these quantities that changes increases: 1 or
/// −1. Empty: none changes.
std::optional<int> preferred_sense(const std::vector<std::shared_ptr<const Observable>>& preference, const State& state,
                                   const Vector& direction, const Metric& metric);

struct TriedWay;

/// Traces a branch and the branches that bifurcate from it, one after the other.
class Explorer {
 public:
  /// `system` must outlive this. `start`, `trace` and `watched` as for Tracer.
  Explorer(const System& system, State start, TraceOptions trace, std::vector<Watch> watched, ExploreOptions options);

  struct Step {
    int branch;
    Arc arc;
  };

  /// Returns the next arc of the current branch, or the first of the next branch. Empty when all have ended.
  std::optional<Step> next();

  /// Adds a disconnected branch from the equilibrium `found`; `sense` as in BranchStart. It is followed to its end, and
  /// unless the policy is `primary` all branches that bifurcate from it are traced under the policy.
  void begin_at(State found, int sense);

  const std::vector<BranchRecord>& branches() const { return branches_; }

  /// Returns the start point of the next step of the current branch, as Tracer::here(). Requires an arc of next().
  const PathPoint& departure() const { return tracer_->here(); }

  /// Ends the current branch at its last point.
  void end_branch(const BranchEnd& end) {
    if (tracer_ && !tracer_->end()) tracer_->stop(end);
  }

  /// Ends all branches at their last points.
  void stop(const BranchEnd& end);
  bool is_stopped() const { return stopped_; }

  /// Writes or reads the whole variable state, as Tracer::serialize().
  template <typename Archive>
  void serialize(Archive& archive) {
    bool under_way = tracer_ != nullptr;
    archive(lambda_scale_, current_, queue_, branches_, known_, not_left_, lost_, was_stable_, stopped_, under_way);
    archive.require(!not_left_ || not_left_->branching != nullptr);
    archive.require(!lost_ || under_way);
    archive.require(!lost_ || lost_->kind != EventKind::branch_point || lost_->branching != nullptr);
    const auto goes_on = [&](std::size_t branch) {
      return under_way && !stopped_ && static_cast<int>(branch) == current_;
    };
    for (std::size_t i = 0; i < branches_.size(); ++i) archive.require(branches_[i].end.has_value() || goes_on(i));
    if (!under_way) return;
    archive.require(current_ >= 0 && static_cast<std::size_t>(current_) < branches_.size());
    if constexpr (Archive::reads)
      tracer_ = make_tracer({.state = {.active_set = system_.open_active_set()}, .lambda_scale = lambda_scale_});
    tracer_->serialize(archive);
  }

 private:
  struct Queued {
    BranchStart start;
    BranchRecord record;
    std::optional<BranchEnd> ends{};  // at its first point

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(start, record, ends);
    }
  };

  const BranchRecord& here() const { return branches_[static_cast<std::size_t>(current_)]; }
  bool takes_every_way() const { return options_.policy == BranchPolicy::all || here().found; }
  std::unique_ptr<Tracer> make_tracer(BranchStart start) const;
  void look_at(const Event& event);
  void look_behind(const Event& event, const Arc& arc);
  void leave(const Event& event, const BranchPoint& point, const std::vector<TriedWay>& ways);
  void stop_unstable();
  void look_for_loss(const Arc& arc);
  void jump(const Event& lost);
  void enqueue(const Event& event, BranchStart start, int sign, bool mirror_image);
  void drop_arrived_at(int other);

  const System& system_;
  TraceOptions trace_;
  std::vector<Watch> watched_;
  ExploreOptions options_;
  std::unique_ptr<Tracer> tracer_;
  int current_ = 0;
  double lambda_scale_ = 1.0;
  std::deque<Queued> queue_;
  std::vector<BranchRecord> branches_;
  std::vector<KnownPoint> known_;
  std::optional<Event> not_left_{};  // the branch point just passed, off which no step has succeeded
  std::optional<Event> lost_{};      // at which the branch under way loses its stability, for `jump`
  bool was_stable_ = false;          // the branch under way, at one of its points
  bool stopped_ = false;
};

}  // namespace arcwall
