#pragma once

#include <optional>

#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// A record of the model's deck and columns, without branches yet.
Record empty_record(const Model& model);

/// Adds one branch to a record, arc by arc.
class Recorder {
 public:
  /// `model` and `record` must outlive this. `branch` says where the branch leaves another; without it, it leaves none.
  Recorder(const Model& model, Record& record, const BranchRecord& branch = {});

  /// The same of a system of a program, without contacts, of which no monitors are read off.
  Recorder(const System& system, Record& record, const BranchRecord& branch = {});

  /// Goes on with the last branch of a record.
  static Recorder last_branch(const Model& model, Record& record) {
    return {&model, model.system(), record, record.branches.size() - 1};
  }

  /// The arc's end as a point, and its events. `leaves`: where the next arc begins, which has another tangent if the
  /// active set has changed.
  void add(const Arc& arc, const PathPoint& leaves);
  void add(const Arc& arc) { add(arc, arc.to); }

  /// The end of the branch, as an event of its last point. A branch without points has no such event.
  void end(const BranchEnd& end);

 private:
  Recorder(const Model* model, const System& system, Record& record, std::size_t branch)
      : model_(model), system_(system), record_(record), branch_(branch) {}

  void begin(const BranchRecord& branch);
  RecordBranch& branch() { return record_.branches[branch_]; }
  /// `at`: the state that the point of the event tells.
  RecordEvent recorded(const Event& event, const State& at) const;
  std::vector<double> values(const State& state, const std::vector<double>& dissipation) const;
  std::vector<double> dissipation_at_start() const;
  std::vector<double> dissipation_until(const PathTangent& arrives, const PathPoint& to) const;
  std::vector<RecordSlip> slips_behind(const State& event, const PathPoint& behind) const;
  void add_event(RecordEvent event);

  const Model* model_;  // null for a system of a program
  const System& system_;
  Record& record_;
  std::size_t branch_;
};

}  // namespace arcwall
