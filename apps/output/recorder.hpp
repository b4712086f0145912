#pragma once

#include <optional>

#include "apps/output/record.hpp"
#include "apps/study.hpp"

namespace arcwall {

/// A record of the study's deck and columns, without branches yet.
Record empty_record(const Study& study);

/// Adds one branch to a record, arc by arc.
class Recorder {
 public:
  /// `study` and `record` must outlive this. `branch` says where the branch leaves another; without it, it leaves none.
  Recorder(const Study& study, Record& record, const BranchRecord& branch = {});

  /// Goes on with the last branch of a record.
  static Recorder last_branch(const Study& study, Record& record) {
    return {study, record, record.branches.size() - 1};
  }

  /// The arc's end as a point, and its events.
  void add(const Arc& arc);

  /// The end of the branch, as an event of its last point. A branch without points has no such event.
  void end(const BranchEnd& end);

 private:
  Recorder(const Study& study, Record& record, std::size_t branch) : study_(study), record_(record), branch_(branch) {}

  RecordBranch& branch() { return record_.branches[branch_]; }
  RecordEvent recorded(const Event& event) const;
  void add_event(RecordEvent event);

  const Study& study_;
  Record& record_;
  std::size_t branch_;
};

}  // namespace arcwall
