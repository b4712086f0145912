#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "continuation/tracer.hpp"
#include "core/system.hpp"

namespace arcwall {

/// What is done at branch points.
enum class BranchPolicy {
  primary,      ///< stay on the first branch through every branch point
  most_stable,  ///< where the branch ahead is unstable, take the bifurcated one: the one with fewest unstable
                ///< directions
  all,          ///< trace every branch found, to a depth
};

struct ExploreOptions {
  BranchPolicy policy = BranchPolicy::primary;
  int depth = 2;                                                ///< branches of branches, for `all`
  std::vector<std::shared_ptr<const Observable>> preference{};  ///< of two mirror images the side on which the first of
                                                                ///< these that changes increases
  double distance = 0.02;                                       ///< of the first step off a branch point [path metric]
};

/// A branch of the graph.
struct BranchRecord {
  int id = 0;
  std::optional<int> parent{};                  ///< the branch it leaves
  std::shared_ptr<const BranchPoint> origin{};  ///< where it leaves
  int depth = 0;
  int sign = 1;               ///< side of its branch point's mode
  bool mirror_image = false;  ///< the other side is its mirror image and not traced
  bool found = false;         ///< it leaves no branch: it begins at a state that was found
  std::optional<BranchEnd> end{};
};

struct TriedWay;

/// Traces a branch and those that leave it, one after the other, by a policy.
class Explorer {
 public:
  /// `system` must outlive this.
  Explorer(const System& system, State start, TraceOptions trace, std::vector<Watch> watched, ExploreOptions options);

  struct Step {
    int branch;
    Arc arc;
  };

  /// The next arc of the branch under way, or the first of the next branch. Empty when all have ended.
  std::optional<Step> next();

  /// A branch more, from a state that no other one passes through, with λ growing or falling (`sense`). It does not
  /// change over to branches that leave it, whatever is done on the others.
  void begin_at(State found, int sense);

  const std::vector<BranchRecord>& branches() const { return branches_; }

  /// Ends the branch under way where it is, unless it has ended.
  void end_branch(const BranchEnd& end) {
    if (tracer_ && !tracer_->end()) tracer_->stop(end);
  }

  /// Ends everything where it is.
  void stop(const BranchEnd& end);
  bool is_stopped() const { return stopped_; }

  /// Visits all that changes, as Tracer::serialize().
  template <typename Archive>
  void serialize(Archive& archive) {
    bool under_way = tracer_ != nullptr;
    archive(lambda_scale_, current_, queue_, branches_, known_, not_left_, stopped_, under_way);
    archive.require(!not_left_ || not_left_->branching != nullptr);
    const auto goes_on = [&](std::size_t branch) {
      return under_way && !stopped_ && static_cast<int>(branch) == current_;
    };
    for (std::size_t i = 0; i < branches_.size(); ++i) archive.require(branches_[i].end.has_value() || goes_on(i));
    if (!under_way) return;
    archive.require(current_ >= 0 && static_cast<std::size_t>(current_) < branches_.size());
    if constexpr (Archive::reads)
      tracer_ = make_tracer({.state = {.piece = system_.open_piece()}, .lambda_scale = lambda_scale_});
    tracer_->serialize(archive);
  }

 private:
  struct Queued {
    BranchStart start;
    BranchRecord record;

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(start, record);
    }
  };

  std::unique_ptr<Tracer> make_tracer(BranchStart start) const;
  void look_at(const Event& event);
  void look_behind(const Event& event, const Arc& arc);
  void leave(const Event& event, const BranchPoint& point, const std::vector<TriedWay>& ways);
  void stop_unstable();
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
  bool stopped_ = false;
};

}  // namespace arcwall
