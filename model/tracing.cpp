#include "model/tracing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "continuation/stops.hpp"
#include "core/text.hpp"
#include "model/build_path.hpp"
#include "model/record_parts.hpp"
#include "model/recorder.hpp"
#include "model/step_ledger.hpp"

namespace arcwall {

namespace {

// Every branch, one after the other.
class PathTracing final : public Tracing {
 public:
  // `reverses`: λ turns at the start.
  PathTracing(const Model& model, Record& record, const State& start, StepLedger ledger,
              std::unique_ptr<PathAnswers> answers, bool reverses = false)
      : model_(model),
        record_(record),
        reverses_(reverses),
        answers_(std::move(answers)),
        first_(static_cast<int>(record.branches.size())),
        explorer_(model.system(), start, options(ledger), model.watched(), explore()) {}

  bool advance() override {
    std::optional<Explorer::Step> step = explorer_.next();
    while (!step && begins_found_branch()) step = explorer_.next();
    if (!step) {
      finish();
      return false;
    }
    if (step->branch != branch_) {
      if (branch_ < 0 && reverses_) add_reversal(step->arc);
      close_branch();
      branch_ = step->branch;
      BranchRecord begun = branch();
      if (begun.parent) *begun.parent += first_;
      recorder_.emplace(model_, record_, begun);
      if (begun.after_jump) leads_here(*begun.parent);
    }
    recorder_->add(step->arc, explorer_.departure());
    const std::size_t first_event = record_.events.size() - step->arc.events.size();
    for (std::size_t i = 0; i < step->arc.events.size(); ++i)
      record_.events[first_event + i].sensitivity = answers_->sensitivities(step->arc, step->arc.events[i]);
    if (const auto end = answers_->end_of_branch()) explorer_.end_branch(*end);
    if (auto why = model_.adrift(step->arc.to.state))
      explorer_.stop({.reason = EndReason::rigid_body_motion, .detail = std::move(*why)});
    return true;
  }

  bool has_ended() const override { return finished_; }

  void stop(const BranchEnd& end) override { explorer_.stop(end); }

  void trace_also(std::vector<BranchStart> found) override { given_ = std::move(found); }

  void serialize(ArchiveWriter& archive) override { visit(archive); }
  void serialize(ArchiveReader& archive) override {
    visit(archive);
    archive.require(first_ >= 0 && first_ + branch_ < static_cast<int>(record_.branches.size()) &&
                    branch_ < static_cast<int>(explorer_.branches().size()) &&
                    (branch_ < 0 || record_.branches.back().id == first_ + branch_) &&
                    (branch_ >= 0 || first_ > 0 || record_.points.empty()));
    if (branch_ >= 0) recorder_.emplace(Recorder::last_branch(model_, record_));
  }

 private:
  template <typename Archive>
  void visit(Archive& archive) {
    archive(first_, branch_, finished_, explorer_, *answers_);
  }

  TraceOptions options(StepLedger ledger) {
    TraceOptions options = model_.options();
    if (ledger == StepLedger::kept)
      options.ledger = [this](const StepAttempt& attempt) {
        record_.steps += ledger_line(model_, first_ + static_cast<Index>(explorer_.branches().size()) - 1, attempt);
      };
    return options;
  }

  // Jumps are told as events of the record, which has the arc that ends at the event.
  ExploreOptions explore() {
    ExploreOptions options = model_.explore();
    options.jump = [this](const Event& lost, const PathPoint& behind) -> JumpEnd {
      Fall fall = answers_->fall(lost, behind);
      for (RecordEvent& event : record_.events)
        if (event.branch == record_.branches.back().id && event.kind == lost.kind && event.arc == lost.arc)
          event.jump = fall.jump;
      return {.state = std::move(fall.state), .why_none = "no state after a jump is known: " + fall.jump->why};
    };
    return options;
  }

  static void add_reversal(Arc& arc) {
    arc.events.push_back({.kind = EventKind::reversal,
                          .state = arc.to.state,
                          .arc = arc.to.arc,
                          .residual = arc.to.residual,
                          .unstable_before = arc.to.count.unstable,
                          .unstable_after = arc.to.count.unstable});
  }

  // The branch that has begun is where a jump from this one ended.
  void leads_here(Index parent) {
    RecordBranch& here = record_.branches.back();
    for (RecordEvent& event : record_.events) {
      if (event.branch != parent || !event.jump) continue;
      RecordJump jump = *event.jump;
      jump.on_branch = here.id;
      jump.point = record_.points.size();
      event.jump = std::make_shared<const RecordJump>(std::move(jump));
      here.origin = event.id;
    }
  }

  const BranchRecord& branch() const { return explorer_.branches()[static_cast<std::size_t>(branch_)]; }

  // Where all branches have ended, one more may begin at an equilibrium beside them.
  bool begins_found_branch() {
    if (finished_ || branch_ < 0 || explorer_.is_stopped()) return false;
    close_branch();
    if (next_given_ < given_.size()) {
      BranchStart& given = given_[next_given_++];
      explorer_.begin_at(std::move(given.state), given.sense);
      return true;
    }
    std::optional<BranchStart> start = answers_->next_start();
    if (start) explorer_.begin_at(std::move(start->state), start->sense);
    return start.has_value();
  }

  void close_branch() {
    if (!recorder_) return;
    BranchEnd end = branch().end.value();
    if (end.partner) *end.partner += first_;
    if (end.reason == EndReason::switched_branch || end.reason == EndReason::jumped)
      end.detail = detail_of_partner(end.reason, *end.partner);
    recorder_->end(end);
    recorder_.reset();
  }

  void finish() {
    if (std::exchange(finished_, true)) return;
    if (branch_ < 0) {  // not even a start: the branch has no points, but an end
      recorder_.emplace(model_, record_);
      branch_ = 0;
    }
    close_branch();
  }

  const Model& model_;
  Record& record_;
  bool reverses_;
  std::unique_ptr<PathAnswers> answers_;
  int first_;  // of the branches that the explorer counts from 0
  Explorer explorer_;
  std::vector<BranchStart> given_;  // which no checkpoint keeps
  std::size_t next_given_ = 0;
  std::optional<Recorder> recorder_;
  int branch_ = -1;
  bool finished_ = false;
};

// The stages of a deck, each from where the one before has stopped.
class StageTracing final : public Tracing {
 public:
  StageTracing(Model& model, Record& record, const State& start, StepLedger ledger, const Answers& answers)
      : model_(model), record_(record), ledger_(ledger), answers_(answers) {
    begin(0, start);
  }

  bool advance() override {
    if (tracing_->advance()) return true;
    if (!goes_on()) return false;
    const State last = record_.points.back().state;
    const Model& ended = model_.at_stage(stage_);
    model_.begin_stage(ended.end_in(last));
    begin(stage_ + 1, model_.at_stage(stage_ + 1).taken_over(last, ended));
    return tracing_->advance();
  }

  bool has_ended() const override { return tracing_->has_ended() && !goes_on(); }

  void stop(const BranchEnd& end) override { tracing_->stop(end); }

  void serialize(ArchiveWriter& archive) override { archive(stage_, *tracing_); }
  void serialize(ArchiveReader& archive) override {
    Index stage = 0;
    archive(stage);
    archive.require(stage == static_cast<Index>(model_.ended_stages().size()));
    const System& system = model_.at_stage(stage).system();
    const ActiveSet open = system.open_active_set();
    begin(stage, State{.x = Vector::Zero(system.size(open)), .lambda = 0.0, .active_set = open});
    archive(*tracing_);
  }

 private:
  void begin(Index stage, const State& start) {
    stage_ = stage;
    const Model& model = model_.at_stage(stage);
    const std::vector<StageEnd>& ended = model_.ended_stages();
    auto answers = answers_.of_paths(model, record_, std::vector(ended.begin(), ended.begin() + stage));
    tracing_ = std::make_unique<PathTracing>(model, record_, start, ledger_, std::move(answers), drives_back(stage));
  }

  // Whether a stage drives something back that an earlier one has driven. Without friction that changes nothing.
  bool drives_back(Index stage) const {
    if (!record_.has_friction) return false;
    const std::vector<deck::Stage>& stages = model_.whole_deck().stages;
    const deck::Stage& now = stages[static_cast<std::size_t>(stage)];
    const double step = model_.at_stage(stage).deck().path.step;
    return std::any_of(now.drives.begin(), now.drives.end(), [&](const std::string& thing) {
      for (Index before = stage - 1; before >= 0; --before)
        if (drives(stages[static_cast<std::size_t>(before)], thing)) return last_sense(before) * step < 0.0;
      return false;
    });
  }

  // The sign of the rate of λ where a stage has ended.
  double last_sense(Index stage) const {
    for (auto point = record_.points.rbegin(); point != record_.points.rend(); ++point)
      if (record_.stage_number(point->branch) == stage && point->rates) return point->rates->lambda;
    return 0.0;
  }

  // A bound or an event of `stop` ends a stage; what ends it otherwise ends the run.
  bool goes_on() const {
    const auto& end = record_.branches.back().end;
    return stage_ + 1 < static_cast<Index>(record_.stages.size()) && end && end->reason == EndReason::stop &&
           !record_.points.empty();
  }

  Model& model_;
  Record& record_;
  StepLedger ledger_;
  const Answers& answers_;
  Index stage_ = 0;
  std::unique_ptr<PathTracing> tracing_;
};

// The deck's load increments: one branch.
class IncrementTracing final : public Tracing {
 public:
  IncrementTracing(Model& model, Record& record, const State& start, StepLedger ledger)
      : model_(model),
        record_(record),
        ledger_(ledger),
        levels_(load_levels(model.deck().path)),
        increments_(model.increments(start)),
        recorder_(model, record) {}

  bool advance() override {
    if (!end_ && record_.points.empty()) {
      recorder_.add(increments_.start());
      return true;
    }
    if (!end_ && taken_ == levels_.size()) end_ = all_taken();
    if (!end_) {
      if (const auto arc = increments_.to(levels_[taken_])) {
        ++taken_;
        const RecordPoint before = record_.points.back();
        recorder_.add(*arc);
        if (ledger_ == StepLedger::kept)
          record_.steps += ledger_line(model_, 0,
                                       {.arc = before.arc,
                                        .radius = arc->to.arc - before.arc,
                                        .iterations = 1,
                                        .residual = arc->to.residual,
                                        .accepted = &*arc});
        end_ = bound_met(before.state, *arc);
        return true;
      }
      end_ = increments_.end();
    }
    if (!std::exchange(finished_, true)) recorder_.end(*end_);
    return false;
  }

  bool has_ended() const override { return finished_; }

  void stop(const BranchEnd& end) override {
    if (!end_) end_ = end;
  }

  void serialize(ArchiveWriter& archive) override { visit(archive); }
  void serialize(ArchiveReader& archive) override {
    visit(archive);
    archive.require(taken_ <= levels_.size() && record_.branches.size() == 1);
    for (std::size_t i = 1; i < record_.points.size(); ++i) increments_.repeat(record_.points[i].state);
  }

 private:
  template <typename Archive>
  void visit(Archive& archive) {
    archive(taken_, finished_, end_, increments_);
  }

  std::optional<BranchEnd> bound_met(const State& before, const Arc& arc) const {
    const TraceOptions& options = model_.options();
    const State& after = arc.to.state;
    if (auto met = stop_at_bounds(options, before, after)) return met;
    for (const StopEvent& stop : options.stop_events)
      if (std::any_of(arc.events.begin(), arc.events.end(), [&](const Event& e) { return e.kind == stop.kind; }))
        return BranchEnd{.reason = EndReason::stop, .detail = stop.label};
    const Index closed = model_.closed_contacts(after);
    if (options.stop_contacts && closed >= *options.stop_contacts)
      return BranchEnd{.reason = EndReason::stop, .detail = "contacts = " + std::to_string(closed)};
    if (static_cast<int>(record_.points.size()) >= options.max_points)
      return BranchEnd{.reason = EndReason::max_points, .detail = std::to_string(options.max_points) + " points"};
    return std::nullopt;
  }

  BranchEnd all_taken() const {
    std::string detail = "lambda = " + round_trip(record_.points.back().lambda);
    if (increments_.unsettled() > 0)
      detail += fmt::format("; contacts did not converge in {} increments", increments_.unsettled());
    return {.reason = EndReason::stop, .detail = detail};
  }

  Model& model_;
  Record& record_;
  StepLedger ledger_;
  std::vector<double> levels_;
  LoadIncrements increments_;
  Recorder recorder_;
  std::size_t taken_ = 0;
  std::optional<BranchEnd> end_;
  bool finished_ = false;
};

}  // namespace

std::unique_ptr<Tracing> make_tracing(Model& model, Record& record, const State& start, StepLedger ledger,
                                      const Answers& answers) {
  if (model.in_increments()) return std::make_unique<IncrementTracing>(model, record, start, ledger);
  if (!record.stages.empty()) return std::make_unique<StageTracing>(model, record, start, ledger, answers);
  return std::make_unique<PathTracing>(model, record, start, ledger, answers.of_paths(model, record, {}));
}

}  // namespace arcwall
